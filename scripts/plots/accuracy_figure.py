# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of scripts/chart_accuracy_speed: error against processor time, and what keeps breakdown from theory."""

import collections

import look
import matplotlib.pyplot as plt
import numpy as np
from look import FAINT, INK, WATER

PANELS = [  # (title, {question: (quantity, filled)}, label of the error)
    ("a  Stiffness of the rock and speed of P waves",
     {"hole": ("shear_modulus_Pa", True), "pulse": ("p_wave_speed_m_s", False)},
     "filled: shear modulus · hollow: P-wave speed"),
    ("b  Breakdown pressure of the wellbore at 65 l/s", {"breakdown": ("breakdown_pressure_Pa", True)},
     "quasi-static cohesive theory (12.45 MPa; paper preset: 12.90); field time: slowly, a straight path"),
    ("c  Pumped crack: pressure and length", {"straight": ("pressure", True), "free": ("half_length", False)},
     "filled: pressure, straight path · hollow: half-length, free path"),
    ("d  Energy dissipated per area of the crack", {"straight": ("energy_per_area_J_m2", True),
                                                    "free": ("energy_per_area_J_m2", False)},
     "filled: straight path · hollow: free path"),
    ("e  Peak stress of a plate with a slit; pressure of a notch", {"plate": ("peak_stress_Pa", True),
                                                                    "slot": ("growth_pressure_Pa", False)},
     "filled: plate, K_Ic: 2.286 MPa · hollow: pressed notch, cohesive theory: 2.341 MPa"),
    ("f  Energy dissipated in breaking them in two", {"plate": ("dissipated_over_G", True), "bar": ("dissipated_over_G", False)},
     "filled: plate · hollow: bar without a notch"),
]
COLORS = ["#111111", "#c9a227", "#e08e00", "#d7263d", "#8e1b3a", "#7b4fa3", "#1f6fb2", "#2a9d8f", "#7fb2d9", "#5c6f82",
          "#9aa5b1", "#0b6e4f", "#b56576", "#3d3dd8"]
MARKERS = ["s", "v", "v", "v", "v", "P", "o", "D", "<", ">", "X", "^", "*", "p"]
STUDY = "default, linear"  # at several rates: in the figure of its own
LEAST = 1e-3  # smaller errors are drawn here


def number(text):
    return float(text) if text not in ("", None) else np.nan


def points_of(rows, question, quantity):
    """{(method, size): (processor time, errors of the seeds)} at the case's own rate."""
    found = collections.defaultdict(list)
    for row in rows:
        if (row["question"], row["quantity"]) == (question, quantity) and row["method"] != STUDY:
            found[row["method"], float(row["size_mm"])].append((number(row["cpu_s"]), number(row["error"])))
    return {key: (np.mean([c for c, _ in v]), np.array([e for _, e in v])) for key, v in found.items()}


def front(points):
    """Keys on the Pareto front: none is both cheaper and better."""
    best, keys = np.inf, []
    for key, (_, errors) in sorted(points.items(), key=lambda item: item[1][0]):
        error = max(np.mean(np.abs(errors)), LEAST)
        if error < best:
            best = error
            keys.append(key)
    return keys


def draw_panel(axes, rows, panel, style):
    title, questions, note = panel
    look.name_axes(axes, title, "processor time of a run [s]", "relative error [%]")
    for question, (quantity, filled) in questions.items():
        points = points_of(rows, question, quantity)
        for (method, _), (cpu, errors) in points.items():
            color, marker = style[method]
            size = np.maximum(np.abs(errors), LEAST)
            mean = np.maximum(np.mean(size), LEAST)
            axes.plot(cpu, 100 * mean, marker, color=color, mfc=color if filled else "white", ms=6, zorder=4)
            if len(size) > 1:
                axes.plot([cpu, cpu], [100 * size.min(), 100 * size.max()], color=color, lw=1, zorder=3)
        for method in style:
            line = sorted((cpu, 100 * max(np.mean(np.abs(e)), LEAST))
                          for (m, _), (cpu, e) in points.items() if m == method)
            if len(line) > 1:
                axes.plot(*zip(*line), color=style[method][0], lw=0.7, alpha=0.5, zorder=2)
        if filled and points:
            keys = front(points)
            axes.plot([points[k][0] for k in keys], [100 * max(np.mean(np.abs(points[k][1])), LEAST) for k in keys],
                      color=FAINT, lw=5, alpha=0.35, zorder=1, solid_capstyle="round")
            for k in keys:
                axes.annotate(f"{k[1]:g} mm", (points[k][0], 100 * max(np.mean(np.abs(points[k][1])), LEAST)),
                              textcoords="offset points", xytext=(5, -9), fontsize=7, color=INK)
    if not any(points_of(rows, question, quantity) for question, (quantity, _) in questions.items()):
        look.say_empty(axes, "not run yet")
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.text(0.0, -0.2, note, transform=axes.transAxes, fontsize=7.5, color="#5b6873", va="top")


def draw_chart(rows, path):
    methods = [m for m in dict.fromkeys(row["method"] for row in rows) if m != STUDY]
    style = {m: (COLORS[i % len(COLORS)], MARKERS[i % len(MARKERS)]) for i, m in enumerate(methods)}
    figure, axes = plt.subplots(2, 3, figsize=(16, 9.4))
    for one, panel in zip(axes.flat, PANELS):
        draw_panel(one, rows, panel, style)
    handles = [plt.Line2D([], [], color=c, marker=m, ls="", label=name) for name, (c, m) in style.items()]
    handles.append(plt.Line2D([], [], color=FAINT, lw=5, alpha=0.35, label="Pareto front of the filled marks"))
    figure.legend(handles=handles, loc="lower center", ncol=5, bbox_to_anchor=(0.5, 0.0))
    figure.text(0.02, 0.985, "Error against processor time", fontsize=12.5, weight="bold", va="top")
    figure.text(0.02, 0.958, "one core; lines join the element sizes of a method (12, 6, 3 and 1.5 mm; plate and bar 2 and 1 mm, notch 1 and 0.5 mm); bars are the "
                "spread over mesh seeds", fontsize=9, color="#5b6873", va="top")
    figure.subplots_adjust(left=0.05, right=0.985, top=0.9, bottom=0.17, hspace=0.42, wspace=0.2)
    look.save(figure, path)


def draw_breakdown(rows, path):
    """Breakdown pressure by pump rate, element size and seed, against the theory for a slow, straight fracture."""
    theory = 12.45
    found = collections.defaultdict(list)
    for row in rows:
        if row["quantity"] == "breakdown_pressure_Pa" and row["method"] == STUDY:
            found[row["question"], number(row["rate_l_s"]), float(row["size_mm"])].append(float(row["value"]) / 1e6)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.4), sharey=True)
    look.name_axes(left, "Pump rate, elements of 3 mm", "pump rate [l/s]", "breakdown pressure [MPa]")
    look.name_axes(right, "Element size, at a tenth of the rate (6.5 l/s)", "element size [mm]", "")
    for question, color, marker, label in (("breakdown", WATER, "o", "path through the mesh: seeds, and their mean"),
                                           ("breakdown_straight", "#d7263d", "D", "edges along the straight path")):
        for axes, points in ((left, {r: v for (q, r, s), v in found.items() if q == question and s == 3}),
                             (right, {s: v for (q, r, s), v in found.items() if q == question and r == 6.5})):
            keys = sorted(points)
            for key in keys:
                axes.plot([key] * len(points[key]), points[key], marker, color=color, ms=4, alpha=0.4)
            axes.plot(keys, [np.mean(points[key]) for key in keys], marker=marker, color=color, lw=1.2, label=label)
    for axes in (left, right):
        axes.axhline(theory, color=INK, lw=1, ls="--")
        axes.axhspan(theory * 0.98, theory * 1.02, color=FAINT, alpha=0.2, lw=0)
        axes.set_xscale("log")
        axes.minorticks_off()
    left.set_xticks([6.5, 13, 32.5, 65], ["6.5", "13", "32.5", "65"])
    right.set_xticks([1.5, 3, 6, 12], ["1.5", "3", "6", "12"])
    left.text(6.5, theory - 0.01, "theory: 12.45 MPa; grey: ±2 %", fontsize=8, va="top")
    left.legend(loc="upper left")
    figure.tight_layout()
    look.save(figure, path)


def draw(rows, folder):
    draw_chart(rows, folder / "chart.png")
    if any(row["question"] == "breakdown_straight" for row in rows):
        draw_breakdown(rows, folder / "breakdown.png")
