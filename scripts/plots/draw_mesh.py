#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a mesh that `crackle mesh CASE -o FILE.vtu` wrote, with its joints (FILE_joints.vtu), into FILE.png."""

import argparse
import pathlib
import sys

from run_data import Frame, RunError

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D

import look

SET_COLORS = ["#c0392b", "#1f6fb2", "#2e8b57", "#e08e00", "#7b4fa3", "#6d4c41", "#22303c", "#d81b60"]
CORE_COLOR = "#eceff1"
EDGE_COLOR = "#c3ccd4"


def read_joints(path):
    """(segments (n, 2, 2), set (n), joint (n)) of a file of joints; none if it is not there."""
    if not path.is_file():
        return np.zeros((0, 2, 2)), np.zeros(0, dtype=int), np.zeros(0, dtype=int)
    frame = Frame(path)
    return (frame.points[frame.cells], frame.cell_fields["joint_set"].astype(int),
            frame.cell_fields["joint"].astype(int))


def window_round(joints, mesh):
    """(left, right, bottom, top) [m] of the joints, a square; of a tenth of the mesh without joints."""
    places = joints.reshape(-1, 2) if len(joints) else 0.1 * mesh.points
    low, high = places.min(axis=0), places.max(axis=0)
    half, middle = 0.54 * max(high - low), 0.5 * (low + high)
    return middle[0] - half, middle[0] + half, middle[1] - half, middle[1] + half


def draw_panel(axes, mesh, joints, sets, window, with_triangles):
    left, right, bottom, top = window
    corners = mesh.points[mesh.cells]
    low, high = corners.min(axis=1), corners.max(axis=1)
    seen = (high[:, 0] > left) & (low[:, 0] < right) & (high[:, 1] > bottom) & (low[:, 1] < top)
    core = mesh.cell_fields.get("region", np.zeros(len(mesh.cells))) > 0.5
    axes.add_collection(PolyCollection(corners[core], facecolors=CORE_COLOR, edgecolors="none"))
    if with_triangles:
        axes.add_collection(PolyCollection(corners[seen], facecolors="none", edgecolors=EDGE_COLOR, linewidths=0.25,
                                           rasterized=True))
    for number in np.unique(sets):
        axes.add_collection(LineCollection(joints[sets == number], colors=SET_COLORS[number % len(SET_COLORS)],
                                           linewidths=1.0, capstyle="round"))
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x [m]")
    for spine in axes.spines.values():
        spine.set_visible(True)


def draw(path, output):
    mesh = Frame(path)
    joints, sets, numbers = read_joints(path.with_name(path.stem + "_joints.vtu"))
    figure, (whole, near) = plt.subplots(1, 2, figsize=(12.0, 6.4))
    box = mesh.points.min(axis=0), mesh.points.max(axis=0)
    window = window_round(joints, mesh)
    draw_panel(whole, mesh, joints, sets, (box[0][0], box[1][0], box[0][1], box[1][1]), len(mesh.cells) < 20000)
    draw_panel(near, mesh, joints, sets, window, True)
    whole.set_ylabel("y [m]")
    length = np.linalg.norm(joints[:, 1] - joints[:, 0], axis=1).sum()
    figure.suptitle(look.plain(f"{path.name}: {len(mesh.cells):,} triangles, {len(np.unique(numbers))} joints, "
                               f"{length:.3g} m of them"), x=0.02, ha="left", fontsize=11, weight="bold")
    handles = [Line2D([], [], color=SET_COLORS[n % len(SET_COLORS)], label=f"set {n + 1}") for n in np.unique(sets)]
    if handles:
        figure.legend(handles=handles, loc="lower center", ncol=8)
    figure.tight_layout(rect=(0, 0.05, 1, 0.97))
    look.save(figure, output)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh", metavar="FILE.vtu", type=pathlib.Path, help="written by `crackle mesh`")
    parser.add_argument("-o", "--output", metavar="FILE.png", help="default: FILE.png")
    parser.add_argument("--small", action="store_true", help="small files, for a repository")
    arguments = parser.parse_args()
    if arguments.small:
        look.make_small()
    output = arguments.output or arguments.mesh.with_suffix(".png")
    try:
        if not arguments.mesh.is_file():
            raise RunError(f"{arguments.mesh}: there is no such file")
        draw(arguments.mesh, output)
        if arguments.small:
            look.shrink(output)
    except (RunError, OSError) as error:
        sys.exit(f"draw_mesh: {error}")


if __name__ == "__main__":
    main()
