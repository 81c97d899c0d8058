#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/layered_block from its sweep: results.csv, figure and the README's table.

    layered_block_results.py SWEEP_DIR -o cases/layered_block
"""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import gallery
import look
import results_page
from run_data import Fractures

HALF = 10e-3  # of the middle layer [m]
THROUGH = 1e-3  # beyond an interface: an element's width [m]
KINDS = ("modulus-0.25", "modulus-0.5", "modulus-1", "modulus-2", "modulus-4", "stress-1", "stress-2", "offset-0.25",
         "offset-4")


def label(kind):
    what, value = kind.split("-")
    return {"modulus": f"E ratio {value}", "stress": f"stress step {value} MPa",
            "offset": f"E ratio {value}, notch 2 mm off"}[what]


def closing(low, high, step):
    """Stress intensities [Pa m^0.5] at the lower and upper end, per MPa of pressure and by the stress `step` [Pa] beyond
    the interfaces: K = 1/sqrt(pi a) times the integral of p(y) sqrt((a +- y)/(a -+ y))."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    angle = (np.arange(2000) + 0.5) * math.pi / 2000.0  # y = -half cos(angle)
    y = middle - half * np.cos(angle)
    load = np.where(np.abs(y) > HALF, -step, 0.0)
    scale = half / math.sqrt(math.pi * half) * math.pi / 2000.0
    return [scale * np.sum(load * (1.0 + sign * np.cos(angle))) for sign in (1.0, -1.0)], math.sqrt(math.pi * half)


def theory(low, high, step, toughness):
    """Pressure [Pa] at which the better placed end grows."""
    closed, per_pressure = closing(low, high, step)
    return (toughness - max(closed)) / per_pressure


def growth(run):
    """(time, low, high, pressure) as every element breaks [s, m, m, Pa]."""
    parts, events = results_page.broken(run), run.events
    times = events["time_s"][~run.slips()]
    notch, low, high, lines = run.case["notches"][0], None, None, []
    low, high = notch["y1"], notch["y2"]
    for i in np.argsort(times):
        low, high = min(low, parts[i, 1]), max(high, parts[i, 1])
        lines.append((times[i], low, high, float(np.interp(times[i], run.history["time_s"], run.history["pressure_Pa"]))))
    return np.array(lines)


def row_of(name, run):
    method, kind = name.split("-", 1)
    rock, lines = run.case["rock"], growth(run)
    toughness = gallery.toughness(rock)
    beyond = (lines[:, 2] > HALF + THROUGH) | (lines[:, 1] < -HALF - THROUGH)
    first = int(np.argmax(beyond)) if beyond.any() else None
    # What it took to get through: the largest pressure from the time the first end was at an interface.
    near = (lines[:, 2] > HALF - 2 * THROUGH) | (lines[:, 1] < -HALF + 2 * THROUGH)
    h = run.history
    through = math.nan
    if first is not None:
        window = (h["time_s"] >= lines[int(np.argmax(near)), 0] - 1e-6) & (h["time_s"] <= lines[first, 0] + 1e-6)
        through = float(h["pressure_Pa"][window].max())
    row = {"run": name, "method": method, "kind": kind, "breakdown_MPa": run.summary["breakdown_pressure_Pa"] * 1e-6,
           "through_MPa": through * 1e-6, "through_ms": lines[first, 0] * 1e3 if first is not None else math.nan,
           "lowest_mm": lines[-1, 1] * 1e3, "highest_mm": lines[-1, 2] * 1e3, "over_theory_percent": math.nan}
    if kind == "modulus-1" or kind.startswith("stress"):
        step = -run.case["layers"][0]["stress_xx"]
        grown = lines[(lines[:, 2] - lines[:, 1] > 15e-3) & (lines[:, 2] - lines[:, 1] < 40e-3)]
        ratio = [p / theory(low, high, step, toughness) for _, low, high, p in grown]
        row["over_theory_percent"] = 100.0 * (float(np.mean(ratio)) - 1.0) if ratio else math.nan
    return row | {"energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
                  "steps": run.summary["steps"]}


def table(rows):
    lines = [[f"{gallery.METHODS[r['method']]}, {label(r['kind'])}", f"{r['breakdown_MPa']:.2f}",
              gallery.number(r["through_MPa"], ".2f"), gallery.number(r["through_ms"], ".2f"),
              f"{r['lowest_mm']:.0f} to {r['highest_mm']:.0f}", gallery.number(r["over_theory_percent"], "+.0f") +
              (" %" if math.isfinite(r["over_theory_percent"]) else ""), f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["run", "breakdown [MPa]", "through an interface [MPa]", "at [ms]", "grown over [mm]",
                                  "pressure over theory's, mean", "energy residual"], lines)


def checks(rows):
    lines = []
    for method, name in gallery.METHODS.items():
        mine = {r["kind"]: r for r in rows if r["method"] == method}
        ratios = [k for k in KINDS if k.startswith("modulus") and k in mine]
        values = [mine[k]["through_MPa"] for k in ratios]
        rises = all(a < b or not math.isfinite(b) for a, b in zip(values, values[1:]))
        lines.append([f"{name}: pressure to get through rises with E ahead", "rises", "yes" if rises else "no"])
    return results_page.markdown(["check", "gate", "got"], lines)


def draw(runs, rows, path):
    figure = plt.figure(figsize=(14.0, 8.6), layout="constrained")
    grid = figure.add_gridspec(3, len(KINDS) + 4)
    for i, (method, name) in enumerate(gallery.METHODS.items()):
        for j, kind in enumerate(KINDS):
            if f"{method}-{kind}" not in runs:
                continue
            run = runs[f"{method}-{kind}"]
            axes = figure.add_subplot(grid[i, j])
            axes.axhspan(-1e3 * HALF, 1e3 * HALF, color="#f3ead8", zorder=0)
            notch, fractures = run.case["notches"][0], Fractures(run.frames("fractures")[-1][1])
            axes.plot([0, 0], [1e3 * notch["y1"], 1e3 * notch["y2"]], color=look.WATER, linewidth=3.0, zorder=1)
            axes.add_collection(LineCollection(fractures.segments[fractures.broken] * 1e3, colors=gallery.COLORS[method],
                                               linewidths=1.2))
            axes.set(xlim=(-12, 12), ylim=(-32, 32), aspect="equal")
            axes.set_title(label(kind).replace(", ", ",\n").replace("step", "step\n") if i == 0 else "", fontsize=7.5, loc="left")
            axes.tick_params(labelsize=7)
            if j > 0:
                axes.set_yticklabels([])
            else:
                axes.set_ylabel(f"{name}\ny [mm]", fontsize=8)
            if i == len(gallery.METHODS) - 1:
                axes.set_xlabel("x [mm]", fontsize=8)
    axes = figure.add_subplot(grid[0, -4:])
    for method, name in gallery.METHODS.items():
        mine = [(float(r["kind"].split("-")[1]), r["through_MPa"]) for r in rows
                if r["method"] == method and r["kind"].startswith("modulus")]
        axes.plot(*zip(*mine), color=gallery.COLORS[method], marker=gallery.MARKERS[method], label=name)
    axes.set_xscale("log", base=2)
    look.name_axes(axes, "Pressure to get through an interface", "modulus ahead over the middle layer's", "[MPa]")
    axes.legend(fontsize=7)
    for line, kind in ((1, "modulus-1"), (2, "stress-2")):
        axes = figure.add_subplot(grid[line, -4:])
        for method in gallery.METHODS:
            if f"{method}-{kind}" not in runs:
                continue
            run = runs[f"{method}-{kind}"]
            rock, lines = run.case["rock"], growth(run)
            step = -run.case["layers"][0]["stress_xx"]
            toughness = gallery.toughness(rock)
            length = 1e3 * (lines[:, 2] - lines[:, 1])
            axes.plot(length, 1e-6 * lines[:, 3], gallery.MARKERS[method], markersize=3, color=gallery.COLORS[method])
            axes.plot(length, [1e-6 * theory(low, high, step, toughness) for _, low, high, _ in lines],
                      color=gallery.COLORS[method], linewidth=0.8)
        axes.set_ylim(bottom=0.0)
        look.name_axes(axes, f"{label(kind)}: pressure as it grows; line: theory", "length [mm]", "[MPa]")
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows) + "\n" + checks(rows))
    draw(runs, rows, folder / "layered_block.png")


if __name__ == "__main__":
    results_page.main("layered_block", make, __doc__)
