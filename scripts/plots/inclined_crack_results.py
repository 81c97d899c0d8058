#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/inclined_crack from its sweep: results.csv, figure and the README's table.

    inclined_crack_results.py SWEEP_DIR -o cases/inclined_crack
"""

import math

import matplotlib.pyplot as plt
import numpy as np

import gallery
import look
import results_page

HALF_LENGTH, WIDTH, REACH = 10e-3, 0.1, 4e-3  # [m]
FINITE_WIDTH = 1.02  # of the plate, on K


def kink(beta):
    """Largest hoop stress (Erdogan and Sih 1963): angle of the kink and K_eq over sigma sqrt(pi a), beta from the load."""
    one, two = math.sin(beta) ** 2, math.sin(beta) * math.cos(beta)
    if two == 0.0:
        return 0.0, one
    theta = 2.0 * math.atan((one - math.hypot(one, math.sqrt(8.0) * two)) / (4.0 * two))
    half = math.cos(0.5 * theta)
    return theta, half ** 3 * one - 1.5 * half * math.sin(theta) * two


def reference(case, beta):
    """Kink [degrees] and stress [Pa] at which the slit starts to grow."""
    theta, share = kink(math.radians(beta))
    return abs(math.degrees(theta)), gallery.toughness(case["rock"]) / (FINITE_WIDTH * share * math.sqrt(math.pi * HALF_LENGTH))


def row_of(name, run):
    method, beta = gallery.method_of(name), int(name.split("-")[1])
    angle, stress = reference(run.case, beta)
    notch = run.case["notches"][0]
    ends = [(notch["x1"], notch["y1"]), (notch["x2"], notch["y2"])]
    kinks = []
    for tip, other in (ends, ends[::-1]):
        along = math.degrees(math.atan2(tip[1] - other[1], tip[0] - other[0]))
        turned = gallery.direction(run, np.array(tip), np.array(other), REACH) - along
        kinks.append(-((turned + 180.0) % 360.0 - 180.0))
    force, time = gallery.peak_force(run, "top")
    return {"run": name, "method": method, "angle_deg": beta,
            "mesh": f", mesh {run.case['mesh']['seed']}" if method == "demand" else "", "peak_MPa": force / WIDTH * 1e-6,
            "reference_MPa": stress * 1e-6, "peak_error_percent": 100.0 * (force / WIDTH / stress - 1.0),
            "peak_time_ms": time * 1e3, "kink_1_deg": kinks[0], "kink_2_deg": kinks[1], "reference_kink_deg": angle,
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
            "steps": run.summary["steps"]}


def table(rows):
    lines = [[f"{gallery.METHODS[r['method']]}, {r['angle_deg']}°{r['mesh']}", f"{r['peak_MPa']:.2f}", f"{r['reference_MPa']:.2f}",
              f"{r['peak_error_percent']:+.1f} %", f"{r['kink_1_deg']:.0f}, {r['kink_2_deg']:.0f}",
              f"{r['reference_kink_deg']:.0f}", f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["method, angle from the load", "peak [MPa]", "theory [MPa]", "error",
                                  "kink at both tips [°]", "theory [°]", "energy residual"], lines)


def means(rows):
    """Over the meshes of edges on demand."""
    lines = []
    for angle in sorted({r["angle_deg"] for r in rows}):
        mine = [r for r in rows if r["method"] == "demand" and r["angle_deg"] == angle]
        kinks = [r[f"kink_{i}_deg"] for r in mine for i in (1, 2)]
        error = 100.0 * (np.mean([r["peak_MPa"] for r in mine]) / mine[0]["reference_MPa"] - 1.0)
        lines.append([f"{angle}°", f"{error:+.1f} %", f"{np.mean(kinks) - mine[0]['reference_kink_deg']:+.0f}°"])
    return results_page.markdown([f"edges on demand, mean of {len(mine)} meshes", "peak, off theory (gate 8 %)",
                                  "kink, off theory (gate 8°)"], lines)


def draw(runs, rows, path):
    figure, (peak, turn, plan) = plt.subplots(1, 3, figsize=(13.0, 4.3), layout="constrained")
    case = next(iter(runs.values())).case
    betas = np.linspace(25.0, 90.0, 131)
    theory = [reference(case, b) for b in betas]
    peak.plot(betas, [1e-6 * t[1] for t in theory], color=look.FAINT, label="largest hoop stress, K_Ic")
    turn.plot(betas, [t[0] for t in theory], color=look.FAINT, label="largest hoop stress")
    for method, name in gallery.METHODS.items():
        mine = [r for r in rows if r["method"] == method]
        style = {"color": gallery.COLORS[method], "marker": gallery.MARKERS[method], "linestyle": "", "label": name}
        peak.plot([r["angle_deg"] for r in mine], [r["peak_MPa"] for r in mine], **style)
        turn.plot([r["angle_deg"] for r in mine for _ in (0, 1)], [r[f"kink_{i}_deg"] for r in mine for i in (1, 2)],
                  **style)
        if f"{method}-45" in runs:
            gallery.draw_path(plan, runs[f"{method}-45"], method, label=name)
    gallery.draw_lines(plan, runs["demand-45"], "notches")
    look.name_axes(peak, "Peak stress", "angle of the slit from the load [°]", "[MPa]")
    look.name_axes(turn, f"Kink, mean over the first {REACH * 1e3:.0f} mm, both tips", "angle of the slit from the load [°]",
                   "[°]")
    look.name_axes(plan, "What broke, slit at 45°, load along y", "x [mm]", "y [mm]")
    plan.set_aspect("equal")
    plan.set_xlim(-30, 30)
    plan.set_ylim(-25, 25)
    peak.set_ylim(bottom=0.0)
    for axes in (peak, turn, plan):
        axes.legend(loc="lower left" if axes is peak else "best", fontsize=7.5)
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", means(rows) + "\n" + table(rows))
    draw(runs, rows, folder / "inclined_crack.png")


if __name__ == "__main__":
    results_page.main("inclined_crack", make, __doc__)
