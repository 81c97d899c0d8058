#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/viscous_flow from its sweep: results.csv, figure and the README's table.

    viscous_flow_results.py SWEEP_DIR -o cases/viscous_flow
"""

import math

import matplotlib.pyplot as plt
import numpy as np

import look
import results_page
from run_data import Fractures, Frame

COLORS = ["#111111", "#1f6fb2", "#2a9d8f", "#e08e00", "#c0392b"]  # from no viscosity to water
TOUGHNESS_REGIME = 4.8  # K_m from which the pressure of a whole fracture is uniform (Dontsov 2017)


def label(viscosity):
    return f"{viscosity * 1e3:g} mPa s" if viscosity > 0.0 else "uniform pressure"


def toughness_number(run):
    """K_m of Dontsov (2017): what opens the rock over what drives the fluid; infinite without viscosity."""
    rock, fluid = run.case["rock"], run.case["fluid"]
    if fluid["viscosity"] == 0.0:
        return math.inf
    modulus = rock["young_modulus"] / (1.0 - rock["poisson_ratio"] ** 2)
    toughness = math.sqrt(modulus * rock["fracture_energy_mode1"])
    speed = 12.0 * fluid["viscosity"] * fluid["pump"][0]["rate"]
    return math.sqrt(32.0 / math.pi) * toughness / (modulus**3 * speed) ** 0.25


def row_of(name, run):
    s = run.summary
    return {"run": name, "viscosity_Pa_s": run.case["fluid"]["viscosity"], "size_mm": 1e3 * run.case["mesh"]["size_fine"],
            "K_m": toughness_number(run), "breakdown_MPa": s["breakdown_pressure_Pa"] * 1e-6,
            "breakdown_ms": s["breakdown_time_s"] * 1e3, "final_MPa": s["final_pressure_Pa"] * 1e-6,
            "extent_x_mm": s["extent_x_m"] * 1e3, "extent_y_mm": s["extent_y_m"] * 1e3,
            "broken_mm": s["broken_length_m"] * 1e3, "energy_residual_max": s["energy_residual_max"],
            "triangles": s["triangles"], "steps": s["steps"]}


def spread(rows, key, form):
    values = [row[key] for row in rows]
    mean = format(np.mean(values), form)
    return f"{mean} ± {format(np.std(values, ddof=1), form)}" if len(values) > 1 else mean


def table(rows):
    lines = []
    for size in sorted({row["size_mm"] for row in rows}, reverse=True):
        for viscosity in sorted({row["viscosity_Pa_s"] for row in rows}):
            chosen = [r for r in rows if (r["viscosity_Pa_s"], r["size_mm"]) == (viscosity, size)]
            number = chosen[0]["K_m"]
            lines.append([f"{label(viscosity)}, {size:g} mm", f"{number:.2f}" if math.isfinite(number) else "-",
                          spread(chosen, "breakdown_MPa", ".2f"), spread(chosen, "breakdown_ms", ".2f"),
                          spread(chosen, "final_MPa", ".2f"), spread(chosen, "extent_x_mm", ".0f"),
                          spread(chosen, "extent_y_mm", ".0f"), f"{max(r['energy_residual_max'] for r in chosen):.1e}"])
    return results_page.markdown(["viscosity, elements", "K_m", "breakdown [MPa]", "at [ms]", "at 3 ms [MPa]",
                                  "extent x [mm]", "y [mm]", "energy residual, largest"], lines)


def draw_along(axes, run, color, name):
    """Pressure in the fracture at the end, over the distance from the wellbore's middle."""
    path = run.frames("fractures")[-1][1]
    fractures, pressure = Fractures(path), np.asarray(Frame(path).cell_fields["pressure_Pa"])
    x = fractures.segments.mean(axis=1)[:, 0]
    axes.plot(x[fractures.wet] * 1e3, pressure[fractures.wet] * 1e-6, ".", color=color, markersize=4, label=name)


def draw(runs, rows, path):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13.5, 4.2), layout="constrained")
    least = min(row["size_mm"] for row in rows)
    for color, viscosity in zip(COLORS, sorted({row["viscosity_Pa_s"] for row in rows})):
        name = label(viscosity)
        row = next(r for r in rows if (r["viscosity_Pa_s"], r["size_mm"]) == (viscosity, least))
        run = runs[row["run"]]
        left.plot(run.history["time_s"] * 1e3, run.history["pressure_Pa"] * 1e-6, color=color, lw=1.2, label=name)
        draw_along(middle, run, color, name)
        at = max(viscosity, 1e-7) * 1e3  # no viscosity: at the left end
        for r in rows:
            if r["viscosity_Pa_s"] == viscosity:
                right.plot(at, r["breakdown_MPa"], "o" if r["size_mm"] > least else "D", color=color, ms=5,
                           mfc="white" if r["size_mm"] > least else color)
    look.name_axes(left, f"Pressure at the wellbore, {least:g} mm", "time [ms]", "pressure [MPa]")
    left.legend(loc="upper left")
    look.name_axes(middle, "Pressure along the fracture at 3 ms", "x [mm]", "pressure [MPa]")
    look.name_axes(right, f"Breakdown: {least:g} mm (full), coarser meshes (hollow)", "viscosity [mPa s]", "pressure [MPa]")
    right.set_xscale("log")
    right.set_xticks([1e-4, 1e-3, 1e-2, 1e-1, 1.0], ["none", "0.001", "0.01", "0.1", "1"])
    right.minorticks_off()
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows))
    draw(runs, rows, folder / "viscous_flow.png")


if __name__ == "__main__":
    results_page.main("viscous_flow", make, __doc__)
