#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/edge_notch_compression from its sweep: results.csv, figure and the README's table.

    edge_notch_compression_results.py SWEEP_DIR -o cases/edge_notch_compression
"""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import gallery
import look
import results_page
from run_data import Fractures

REACH = 3e-3  # within which the wing's direction is taken: farther on it bends towards the load [m]
WIDTH, HEIGHT = 50e-3, 100e-3  # [m]


def compliance(rock, turn):
    """(s11, s12, s22, s16, s26, s66) in plane strain, in axes in which the bedding lies at an angle [rad]."""
    along, across = rock["young_modulus"], rock["young_modulus_normal"]
    nu, nu_across = rock["poisson_ratio"], rock["poisson_ratio_normal"]  # the latter: strain along under stress across
    s11, s22 = (1.0 - nu * nu) / along, (1.0 - nu_across**2 * along / across) / across
    s12, s66 = -nu_across * (1.0 + nu) / across, 1.0 / rock["shear_modulus_normal"]
    c, s = math.cos(turn), math.sin(turn)
    into = np.array([[c * c, s * s, 2 * c * s], [s * s, c * c, -2 * c * s], [-c * s, c * s, c * c - s * s]])
    whole = into.T @ np.array([[s11, s12, 0], [s12, s22, 0], [0, 0, s66]]) @ into
    return whole[0, 0], whole[0, 1], whole[1, 1], whole[0, 2], whole[1, 2], whole[2, 2]


def wing(rock, slit, resistance, power):
    """Direction [degrees from x] of the largest hoop stress over what the plane resists (a key of the rock, to a power)
    round the tip of a closed slit (K_II alone) in bedded rock: Sih, Paris and Irwin (1965), Saouma, Ayari and Leavell
    (1987)."""
    bedding = rock["bedding_angle"]
    s11, s12, s22, s16, s26, s66 = compliance(rock, bedding - slit)
    one, two = [r for r in np.roots([s11, -2.0 * s16, 2.0 * s12 + s66, -2.0 * s26, s22]) if r.imag > 0.0]
    two *= 1.001  # in isotropic rock they are the same
    theta = np.radians(np.linspace(-175.0, 175.0, 3501))
    terms = [(np.cos(theta) + root * np.sin(theta) + 0j) ** 1.5 for root in (two, one)]
    hoop = ((terms[0] - terms[1]) / (one - two)).real
    across, along = rock[resistance], rock[f"{resistance}_bedding"]
    plane = across - (across - along) * np.cos(theta + slit - bedding) ** 2
    return math.degrees(theta[int(np.argmax(hoop / plane**power))] + slit)


def row_of(name, run):
    method, ratio, angle = name.split("-")[:3]
    notch, rock, h = run.case["notches"][0], run.case["rock"], run.history
    mouth, tip = np.array([notch["x1"], notch["y1"]]), np.array([notch["x2"], notch["y2"]])
    times = run.events["time_s"][~run.slips()]
    force, down = np.abs(h["top_force_y_N_m"]), np.abs(h["top_displacement_y_m"])
    before = (h["time_s"] > 0.15e-3) & (h["time_s"] < 0.25e-3)
    stiffness = np.polyfit(down[before], force[before], 1)[0] * HEIGHT / WIDTH
    slit = math.atan2(*(tip - mouth)[::-1])
    found = gallery.direction(run, tip, tip + [0.0, 1.0], REACH)  # wings go down
    by_strength = wing(rock, slit, "tensile_strength", 1.0)
    by_energy = wing(rock, slit, "fracture_energy_mode1", 0.5)
    parts = results_page.broken(run)
    return {"run": name, "method": method, "ratio": int(ratio), "bedding_deg": int(angle),
            "edge_mm": run.case["mesh"]["size_fine"] * 1e3,
            "platen_modulus_GPa": stiffness * 1e-9, "s22_GPa": 1e-9 / compliance(rock, rock["bedding_angle"])[2],
            "first_break_kN_m": float(np.interp(times.min(), h["time_s"], force)) * 1e-3 if len(times) else math.nan,
            "wing_deg": found, "by_strength_deg": by_strength, "by_energy_deg": by_energy,
            "broken_mm": float(parts[:, 2].sum()) * 1e3 if len(parts) else 0.0,
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
            "steps": run.summary["steps"]}


def rock_of(row):
    return "isotropic" if row["ratio"] == 1 else f"E_h/E_v = {row['ratio']}, bedding at {row['bedding_deg']}°"


def table(rows):
    lines = [[f"{gallery.METHODS[r['method']]}, {r['edge_mm']:.3g} mm, {rock_of(r)}", f"{r['platen_modulus_GPa']:.1f}", f"{r['s22_GPa']:.1f}",
              gallery.number(r["first_break_kN_m"], ".0f"), gallery.number(r["wing_deg"], ".0f"),
              f"{r['by_energy_deg']:.0f}, {r['by_strength_deg']:.0f}", f"{r['broken_mm']:.0f}", f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["method, edges, rock", "modulus between platens [GPa]", "without slit 1/s22",
                                  "force at first break [kN/m]", "wing [°]", "theory, by energy, by strength",
                                  "broken [mm]",
                                  "energy residual"], lines)


def means(rows):
    """Of edges on demand over the meshes of the finest edges."""
    finest = min(r["edge_mm"] for r in rows)
    lines = []
    for ratio, angle in sorted({(r["ratio"], r["bedding_deg"]) for r in rows if r["edge_mm"] == finest}):
        mine = [r for r in rows if (r["method"], r["ratio"], r["bedding_deg"], r["edge_mm"]) == ("demand", ratio, angle, finest)]
        found = [r["wing_deg"] for r in mine]
        lines.append([rock_of(mine[0]), f"{np.mean(found):.0f} ± {np.std(found, ddof=1):.0f}",
                      f"{mine[0]['by_energy_deg']:.0f}, {mine[0]['by_strength_deg']:.0f}"])
    return results_page.markdown([f"edges on demand of {finest:.2g} mm, {len(mine)} meshes", "wing [°]",
                                  "theory, by energy, by strength"], lines)


def draw(runs, rows, path):
    kinds = list(dict.fromkeys((r["ratio"], r["bedding_deg"]) for r in rows))
    methods = [m for m in gallery.METHODS if any(r["method"] == m for r in rows)]
    figure, grid = plt.subplots(1, len(kinds), figsize=(14.0, 3.4), sharex=True, sharey=True)
    for axes, (ratio, angle) in zip(grid, kinds):
        row = next(r for r in rows if (r["ratio"], r["bedding_deg"]) == (ratio, angle))
        for method in methods:
            mine = [r for r in rows if (r["method"], r["ratio"], r["bedding_deg"]) == (method, ratio, angle)]
            finest = min((r["edge_mm"] for r in mine), default=0.0)
            for name in (r["run"] for r in mine if r["edge_mm"] == finest):
                fractures = Fractures(runs[name].frames("fractures")[-1][1])
                axes.add_collection(LineCollection(fractures.segments[fractures.broken] * 1e3, colors=gallery.COLORS[method],
                                                   linewidths=1.2, label=gallery.METHODS[method]))
        run = runs[row["run"]]
        notch = run.case["notches"][0]
        axes.plot([notch["x1"] * 1e3, notch["x2"] * 1e3], [notch["y1"] * 1e3, notch["y2"] * 1e3], color="#8a97a3", linewidth=3.0)
        tip = np.array([notch["x2"], notch["y2"]]) * 1e3
        for key, style in (("by_energy", "--"), ("by_strength", ":")):
            toward = math.radians(row[f"{key}_deg"])
            axes.plot([tip[0], tip[0] + 12.0 * math.cos(toward)], [tip[1], tip[1] + 12.0 * math.sin(toward)], style,
                      color="#2a7f62", linewidth=1.4, label=f"theory at the tip, {key.replace('_', ' ')}")
        if ratio > 1:
            along = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
            for k in range(-2, 3):
                middle = np.array([-5.0, 12.0]) + k * 2.0 * np.array([-along[1], along[0]])
                ends = np.array([middle - 5.0 * along, middle + 5.0 * along])
                axes.plot(ends[:, 0], ends[:, 1], color="#8d5524", linewidth=0.8)
        axes.set(xlim=(-26, 2), ylim=(-22, 20), aspect="equal")
        axes.set_title("isotropic" if ratio == 1 else f"E_h/E_v = {ratio},\nbedding at {angle}°", fontsize=8.5, loc="left")
    handles = {text: handle for axes in grid for handle, text in zip(*axes.get_legend_handles_labels())}
    figure.subplots_adjust(left=0.05, right=0.99, top=0.88, bottom=0.22, wspace=0.1)
    figure.legend(handles.values(), handles.keys(), loc="lower center", bbox_to_anchor=(0.5, 0.0), ncols=5)
    grid[0].set_ylabel("y [mm]")
    grid[len(grid) // 2].set_xlabel("x [mm]; brown: bedding; grey: slit")
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", means(rows) + "\n" + table(rows))
    draw(runs, rows, folder / "edge_notch_compression.png")


if __name__ == "__main__":
    results_page.main("edge_notch_compression", make, __doc__)
