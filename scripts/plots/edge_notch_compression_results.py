#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/edge_notch from its sweep: results.csv, edge_notch.png and the table of the README.

    edge_notch_results.py SWEEP_DIR -o cases/edge_notch
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

ANGLES = [0, 30, 60, 90]
METHODS = {"demand": "edges on demand", "damage": "damage"}
TIP = np.array([-17.929e-3, -7.071e-3])  # [m]


def cases():
    return ["ratio-1"] + [f"ratio-{r}-{a}" for r in (2, 3) for a in ANGLES]


def row_of(name, run):
    broken = results_page.broken(run)
    near = broken[np.hypot(*(broken[:, :2] - TIP).T) < 10e-3] if len(broken) else broken
    direction = ""
    if len(near) > 3:  # principal axis of what broke round the tip
        apart, weight = near[:, :2] - TIP, near[:, 2]
        xx, xy, yy = [(weight * a * b).sum() for a, b in ((apart[:, 0],) * 2, (apart[:, 0], apart[:, 1]), (apart[:, 1],) * 2)]
        direction = float(np.degrees(0.5 * np.arctan2(2.0 * xy, xx - yy)))
    force = np.abs(run.history["top_force_y_N_m"]) if "top_force_y_N_m" in run.history else np.zeros(1)
    times = run.events["time_s"]
    return {"run": name, "first_break_ms": float(times[0] * 1e3) if len(times) else "", "peak_kN_m": float(force.max() / 1e3),
            "direction_deg": direction, "broken_mm": float(broken[:, 2].sum() * 1e3) if len(broken) else 0.0,
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
            "steps": run.summary["steps"]}


def text(value, form):
    return form.format(value) if value != "" else "-"


def table(rows):
    lines = []
    for case in cases():
        cells = [case.replace("ratio-", "").replace("-", ", bedding at ") + ("°" if case.count("-") > 1 else "")]
        for method in METHODS:
            row = rows[f"{case}-{method}"]
            cells += [text(row["first_break_ms"], "{:.2f}"), text(row["peak_kN_m"], "{:.0f}"), text(row["direction_deg"], "{:+.0f}")]
        lines.append(cells)
    header = ["E_h/E_v"] + [f"{label}: {what}" for label in METHODS.values()
                            for what in ("first break [ms]", "peak force [kN/m]", "direction at the tip [deg]")]
    return results_page.markdown(header, lines)


def draw(runs, path):
    figure, grid = plt.subplots(len(METHODS), len(cases()), figsize=(15.0, 6.6), sharex=True, sharey=True, layout="constrained")
    for i, (method, label) in enumerate(METHODS.items()):
        for axes, case in zip(grid[i], cases()):
            run = runs[f"{case}-{method}"]
            fractures = Fractures(run.frames("fractures")[-1][1])
            for mode, color in look.MODE_COLORS.items():
                chosen = fractures.broken & (fractures.mode == mode)
                axes.add_collection(LineCollection(fractures.segments[chosen] * 1e3, colors=color, linewidths=1.0))
            axes.plot([-25, TIP[0] * 1e3], [0, TIP[1] * 1e3], color=look.WATER, linewidth=2.0)
            if case.count("-") > 1:
                angle = np.radians(float(case.split("-")[2]))
                axes.plot([15 - 6 * np.cos(angle), 15 + 6 * np.cos(angle)], [42 - 6 * np.sin(angle), 42 + 6 * np.sin(angle)],
                          color="#8d5524", linewidth=1.5)
            axes.set(xlim=(-25, 25), ylim=(-50, 50), aspect="equal")
            axes.set_title(f"{case.split('-')[1]}{', ' + case.split('-')[2] + '°' if case.count('-') > 1 else ''}", fontsize=8.5)
        grid[i][0].set_ylabel(label)
    figure.suptitle("E_h/E_v and bedding (brown); slit blue; broken in tension black, shear red, mixed orange", fontsize=10)
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
        figure = options.output / "edge_notch.png"
        draw(runs, figure)
        look.shrink(figure)
        results_page.put_between(options.output / "README.md", "results", table(rows))
    except RunError as error:
        sys.exit(f"edge_notch_results.py: {error}")


if __name__ == "__main__":
    main()
