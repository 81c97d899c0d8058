#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws what `crackle dfit-analyse` wrote: record.png, g_function.png, sqrt_time.png, log_log.png, after_closure.png.

What a simulated test knows (closure stress, contact fraction, half length) is drawn over them.
"""

import argparse
import json
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from run_data import RunError, read_csv, shorten

import look

PICKS = {"isip": ("ISIP", "#1e8449", "s"), "contact_compliance": ("contact", look.ACCENT, "o"),
         "closure_tangent": ("tangent", "#8e44ad", "^"), "closure_sqrt_time": ("√t tangent", "#b9770e", "v"),
         "reservoir_pressure": ("reservoir", look.INK, "D")}
DERIVATIVE, PRODUCT = "#e08e00", "#6c3483"


class Analysis:
    """What the folder of an analysis holds; Pa are turned into MPa."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        for name in ("picks.json", "analysis.json", "fall_off.csv", "record.csv"):
            if not (self.folder / name).is_file():
                raise RunError(f"{folder}: holds no analysis ({name} is missing); run crackle dfit-analyse first")
        self.picks = {pick["name"]: pick for pick in self._json("picks.json")}
        self.facts = self._json("analysis.json")
        self.fall_off = read_csv(self.folder / "fall_off.csv")
        self.record = read_csv(self.folder / "record.csv")

    def _json(self, name):
        try:
            return json.loads((self.folder / name).read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{self.folder / name}: not JSON: {error}") from error

    @property
    def title(self):
        source = pathlib.Path(self.facts["record"])
        return f"DFIT of {source.parent.name if source.name == 'history.csv' else source.name}"

    def remarks(self):
        noise = self.facts["noise_Pa"]
        return (f"t_p = {self.facts['pump_time_s']:.4g} s, α = {self.facts['alpha']:g}, derivatives over "
                f"{self.facts['window_decades']:g} decades, noise "
                f"{'below 1 Pa' if noise < 1.0 else f'{noise:.0f} Pa' if noise < 1e3 else f'{1e-3 * noise:.1f} kPa'}")

    def mega(self, name):
        return 1e-6 * self.fall_off[name]

    def elapsed(self, name):
        """Time of a pick after shut-in [s]; None without it."""
        pick = self.picks[name]
        found = pick["value"] is not None and pick["time_s"] is not None
        return pick["time_s"] - self.facts["shut_in_s"] if found else None

    def at(self, elapsed, name):
        """A column of the fall-off at a time after shut-in."""
        return float(np.interp(elapsed, self.fall_off["elapsed_s"], self.fall_off[name]))

    def truth(self, name):
        return self.fall_off.get(name)


def mark_picks(axes, analysis, x, names):
    """Picks on the line of pressure over a column of the fall-off."""
    for name in names:
        elapsed = analysis.elapsed(name)
        if elapsed is None:
            continue
        label, color, marker = PICKS[name]
        value = 1e-6 * analysis.picks[name]["value"]
        place = analysis.at(elapsed, x) if elapsed > 0.0 else 0.0
        axes.plot(place, value, marker, color=color, markersize=6, zorder=6, clip_on=False, markeredgecolor="white",
                  markeredgewidth=0.7, label=f"{label} {value:.3f} MPa")


def draw_truth(axes, analysis, x, horizontal=True):
    """Closure stress as a line, contact fraction as a band from 0 to 1 along the foot of the axes."""
    stress = analysis.truth("closure_stress_Pa")
    if stress is not None and horizontal:
        axes.plot(x, 1e-6 * stress, color=look.FAINT, linewidth=1.0, linestyle=(0, (6, 3)), label="true closure stress")
    fraction = analysis.truth("contact_fraction")
    if fraction is not None:
        foot = axes.get_xaxis_transform()
        axes.fill_between(x, 0.0, 0.12 * fraction, transform=foot, color=look.FAINT, alpha=0.35, linewidth=0, zorder=0,
                          label="true contact fraction (0 to 1)")


def second_axis(axes, label, color):
    right = axes.twinx()
    right.spines["right"].set_visible(True)
    right.spines["right"].set_color(color)
    right.grid(False)
    right.tick_params(axis="y", colors=color)
    right.set_ylabel(label, color=color)
    return right


def legend_above(axes, *others, columns=4):
    handles, labels = [], []
    for part in (axes, *others):
        more = part.get_legend_handles_labels()
        handles += more[0]
        labels += more[1]
    axes.legend(handles, labels, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=columns, borderaxespad=0.2,
                handlelength=1.6, columnspacing=1.4)


def finish(figure, analysis, what, path):
    look.set_titles(figure, analysis, what)
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, path)


def draw_record(analysis, path):
    figure, (top, bottom) = plt.subplots(2, 1, figsize=(8.2, 7.4))
    record, shut_in, start = analysis.record, analysis.facts["shut_in_s"], analysis.facts["pump_start_s"]
    per_metre = "rate_m2_s" in record
    rate = 1e3 * record["rate_m2_s" if per_metre else "rate_m3_s"]
    pumping = shut_in - start
    shown = (record["time_s"] >= start - 0.15 * pumping) & (record["time_s"] <= shut_in + pumping)
    scale, unit = (60.0, "min") if pumping > 120.0 else (1.0, "s") if pumping > 1.0 else (1e-3, "ms")
    top.plot(record["time_s"][shown] / scale, 1e-6 * record["pressure_Pa"][shown], color=look.WATER, linewidth=1.3,
             label="pressure")
    top.set_xlabel(f"time [{unit}]")
    top.set_ylabel("pressure [MPa]", color=look.WATER)
    top.margins(x=0.02)
    right = second_axis(top, "rate [l/s per m]" if per_metre else "rate [l/s]", look.INK)
    right.plot(record["time_s"][shown] / scale, rate[shown], color=look.INK, linewidth=1.0, label="rate",
               drawstyle="steps-post")
    right.set_ylim(0.0, 2.5 * np.nanmax(rate))
    legend_above(top, right)

    time = analysis.fall_off["elapsed_s"]
    bottom.semilogx(time, analysis.mega("pressure_Pa"), color=look.WATER, linewidth=1.3, label="pressure")
    mark_picks(bottom, analysis, "elapsed_s", ("contact_compliance", "closure_tangent", "closure_sqrt_time"))
    for name in ("isip", "reservoir_pressure"):
        value = analysis.picks[name]["value"]
        if value is not None:
            label, color, _ = PICKS[name]
            bottom.axhline(1e-6 * value, color=color, linewidth=1.0, linestyle=(0, (1, 1.5)),
                           label=f"{label} {1e-6 * value:.3f} MPa")
    span = bottom.get_ylim()
    draw_truth(bottom, analysis, time)
    bottom.set_ylim(span)
    bottom.set_xlabel("time after shut-in [s]")
    bottom.set_ylabel("pressure [MPa]", color=look.WATER)
    length = analysis.truth("half_length_m")
    others = []
    if length is not None:
        others = [second_axis(bottom, "half length [m]", "#6e5a3c")]
        others[0].plot(time, length, color="#6e5a3c", linewidth=1.0, label="true half length")
        others[0].set_ylim(0.0, 1.15 * np.nanmax(length))
    legend_above(bottom, *others, columns=4)
    finish(figure, analysis, "Pressure and rate while pumping; fall-off", path)


class Abscissa:
    """What the derivatives of a figure are taken by."""

    def __init__(self, column, slope, product, unit, label, tangent):
        self.column, self.slope, self.product = column, slope, product
        self.unit, self.label, self.tangent = unit, label, tangent


G = Abscissa("G", "fall_per_G_Pa", "G_fall_per_G_Pa", "G", "G-function time", "closure_tangent")
ROOT = Abscissa("sqrt_elapsed_s05", "fall_per_sqrt_Pa_s05", "sqrt_fall_per_sqrt_Pa", "√Δt", "√Δt [√s]",
                "closure_sqrt_time")


def draw_derivatives(analysis, path, by, what):
    """p, -dp/dx and -x dp/dx over x: to beyond closure, and the part before the contact alone."""
    x = analysis.fall_off[by.column]
    closing = [analysis.elapsed(name) for name in ("contact_compliance", by.tangent)]
    closing = [analysis.at(elapsed, by.column) for elapsed in closing if elapsed is not None]
    contact = analysis.elapsed("contact_compliance") is not None
    figure, panels = plt.subplots(2 if contact else 1, 1, figsize=(8.2, 8.6 if contact else 5.2), squeeze=False)
    end = min(x[-1], 2.5 * max(closing)) if closing else x[-1]
    draw_part(panels[0, 0], analysis, by, end, np.nanmax, (by.tangent,) if closing else ())
    if contact:
        before = lambda values: 1.3 * np.nanmax(values[:int(0.85 * len(values))])
        draw_part(panels[1, 0], analysis, by, 1.1 * closing[0], before, ())
    finish(figure, analysis, what, path)


def draw_part(axes, analysis, by, end, top_of, tangent):
    """From 0 to `end`; derivatives that noise drowns are left out."""
    columns = analysis.fall_off
    x, pressure = columns[by.column], analysis.mega("pressure_Pa")
    sure = columns["fall_per_log_Pa"] > 2.0 * columns["fall_per_log_error_Pa"]
    slope, product = (np.where(sure, analysis.mega(name), np.nan) for name in (by.slope, by.product))
    inside = (x <= end) & (x >= 0.05 * end)
    largest = top_of(product[inside])
    steepest = top_of(slope[inside])
    times = max(1.0, 10.0 ** np.floor(np.log10(max(largest / steepest, 1e-9))))
    axes.plot(x, pressure, color=look.WATER, linewidth=1.5, label="pressure")
    right = second_axis(axes, f"−dp/d{by.unit}, −{by.unit} dp/d{by.unit} [MPa]", PRODUCT)
    right.plot(x, product, color=PRODUCT, linewidth=1.3, label=f"−{by.unit} dp/d{by.unit}")
    right.plot(x, times * slope, color=DERIVATIVE, linewidth=1.1,
               label=f"{'' if times == 1.0 else f'{times:g} × '}−dp/d{by.unit}")
    for name in tangent:
        if analysis.elapsed(name) is not None:
            last = analysis.at(analysis.elapsed(name), by.column)
            # the pick lies up to a tenth below the tangent
            steep = np.nanmax(slope[(x > 0.5 * last) & (x <= last)])
            right.plot([0.0, end], [0.0, steep * end], color=PICKS[name][1], linewidth=0.9, linestyle=(0, (4, 3)),
                       label="tangent from the origin")
    right.set_ylim(0.0, 1.12 * max(largest, times * steepest))
    axes.set_xlim(0.0, end)
    span = np.ptp(pressure[x <= end])
    axes.set_ylim(np.nanmin(pressure[x <= end]) - 0.05 * span, np.nanmax(pressure[x <= end]) + 0.08 * span)
    axes.set_xlabel(by.label)
    axes.set_ylabel("pressure [MPa]", color=look.WATER)
    mark_picks(axes, analysis, by.column, [name for name in ("isip", "contact_compliance", by.tangent)
                                           if analysis.elapsed(name) is not None
                                           and analysis.at(analysis.elapsed(name), by.column) <= end])
    draw_truth(axes, analysis, x)
    axes.set_zorder(right.get_zorder() + 1)
    axes.patch.set_visible(False)
    legend_above(axes, right, columns=4)


def fan(axes, x, y, slopes):
    """Lines of some slopes, a decade long, from one point of log-log axes."""
    for slope, text in slopes:
        axes.plot([x, 10.0 * x], [y, y * 10.0 ** slope], color=look.FAINT, linewidth=1.0, linestyle=(0, (4, 2)), zorder=1)
        axes.annotate(text, (10.0 * x, y * 10.0 ** slope), xytext=(3, 0), textcoords="offset points", fontsize=8.5,
                      color="#5b6873", va="center")


def draw_log_log(analysis, path):
    figure, axes = plt.subplots(figsize=(8.2, 5.8))
    columns = analysis.fall_off
    time = columns["elapsed_s"]
    below, fall = analysis.mega("below_isip_Pa"), analysis.mega("fall_per_log_Pa")
    sure = fall > 2.0 * analysis.mega("fall_per_log_error_Pa")
    axes.loglog(time[below > 0], below[below > 0], ".", color=look.WATER, markersize=3, label="ISIP − p")
    axes.loglog(time[sure], fall[sure], ".", color=PRODUCT, markersize=3.5, label="−dp/d ln Δt")
    for name in ("contact_compliance", "closure_tangent"):
        elapsed = analysis.elapsed(name)
        if elapsed is not None:
            label, color, _ = PICKS[name]
            axes.axvline(elapsed, color=color, linewidth=0.9, label=f"{label}, {elapsed:.4g} s")
    draw_truth(axes, analysis, time, horizontal=False)
    closed = analysis.elapsed("contact_compliance") or analysis.elapsed("closure_tangent")
    if np.count_nonzero(sure) > 2:
        highest = lambda a, b: np.max(fall[sure & (time >= a) & (time <= b)], initial=np.min(fall[sure]))
        early = (closed or time[-1]) / 50.0
        fan(axes, early, 2.0 * highest(early / 3.0, 3.0 * early), [(0.5, "½"), (1.0, "1"), (1.5, "3/2")])
        if closed and time[-1] > 20.0 * closed:
            late = 5.0 * closed
            fan(axes, late, 1.5 * highest(late, 10.0 * late), [(-0.5, "−½"), (-1.0, "−1")])
    axes.set_xlabel("time after shut-in [s]")
    axes.set_ylabel("[MPa]")
    shown = np.concatenate([below[below > 0], fall[sure]])
    axes.set_ylim(0.5 * max(np.min(shown), 1e-4 * np.max(shown)), 10.0 * np.max(shown))
    legend_above(axes, columns=5)
    finish(figure, analysis, "Log-log derivative, slopes of flow as guides", path)


def draw_after_closure(analysis, path):
    figure, axes = plt.subplots(figsize=(8.2, 5.0))
    columns, facts = analysis.fall_off, analysis.facts
    radial = facts["after_closure_flow"] == "radial"
    x = columns["inverse_elapsed_1_s" if radial else "inverse_sqrt_elapsed_1_s05"]
    closed = analysis.elapsed("contact_compliance") or analysis.elapsed("closure_tangent")
    first = facts["after_closure_from_s"] or closed or 0.3 * columns["elapsed_s"][-1]
    shown = columns["elapsed_s"] >= max(0.3 * first, closed or 0.0)
    pressure = analysis.mega("pressure_Pa")
    axes.plot(x[shown], pressure[shown], ".", color=look.WATER, markersize=4, label="pressure")
    axes.set_xlabel("1/Δt [1/s]" if radial else "1/√Δt [1/√s]")
    axes.set_ylabel("pressure [MPa]")
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-2, 3), useMathText=True)
    reservoir = analysis.picks["reservoir_pressure"]
    if reservoir["value"] is not None:
        ends = np.array([0.0, np.max(x[shown])])
        axes.plot(ends, 1e-6 * (reservoir["value"] + facts["after_closure_slope"] * ends), color=look.ACCENT, linewidth=1.1,
                  label=f"{facts['after_closure_flow']} flow, fitted from {facts['after_closure_from_s'] / 3600.0:.3g} h on")
        axes.errorbar(0.0, 1e-6 * reservoir["value"], yerr=1e-6 * reservoir["uncertainty"], fmt="D", color=look.INK,
                      markersize=6, capsize=3, clip_on=False, zorder=6,
                      label=f"reservoir {1e-6 * reservoir['value']:.3f} ± {1e-6 * reservoir['uncertainty']:.3f} MPa")
    else:
        axes.set_title(look.plain(shorten(reservoir["method"], 120)), loc="left", color="#5b6873", fontsize=8.5)
    axes.set_xlim(left=0.0)
    axes.legend(loc="upper left")
    finish(figure, analysis, "After closure", path)


FIGURES = {
    "record.png": draw_record,
    "g_function.png": lambda analysis, path: draw_derivatives(analysis, path, G, "G-function"),
    "sqrt_time.png": lambda analysis, path: draw_derivatives(analysis, path, ROOT, "Square root of time"),
    "log_log.png": draw_log_log,
    "after_closure.png": draw_after_closure,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("analysis", metavar="DIR", help="folder that `crackle dfit-analyse` wrote")
    parser.add_argument("-o", "--output", metavar="DIR", help="where the figures go (default: the same folder)")
    parser.add_argument("--small", action="store_true", help="small files, for a repository")
    arguments = parser.parse_args()
    if arguments.small:
        look.make_small()
    try:
        folder = pathlib.Path(arguments.output or arguments.analysis)
        folder.mkdir(parents=True, exist_ok=True)
        analysis = Analysis(arguments.analysis)
        for name, draw in FIGURES.items():
            draw(analysis, folder / name)
            if arguments.small:
                look.shrink(folder / name)
    except (RunError, OSError) as error:
        sys.exit(f"draw_dfit: {error}")


if __name__ == "__main__":
    main()
