# SPDX-License-Identifier: GPL-3.0-or-later
"""events.png: where, when and how large the events are, as in Figures 9 and 10 of AbuAisha et al. (2016)."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import look
from run_data import MODES

MODE_FILLS = {**look.MODE_COLORS, 1: "#5b6873"}


def draw(run, path):
    figure = plt.figure(figsize=(11.0, 5.9))
    layout = figure.add_gridspec(2, 2, width_ratios=[1.25, 1.0], left=0.07, right=0.98, bottom=0.09,
                                 top=look.below_titles(figure) - 0.03, wspace=0.38, hspace=0.42)
    place, over_time, counts = (figure.add_subplot(layout[:, 0]), figure.add_subplot(layout[0, 1]),
                                figure.add_subplot(layout[1, 1]))
    time = run.events.get("time_s", np.zeros(0))
    look.set_titles(figure, run, f"{len(time):,} seismic event{'s' * (len(time) != 1)}")
    look.name_axes(place, "Where", "x [mm]", "y [mm]")
    unit, _ = look.time_unit_of(run)
    look.name_axes(over_time, "Magnitudes over time", f"time [{unit}]", "magnitude")
    look.name_axes(counts, "How many of which magnitude", "magnitude  (log₁₀ E[J] − 4.8) / 1.5", "events")
    if len(time) == 0:
        for axes in (place, over_time, counts):
            look.say_empty(axes, "no events")
    else:
        draw_map(figure, place, run)
        draw_magnitudes(over_time, run)
        draw_counts(counts, run)
    look.save(figure, path)


def groups(run):
    """{key of the look: (name, which events)}: the modes of breaking, and slips of joints where there are any."""
    slips = run.slips()
    found = {mode: (name, (run.events["mode"] == name) & ~slips) for mode, name in MODES.items()}
    if slips.any():
        found[look.SLIP] = ("slip of a joint", slips)
    return found


def with_energy(run):
    """An event that released nothing has no magnitude."""
    return np.isfinite(run.events["magnitude"])


def lowest_shown(magnitude):
    """Where an axis of magnitudes begins: a few events of next to no energy, cut off by the run's end for example, would
    press all others together."""
    return max(magnitude.min(), np.percentile(magnitude, 2) - 1.0)


def say_below(axes, count):
    if count:
        axes.text(0.01, 0.02, f"{count} below", transform=axes.transAxes, fontsize=8, color="#5b6873")


def marker_sizes(magnitude):
    """Areas [pt²]: doubled by each 0.5 of magnitude, from the smallest but 2 % on."""
    known = magnitude[np.isfinite(magnitude)]
    low = np.percentile(known, 2) if known.size else 0.0
    steps = np.clip(np.nan_to_num(magnitude, nan=low, neginf=low, posinf=low) - low, 0.0, 2.5)
    return 9.0 * 2.0 ** (2.0 * steps)


def draw_map(figure, axes, run):
    events = run.events
    unit, seconds = look.time_unit_of(run)
    time = events["time_s"] / seconds
    sizes = marker_sizes(events["magnitude"])
    span = (time.min(), time.max()) if time.max() > time.min() else (0.0, run.history["time_s"][-1] / seconds)
    for mode, (_, chosen) in groups(run).items():
        dots = axes.scatter(events["x_m"][chosen] * 1e3, events["y_m"][chosen] * 1e3, s=sizes[chosen], c=time[chosen],
                            vmin=span[0], vmax=span[1], cmap="plasma", marker=look.MODE_MARKERS[mode],
                            edgecolors=look.INK, linewidths=0.3, alpha=0.9, zorder=2)
    look.draw_wellbore(axes, run.wellbore_radius * 1e3)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    figure.colorbar(dots, cax=axes.inset_axes([1.025, 0.0, 0.03, 1.0])).set_label(f"time [{unit}]")
    handles = [Line2D([], [], color="none", marker=look.MODE_MARKERS[mode], markerfacecolor="#b9c1c8",
                      markeredgecolor=look.INK, markeredgewidth=0.5, markersize=6,
                      label=f"{name} ({int(chosen.sum()):,})") for mode, (name, chosen) in groups(run).items()]
    axes.legend(handles=handles, loc="best", frameon=True, framealpha=0.9, edgecolor="none",
                title="size by magnitude", title_fontsize=8)


def draw_magnitudes(axes, run):
    _, seconds = look.time_unit_of(run)
    for mode, (name, chosen) in groups(run).items():
        chosen = chosen & with_energy(run)
        axes.scatter(run.events["time_s"][chosen] / seconds, run.events["magnitude"][chosen], s=11,
                     marker=look.MODE_MARKERS[mode], color=MODE_FILLS[mode], alpha=0.75, linewidths=0, label=name)
    known = run.events["magnitude"][with_energy(run)]
    if known.size:
        low = lowest_shown(known)
        axes.set_ylim(bottom=low - 0.1)
        say_below(axes, int((known < low).sum()))


def draw_counts(axes, run):
    magnitude = run.events["magnitude"][with_energy(run)]
    if magnitude.size == 0:
        look.say_empty(axes, "no event has an energy")
        return
    low = lowest_shown(magnitude)
    bins = np.arange(np.floor(low * 5.0) / 5.0, magnitude.max() + 0.2, 0.2)
    if len(bins) < 2:
        bins = bins[0] + np.array([0.0, 0.2])
    shown = groups(run)
    parts = [run.events["magnitude"][chosen & with_energy(run)] for _, chosen in shown.values()]
    axes.hist(parts, bins=bins, stacked=True, color=[MODE_FILLS[mode] for mode in shown],
              label=[name for name, _ in shown.values()], edgecolor="white", linewidth=0.6)
    say_below(axes, int((magnitude < bins[0]).sum()))
    median = np.median(magnitude)
    axes.axvline(median, color=look.INK, linewidth=1.0, linestyle=(0, (4, 2)))
    axes.set_title(f"median {median:.2f}", loc="right", fontsize=9, color="#5b6873")
    axes.grid(axis="x", visible=False)
    axes.locator_params(axis="x", nbins=6)
    axes.legend(loc="best")
