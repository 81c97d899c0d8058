# SPDX-License-Identifier: GPL-3.0-or-later
"""What the runs of scripts/chart_accuracy_speed answer, and by how much they err."""

import math

import numpy as np
from run_data import Fractures, Frame, Run

# Granite of AbuAisha et al. (2016) in all cases.
YOUNG, POISSON, DENSITY, ENERGY = 35e9, 0.27, 2500.0, 5.0
PLANE_STRAIN = YOUNG / (1.0 - POISSON**2)
SHEAR = 0.5 * YOUNG / (1.0 + POISSON)
P_SPEED = math.sqrt(YOUNG * (1.0 - POISSON) / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON)) / DENSITY)
TOUGHNESS = math.sqrt(PLANE_STRAIN * ENERGY)

# Quasi-static breakdown of a straight cohesive crack in intact rock, fluid in broken elements only [Pa]:
# linear softening of area G, and the curve of Evans and Marathe with the softening length 3 G / f.
BREAKDOWN_LINEAR, BREAKDOWN_Y_GEO = 12.45e6, 12.90e6


def measure(question, method, folder):
    """[(quantity, value, relative error or None)] of a run."""
    run = Run(folder)
    if question == "hole":
        return [shear_modulus(run)]
    if question == "pulse":
        return [wave_speed(run)]
    if question.startswith("breakdown"):
        return breakdown(run, method)
    if question == "plate":
        return plate(run)
    if question == "bar":
        return bar(run)
    if question == "slot":
        return slot(run)
    return crack(run)


def plate(run):
    """Peak stress of cases/accuracy_speed/plate.toml, and what it took to break it."""
    half, width, rise = 10e-3, 60e-3, 1.0724  # [m]; F of K = s sqrt(pi a) F for a third of the width
    stress = run.history["top_force_y_N_m"].max() / width
    spent = run.history["energy_fracture_J_m"][-1] / (ENERGY * (width - 2.0 * half))
    return [("peak_stress_Pa", stress, stress * rise * math.sqrt(math.pi * half) / TOUGHNESS - 1.0),
            ("dissipated_over_G", spent, spent - 1.0),
            ("energy_residual", run.summary["energy_residual_max"], None)]


def bar(run):
    """What it took to break cases/accuracy_speed/bar.toml."""
    spent = run.history["energy_fracture_J_m"][-1] / (50.0 * 25e-3)  # G [J/m2], width [m]
    return [("dissipated_over_G", spent, spent - 1.0), ("energy_residual", run.summary["energy_residual_max"], None)]


def slot(run):
    """Pressure at which the notch of cases/accuracy_speed/slot.toml begins to grow: the largest until something breaks.
    Reference: straight cohesive crack, linear softening, a = 4.29 l_ch, the fluid in its cohesive zone."""
    h = run.history
    broken = h["broken_tensile"] + h["broken_shear"] + h["broken_mixed"]
    until = int(np.argmax(broken > 0)) + 1 if broken[-1] > 0 else len(broken)
    value = h["pressure_Pa"][:until].max()
    reference = 0.9552 * TOUGHNESS / math.sqrt(math.pi * 10e-3)
    return [("growth_pressure_Pa", value, value / reference - 1.0),
            ("energy_residual", run.summary["energy_residual_max"], None)]


def shear_modulus(run):
    """Lame: dV/dp = V_0 / G, from the steady rise after the first waves."""
    h = run.history
    late = h["time_s"] > 0.15 * h["time_s"][-1]
    slope = np.polyfit(h["pressure_Pa"][late], h["cavity_volume_m2"][late], 1)
    value = slope[1] / slope[0]
    return "shear_modulus_Pa", value, value / SHEAR - 1.0


def crest(frame):
    """Radius of the largest radial velocity [m], by a parabola through the mean near it."""
    velocity, x = frame.cell_fields.get("velocity_m_s"), frame.points[frame.cells].mean(axis=1)
    if velocity is None:
        velocity, x = frame.point_fields["velocity_m_s"], frame.points
    radius = np.hypot(x[:, 0], x[:, 1])
    radial = (velocity[:, 0] * x[:, 0] + velocity[:, 1] * x[:, 1]) / np.maximum(radius, 1e-9)
    inside = (radius > 0.08) & (radius < 0.58)
    radius, radial = radius[inside], radial[inside] * np.sqrt(radius[inside])
    bins = (radius / 0.012).astype(int)
    mean = np.bincount(bins, radial) / np.maximum(1, np.bincount(bins))
    top = (np.argmax(mean) + 0.5) * 0.012
    near = np.abs(radius - top) < 0.025
    a, b, _ = np.polyfit(radius[near] - top, radial[near], 2)
    return top - 0.5 * b / a


def wave_speed(run):
    (t0, first), (t1, second) = run.frames("fields")[-2:]
    value = (crest(Frame(second)) - crest(Frame(first))) / (t1 - t0)
    return "p_wave_speed_m_s", value, value / P_SPEED - 1.0


def breakdown(run, method):
    value = run.summary["breakdown_pressure_Pa"]
    reference = BREAKDOWN_Y_GEO if method == "paper preset" else BREAKDOWN_LINEAR
    broken = run.summary["broken_length_m"]
    energy = run.history["energy_fracture_J_m"][-1] / broken if broken > 0.0 else math.nan
    return [("breakdown_pressure_Pa", value, value / reference - 1.0),
            ("energy_per_broken_area_J_m2", energy, energy / ENERGY - 1.0),
            ("energy_residual", run.summary["energy_residual_max"], None)]


def griffith(injected, fluid_modulus, notch):
    """(half-length, pressure) of a crack that needs K_Ic to grow, when so much has been injected."""
    def volume(a, p):
        return 2.0 * math.pi * p * a * a / PLANE_STRAIN

    def pressure(a):
        return TOUGHNESS / math.sqrt(math.pi * a)

    def missing(a, p):
        return injected - volume(a, p) * math.exp(p / fluid_modulus)

    low, high = notch, 100.0 * notch
    if missing(notch, pressure(notch)) <= 0.0:
        lower, upper = 0.0, pressure(notch)
        for _ in range(80):
            middle = 0.5 * (lower + upper)
            lower, upper = (middle, upper) if missing(notch, middle) > 0.0 else (lower, middle)
        return notch, lower
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if missing(middle, pressure(middle)) > 0.0 else (low, middle)
    return low, pressure(low)


def wings(segments):
    """2 where one wing is modelled and stands for both (field time, straight), else 1."""
    return 2.0 if segments[:, :, 0].min() > -1e-9 else 1.0


def broken_area(run, ends):
    """Of all broken edges; in field time along the fracture: there an edge stands for the smooth fracture."""
    if run.case["run"]["regime"] == "quasi_static":
        return wings(ends) * np.ptp(ends[:, :, 0])
    return np.hypot(*(ends[:, 1] - ends[:, 0]).T).sum()


def energy_per_area(run):
    """Dissipated per area broken, slope over the second half of the run: the cohesive zone only moves meanwhile."""
    h, frames = run.history, run.frames("fractures")
    area, energy = [], []
    for time, path in frames[len(frames) // 2:]:
        ends = Fractures(path).segments[np.asarray(Frame(path).cell_fields["broken"]) > 0]
        area.append(broken_area(run, ends))
        energy.append(np.interp(time, h["time_s"], h["energy_fracture_J_m"]))
    value = np.polyfit(area, energy, 1)[0] if area[-1] > area[0] else math.nan
    return "energy_per_area_J_m2", value, value / ENERGY - 1.0


def crack(run):
    """Pressure over the second half of the run, length and opening in its last three frames, energy per area."""
    h, case = run.history, run.case
    modulus, notch = case["fluid"]["bulk_modulus"], case["fracture"]["notch"]
    late = h["time_s"] > 0.5 * h["time_s"][-1]
    theory = np.array([griffith(v, modulus, notch)[1] for v in h["injected_m2"][late]])
    pressure = np.mean(h["pressure_Pa"][late] / theory) - 1.0
    length, width = [], []
    for time, path in run.frames("fractures")[-3:]:
        fractures, frame = Fractures(path), Frame(path)
        injected = np.interp(time, h["time_s"], h["injected_m2"])
        a, p = griffith(injected, modulus, notch)
        wet = fractures.segments[fractures.wet]
        length.append(0.5 * wings(wet) * (wet[:, :, 0].max() - wet[:, :, 0].min()) / a - 1.0)
        middle = np.argmin(np.abs(fractures.segments.mean(axis=1)[:, 0]))
        width.append(frame.cell_fields["opening_m"][middle] / (4.0 * p * a / PLANE_STRAIN) - 1.0)
    return [("pressure", pressure + 1.0, pressure), ("half_length", np.mean(length) + 1.0, np.mean(length)),
            ("opening_in_the_middle", np.mean(width) + 1.0, np.mean(width)),
            energy_per_area(run),
            ("energy_residual", run.summary["energy_residual_max"], None)]
