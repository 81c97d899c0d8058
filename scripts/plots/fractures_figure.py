# SPDX-License-Identifier: GPL-3.0-or-later
"""fractures.png: fractures over the velocity magnitude at four times, as in Figure 6 of AbuAisha et al. (2016)."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, PowerNorm
from matplotlib.lines import Line2D

import look
from run_data import MODES, Fractures, Frame

# light enough for black and red lines to stand out on its upper end
SPEED_COLORS = LinearSegmentedColormap.from_list("speed", plt.get_cmap("YlGnBu")(np.linspace(0.0, 0.68, 256)))
YIELDING_COLOR = "#6d7680"
JOINT_COLOR = "#8d5524"


def draw(run, path):
    fields = run.frames("fields")
    chosen = choose(run, fields)
    rows, columns = (2, 2) if len(chosen) > 2 else (1, max(1, len(chosen)))
    width, height = max(4.2 * columns + 1.6, 7.4), 4.2 * rows + 1.5
    figure, grid = plt.subplots(rows, columns, figsize=(width, height), squeeze=False, sharex=True, sharey=True)
    look.set_titles(figure, run, "Fractures")
    if not chosen:
        look.say_empty(grid[0][0], "no frames yet")
        look.save(figure, path)
        return
    window = window_round([fractures for _, _, fractures in chosen], run, fields[-1][1])
    panels = [triangles_within(Frame(frame), window) for _, frame, _ in chosen]
    top = common_top([speed for _, _, speed in panels])
    unit, scale = ("m/s", 1.0) if top >= 0.1 else ("mm/s", 1e3)
    norm = PowerNorm(0.5, 0.0, top * scale)
    for axes in grid.flat[len(chosen):]:
        axes.set_visible(False)
    for axes, (time, _, fractures), (points, triangles, speed) in zip(grid.flat, chosen, panels):
        image = draw_panel(axes, (points, triangles, speed * scale), fractures, norm, window)
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        axes.set_title(f"t = {time * 1e3:.3f} ms", fontsize=10, loc="left")
        axes.set_title(f"{int(fractures.broken.sum())} broken", fontsize=9, loc="right", color="#5b6873")
    for axes in grid[-1]:
        axes.set_xlabel("x [mm]")
    for axes in grid[:, 0]:
        axes.set_ylabel("y [mm]")
    figure.tight_layout(rect=(0, 0.4 / height, 1.0 - 1.1 / width, look.below_titles(figure)))
    figure.canvas.draw()  # equal aspect moves the panels
    last, first = grid.flat[len(chosen) - 1].get_position(), grid.flat[0].get_position()
    right = max(axes.get_position().x1 for axes in grid.flat[:len(chosen)])
    bar = figure.colorbar(image, extend="max",
                          cax=figure.add_axes([right + 0.2 / width, last.y0, 0.16 / width, first.y1 - last.y0]))
    bar.set_label(f"velocity magnitude [{unit}]")
    add_legend(figure, any(fractures.joint.any() for _, _, fractures in chosen))
    look.save(figure, path)


def choose(run, fields):
    """At most four (time, fields file, Fractures): the last, and three spread over the time since something broke."""
    lines = dict(run.frames("fractures"))
    fields = without_twins(fields)
    frames = [(time, path, Fractures(lines.get(time))) for time, path in fields]
    broken = [frame for frame in frames if frame[2].broken.any()]
    if len(broken) < 4:
        return frames[-4:]
    return [broken[i] for i in np.linspace(0, len(broken) - 1, 4).round().astype(int)]


def without_twins(frames):
    """The end of a run often comes just after a regular frame, which then shows nothing of its own."""
    if len(frames) > 2:
        steps = np.diff([time for time, _ in frames])
        if steps[-1] < 0.25 * np.median(steps):
            return frames[:-2] + frames[-1:]
    return frames


def window_round(fractures, run, last_frame):
    """(left, right, bottom, top) [m] of what is shown in every panel."""
    radius = run.wellbore_radius
    low, high = np.array([-1.6, -1.6]) * radius, np.array([1.6, 1.6]) * radius
    places = np.concatenate([f.segments[f.broken].reshape(-1, 2) for f in fractures])
    if places.size:
        low, high = np.minimum(low, places.min(axis=0)), np.maximum(high, places.max(axis=0))
    elif radius > 0.0:
        low, high = np.array([-4.0, -4.0]) * radius, np.array([4.0, 4.0]) * radius
    else:
        points = Frame(last_frame).points
        low, high = points.min(axis=0), points.max(axis=0)
    # square panels, so that four times stand beside one another
    half = 0.5 * 1.16 * max(np.max(high - low), 1e-9)
    middle = 0.5 * (low + high)
    return middle[0] - half, middle[0] + half, middle[1] - half, middle[1] + half


def triangles_within(frame, window):
    """(points [mm], triangles, speed at the points) of the triangles that the window shows."""
    corners = frame.points[frame.cells]
    low, high = corners.min(axis=1), corners.max(axis=1)
    seen = ((high[:, 0] > window[0]) & (low[:, 0] < window[1]) & (high[:, 1] > window[2]) & (low[:, 1] < window[3]))
    used, triangles = np.unique(frame.cells[seen], return_inverse=True)
    velocity = frame.point_fields.get("velocity_m_s", np.zeros((len(frame.points), 2)))[used]
    return frame.points[used] * 1e3, triangles.reshape(-1, 3), np.linalg.norm(velocity, axis=1)


def common_top(speeds):
    """Upper end [m/s] of the one scale of colours; a single violent frame does not set it."""
    tops = [float(np.percentile(speed, 99.8)) for speed in speeds if speed.size]
    tops = [top for top in tops if top > 0.0]
    return float(np.median(tops)) if tops else 1.0


def draw_panel(axes, panel, fractures, norm, window):
    points, triangles, speed = panel
    axes.grid(False)
    axes.set_aspect("equal")
    axes.set_xlim(window[0] * 1e3, window[1] * 1e3)
    axes.set_ylim(window[2] * 1e3, window[3] * 1e3)
    for spine in axes.spines.values():
        spine.set_visible(True)
    image = axes.tripcolor(points[:, 0], points[:, 1], triangles, speed, shading="gouraud", cmap=SPEED_COLORS, norm=norm,
                           rasterized=True)
    yielding = fractures.segments[~fractures.broken & ~fractures.joint] * 1e3
    axes.add_collection(LineCollection(yielding, colors=YIELDING_COLOR, linewidths=0.6))
    for wet, width in ((False, 0.9), (True, 1.8)):
        joints = fractures.segments[fractures.joint & (fractures.wet == wet)] * 1e3
        axes.add_collection(LineCollection(joints, colors=JOINT_COLOR, linewidths=width, capstyle="round"))
    broken = fractures.segments[fractures.broken] * 1e3
    axes.add_collection(LineCollection(broken, colors="white", linewidths=3.0, alpha=0.8, capstyle="round"))
    for mode in MODES:
        lines = fractures.segments[fractures.broken & (fractures.mode == mode)] * 1e3
        axes.add_collection(LineCollection(lines, colors=look.MODE_COLORS[mode], linewidths=1.5, capstyle="round"))
    return image


def add_legend(figure, with_joints):
    handles = [Line2D([], [], color=look.MODE_COLORS[mode], linewidth=1.8, label=f"broken, {name}")
               for mode, name in MODES.items()]
    handles.append(Line2D([], [], color=YIELDING_COLOR, linewidth=0.8, label="yielding"))
    if with_joints:
        handles += [Line2D([], [], color=JOINT_COLOR, linewidth=0.9, label="joint"),
                    Line2D([], [], color=JOINT_COLOR, linewidth=1.8, label="wet joint")]
    figure.legend(handles=handles, loc="lower center", ncol=len(handles))
