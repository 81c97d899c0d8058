# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of a run in field time: pressure.png (pressure, rate, volumes, length) and fractures.png
(opening and pressure along a straight fracture, frame by frame; of any other on a map, where it holds most)."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

import look
from run_data import Frame


def is_one(run):
    return "fracture_volume_m2" in run.history


def draw_history(run, path):
    history = run.history
    unit, seconds = look.time_unit_of(run)
    time = history["time_s"] / seconds
    figure, (top, middle, bottom) = plt.subplots(
        3, 1, figsize=(8.2, 7.6), sharex=True, gridspec_kw={"height_ratios": [3.0, 1.5, 1.5]})
    look.set_titles(figure, run, "Pressure, volumes and length")
    top.plot(time, history["pressure_Pa"] / 1e6, color=look.WATER, linewidth=1.3, label="well")
    top.plot(time, history["fracture_pressure_Pa"] / 1e6, color=look.INK, linewidth=0.9, linestyle=(0, (4, 2)),
             label="fracture, at the well")
    top.set_ylabel("pressure [MPa]")
    top.legend(loc="upper right")
    rate = top.twinx()
    rate.plot(time, history["rate_m3_s"] * 60.0, color=look.FAINT, linewidth=0.9)
    rate.set_ylabel("rate [m³/min]", color=look.FAINT)
    rate.set_ylim(0.0, 3.0 * max(float(history["rate_m3_s"].max()) * 60.0, 1e-12))
    rate.grid(False)
    for name, label, color in (("injected_m2", "injected", look.FAINT), ("fracture_volume_m2", "fracture", look.WATER),
                               ("leaked_m2", "leaked off", look.ACCENT), ("well_stored_m2", "well", look.INK)):
        middle.plot(time, history[name], color=color, linewidth=1.1, label=label)
    middle.set_ylabel("volume [m³/m]")
    middle.legend(loc="upper left", ncol=4)
    bottom.fill_between(time, history["broken_length_m"], history["damaged_length_m"], color=look.WATER, alpha=0.35,
                        linewidth=0, label="length of a wing: broken to damaged")
    bottom.set_ylabel("length [m]")
    closed = bottom.twinx()
    closed.plot(time, history["contact_fraction"], color=look.ACCENT, linewidth=1.0)
    closed.set_ylabel("faces in contact", color=look.ACCENT)
    closed.set_ylim(0.0, 1.05)
    closed.grid(False)
    bottom.legend(loc="upper left")
    bottom.set_xlabel(f"time [{unit}]")
    figure.align_ylabels()
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, path)


def draw_fracture(run, figure_path):
    """Profiles of a fracture along x; of any other its map where it holds most: at a shut-in as a rule."""
    frames = [(time, Frame(path)) for time, path in run.frames("fractures")]
    frames = [(time, frame) for time, frame in frames if "opening_m" in frame.cell_fields]
    if frames and np.ptp(frames[-1][1].points[:, 1]) > 0.0:
        history = run.history
        held = [np.interp(time, history["time_s"], history["fracture_volume_m2"]) for time, _ in frames]
        draw_map(run, *frames[int(np.argmax(held))], figure_path)
    else:
        draw_profiles(run, frames, figure_path)


def draw_map(run, time, frame, figure_path):
    lines = frame.points[frame.cells][:, :, :2]
    wide, high = 1.16 * np.ptp(lines[:, :, 0]), np.ptp(lines[:, :, 1]) + 0.16 * np.ptp(lines[:, :, 0])
    height = min(2.3 + 4.3 * high / wide, 8.0)
    figure, panels = plt.subplots(1, 2, figsize=(9.6, height), sharex=True, sharey=True)
    unit, seconds = look.time_unit_of(run)
    look.set_titles(figure, run, f"Fracture and joints at {time / seconds:.3g} {unit}")
    for axes, name, scale, label in zip(panels, ("opening_m", "pressure_Pa"), (1e3, 1e-6),
                                        ("opening [mm]", "pressure [MPa]")):
        values = LineCollection(lines, array=frame.cell_fields[name] * scale, cmap="viridis", linewidths=2.5)
        axes.add_collection(values)
        figure.colorbar(values, ax=axes, label=label, orientation="horizontal", pad=1.0 / height, aspect=30,
                        ticks=MaxNLocator(5))
        axes.plot(0.0, 0.0, marker="o", markersize=4, color=look.ACCENT)
        axes.set_aspect("equal")
        axes.set_xlabel("x [m]")
    margin = 0.08 * np.ptp(lines[:, :, 0])
    panels[0].set_xlim(lines[:, :, 0].min() - margin, lines[:, :, 0].max() + margin)
    panels[0].set_ylim(lines[:, :, 1].min() - margin, lines[:, :, 1].max() + margin)
    panels[0].set_ylabel("y [m]")
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, figure_path)


def draw_profiles(run, frames, figure_path):
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(8.2, 6.0), sharex=True)
    look.set_titles(figure, run, "Opening and pressure along the fracture")
    unit, seconds = look.time_unit_of(run)
    for number, (time, frame) in enumerate(frames):
        x = frame.points[frame.cells].mean(axis=1)[:, 0]
        order = np.argsort(x)
        color = plt.cm.viridis(number / max(len(frames) - 1, 1))
        top.plot(x[order], frame.cell_fields["opening_m"][order] * 1e3, color=color, linewidth=1.1,
                 label=f"{time / seconds:.3g} {unit}")
        bottom.plot(x[order], frame.cell_fields["pressure_Pa"][order] / 1e6, color=color, linewidth=1.1)
    top.set_ylabel("opening [mm]")
    bottom.set_ylabel("pressure [MPa]")
    bottom.set_xlabel("along the fracture [m]")
    if frames:
        top.legend(loc="upper right", ncol=3, fontsize=7)
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, figure_path)
