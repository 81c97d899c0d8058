# SPDX-License-Identifier: GPL-3.0-or-later
"""pressure.png: wellbore pressure, volumes and broken elements over time."""

import matplotlib.pyplot as plt
import numpy as np

import look
from run_data import MODES, finite


def draw(run, path):
    figure, (top, middle, bottom) = plt.subplots(
        3, 1, figsize=(8.2, 7.6), sharex=True, gridspec_kw={"height_ratios": [3.0, 1.5, 1.2]})
    look.set_titles(figure, run, "Wellbore pressure")
    if run.history.get("time_s", np.zeros(0)).size < 2:
        for axes in (top, middle, bottom):
            look.say_empty(axes, "no history yet")
    else:
        draw_pressure(top, run)
        draw_volumes(middle, run)
        draw_broken(bottom, run)
    bottom.set_xlabel("time [ms]")
    figure.align_ylabels()
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, path)


def draw_pressure(axes, run):
    time, pressure = run.history["time_s"] * 1e3, run.history["pressure_Pa"] / 1e6
    axes.plot(time, pressure, color=look.WATER, linewidth=1.3)
    axes.set_ylabel("pressure [MPa]")
    axes.set_ylim(bottom=min(0.0, np.nanmin(pressure)))
    axes.set_xlim(time[0], time[-1])
    top = run.breakdown()
    if top is not None:
        at, value = top[0] * 1e3, top[1] / 1e6
        name, remark = ("breakdown", "") if run.has_broken() else ("largest", ", nothing broken")
        side = "left" if at < 0.2 * time[-1] else "right" if at > 0.8 * time[-1] else "center"
        axes.plot(at, value, "o", color=look.ACCENT, markersize=5, clip_on=False)
        axes.annotate(f"{name} {value:.2f} MPa at {at:.3f} ms{remark}", (at, value), xytext=(0, 7),
                      textcoords="offset points", ha=side, va="bottom", color=look.ACCENT)
        axes.set_ylim(top=max(1.15 * value, 1e-6))
    steady = run.summary.get("propagation_pressure_Pa")
    if finite(steady) and run.has_broken():
        last_tenth = time >= 0.9 * time[-1]
        axes.plot([0.9 * time[-1], time[-1]], [steady / 1e6] * 2, color=look.INK, linewidth=2.2, zorder=4,
                  solid_capstyle="butt")
        axes.annotate(f"propagation {steady / 1e6:.2f} MPa\n(mean of the last tenth)",
                      (time[-1], min(steady / 1e6, np.nanmin(pressure[last_tenth]))), xytext=(0, -7),
                      textcoords="offset points", ha="right", va="top", fontsize=8.5)


def draw_volumes(axes, run):
    time = run.history["time_s"] * 1e3
    injected = run.history["injected_m2"] * 1e4
    growth = (run.history["cavity_volume_m2"] - run.history["cavity_volume_m2"][0]) * 1e4
    axes.plot(time, injected, color=look.INK, linewidth=1.1, linestyle=(0, (5, 2)), label="injected")
    axes.plot(time, growth, color=look.WATER, linewidth=1.3, label="growth of the cavity")
    axes.fill_between(time, growth, injected, color=look.WATER, alpha=0.10, linewidth=0,
                      label="stored by compression")
    axes.set_ylabel("volume [cm²]")
    axes.legend(loc="upper left")


def draw_broken(axes, run):
    time = run.history["time_s"] * 1e3
    for mode, name in MODES.items():
        axes.step(time, run.history[f"broken_{name}"], where="post", color=look.MODE_COLORS[mode],
                  linewidth=1.2, label=name)
    axes.set_ylabel("broken elements")
    axes.set_ylim(bottom=0)
    if not run.has_broken():
        axes.set_ylim(0, 1)
        axes.set_yticks([0, 1])
    axes.legend(loc="upper left", ncol=3)
