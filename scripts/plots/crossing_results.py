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

NEAR = 0.12  # across the way: what broke beyond the joint within this of where the fracture went on is its own [m]
BEYOND = 0.015  # off the joint: what first breaks within this beyond it is where the fracture goes on [m]
OFFSET = 0.03  # along the joint: a fracture that goes on within this of where it comes from has crossed [m]
LEAST_BROKEN, LEAST_WET = 0.05, 0.05  # beyond the joint; of the joint [m]
MARGIN = 1.2  # by which a criterion has to be met or missed where runs are held against it
METHODS = gallery.METHODS | {"permeable": "cohesive edges on demand, permeable joint"}
OUTCOMES = {"crossed": ("o", "#2a7f62"), "dilated": ("D", look.ACCENT), "arrested": ("s", look.FAINT)}
FRICTION, COHESION, STRENGTH, LEAST = 0.6, 0.0, 2.6, 5.0  # of the joint; of the rock, the least stress [MPa]
NETS = (0.5, 1.0)  # pressures above the least stress [MPa]


def stresses_on(angle, difference):
    """Compression and shear [MPa] on a plane at an angle [degrees] from the greatest compression."""
    theta = math.radians(angle)
    return LEAST + difference * math.sin(theta) ** 2, 0.5 * difference * math.sin(2.0 * theta)


def gu_weng(angle, difference):
    """Gu and Weng (2010): shear on the joint over what friction bears, where the tip's stress reaches the strength beyond
    it; the worse side. Below 1 the joint holds and the fracture crosses.

    Where the largest stress of tip and far field together is the strength, the joint must not slip. With
    s = K/sqrt(2 pi r): principal stresses -(S_H + S_h)/2 + s cos(t/2) +- (...); solved for s on each side."""
    strength, most = STRENGTH, LEAST + difference
    theta = math.radians(angle)
    worst = 0.0
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
        worst = max(worst, over(shear, COHESION - FRICTION * normal))
    return worst


def over(shear, strength):
    """Their ratio; 99 where nothing bears."""
    return min(99.0, shear / strength) if strength > 0.0 else 99.0


def renshaw_pollard(difference):
    """Renshaw and Pollard (1995), at 90 degrees: -S_H/(T - S_h) > (0.35 + 0.35/mu)/1.06, compression negative."""
    return (LEAST + difference) / (STRENGTH + LEAST) > (0.35 + 0.35 / FRICTION) / 1.06


def warpinski_teufel(angle, difference, net):
    """Warpinski and Teufel (1987): does the joint open under a pressure above the least stress, and its shear over what
    friction bears with that pressure in it (above 1 it slips)?"""
    normal, shear = stresses_on(angle, difference)
    pressure = LEAST + net
    return pressure >= normal - 1e-9, over(shear, COHESION + FRICTION * max(0.0, normal - pressure))


def agreed(angle, difference, margin):
    """What both criteria say by a margin: "crosses", "stays", or "" where they do not."""
    tip, slip = gu_weng(angle, difference), warpinski_teufel(angle, difference, NETS[0])[1]
    if max(tip, slip) * margin <= 1.0:
        return "crosses"
    return "stays" if min(tip, slip) >= margin else ""


def outcome(run, angle):
    """(name, offset [m] along the joint of where it first goes on, NaN: nowhere, length broken beyond there [m], length
    of joint with fluid [m])."""
    theta = math.radians(angle)
    along = np.array([math.cos(theta), math.sin(theta)])
    beyond = np.array([along[1], -along[0]])
    events, chosen = run.events, ~run.slips()
    order = np.argsort(events["time_s"][chosen], kind="stable")
    place = np.column_stack([events[name][chosen][order] for name in ("x_m", "y_m")])
    length = events["length_m"][chosen][order]
    across = place @ beyond
    before = (across <= 0.0) & (across > -BEYOND) & (np.abs(place @ along) < 0.2)
    after = (across > 0.0) & (across < BEYOND) & (np.abs(place @ along) < 0.25)
    offset, crossed = math.nan, 0.0
    if before.any() and after.any():
        came, went = place[before][0, 1], place[after][0, 1]
        offset = abs(went - came) / math.sin(theta)
        crossed = float(length[(across > BEYOND) & (np.abs(place[:, 1] - went) < NEAR)].sum())
    fractures = Fractures(run.frames("fractures")[-1][1])
    lines = fractures.segments[fractures.joint & fractures.wet]
    middle = lines.mean(axis=1) if len(lines) else np.zeros((0, 2))
    on_joint = (np.abs(middle @ beyond) < 0.005) & (np.abs(middle @ along) < 0.21)
    wet = float(np.linalg.norm(lines[on_joint, 1] - lines[on_joint, 0], axis=1).sum()) if len(lines) else 0.0
    if offset <= OFFSET and crossed > LEAST_BROKEN:
        return "crossed", offset, crossed, wet
    return "dilated" if wet > LEAST_WET else "arrested", offset, crossed, wet


def row_of(name, run):
    method, angle, difference = name.split("-")[:3]
    angle, difference = int(angle), int(difference)
    what, offset, crossed, wet = outcome(run, angle)
    opens, slips = zip(*(warpinski_teufel(angle, difference, net) for net in NETS))
    return {"run": name, "method": "permeable" if name.endswith("-permeable") else method, "angle_deg": angle,
            "difference_MPa": difference, "outcome": what, "offset_mm": 1e3 * offset,
            "broken_beyond_mm": 1e3 * crossed, "wet_joint_mm": 1e3 * wet,
            "pressure_at_end_MPa": run.summary["propagation_pressure_Pa"] * 1e-6,
            "gu_weng": gu_weng(angle, difference),
            "renshaw_pollard": ("crosses" if renshaw_pollard(difference) else "no") if angle == 90 else "",
            "opens_at_0.5": "yes" if opens[0] else "no", "opens_at_1": "yes" if opens[1] else "no",
            "slips_at_0.5": slips[0], "slips_at_1": slips[1], "agreed": agreed(angle, difference, 1.0),
            "agreed_by_margin": agreed(angle, difference, MARGIN),
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"]}


def ratio(value):
    return f"{value:.2f}" if value < 10.0 else "over 10"


def table(rows):
    lines = [[f"{METHODS[r['method']]}, {r['angle_deg']}°, {r['difference_MPa']} MPa", r["outcome"],
              gallery.number(r["offset_mm"], ".0f"), f"{r['broken_beyond_mm']:.0f}", f"{r['wet_joint_mm']:.0f}",
              ratio(r["gu_weng"]), r["renshaw_pollard"], f"{r['opens_at_0.5']}, {r['opens_at_1']}",
              f"{ratio(r['slips_at_0.5'])}, {ratio(r['slips_at_1'])}", r["agreed_by_margin"],
              f"{r['energy_residual_max']:.1e}"] for r in rows]
    return results_page.markdown(["run", "outcome", "goes on after [mm]", "broken beyond [mm]", "joint with fluid [mm]",
                                  "Gu-Weng, below 1 crosses", "Renshaw-Pollard", "opens at 0.5, 1 MPa",
                                  "Warpinski-Teufel at 0.5, 1 MPa, above 1 slips", "both, by 20 %", "energy residual"], lines)


def counts(rows):
    """Agreement with the criteria where they speak with one voice, by a margin and without one."""
    lines = []
    for method in dict.fromkeys(r["method"] for r in rows):
        line = [METHODS[method]]
        for key in ("agreed_by_margin", "agreed"):
            for what in ("crosses", "stays"):
                mine = [r for r in rows if r["method"] == method and r[key] == what]
                good = sum((r["outcome"] == "crossed") == (what == "crosses") for r in mine)
                line.append(f"{good} of {len(mine)}")
        lines.append(line)
    return results_page.markdown(["method", "crossed where both criteria say so by 20 %", "not crossed, the same",
                                  "crossed where both say so, however narrowly", "not crossed, the same"], lines)


def draw_map(rows, path):
    methods = [m for m in METHODS if any(r["method"] == m for r in rows)]
    figure, grid = plt.subplots(1, len(methods), figsize=(3.6 * len(methods), 5.2), sharey=True, squeeze=False)
    angles, differences = np.linspace(25.0, 90.0, 66), np.linspace(0.1, 11.0, 56)
    crosses = np.array([[gu_weng(a, d) < 1.0 for a in angles] for d in differences])
    opens = np.array([[warpinski_teufel(a, d, NETS[1])[0] for a in angles] for d in differences])
    slips = np.array([[warpinski_teufel(a, d, NETS[0])[1] > 1.0 for a in angles] for d in differences])
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
        look.name_axes(axes, METHODS[method].replace(", ", ",\n"), "angle of the joint from the fracture [°]", "")
        axes.legend(loc="upper left", fontsize=8, frameon=True)
    grid[0][0].set_ylabel("stress difference [MPa]")
    figure.text(0.01, 0.98, "Green: Gu-Weng crosses (star: Renshaw-Pollard at 90°). Left of dashed: the joint opens at 1 MPa net;\n"
                "left of dotted: it slips at 0.5 MPa net (Warpinski-Teufel)", fontsize=9, va="top")
    figure.tight_layout(rect=(0, 0, 1, 0.91))
    look.save(figure, path)


def draw_fractures(runs, path):
    columns = [(angle, difference) for angle, difference in ((30, 4), (60, 4), (90, 2), (90, 7))]
    figure, grid = plt.subplots(len(METHODS), len(columns), figsize=(12.4, 9.2), sharex=True, sharey=True, layout="constrained")
    for line, method in zip(grid, METHODS):
        for axes, (angle, difference) in zip(line, columns):
            name = f"{method}-{angle}-{difference}"
            run = runs[f"demand-{angle}-{difference}-permeable" if method == "permeable" else name]
            gallery.draw_lines(axes, run, "joints")
            gallery.draw_lines(axes, run, "notches")
            gallery.draw_path(axes, run, "demand" if method == "permeable" else method)
            fractures = Fractures(run.frames("fractures")[-1][1])
            for segment in fractures.segments[fractures.joint & fractures.wet]:
                axes.plot(segment[:, 0] * 1e3, segment[:, 1] * 1e3, color=look.WATER, linewidth=2.4)
            axes.set_title(f"{angle}°, {difference} MPa: {outcome(run, angle)[0]}", fontsize=9, loc="left")
            axes.set_aspect("equal")
            axes.set_xlim(-560, 460)
            axes.set_ylim(-330, 330)
        line[0].set_ylabel(METHODS[method].replace(", ", ",\n") + "\ny [mm]", fontsize=7)
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
