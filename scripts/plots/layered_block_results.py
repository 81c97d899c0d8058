#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/layered_block from its sweep: results.csv, layered_block.png and the table of the README.

    layered_block_results.py SWEEP_DIR -o cases/layered_block
"""

import argparse
import pathlib
import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import look
import results_page
from run_data import Fractures, RunError

RATIOS, STEPS = [0.25, 0.5, 1, 2, 4], [1, 2]
METHODS = {"demand": ("edges on demand", look.INK, "o"), "damage": ("damage", look.ACCENT, "s"),
           "all": ("all edges", look.WATER, "^")}
HALF = 10e-3  # of the middle layer [m]
BEYOND = 1e-3  # an element's width beyond the interface counts as broken through [m]
TOUGHNESS = (35e9 / (1.0 - 0.2**2) * 5.0)**0.5  # [Pa m^0.5]


def pressure_for(half, step):
    """That holds a slit open up to `half` (Griffith), closed by `step` beyond HALF (adam.md 4.4)."""
    within = 2.0 / np.pi * np.arcsin(min(1.0, HALF / half))
    return TOUGHNESS / (np.pi * half)**0.5 + step * (1.0 - within)


def row_of(name, run):
    time, pressure = run.history["time_s"], run.history["pressure_Pa"]
    broken = results_page.broken(run)
    times = run.events["time_s"][~run.slips()]
    row = {"run": name, "first_MPa": "", "through_above_MPa": "", "through_below_MPa": "", "highest_mm": 0.0, "lowest_mm": 0.0}
    at = lambda when: float(np.interp(when, time, pressure) / 1e6)
    if len(times):
        row["first_MPa"] = at(times[0])
        row["highest_mm"], row["lowest_mm"] = float(broken[:, 1].max() * 1e3), float(broken[:, 1].min() * 1e3)
    for key, beyond in (("above", broken[:, 1] > HALF + BEYOND), ("below", broken[:, 1] < -HALF - BEYOND)):
        if beyond.any():
            row[f"through_{key}_MPa"] = at(times[beyond][0])
    row |= {"end_MPa": float(pressure[-1] / 1e6), "energy_residual_max": run.summary["energy_residual_max"],
            "triangles": run.summary["triangles"], "steps": run.summary["steps"]}
    return row


def through(row):
    values = [row[key] for key in ("through_above_MPa", "through_below_MPa") if row[key] != ""]
    return min(values) if values else None


def text(value, form="{:.2f}"):
    return form.format(value) if value not in ("", None) else "not"


def table(rows):
    lines = []
    for kind, values in (("modulus", RATIOS), ("stress", STEPS)):
        for value in values:
            cells = [f"E ratio {value:g}" if kind == "modulus" else f"stress step {value:g} MPa"]
            for method in METHODS:
                row = rows[f"{kind}-{value:g}-{method}"]
                cells += [text(row["first_MPa"]), text(through(row)), f"{row['highest_mm']:.0f}, {row['lowest_mm']:.0f}"]
            lines.append(cells)
    header = ["outer layers"] + [f"{METHODS[m][0]}: {what}" for m in METHODS
                                 for what in ("first break [MPa]", "through [MPa]", "reach [mm]")]
    return results_page.markdown(header, lines)


def draw(runs, rows, path):
    figure = plt.figure(figsize=(13.0, 7.6), layout="constrained")
    grid = figure.add_gridspec(len(METHODS), 5)
    shown = [("modulus", 0.25), ("modulus", 1), ("modulus", 4), ("stress", 2)]
    for i, (method, (label, _, _)) in enumerate(METHODS.items()):
        for j, (kind, value) in enumerate(shown):
            axes = figure.add_subplot(grid[i, j])
            fractures = Fractures(runs[f"{kind}-{value:g}-{method}"].frames("fractures")[-1][1])
            axes.axhspan(-10, 10, color="#f3ead8", zorder=0)
            for mode, color in look.MODE_COLORS.items():
                chosen = fractures.broken & (fractures.mode == mode)
                axes.add_collection(LineCollection(fractures.segments[chosen] * 1e3, colors=color, linewidths=1.1))
            axes.plot([0, 0], [-5, 5], color=look.WATER, linewidth=2.0, zorder=1)
            axes.set(xlim=(-22, 22), ylim=(-30, 30), aspect="equal")
            axes.set_title((f"E ratio {value:g}" if kind == "modulus" else f"stress step {value:g} MPa") + f", {label}",
                           fontsize=8.5, loc="left")
    axes = figure.add_subplot(grid[:2, 4])
    for method, (label, color, marker) in METHODS.items():
        points = [(r, through(rows[f"modulus-{r:g}-{method}"])) for r in RATIOS]
        points = [(r, p) for r, p in points if p is not None]
        axes.plot(*zip(*points), color=color, marker=marker, label=label) if points else None
    axes.axhline(pressure_for(HALF, 0.0) / 1e6, color=look.FAINT, linestyle="--")
    axes.set_xscale("log", base=2)
    look.name_axes(axes, "pressure as it breaks through", "modulus of the layer ahead over the crack's", "MPa")
    axes.legend(loc="best")
    axes = figure.add_subplot(grid[2, 4])
    for method, (label, color, marker) in METHODS.items():
        points = [(s, through(rows[f"{k}-{v:g}-{method}"])) for s, k, v in ((0, "modulus", 1), (1, "stress", 1), (2, "stress", 2))]
        points = [(s, p) for s, p in points if p is not None]
        axes.plot(*zip(*points), color=color, marker=marker) if points else None
    steps = np.linspace(0.0, 2.0, 20)
    axes.plot(steps, [pressure_for(HALF + BEYOND, 1e6 * s) / 1e6 for s in steps], color=look.FAINT, linestyle="--")
    look.name_axes(axes, "", "stress step [MPa]", "MPa")
    look.save(figure, path)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("sweep", type=pathlib.Path)
    arguments.add_argument("-o", "--output", type=pathlib.Path, required=True)
    options = arguments.parse_args()
    try:
        runs = results_page.runs_of(options.sweep)
        rows = {name: row_of(name, run) for name, run in runs.items()}
        results_page.write_csv(options.output / "results.csv", list(rows.values()))
        look.make_small()
        figure = options.output / "layered_block.png"
        draw(runs, rows, figure)
        look.shrink(figure)
        results_page.put_between(options.output / "README.md", "results", table(rows))
    except RunError as error:
        sys.exit(f"layered_block_results.py: {error}")


if __name__ == "__main__":
    main()
