# SPDX-License-Identifier: GPL-3.0-or-later
"""catalog.png: how far events are when, cumulative moment against pressure, and how many exceed a magnitude."""

import matplotlib.pyplot as plt
import numpy as np

import look
from events_figure import groups, lowest_shown, say_below


def draw(run, path, b=None, completeness=None):
    figure = plt.figure(figsize=(11.0, 5.9))
    layout = figure.add_gridspec(2, 2, left=0.07, right=0.98, bottom=0.09, top=look.below_titles(figure) - 0.03,
                                 wspace=0.22, hspace=0.42)
    distance, moment = figure.add_subplot(layout[:, 0]), figure.add_subplot(layout[0, 1])
    counts = figure.add_subplot(layout[1, 1])
    events = run.events
    count = len(events.get("time_s", ()))
    look.set_titles(figure, run, f"catalog of {count:,} seismic event{'s' * (count != 1)}")
    unit, _ = look.time_unit_of(run)
    look.name_axes(distance, "Distance from the origin over time", f"time [{unit}]", "distance [mm]")
    look.name_axes(moment, "Cumulative moment and pressure", "wellbore pressure [MPa]", "Σ M0 [N m/m]")
    look.name_axes(counts, "How many exceed a magnitude", "magnitude", "events ≥ magnitude")
    if count == 0:
        for axes in (distance, moment, counts):
            look.say_empty(axes, "no events")
    else:
        draw_distance(distance, run)
        draw_moment(figure, moment, run)
        draw_exceeding(counts, events["magnitude"], b, completeness)
    look.save(figure, path)


def draw_distance(axes, run):
    _, seconds = look.time_unit_of(run)
    events = run.events
    reach = np.hypot(events["x_m"], events["y_m"]) * 1e3
    for key, (name, chosen) in groups(run).items():
        if chosen.any():
            axes.scatter(events["time_s"][chosen] / seconds, reach[chosen], s=13, marker=look.MODE_MARKERS[key],
                         color=look.MODE_COLORS[key], alpha=0.75, linewidths=0, label=f"{name} ({chosen.sum():,})")
    if run.wellbore_radius > 0.0:
        axes.axhline(run.wellbore_radius * 1e3, color=look.FAINT, linewidth=0.8)
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="best")


def scalar_moment(events):
    """M0 per metre of thickness of every event's tensor [N m/m]"""
    xx, yy, zz, xy = (events[f"moment_{name}_N_m_m"] for name in ("xx", "yy", "zz", "xy"))
    return np.sqrt(0.5 * (xx**2 + yy**2 + zz**2 + 2.0 * xy**2))


def draw_moment(figure, axes, run):
    """The path of a run in the plane of pressure and moment released so far."""
    history = run.history
    if "moment_xx_N_m_m" not in run.events or len(history.get("time_s", ())) < 2:
        look.say_empty(axes, "no moments or no pressure")
        return
    order = np.argsort(run.events["time_s"], kind="stable")
    total = np.concatenate([[0.0], np.cumsum(scalar_moment(run.events)[order])])
    time, pressure = history["time_s"], history["pressure_Pa"]
    released = total[np.searchsorted(run.events["time_s"][order], time, side="right")]
    unit, seconds = look.time_unit_of(run)
    line = axes.scatter(pressure / 1e6, released, c=time / seconds, s=6, cmap="plasma", linewidths=0)
    axes.plot(pressure / 1e6, released, color=look.FAINT, linewidth=0.6, zorder=1)
    figure.colorbar(line, ax=axes, pad=0.02).set_label(f"time [{unit}]")


def draw_exceeding(axes, magnitude, b, completeness):
    known = np.sort(magnitude[np.isfinite(magnitude)])
    if known.size == 0:
        look.say_empty(axes, "no event has an energy")
        return
    exceeding = np.arange(known.size, 0, -1)
    axes.step(known, exceeding, where="post", color=look.INK, linewidth=1.2)
    axes.set_yscale("log")
    axes.set_xlim(left=lowest_shown(known) - 0.1)
    say_below(axes, int((known < lowest_shown(known)).sum()))
    if b is not None and completeness is not None:
        above = np.count_nonzero(known >= completeness)
        ends = np.array([completeness, completeness + np.log10(max(above, 1)) / b])
        axes.plot(ends, above * 10.0 ** (-b * (ends - completeness)), color=look.ACCENT, linewidth=1.2,
                  linestyle=(0, (4, 2)), label=f"b = {b:.2f} from {completeness:.2f} on")
        axes.legend(loc="best")
