# SPDX-License-Identifier: GPL-3.0-or-later
"""What the figures of the gallery's cases share: the methods, crack paths and directions, closed forms."""

import math

import numpy as np

import look
import results_page

METHODS = {"demand": "cohesive edges on demand", "all": "cohesive edges everywhere", "damage": "smeared damage"}
COLORS = {"demand": look.INK, "all": look.WATER, "damage": look.ACCENT}
MARKERS = {"demand": "o", "all": "s", "damage": "^"}


def method_of(name):
    return name.split("-")[0]


def number(value, form):
    """Its text, or a dash where there is none."""
    return format(value, form) if math.isfinite(value) else "-"


def toughness(rock):
    """K_Ic [Pa m^0.5] of isotropic rock, plane strain."""
    return math.sqrt(rock["young_modulus"] / (1.0 - rock["poisson_ratio"] ** 2) * rock["fracture_energy_mode1"])


def peak_force(run, load, axis="y"):
    """Largest magnitude of a load's force [N/m] and its time [s]."""
    force = np.abs(run.history[f"{load}_force_{axis}_N_m"])
    top = int(np.argmax(force))
    return float(force[top]), float(run.history["time_s"][top])


def direction(run, tip, away_from, reach, until=float("inf")):
    """Direction [degrees from x] in which it broke from a tip, by length, within a reach [m]; NaN where nothing did.

    The line through the tip with the least squared distance to what broke on the side away from a point."""
    parts = results_page.broken(run, until)
    offset = parts[:, :2] - tip
    distance = np.hypot(*offset.T)
    outward = np.asarray(tip) - np.asarray(away_from)
    near = (distance < reach) & (offset @ outward > 0.0)
    if not near.any():
        return math.nan
    moment = (offset[near].T * parts[near, 2]) @ offset[near]
    values, vectors = np.linalg.eigh(moment)
    axis = vectors[:, int(np.argmax(values))]
    if axis @ outward < 0.0:
        axis = -axis
    return math.degrees(math.atan2(axis[1], axis[0]))


def draw_path(axes, run, method, **style):
    """What broke, as points in mm."""
    parts = results_page.broken(run)
    axes.plot(parts[:, 0] * 1e3, parts[:, 1] * 1e3, MARKERS[method], color=COLORS[method], markersize=2.6,
              markeredgewidth=0.0, **style)


def draw_lines(axes, run, key):
    """Notches or joints of a case, in mm."""
    for line in run.case.get(key, []):
        axes.plot([line["x1"] * 1e3, line["x2"] * 1e3], [line["y1"] * 1e3, line["y2"] * 1e3],
                  color=look.INK if key == "notches" else "#8a6d3b", linewidth=2.2 if key == "notches" else 1.4)


def cost(run):
    return float(run.summary["wall_s"]) if "wall_s" in run.summary else math.nan
