#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the wellbore pressure of several runs into one figure."""

import argparse
import sys

from run_data import Run, RunError

import look
import matplotlib.pyplot as plt


def draw(runs, labels, path):
    figure, axes = plt.subplots(figsize=(8.2, 5.0))
    colors = plt.get_cmap("tab10" if len(runs) <= 10 else "turbo")
    for i, (run, label) in enumerate(zip(runs, labels)):
        color = colors(i if len(runs) <= 10 else i / (len(runs) - 1))
        top = run.breakdown()
        if top is None:
            print(f"{run.folder}: no history yet, left out", file=sys.stderr)
            continue
        axes.plot(run.history["time_s"] * 1e3, run.history["pressure_Pa"] / 1e6, color=color, linewidth=1.3,
                  label=look.plain(f"{label}: {top[1] / 1e6:.2f} MPa at {top[0] * 1e3:.3f} ms"))
        axes.plot(top[0] * 1e3, top[1] / 1e6, "o", color=color, markersize=5)
    axes.set_xlabel("time [ms]")
    axes.set_ylabel("pressure [MPa]")
    axes.set_title("Wellbore pressure, the largest marked", loc="left", weight="bold")
    axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    axes.margins(x=0.01)
    if axes.lines:
        axes.legend(loc="best")
    figure.tight_layout()
    look.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", metavar="RUN_DIR", nargs="+")
    parser.add_argument("-o", "--output", metavar="FILE", required=True, help="figure to write (.png, .pdf, .svg)")
    parser.add_argument("--labels", nargs="+", metavar="TEXT", help="one a run (default: the folders' names)")
    arguments = parser.parse_args()
    try:
        runs = [Run(folder) for folder in arguments.runs]
        labels = arguments.labels or [run.folder.resolve().name for run in runs]
        if len(labels) != len(runs):
            raise RunError(f"{len(labels)} labels for {len(runs)} runs; give one a run")
        draw(runs, labels, arguments.output)
    except (RunError, OSError) as error:
        sys.exit(f"overlay_pressure: {error}")


if __name__ == "__main__":
    main()
