#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/reorientation from its sweep: results.csv, figure and the README's table.

    reorientation_results.py SWEEP_DIR -o cases/reorientation
"""

import csv
import math

import matplotlib.pyplot as plt
import numpy as np

import gallery
import look
import results_page

HALF = 0.1  # half-length of the notch [m]
STEP = 0.15  # of the path that is drawn through what broke, over HALF
GATE_Y, GATE_DIRECTION = 0.15, 8.0  # over HALF; degrees


def references(path):
    with open(path, encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return {(row["beta_deg"], row["R"]): row for row in rows}


def between(known, beta, ratio):
    """The reference at a ratio, linear between its neighbours; held at the ends."""
    ratios = sorted(r for b, r in known if b == beta)
    return {key: float(np.interp(ratio, ratios, [known[beta, r][key] for r in ratios])) for key in known[beta, ratios[0]]}


def reference_path(row):
    """(s, x, y) over HALF, from the tip on, by its directions."""
    beta = math.radians(row["beta_deg"])
    at, direction = [0.0, 0.5, 1.0, 2.0, 4.0], [row[f"dir_{k}_deg"] for k in ("first", "0.5", "1", "2", "4")]
    s = np.linspace(0.0, 2.5, 251)
    angle = np.radians(np.interp(s, at, direction))
    middle = 0.5 * (angle[1:] + angle[:-1])
    x = math.cos(beta) + np.concatenate([[0.0], np.cumsum(np.cos(middle) * np.diff(s))])
    y = math.sin(beta) + np.concatenate([[0.0], np.cumsum(np.sin(middle) * np.diff(s))])
    return s, x, y


def path_from(parts, tip, sign):
    """(s, x, y) over HALF of what broke beyond a tip; the other tip's is turned by half a turn (sign -1)."""
    place = sign * parts[:, :2] / HALF
    tip = np.asarray(tip) / HALF
    near = (place[:, 0] > tip[0] - 0.1) & (np.abs(place[:, 1]) < 2.5)
    x, y, weight = place[near, 0], place[near, 1], parts[near, 2]
    points = [tip]
    for low in np.arange(tip[0], 4.0, STEP):
        here = (x >= low) & (x < low + STEP)
        if not here.any():
            break
        points.append(np.array([np.average(x[here], weights=weight[here]), np.average(y[here], weights=weight[here])]))
    points = np.array(points)
    s = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return s, points[:, 0], points[:, 1]


def at_arc(path, s_wanted):
    """(direction [degrees] over half a length each way, y over HALF) at an arc; NaN where it does not come that far."""
    s, x, y = path
    if s[-1] < s_wanted:
        return math.nan, math.nan
    near = np.abs(s - s_wanted) <= 0.6
    slope = np.polyfit(x[near], y[near], 1)[0] if near.sum() > 1 else math.nan
    return math.degrees(math.atan(slope)), float(np.interp(s_wanted, s, y))


def ratio_of(run):
    """Mean of p/(S_H - S_h) while it grew; the least stress is 0."""
    h = run.history
    growing = (h["wetted_length_m"] > h["wetted_length_m"][0] + 0.2 * HALF) & (h["wetted_length_m"] < 6.0 * HALF)
    growing = growing if growing.any() else h["wetted_length_m"] > -1.0
    return float(np.mean(h["pressure_Pa"][growing])) / -run.case["stress"]["xx"]


def row_of(name, run, known):
    method, beta, wanted = name.split("-")[:3]
    ratio = ratio_of(run)
    theory = between(known, float(beta), ratio)
    notch, parts = run.case["notches"][0], results_page.broken(run)
    paths = [path_from(parts, (notch["x2"], notch["y2"]), sign) for sign in (1.0, -1.0)]
    row = {"run": name, "method": method, "beta_deg": int(beta), "edge_mm": run.case["mesh"]["size_fine"] * 1e3,
           "R_wanted": float(wanted), "R": ratio}
    for k in (1, 2):
        found = [at_arc(path, float(k)) for path in paths]
        for tip, (direction, y) in enumerate(found, 1):
            row |= {f"dir_{k}_tip{tip}_deg": direction, f"y_{k}_tip{tip}": y}
        row |= {f"reference_dir_{k}_deg": theory[f"dir_{k}_deg"], f"reference_y_{k}": theory[f"y_{k}"]}
    row["arc_reached"] = min(path[0][-1] for path in paths)
    return row | {"energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"]}, paths


def table(rows):
    lines = []
    for r in rows:
        off = [r[f"y_2_tip{t}"] - r["reference_y_2"] for t in (1, 2)]
        turn = [r[f"dir_2_tip{t}_deg"] - r["reference_dir_2_deg"] for t in (1, 2)]
        lines.append([f"{gallery.METHODS[r['method']]}, {r['edge_mm']:.2g} mm, {r['beta_deg']}°", f"{r['R']:.2f}",
                      ", ".join(gallery.number(r[f"y_2_tip{t}"], ".2f") for t in (1, 2)), f"{r['reference_y_2']:.2f}",
                      ", ".join(gallery.number(o, "+.2f") for o in off),
                      ", ".join(gallery.number(r[f"dir_2_tip{t}_deg"], ".0f") for t in (1, 2)), f"{r['reference_dir_2_deg']:.0f}",
                      ", ".join(gallery.number(t, "+.0f") for t in turn), f"{r['energy_residual_max']:.1e}"])
    return results_page.markdown(["method, edges, angle of the notch", "R", "y(2 a0)/a0, both tips", "theory",
                                  f"off (gate {GATE_Y})", "direction at 2 a0 [°]", "theory", f"off (gate {GATE_DIRECTION:.0f}°)",
                                  "energy residual"], lines)


def means(rows):
    """Over both tips of all meshes of edges on demand, by the size of edges."""
    lines = []
    for size in sorted({r["edge_mm"] for r in rows if r["method"] == "demand"}):
        for beta, wanted in sorted({(r["beta_deg"], r["R_wanted"]) for r in rows}):
            mine = [r for r in rows if r["method"] == "demand" and r["edge_mm"] == size
                    and (r["beta_deg"], r["R_wanted"]) == (beta, wanted)]
            off = [r[f"y_2_tip{t}"] - r["reference_y_2"] for r in mine for t in (1, 2)]
            turn = [r[f"dir_2_tip{t}_deg"] - r["reference_dir_2_deg"] for r in mine for t in (1, 2)]
            lines.append([f"{size:.2g} mm, {beta}°, R = {wanted:g} wanted", f"{np.mean(off):+.2f} ± {np.std(off, ddof=1):.2f}",
                          f"{np.mean(turn):+.1f} ± {np.std(turn, ddof=1):.1f}"])
    return results_page.markdown([f"edges on demand, mean and deviation over both tips of {len(mine)} meshes",
                                  f"y(2 a0)/a0, off (gate {GATE_Y})", f"direction, off [°] (gate {GATE_DIRECTION:.0f})"], lines)


def chosen(rows, beta, wanted):
    """{run: (method, label)}: three meshes of the finest edges on demand, one of the other methods."""
    named = {r["run"]: r for r in rows}
    keys = [f"demand-{beta}-{wanted}-{seed}-3.3mm" for seed in (1, 2, 3)] + [f"{m}-{beta}-{wanted}" for m in ("all", "damage")]
    first = {keys[0], *keys[3:]}
    return {key: (named[key]["method"], f"{gallery.METHODS[named[key]['method']]}, R = {named[key]['R']:.2f}" if key in first
                  else None) for key in keys if key in named}


def draw(paths, rows, known, path):
    figure, grid = plt.subplots(2, 3, figsize=(12.4, 6.4), sharex=True, sharey=True, layout="constrained")
    for line, beta in zip(grid, (45, 60)):
        for axes, wanted in zip(line, ("1.5", "2", "3")):
            tip = np.array([math.cos(math.radians(beta)), math.sin(math.radians(beta))])
            axes.plot([-tip[0], tip[0]], [-tip[1], tip[1]], color=look.INK, linewidth=2.4)
            for key, (method, label) in chosen(rows, beta, wanted).items():
                for i, (_, x, y) in enumerate(paths[key]):
                    axes.plot(x, y, marker=gallery.MARKERS[method], markersize=2.5, linewidth=0.9,
                              linestyle="-" if i == 0 else ":", color=gallery.COLORS[method],
                              label=label if i == 0 else None)
            ratio = next(r["R"] for r in rows if r["run"] == f"demand-{beta}-{wanted}-1-3.3mm")
            _, x, y = reference_path(between(known, float(beta), ratio))
            axes.plot(x, y, color="#2a7f62", linewidth=3.0, alpha=0.45, label=f"theory, R = {ratio:.2f}")
            axes.set_title(f"notch at {beta}°, R = {wanted} wanted", fontsize=9, loc="left")
            axes.set_aspect("equal")
            axes.set_xlim(-0.2, 3.2)
            axes.set_ylim(-0.2, 2.4)
            axes.legend(loc="upper left", fontsize=7)
    figure.supxlabel("x / a0, along the greatest compression; dotted: the other tip, turned by half a turn", fontsize=9)
    figure.supylabel("y / a0", fontsize=9)
    look.save(figure, path)


def make(runs, folder):
    known = references(folder / "reference.csv")
    pairs = {name: row_of(name, run, known) for name, run in runs.items()}
    rows = [row for row, _ in pairs.values()]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", means(rows) + "\n" + table(rows))
    draw({name: paths for name, (_, paths) in pairs.items()}, rows, known, folder / "reorientation.png")


if __name__ == "__main__":
    results_page.main("reorientation", make, __doc__)
