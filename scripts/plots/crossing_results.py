#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/crossing from its sweep: results.csv, map, pictures and the README's table.

    crossing_results.py SWEEP_DIR -o cases/crossing
"""

import math

import matplotlib.pyplot as plt
import numpy as np

import gallery
import look
import results_page
from run_data import Fractures

NEAR = 0.12  # along the joint: what breaks beyond it within this of the intersection has crossed [m]
BEYOND = 0.02  # off the joint [m]
LEAST_CROSSED, LEAST_OPENED = 0.05, 0.1  # [m]
OUTCOMES = {"crossed": ("o", "#2a7f62"), "dilated": ("D", look.ACCENT), "arrested": ("s", look.FAINT)}
FRICTION, COHESION, STRENGTH, LEAST = 0.6, 0.0, 2.6, 5.0  # of the joint; of the rock, the least stress [MPa]
NETS = (0.5, 1.0)  # pressures above the least stress [MPa]


def stresses_on(angle, difference):
    """Compression and shear [MPa] on a plane at an angle [degrees] from the greatest compression."""
    theta = math.radians(angle)
    return LEAST + difference * math.sin(theta) ** 2, 0.5 * difference * math.sin(2.0 * theta)


def gu_weng(angle, difference):
    """Gu and Weng (2010): does the tip's stress reach the strength beyond the joint without sliding it? Both sides.

    Where the largest stress of tip and far field together is the strength, the joint must not slip. With
    s = K/sqrt(2 pi r): principal stresses -(S_H + S_h)/2 + s cos(t/2) +- (...); solved for s on each side."""
    strength, most = STRENGTH, LEAST + difference
    theta = math.radians(angle)
    for side in (theta, theta - math.pi):
        c, s, s3, c3 = math.cos(side / 2), math.sin(side / 2), math.sin(1.5 * side), math.cos(1.5 * side)

        def stress(k):
            xx = -most + k * c * (1.0 - s * s3)
            yy = -LEAST + k * c * (1.0 + s * s3)
            xy = k * s * c * c3
            return xx, yy, xy

        low, high = 0.0, 1000.0
        for _ in range(80):
            middle = 0.5 * (low + high)
            xx, yy, xy = stress(middle)
            largest = 0.5 * (xx + yy) + math.hypot(0.5 * (xx - yy), xy)
            low, high = (middle, high) if largest < strength else (low, middle)
        xx, yy, xy = stress(high)
        n = (-math.sin(theta), math.cos(theta))
        normal = xx * n[0] ** 2 + yy * n[1] ** 2 + 2.0 * xy * n[0] * n[1]
        shear = abs((yy - xx) * n[0] * n[1] + xy * (n[0] ** 2 - n[1] ** 2))
        if shear >= COHESION - FRICTION * normal:
            return False
    return True


def renshaw_pollard(difference):
    """Renshaw and Pollard (1995), at 90 degrees: -S_H/(T - S_h) > (0.35 + 0.35/mu)/1.06, compression negative."""
    return (LEAST + difference) / (STRENGTH + LEAST) > (0.35 + 0.35 / FRICTION) / 1.06


def warpinski_teufel(angle, difference, net):
    """Warpinski and Teufel (1987): does the joint open, and does it slip, under a pressure above the least stress?"""
    normal, shear = stresses_on(angle, difference)
    pressure = LEAST + net
    return pressure >= normal - 1e-9, shear > COHESION + FRICTION * max(0.0, normal - pressure)


def outcome(run, angle):
    """(name, length broken beyond [m], length of joint with fluid [m])."""
    theta = math.radians(angle)
    along = np.array([math.cos(theta), math.sin(theta)])
    beyond = np.array([along[1], -along[0]])
    parts = results_page.broken(run)
    place = parts[:, :2]
    crossed = float(parts[(place @ beyond > BEYOND) & (np.abs(place @ along) < NEAR), 2].sum())
    fractures = Fractures(run.frames("fractures")[-1][1])
    lines = fractures.segments[fractures.joint & fractures.wet]
    middle = lines.mean(axis=1) if len(lines) else np.zeros((0, 2))
    on_joint = (np.abs(middle @ beyond) < 0.005) & (np.abs(middle @ along) < 0.21) if len(lines) else np.zeros(0, bool)
    opened = float(np.linalg.norm(lines[on_joint, 1] - lines[on_joint, 0], axis=1).sum()) if len(lines) else 0.0
    name = "crossed" if crossed > LEAST_CROSSED else "dilated" if opened > LEAST_OPENED else "arrested"
    return name, crossed, opened


def row_of(name, run):
    method, angle, difference = name.split("-")
    angle, difference = int(angle), int(difference)
    what, crossed, opened = outcome(run, angle)
    opens, slips = zip(*(warpinski_teufel(angle, difference, net) for net in NETS))
    return {"run": name, "method": method, "angle_deg": angle, "difference_MPa": difference, "outcome": what,
            "broken_beyond_mm": 1e3 * crossed, "wet_joint_mm": 1e3 * opened,
            "pressure_at_end_MPa": run.summary["propagation_pressure_Pa"] * 1e-6,
            "gu_weng": "crosses" if gu_weng(angle, difference) else "no",
            "renshaw_pollard": ("crosses" if renshaw_pollard(difference) else "no") if angle == 90 else "",
            "opens_at_0.5": "yes" if opens[0] else "no", "opens_at_1": "yes" if opens[1] else "no",
            "slips_at_0.5": "yes" if slips[0] else "no", "slips_at_1": "yes" if slips[1] else "no",
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"]}


def table(rows):
    lines = [[f"{gallery.METHODS[r['method']]}, {r['angle_deg']}°, {r['difference_MPa']} MPa", r["outcome"],
              f"{r['broken_beyond_mm']:.0f}", f"{r['wet_joint_mm']:.0f}", r["gu_weng"], r["renshaw_pollard"],
              f"{r['opens_at_0.5']}, {r['opens_at_1']}", f"{r['slips_at_0.5']}, {r['slips_at_1']}",
              f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["run", "outcome", "broken beyond [mm]", "joint with fluid [mm]", "Gu-Weng",
                                  "Renshaw-Pollard", "opens at 0.5, 1 MPa", "slips at 0.5, 1 MPa", "energy residual"], lines)


def counts(rows):
    """Agreement with the criteria where they speak with one voice."""
    lines = []
    for method in dict.fromkeys(r["method"] for r in rows):
        name, mine = gallery.METHODS[method], [r for r in rows if r["method"] == method]
        crossing = [r for r in mine if r["gu_weng"] == "crosses" and r["slips_at_0.5"] == "no"]
        opening = [r for r in mine if r["gu_weng"] == "no" and r["slips_at_0.5"] == "yes"]
        lines.append([name, f"{sum(r['outcome'] == 'crossed' for r in crossing)} of {len(crossing)}",
                      f"{sum(r['outcome'] != 'crossed' for r in opening)} of {len(opening)}"])
    return results_page.markdown(["method", "crossed, where Gu-Weng crosses and Warpinski-Teufel does not slip",
                                  "not crossed, where Gu-Weng does not cross and Warpinski-Teufel slips"], lines)


def draw_map(rows, path):
    methods = [m for m in gallery.METHODS if any(r["method"] == m for r in rows)]
    figure, grid = plt.subplots(1, len(methods), figsize=(4.6 * len(methods), 5.2), sharey=True, squeeze=False)
    angles, differences = np.linspace(25.0, 90.0, 66), np.linspace(0.1, 11.0, 56)
    crosses = np.array([[gu_weng(a, d) for a in angles] for d in differences])
    opens = np.array([[warpinski_teufel(a, d, NETS[1])[0] for a in angles] for d in differences])
    slips = np.array([[warpinski_teufel(a, d, NETS[0])[1] for a in angles] for d in differences])
    least = next(d for d in np.linspace(0.0, 11.0, 1101) if renshaw_pollard(d))
    for axes, method in zip(grid[0], methods):
        axes.contourf(angles, differences, crosses, levels=[0.5, 1.5], colors=["#cfe8dd"])
        for field, color, style in ((crosses, "#2a7f62", "-"), (opens, look.WATER, "--"), (slips, look.ACCENT, ":")):
            axes.contour(angles, differences, field, levels=[0.5], colors=[color], linestyles=[style], linewidths=1.2)
        axes.plot(90.0, least, "*", color="#2a7f62", markersize=11)
        for name, (marker, color) in OUTCOMES.items():
            mine = [r for r in rows if r["method"] == method and r["outcome"] == name]
            axes.plot([r["angle_deg"] for r in mine], [r["difference_MPa"] for r in mine], marker, color=color, markersize=8,
                      linestyle="", label=name)
        axes.set_xlim(25.0, 94.0)
        look.name_axes(axes, gallery.METHODS[method], "angle of the joint from the fracture [°]", "")
        axes.legend(loc="upper left", fontsize=8, frameon=True)
    grid[0][0].set_ylabel("stress difference [MPa]")
    figure.text(0.01, 0.98, "Green: Gu-Weng crosses (star: Renshaw-Pollard at 90°). Left of dashed: the joint opens at 1 MPa net;\n"
                "left of dotted: it slips at 0.5 MPa net (Warpinski-Teufel)", fontsize=9, va="top")
    figure.tight_layout(rect=(0, 0, 1, 0.91))
    look.save(figure, path)


def draw_fractures(runs, path):
    columns = [(angle, difference) for angle, difference in ((30, 4), (60, 4), (90, 2), (90, 7))]
    methods = list(gallery.METHODS)
    figure, grid = plt.subplots(len(methods), len(columns), figsize=(12.4, 7.0), sharex=True, sharey=True, layout="constrained")
    for line, method in zip(grid, methods):
        for axes, (angle, difference) in zip(line, columns):
            run = runs[f"{method}-{angle}-{difference}"]
            gallery.draw_lines(axes, run, "joints")
            gallery.draw_lines(axes, run, "notches")
            gallery.draw_path(axes, run, method)
            fractures = Fractures(run.frames("fractures")[-1][1])
            for segment in fractures.segments[fractures.joint & fractures.wet]:
                axes.plot(segment[:, 0] * 1e3, segment[:, 1] * 1e3, color=look.WATER, linewidth=2.4)
            axes.set_title(f"{angle}°, {difference} MPa: {outcome(run, angle)[0]}", fontsize=9, loc="left")
            axes.set_aspect("equal")
            axes.set_xlim(-560, 460)
            axes.set_ylim(-330, 330)
        line[0].set_ylabel(gallery.METHODS[method] + "\ny [mm]", fontsize=8)
    figure.supxlabel("x [mm]; blue: with fluid, brown: joint", fontsize=9)
    look.save(figure, path)


def make(runs, folder):
    rows = [row_of(name, run) for name, run in runs.items()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", counts(rows) + "\n" + table(rows))
    draw_map(rows, folder / "map.png")
    draw_fractures(runs, folder / "fractures.png")


if __name__ == "__main__":
    results_page.main("crossing", make, __doc__)
