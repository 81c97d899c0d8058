# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of the stability map from its points.csv."""

import csv
import math

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from look import ACCENT, FAINT, INK, WATER, name_axes

COLORS = {"tied": FAINT, "all": ACCENT, "on_demand": WATER, "damage": "#2a9d8f"}
NAMES = {"tied": "no elements", "all": "elements on all edges", "on_demand": "elements on demand",
         "damage": "smeared damage"}


def read(table):
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for key, value in row.items():
            if key not in ("scene", "setting", "alarm"):
                row[key] = float(value)
    return rows


class Points:
    """Rows of one scene and setting, in order of x."""

    def __init__(self, rows, scene, setting):
        self.rows = sorted((r for r in rows if r["scene"] == scene and r["setting"] == setting), key=lambda r: (r["y"], r["x"]))

    def __getitem__(self, column):
        return [row[column] for row in self.rows]


def style(setting):
    base = setting.removesuffix("-naive")
    return {"color": COLORS[base], "marker": "x" if setting.endswith("-naive") else "o", "ms": 5,
            "ls": ":" if setting.endswith("-naive") else "-", "lw": 1.2,
            "label": NAMES[base] + (", naive" if setting.endswith("-naive") else "")}


def new(title, columns=1, width=5.2, height=4.0):
    figure, axes = plt.subplots(1, columns, figsize=(width * columns, height), constrained_layout=True, squeeze=False)
    figure.suptitle(title, x=0.01, ha="left", fontsize=12, weight="bold")
    return figure, axes[0]


def save(figure, folder, name):
    path = folder / f"{name}.png"
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return path


def time_step(rows, folder):
    figure, axes = new("Time step: a fracture in a strip strained to 1.2 G", 3)
    for setting in ("all", "on_demand", "damage"):
        p = Points(rows, "strip", setting)
        axes[0].plot(p["x"], [max(v, 1e-8) for v in p["made"]], **style(setting))
        axes[1].plot(p["x"], [min(v, 1e4) if math.isfinite(v) else 1e4 for v in p["dissipated"]], **style(setting))
        axes[2].plot(p["x"], p["broken"], **style(setting))
        axes[2].plot(p["x"], p["stray"], color=COLORS[setting], ls=":", marker="x", ms=5, lw=1.2,
                     label="of them away from any fracture")
        for row in p.rows:
            if row["alarm_step"] >= 0:
                axes[0].annotate(f"{row['alarm_step']:.0f}", (row["x"], max(row["made"], 1e-8)), fontsize=7,
                                 xytext=(2, 4), textcoords="offset points", color=COLORS[setting])
    for ax in axes:
        ax.axvline(1.0, color=INK, lw=0.9, ls="--")
        ax.set_yscale("log")
    axes[0].axhspan(0.2, 10, color=ACCENT, alpha=0.08, lw=0)
    axes[1].axhline(1.0, color=INK, lw=0.9, ls="--")
    axes[2].set_yscale("symlog", linthresh=1)
    unit = "step over the predicted limit"
    name_axes(axes[0], "energy made by elements (number: step at which a guard stops)", unit, "made / dissipated")
    name_axes(axes[1], "dissipated by breaking", unit, "over G x area broken")
    name_axes(axes[2], "broken elements", unit, "number")
    axes[0].legend(loc="upper left")
    axes[2].legend(loc="upper left")
    return save(figure, folder, "time_step")


def limits(rows, folder):
    figure, axes = new("Step at which a disturbed body blows up (points), predicted (lines), taken by crackle (dotted)", 5, 4.2)
    panels = (("penalty", "T4 penalty", "penalty / E", "log", 1), ("damping", "T5 damping", "viscosity / critical", "symlog", 1),
              ("viscosity", "T5 fixed viscosity: falls with h²", "edge / 50 mm", "log", 1),
              ("poisson", "T3 Poisson's ratio", "1 − 2 ν", "log", 0), ("skew", "T2 skewed triangles", "smallest angle [degrees]", "log", 1))
    for ax, (scene, title, label, scale, plain) in zip(axes, panels):
        for setting in ("tied", "all", "on_demand"):
            p = Points(rows, scene, setting)
            x = p["x"] if plain else [1.0 - 2.0 * v for v in p["x"]]
            ax.plot(x, p["measured"], "o", color=COLORS[setting], ms=5, label=NAMES[setting])
            ax.plot(x, p["predicted"], "-", color=COLORS[setting], lw=1)
            ax.plot(x, p["bound"], ":", color=COLORS[setting], lw=1.2)
        ax.set_xscale(scale, **({"linthresh": 0.1} if scale == "symlog" else {}))
        ax.set_yscale("log")
        name_axes(ax, title, label, "step / (h √(ρ/E))")
    axes[0].legend(loc="lower left")
    return save(figure, folder, "limits")


def contact(rows, folder):
    figure, axes = new("T9 Edges cut under 20 MPa: motion that this makes", width=6.4)
    for setting in ("all", "on_demand", "all-naive", "on_demand-naive"):
        p = Points(rows, "handover", setting)
        axes[0].plot(p["x"], [max(v, 1e-30) for v in p["measured"]], **style(setting))
        if setting.endswith("naive"):
            axes[0].plot(p["x"], p["predicted"], color=style(setting)["color"], lw=0.8, ls="--")
    axes[0].axhline(1e-3, color=INK, lw=0.9)
    axes[0].set_xscale("log")
    axes[0].set_yscale("log")
    name_axes(axes[0], "naive: nothing is handed over; dashed: ½ p_f/p_n; line: 1e-3", "contact penalty / cohesive penalty",
              "kinetic energy / (σ² h/p_f)")
    axes[0].legend(loc="center left")
    return save(figure, folder, "contact")


def fluid(rows, folder):
    figure, axes = new("T8 Stiff fluid in a thin closed crack", 2)
    for setting in ("all", "on_demand", "all-naive", "on_demand-naive"):
        p = Points(rows, "thin_crack", setting)
        look = style(setting) | {"ls": ""}
        axes[0].plot(p["predicted"], p["measured"], **look)
        failed = [r for r in p.rows if r["alarm_step"] >= 0]
        if setting.endswith("naive"):
            axes[1].plot([r["x"] / r["y"] for r in failed], [r["alarm_step"] for r in failed], **look)
    axes[0].axvline(4.0 * (1.0 - 0.64), color=INK, lw=0.9, ls="--")
    for ax in axes:
        ax.set_xscale("log")
    axes[0].set_yscale("log")
    name_axes(axes[0], "naive: explicit; dashed: its limit", "(ω_f Δt)² of the fluid at the dry step",
              "largest speed over that of the rebound")
    name_axes(axes[1], "explicit: step at which it is lost", "K_f / aperture [Pa/m]", "step")
    axes[0].legend(loc="upper left")
    return save(figure, folder, "fluid")


def motion(rows, folder):
    figure, axes = new("Stressed rock, large rotation, single precision, a pump that draws", 4, 4.6)
    for setting in ("all", "on_demand", "all-naive", "on_demand-naive"):
        p = Points(rows, "activation", setting)
        axes[0].plot(p["x"], p["measured"], **style(setting))
        p = Points(rows, "rotation", setting)
        axes[1].plot(p["x"], p["measured"], **style(setting))
    for setting in ("all", "tied", "all-naive", "tied-naive"):
        p = Points(rows, "precision", setting)
        axes[2].plot(p["x"], p["measured"], **(style(setting) | {"ls": ""}))
        axes[2].plot(p["x"], p["predicted"], color=style(setting)["color"], lw=0.8, ls="--")
    for setting in ("all", "on_demand"):
        p = Points(rows, "drawing", setting)
        axes[3].plot(p["x"], [-1e-6 * v for v in p["measured"]], **(style(setting) | {"ls": ""}))
        axes[3].plot(p["x"], [-1e-6 * v for v in p["predicted"]], color=COLORS[setting], lw=0.8, ls="--")
        for row in p.rows:
            if row["alarm_step"] >= 0:
                axes[3].axvline(row["x"], color=COLORS[setting], lw=1, ls=":")
    for ax in axes:
        ax.set_yscale("log")
    for ax in axes[1:]:
        ax.set_xscale("log")
    axes[2].axhline(1.0, color=INK, lw=0.9)
    name_axes(axes[0], "T6 elements come in; naive: unloaded", "stress / strength", "wave / stress")
    name_axes(axes[1], "T7 rotation; naive: small strains", "angle [degrees]", "stress / E")
    name_axes(axes[2], "T14 single precision; naive: positions", "distance from the origin [m]", "noise / strength")
    name_axes(axes[3], "T15 drawn from a hole; dotted: refused", "share of the fluid drawn", "suction [MPa]")
    axes[0].legend(loc="center left")
    axes[2].legend(loc="center left")
    return save(figure, folder, "motion")


def turned(rows, folder):
    figure, axes = new("Mesh turned under a notch: strength in tension", width=6.4)
    for setting in ("on_demand", "damage"):
        p = Points(rows, "turned", setting)
        axes[0].plot(p["x"], p["measured"], **style(setting))
    axes[0].axhline(1.0, color=INK, lw=0.9, ls="--")
    axes[0].set_ylim(0.8, 1.3)
    axes[0].set_xticks(range(0, 91, 15))
    name_axes(axes[0], "a lattice of right triangles, 10 in the notch's half-length", "notch from the lattice [degrees]",
              "largest stress / straight cohesive crack")
    axes[0].legend(loc="lower left")
    return save(figure, folder, "turned")


def draw(table, folder):
    """Draws all figures. Returns their paths."""
    rows = read(table)
    return [figure(rows, folder) for figure in (time_step, limits, contact, fluid, motion, turned)]
