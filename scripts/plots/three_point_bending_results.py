#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/three_point_bending from its sweep: results.csv, figure and the README's tables.

    three_point_bending_results.py SWEEP_DIR -o cases/three_point_bending
"""

import math

import matplotlib.pyplot as plt
import numpy as np

import gallery
import look
import results_page

HEIGHTS = (10e-3, 20e-3, 30e-3)  # above the notch [m]
SPREAD = 3e-3  # of what counts as at a height [m]


def offset(run, height):
    """Sideways distance of what broke from the notch's plane at a height above its tip [m], by length."""
    parts = results_page.broken(run)
    near = (np.abs(parts[:, 1] - height) < SPREAD) & (np.abs(parts[:, 0]) < 40e-3)
    return float(np.average(parts[near, 0], weights=parts[near, 2])) if near.any() else math.nan


def row_of(name, run):
    method, kind, eccentricity = name.split("-")
    force, time = gallery.peak_force(run, "striker")
    row = {"run": name, "method": method, "kind": kind, "eccentricity_mm": int(eccentricity), "peak_kN_m": force * 1e-3,
           "peak_time_ms": time * 1e3,
           "first_10mm_deg": 90.0 - gallery.direction(run, np.zeros(2), np.array([0.0, -0.05]), 10e-3)}
    row |= {f"x_at_{h * 1e3:.0f}mm_mm": 1e3 * offset(run, h) for h in HEIGHTS}
    return row | {"energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
                  "steps": run.summary["steps"]}


def table(rows):
    names = {"fast": "5 m/s", "slow": "0.3 m/s"}
    lines = [[f"{gallery.METHODS[r['method']]}, {names[r['kind']]}, e = {r['eccentricity_mm']} mm", f"{r['peak_kN_m']:.0f}",
              gallery.number(r["first_10mm_deg"], "+.0f")] + [gallery.number(r[f"x_at_{h * 1e3:.0f}mm_mm"], "+.1f") for h in HEIGHTS]
             + [f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["run", "peak force [kN/m]", "lean over the first 10 mm [°]", "x at 10 mm [mm]",
                                  "at 20 mm", "at 30 mm", "energy residual"], lines)


def gates(rows):
    """What the acceptance list asks for, and what came out."""
    known = {row["run"]: row for row in rows}
    slow = {m: max(abs(r["first_10mm_deg"]) for r in rows if r["run"].startswith(f"{m}-slow")) for m in ("demand", "damage")}
    lean = min(known[f"{m}-fast-20"]["first_10mm_deg"] for m in ("demand", "damage"))
    straight = max(abs(known[f"{m}-fast-0"][f"x_at_{h * 1e3:.0f}mm_mm"]) for m in ("demand",) for h in HEIGHTS)
    apart = max(abs(known[f"demand-{k}-{e}"][f"x_at_{h * 1e3:.0f}mm_mm"] - known[f"damage-{k}-{e}"][f"x_at_{h * 1e3:.0f}mm_mm"])
                for k in ("fast", "slow") for e in (0, 20) for h in HEIGHTS)
    lines = [["slow: lean over the first 10 mm, both eccentricities, edges", "5° at most", gallery.number(slow["demand"], ".1f") + "°"],
             ["the same, damage (coarse in directions)", "none", gallery.number(slow["damage"], ".1f") + "°"],
             ["fast, e = 20 mm: leans to the striker's side", "above 0°", gallery.number(lean, "+.1f") + "°"],
             ["fast, e = 0, edges: off the notch's plane", "2 mm (an edge) at most", gallery.number(straight, ".1f") + " mm"],
             ["damage against edges over 30 mm", "4 mm at most", gallery.number(apart, ".1f") + " mm"]]
    return results_page.markdown(["check", "gate", "got"], lines)


def draw(runs, path):
    figure, grid = plt.subplots(1, 4, figsize=(13.5, 4.3), layout="constrained", width_ratios=[1, 1, 1.2, 1.2])
    kinds = {"fast": "5 m/s", "slow": "0.3 m/s"}
    for axes, kind in zip(grid[:2], kinds):
        for method, name in gallery.METHODS.items():
            for eccentricity, alpha in ((0, 0.35), (20, 1.0)):
                if f"{method}-{kind}-{eccentricity}" in runs:
                    gallery.draw_path(axes, runs[f"{method}-{kind}-{eccentricity}"], method, alpha=alpha,
                                      label=f"{name}, e = {eccentricity} mm")
        axes.plot([0, 0], [-26, 0], color=look.INK, linewidth=2.2)
        axes.plot([15, 25], [50, 50], color="#8a6d3b", linewidth=4.0, solid_capstyle="butt")
        look.name_axes(axes, f"What broke, {kinds[kind]}", "x [mm]", "y above the notch [mm]")
        axes.set_aspect("equal")
        axes.set_xlim(-22, 32)
        axes.set_ylim(-26, 54)
        axes.legend(loc="lower right", fontsize=6.0)
    for axes, kind in zip(grid[2:], kinds):
        for method, name in gallery.METHODS.items():
            if f"{method}-{kind}-20" in runs:
                history = runs[f"{method}-{kind}-20"].history
                axes.plot(history["time_s"] * 1e3, -history["striker_force_y_N_m"] / 1e3, color=gallery.COLORS[method],
                          linewidth=1.0, label=name)
        look.name_axes(axes, f"Force of the striker, {kinds[kind]}, e = 20 mm", "time [ms]", "[kN per m of thickness]")
        axes.legend(loc="best", fontsize=7.5)
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows) + "\n" + gates(rows))
    draw(runs, folder / "three_point_bending.png")


if __name__ == "__main__":
    results_page.main("three_point_bending", make, __doc__)
