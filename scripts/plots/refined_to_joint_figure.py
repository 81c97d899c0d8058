#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""cases/stability/refined_to_joint.png: the paper's unstable case with a step that is too long and with the stable one."""

import argparse
import sys

import matplotlib.pyplot as plt
from matplotlib.collections import LineCollection

import look
from fractures_figure import JOINT_COLOR
from run_data import MODES, Fractures, Run, RunError


def draw(runs, path):
    figure, grid = plt.subplots(1, 2, figsize=(11.5, 4.6), sharex=True, sharey=True)
    for axes, run in zip(grid, runs):
        time, frame = run.frames("fractures")[-1]
        fractures = Fractures(frame)
        axes.set_aspect("equal")
        axes.set_xlim(-800, 1400)
        axes.set_ylim(-800, 800)
        joints = fractures.segments[fractures.joint] * 1e3
        axes.add_collection(LineCollection(joints, colors=JOINT_COLOR, linewidths=1.8))
        for mode in MODES:
            lines = fractures.segments[fractures.broken & (fractures.mode == mode)] * 1e3
            axes.add_collection(LineCollection(lines, colors=look.MODE_COLORS[mode], linewidths=1.8))
        axes.add_patch(plt.Circle((0, 0), run.case["mesh"]["fine_radius"] * 1e3, fill=False, color="#8e99a3", linestyle=":"))
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        step = run.history["time_step_s"][-1] * 1e9
        title = f"step {step:.0f} ns, at {time * 1e3:.3g} ms: {int(fractures.broken.sum())} broken"
        look.name_axes(axes, title, "x [mm]", "y [mm]")
    figure.tight_layout()
    look.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("too_long", help="run folder with a step above the stable one")
    parser.add_argument("stable", help="run folder with the stable step")
    parser.add_argument("-o", "--output", default="cases/stability/refined_to_joint.png")
    args = parser.parse_args()
    try:
        draw([Run(args.too_long), Run(args.stable)], args.output)
    except RunError as error:
        sys.exit(f"refined_to_joint_figure.py: {error}")


if __name__ == "__main__":
    main()
