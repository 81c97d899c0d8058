#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/single_joint from its sweep: results.csv, figures as 12 to 16 of AbuAisha et al. (2016), and the
table of the README.

    single_joint_results.py SWEEP_DIR -o cases/single_joint
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import PowerNorm

import fractures_figure
import look
import results_page
from run_data import Fractures, Frame

KINDS = {"longitudinal": "0°", "oblique": "45°", "transversal": "90°"}
DISTANCES = {"0.3L": 0.3, "0.6L": 0.6, "1L": 1.0}
COLORS = {"reference": look.INK, "longitudinal": look.WATER, "oblique": look.ACCENT, "transversal": look.MODE_COLORS[3]}
AFTER = {"early": 0.18e-3, "middle": 0.30e-3}  # [s] the paper's 1.26 and 1.38 ms, from its onset at 1.08 ms
PAPER = {"longitudinal-0.3L": "+5.2 %", "oblique-0.3L": "+5.2 %", "transversal-0.3L": "0",
         **{f"{kind}-0.6L": "0" for kind in KINDS}, **{f"{kind}-1L": "0" for kind in KINDS}}


def lengths(run, until):
    """Broken so far [m] on the joint's side (x > 0) and on the other."""
    parts = results_page.broken(run, until)
    joint = parts[:, 0] > 0.0
    return parts[joint, 2].sum(), parts[~joint, 2].sum()


def rows_of(runs):
    reference = runs["reference"].summary["breakdown_pressure_Pa"]
    rows = []
    for name, run in runs.items():
        pressure = run.summary["breakdown_pressure_Pa"]
        row = {"run": name, "breakdown_MPa": pressure * 1e-6, "breakdown_ms": run.summary["breakdown_time_s"] * 1e3,
               "over_reference_percent": 100.0 * (pressure / reference - 1.0), "over_healed_percent": ""}
        if f"{name}-healed" in runs:
            healed = runs[f"{name}-healed"].summary["breakdown_pressure_Pa"]
            row["over_healed_percent"] = 100.0 * (pressure / healed - 1.0)
        onset = run.summary["breakdown_time_s"]
        for when, after in {**AFTER, "end": np.inf}.items():
            joint, other = lengths(run, onset + after)
            row |= {f"joint_side_{when}_mm": joint * 1e3, f"other_side_{when}_mm": other * 1e3,
                    f"asymmetry_{when}": joint / other}
        slips = run.events["time_s"][run.slips()]
        row |= {"slips": int(run.slips().sum()), "slips_before_breakdown": int((slips < onset).sum()),
                "wet_joint": "yes" if wet_joint(run) else "no",
                "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
                "steps": run.summary["steps"]}
        rows.append(row)
    return rows


def wet_joint(run):
    fractures = Fractures(run.frames("fractures")[-1][1])
    return bool((fractures.joint & fractures.wet).any())


def table(rows):
    """Joint against its healed twin, beside the paper."""
    known = {row["run"]: row for row in rows}
    lines = []
    for name in ["reference"] + [f"{kind}-{distance}" for distance in DISTANCES for kind in KINDS]:
        row, twin = known[name], known.get(f"{name}-healed")
        asymmetry = [f"{row[f'asymmetry_{when}']:.2f}" + (f" ({twin[f'asymmetry_{when}']:.2f})" if twin else "")
                     for when in (*AFTER, "end")]
        lines.append([name.replace("-", ", ").replace("L", " L"), f"{row['breakdown_MPa']:.2f}",
                      f"{twin['breakdown_MPa']:.2f}" if twin else "",
                      f"{row['over_healed_percent']:+.2f} %" if twin else "", PAPER.get(name, ""), *asymmetry,
                      row["wet_joint"] if twin else ""])
    header = ["joint", "breakdown [MPa]", "healed [MPa]", "joint over healed", "paper", "asymmetry +0.18 ms", "+0.30 ms",
              "end", "joint wetted"]
    return results_page.markdown(header, lines)


def joint_of(run):
    """Its two ends [mm], none in the reference."""
    return [[(j["x1"] * 1e3, j["y1"] * 1e3), (j["x2"] * 1e3, j["y2"] * 1e3)] for j in run.case.get("joints", [])]


def frame_near(run, kind, time):
    return min(run.frames(kind), key=lambda frame: abs(frame[0] - time))


def draw_fractures(runs, distance, path, times):
    """A row a joint and one for none, a column a time after breakdown; over the velocity magnitude."""
    names = ["reference"] + [f"{kind}-{distance}" for kind in KINDS]
    across = len(times) if len(times) > 1 else len(names)
    down = len(names) if len(times) > 1 else 1
    figure, grid = plt.subplots(down, across, figsize=(3.5 * across + 0.9, 2.6 * down + 0.9), squeeze=False, sharex=True,
                                sharey=True, layout="constrained")
    panels = [(runs[name], name, when, after) for name in names for when, after in times.items()]
    frames = []
    for run, _, _, after in panels:
        time, path_of_fields = frame_near(run, "fields", run.summary["breakdown_time_s"] + after)
        frames.append((time, path_of_fields, Fractures(frame_near(run, "fractures", time)[1])))
    window = (-0.62, 0.62, -0.42, 0.42)
    fields = [fractures_figure.triangles_within(Frame(path_of_fields), window) for _, path_of_fields, _ in frames]
    norm = PowerNorm(0.5, 0.0, fractures_figure.common_top([speed for _, _, speed in fields]))
    for axes, (run, name, _, _), (time, _, fractures), field in zip(grid.flat, panels, frames, fields):
        image = fractures_figure.draw_panel(axes, field, fractures, norm, window)
        axes.add_collection(LineCollection(joint_of(run), colors=fractures_figure.JOINT_COLOR, linewidths=1.2,
                                           linestyles=(0, (4, 2)), zorder=1))
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        since = time - run.summary["breakdown_time_s"]
        axes.set_title("no joint" if name == "reference" else name.split("-")[0], fontsize=9, loc="left")
        axes.set_title(f"{time * 1e3:.2f} ms = breakdown {since * 1e3:+.2f} ms", fontsize=8, loc="right", color="#5b6873")
    figure.colorbar(image, ax=grid, extend="max", shrink=0.7, pad=0.01, aspect=40).set_label("velocity magnitude [m/s]")
    figure.supxlabel("x [mm]", fontsize=9)
    figure.supylabel("y [mm]", fontsize=9)
    figure.suptitle(f"Joint at {DISTANCES[distance]:g} L from the wall (dashed brown; wetted: thick). Black: broken in "
                    "tension, red: shear, orange: mixed", fontsize=10, x=0.01, ha="left")
    look.save(figure, path)


def draw_pressure(runs, path):
    figure, grid = plt.subplots(1, 3, figsize=(13.0, 4.4), sharey=True, layout="constrained")
    for axes, (distance, number) in zip(grid, DISTANCES.items()):
        for kind in ("reference", *KINDS):
            run = runs[kind if kind == "reference" else f"{kind}-{distance}"]
            axes.plot(run.history["time_s"] * 1e3, run.history["pressure_Pa"] / 1e6, color=COLORS[kind], linewidth=1.2,
                      label=f"{'no joint' if kind == 'reference' else kind}: "
                            f"{run.summary['breakdown_pressure_Pa'] / 1e6:.2f} MPa")
        axes.axhline(11.47 * 1.052, color=look.FAINT, linewidth=0.8, linestyle=(0, (2, 2)))
        axes.axhline(11.47, color=look.FAINT, linewidth=0.8)
        axes.set_title(f"joint at {number:g} L", loc="left", fontsize=10)
        axes.set_xlabel("time [ms]")
        axes.legend(loc="lower right", fontsize=8)
    grid[0].set_ylabel("wellbore pressure [MPa]")
    grid[0].set_ylim(0.0, 14.5)
    grid[0].text(0.02, 11.47, "paper: no joint, 11.47 MPa", fontsize=7, color="#5b6873", va="top")
    grid[0].text(0.02, 11.47 * 1.052, "paper: longitudinal and oblique at 0.3 L, +5.2 %", fontsize=7, color="#5b6873",
                 va="bottom")
    look.save(figure, path)


def draw_summary(rows, path):
    """Threshold and asymmetry over the distance, joints full, healed ones hollow."""
    known = {row["run"]: row for row in rows}
    figure, (threshold, asymmetry) = plt.subplots(1, 2, figsize=(11.0, 4.3), layout="constrained")
    for i, kind in enumerate(KINDS):
        at = [DISTANCES[d] + 0.012 * (i - 1) for d in DISTANCES]
        here = [known[f"{kind}-{d}"] for d in DISTANCES]
        twin = [known[f"{kind}-{d}-healed"] for d in DISTANCES]
        threshold.plot(at, [row["over_healed_percent"] for row in here], "o-", color=COLORS[kind], label=f"{kind}, this code")
        threshold.plot(at, [row["over_reference_percent"] for row in twin], "o", color=COLORS[kind], markerfacecolor="white")
        paper = [5.2 if d == "0.3L" and kind != "transversal" else 0.0 for d in DISTANCES]
        threshold.plot(at, paper, "x", color=COLORS[kind], markersize=7, markeredgewidth=1.6)
        asymmetry.plot(at, [row["asymmetry_middle"] for row in here], "o-", color=COLORS[kind], label=kind)
        asymmetry.plot(at, [row["asymmetry_middle"] for row in twin], "o", color=COLORS[kind], markerfacecolor="white")
    asymmetry.axhline(known["reference"]["asymmetry_middle"], color=look.INK, linewidth=1.0, label="no joint")
    threshold.plot([], [], "x", color=look.INK, label="paper")
    threshold.plot([], [], "o", color=look.INK, markerfacecolor="white", label="mesh alone: joint healed, over no joint")
    look.name_axes(threshold, "Change of the breakdown pressure by the joint, same mesh", "distance of the joint / L", "[%]")
    look.name_axes(asymmetry, "Broken length, joint's side over the other, 0.30 ms after breakdown",
                   "distance of the joint / L", "asymmetry index")
    asymmetry.plot([], [], "o", color=look.INK, markerfacecolor="white", label="same mesh, joint healed")
    asymmetry.set_ylim(0.5, 1.3)
    for axes in (threshold, asymmetry):
        axes.set_xticks(list(DISTANCES.values()))
        axes.legend(loc="best", fontsize=8)
    look.save(figure, path)


def draw_stress(runs, path):
    """Magnitude of the principal stresses just before breakdown, joints at 0.3 L: Figure 12."""
    names = ["reference"] + [f"{kind}-0.3L" for kind in KINDS]
    figure, grid = plt.subplots(2, 2, figsize=(9.4, 7.6), sharex=True, sharey=True, layout="constrained")
    for axes, name in zip(grid.flat, names):
        run = runs[name]
        before = [frame for frame in run.frames("fields") if frame[0] < run.summary["breakdown_time_s"]]
        time, file = before[-1]
        frame = Frame(file)
        corners = frame.points[frame.cells]
        seen = np.all(np.abs(corners).min(axis=1) < 0.85, axis=1)
        stress = frame.cell_fields["stress_Pa"][seen]
        half = np.hypot(0.5 * (stress[:, 0] - stress[:, 1]), stress[:, 2])
        mean = 0.5 * (stress[:, 0] + stress[:, 1])
        image = axes.tripcolor(frame.points[:, 0] * 1e3, frame.points[:, 1] * 1e3, frame.cells[seen],
                               np.hypot(mean + half, mean - half) / 1e6, cmap="viridis", vmin=7.8, vmax=9.8,
                               rasterized=True)
        axes.add_collection(LineCollection(joint_of(run), colors="white", linewidths=1.2))
        axes.grid(False)
        axes.set_aspect("equal")
        axes.set_xlim(-450, 850)
        axes.set_ylim(-450, 650)
        axes.set_title("no joint" if name == "reference" else f"{name.split('-')[0]} at 0.3 L", fontsize=9.5, loc="left")
        axes.set_title(f"{time * 1e3:.2f} ms", fontsize=8, loc="right", color="#5b6873")
    figure.colorbar(image, ax=grid, extend="both", shrink=0.75, aspect=40).set_label("√(σ₁² + σ₂²) [MPa]")
    figure.supxlabel("x [mm]", fontsize=9)
    figure.supylabel("y [mm]", fontsize=9)
    look.save(figure, path)


def make(runs, folder):
    rows = rows_of(runs)
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows))
    three = {**AFTER, "end": 1.0}
    draw_fractures(runs, "0.3L", folder / "fractures_0.3L.png", three)
    draw_fractures(runs, "0.6L", folder / "fractures_0.6L.png", three)
    draw_fractures(runs, "1L", folder / "fractures_1L.png", {"early": AFTER["early"]})
    draw_pressure(runs, folder / "pressure.png")
    draw_summary(rows, folder / "summary.png")
    draw_stress(runs, folder / "stress.png")


if __name__ == "__main__":
    results_page.main("single_joint", make, __doc__)
