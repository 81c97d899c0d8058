#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/heavily_fractured from its sweep over networks: results.csv, figures as 7 to 10 of AbuAisha et al.
(2016), and the tables of the README.

    heavily_fractured_results.py SWEEP_DIR -o cases/heavily_fractured
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import PowerNorm
from matplotlib.lines import Line2D

import events_figure
import fractures_figure
import look
import results_page
from run_data import MODES, Fractures, Frame

STRESSES = ("isotropic", "anisotropic")
PAPER = {"isotropic": 0.25, "anisotropic": 0.45}  # [MPa] above the intact rock
FAR = 0.031  # [m] a joint's mean length: a slip farther than this from all fluid is away from it
# Isotropic with joints the paper breaks at 12.99 MPa, 1.225 ms by its rate of pressure: 1.28 and 1.40 ms are then
AFTER = {"1.28": 0.055e-3, "1.40": 0.175e-3}  # [s] after breakdown


def wet_segments(run, time):
    """Edges with fluid in them in the first frame at or after a time, the wall left out: (n, 2, 2) [m]."""
    frames = run.frames("fractures")
    later = [path for at, path in frames if at >= time]
    fractures = Fractures(later[0] if later else frames[-1][1])
    return fractures.segments[fractures.wet]


def distance(place, segments, radius):
    """From a place to the nearest fluid, in segments or the wellbore [m]."""
    nearest = max(np.hypot(*place) - radius, 0.0)
    if len(segments) == 0:
        return nearest
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    share = np.clip(np.sum((place - start) * along, axis=1) / np.maximum(np.sum(along**2, axis=1), 1e-30), 0.0, 1.0)
    return min(nearest, np.linalg.norm(start + share[:, None] * along - place, axis=1).min())


def away_from_fluid(run):
    """Which events are slips farther than FAR from any fluid when they end."""
    events = run.events
    away = np.zeros(len(events["time_s"]), dtype=bool)
    for i in np.flatnonzero(run.slips()):
        wet = wet_segments(run, events["time_s"][i] + events["duration_s"][i])
        away[i] = distance(np.array([events["x_m"][i], events["y_m"][i]]), wet, run.wellbore_radius) > FAR
    return away


def reach_at(run, work):
    """Farthest point from the wellbore's middle that is broken or wet once the pump has done a work [J/m], by the frames."""
    history = run.history
    time = np.interp(work, np.maximum.accumulate(history["work_external_J_m"]), history["time_s"])
    before = [path for at, path in run.frames("fractures") if at <= time]
    fractures = Fractures(before[-1])
    chosen = fractures.segments[fractures.wet | fractures.broken]
    return float(np.linalg.norm(chosen, axis=2).max()) if len(chosen) else run.wellbore_radius


def rows_of(runs):
    rows = []
    for stress in STRESSES:
        chosen = {name: run for name, run in runs.items() if name.startswith(stress + "-")}
        work = 0.98 * min(run.history["work_external_J_m"].max() for run in chosen.values())
        for name, run in chosen.items():
            slips, onset = run.slips(), run.summary["breakdown_time_s"]
            magnitude = run.events["magnitude"][np.isfinite(run.events["magnitude"])]
            row = {"run": name, "breakdown_MPa": run.summary["breakdown_pressure_Pa"] * 1e-6, "breakdown_ms": onset * 1e3,
                   "over_healed_MPa": "", "over_intact_MPa": ""}
            if f"{name}-healed" in chosen:
                row["over_healed_MPa"] = row["breakdown_MPa"] - chosen[f"{name}-healed"].summary["breakdown_pressure_Pa"] * 1e-6
            row["over_intact_MPa"] = row["breakdown_MPa"] - chosen[f"{stress}-intact"].summary["breakdown_pressure_Pa"] * 1e-6
            away = away_from_fluid(run)
            rows.append(row | {
                "work_J_m": float(work), "reach_mm": reach_at(run, work) * 1e3, "breaks": int((~slips).sum()),
                "slips": int(slips.sum()), "slips_away_from_fluid": int(away.sum()),
                "slips_before_breakdown": int((run.events["time_s"][slips] < onset).sum()),
                "magnitude_5th": float(np.percentile(magnitude, 5)), "magnitude_median": float(np.median(magnitude)),
                "magnitude_95th": float(np.percentile(magnitude, 95)),
                "magnitude_share_-5_to_-4": float(np.mean((magnitude >= -5.0) & (magnitude <= -4.0))),
                "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
                "steps": run.summary["steps"]})
    return rows


def networks(rows, stress):
    """(with joints, healed) rows of the networks of a stress state, in order."""
    known = {row["run"]: row for row in rows}
    names = [name for name in known if name.startswith(stress + "-") and f"{name}-healed" in known]
    return [known[name] for name in names], [known[f"{name}-healed"] for name in names]


def spread(values, digits=2, sign=""):
    return f"{np.mean(values):{sign}.{digits}f} ± {np.std(values, ddof=1):.{digits}f}"


def table(rows):
    """Mean and standard deviation over the networks."""
    columns = []
    for stress in STRESSES:
        here, healed = networks(rows, stress)
        intact = next(row for row in rows if row["run"] == f"{stress}-intact")
        get = lambda key, of: [row[key] for row in of]  # noqa: E731
        shift = get("over_healed_MPa", here)
        columns.append([
            f"{intact['breakdown_MPa']:.2f}", spread(get("breakdown_MPa", healed)), spread(get("breakdown_MPa", here)),
            spread(shift, 2, "+"), " ".join(f"{value:+.2f}" for value in shift), f"+{PAPER[stress]:.2f}",
            f"{intact['reach_mm']:.0f}", spread(get("reach_mm", healed), 0), spread(get("reach_mm", here), 0),
            spread(get("breaks", here), 0), spread(get("slips", here), 0), spread(get("slips_away_from_fluid", here), 0),
            spread(get("slips_before_breakdown", here), 0),
            f"{np.mean(get('magnitude_5th', here)):.2f} to {np.mean(get('magnitude_95th', here)):.2f}",
            f"{100.0 * np.mean(get('magnitude_share_-5_to_-4', here)):.0f} %",
            f"{max(get('energy_residual_max', here)):.1e}"])
    names = ["breakdown of intact rock [MPa]", "with the networks healed [MPa]", "with joints [MPa]",
             "**joints over healed, same mesh [MPa]**", "each network [MPa]", "paper, over intact rock [MPa]",
             "reach at the same work of the pump, intact [mm]", "the same, healed [mm]", "**the same, with joints [mm]**",
             "broken elements", "slips of joints", f"**slips farther than {FAR * 1e3:.0f} mm from any fluid**",
             "slips before breakdown", "magnitudes, 5 % to 95 % (paper: -5 to -4)", "of them between -5 and -4",
             "largest energy residual"]
    return results_page.markdown(["mean ± standard deviation", *STRESSES], [[name, *parts] for name, parts in
                                                                           zip(names, zip(*columns))])


def draw_thresholds(rows, path):
    figure, grid = plt.subplots(1, 2, figsize=(10.6, 4.2), layout="constrained")
    for i, stress in enumerate(STRESSES):
        here, healed = networks(rows, stress)
        intact = next(row for row in rows if row["run"] == f"{stress}-intact")
        shift = np.array([row["over_healed_MPa"] for row in here])
        grid[0].plot(i + 0.05 * np.arange(len(shift)) - 0.2, shift, "o", color=look.ACCENT,
                     label="a network, over the same mesh with its joints healed" if i == 0 else None)
        grid[0].errorbar(i + 0.12, shift.mean(), shift.std(ddof=1), color=look.INK, marker="_", capsize=4,
                         label="mean, standard deviation" if i == 0 else None)
        grid[0].plot(i + 0.22, PAPER[stress], "x", color=look.WATER, markersize=8, markeredgewidth=2,
                     label="paper (one network)" if i == 0 else None)
        for rows_here, color, name, offset in ((healed, look.FAINT, "joints healed", -0.15), (here, look.ACCENT, "joints", 0.15)):
            reach = np.array([row["reach_mm"] for row in rows_here])
            grid[1].plot(np.full(len(reach), i + offset), reach, "o", color=color, label=name if i == 0 else None)
            grid[1].errorbar(i + offset + 0.07, reach.mean(), reach.std(ddof=1), color=look.INK, marker="_", capsize=4)
        grid[1].plot(i - 0.3, intact["reach_mm"], "s", color=look.WATER, label="intact rock" if i == 0 else None)
    grid[0].axhline(0.0, color=look.FAINT, linewidth=0.8)
    for axes in grid:
        axes.set_xticks([0, 1], STRESSES)
        axes.set_xlim(-0.6, 1.6)
        axes.legend(loc="best", fontsize=8)
    grid[0].set_title("Change of the breakdown pressure by joints", loc="left", fontsize=10)
    grid[0].set_ylabel("[MPa]")
    grid[1].set_title("Reach of broken and wet edges at the same work of the pump", loc="left", fontsize=10)
    grid[1].set_ylabel("from the wellbore's middle [mm]")
    grid[1].set_ylim(bottom=0.0)
    look.save(figure, path)


def draw_fractures(runs, path, after=0.16e-3):
    """Seed 2 with joints and healed, at the paper's 1.36 ms from its onset at 1.2 ms: Figure 8."""
    names = [f"{stress}-2{more}" for stress in STRESSES for more in ("", "-healed")]
    figure, grid = plt.subplots(2, 2, figsize=(10.2, 9.6), sharex=True, sharey=True, layout="constrained")
    window = (-0.42, 0.42, -0.42, 0.42)
    panels = []
    for name in names:
        run = runs[name]
        time, fields = min(run.frames("fields"), key=lambda f: abs(f[0] - run.summary["breakdown_time_s"] - after))
        lines = min(run.frames("fractures"), key=lambda f: abs(f[0] - time))[1]
        panels.append((run, name, time, Fractures(lines), fractures_figure.triangles_within(Frame(fields), window)))
    norm = PowerNorm(0.5, 0.0, fractures_figure.common_top([panel[4][2] for panel in panels]))
    for axes, (run, name, time, fractures, field) in zip(grid.flat, panels):
        image = fractures_figure.draw_panel(axes, field, fractures, norm, window)
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        axes.set_title(f"{name.split('-')[0]}, {'joints healed' if 'healed' in name else 'joints'}", loc="left", fontsize=10)
        axes.set_title(f"{time * 1e3:.2f} ms = breakdown {(time - run.summary['breakdown_time_s']) * 1e3:+.2f} ms", loc="right",
                       fontsize=8.5, color="#5b6873")
    figure.colorbar(image, ax=grid, extend="max", shrink=0.6, aspect=40).set_label("velocity magnitude [m/s]")
    figure.supxlabel("x [mm]", fontsize=9)
    figure.supylabel("y [mm]", fontsize=9)
    handles = [Line2D([], [], color=look.MODE_COLORS[mode], linewidth=1.8, label=f"broken, {name}") for mode, name in MODES.items()]
    handles += [Line2D([], [], color=fractures_figure.JOINT_COLOR, linewidth=width, label=name)
                for width, name in ((0.9, "joint"), (1.8, "wet joint"))]
    grid[0][0].legend(handles=handles, loc="lower left", fontsize=8, frameon=True, framealpha=0.9, edgecolor="none")
    look.save(figure, path)


def draw_events(run, path):
    """Maps and magnitudes up to two times: Figures 9 and 10. Slips away from any fluid are marked."""
    away, slips = away_from_fluid(run), run.slips()
    onset, events = run.summary["breakdown_time_s"], run.events
    figure, grid = plt.subplots(2, 2, figsize=(10.6, 9.4), height_ratios=[2.0, 1.0], layout="constrained")
    kinds = [(~slips, "o", look.FAINT, "broken element"), (slips & ~away, "D", look.MODE_COLORS[look.SLIP],
                                                         "slip of a joint"),
             (away, "D", look.ACCENT, f"slip farther than {FAR * 1e3:.0f} mm from any fluid")]
    finite = np.isfinite(events["magnitude"])
    for column, (name, after) in enumerate(AFTER.items()):
        until = events["time_s"] <= onset + after
        axes, sizes = grid[0][column], events_figure.marker_sizes(events["magnitude"])
        for which, marker, color, text in kinds:
            chosen = which & until
            axes.scatter(events["x_m"][chosen] * 1e3, events["y_m"][chosen] * 1e3, s=sizes[chosen], marker=marker, color=color,
                         edgecolors=look.INK, linewidths=0.3, label=f"{text} ({chosen.sum()})")
            grid[1][column].scatter((events["time_s"][chosen & finite] - onset) * 1e3, events["magnitude"][chosen & finite], s=14,
                                    marker=marker, color=color, edgecolors=look.INK, linewidths=0.2)
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        axes.set_aspect("equal")
        axes.set_xlim(-420, 420)
        axes.set_ylim(-420, 420)
        look.name_axes(axes, f"up to {after * 1e3:.3f} ms after breakdown (the paper's {name} ms)", "x [mm]", "y [mm]")
        legend = axes.legend(loc="upper left", fontsize=8, frameon=True, framealpha=0.9, edgecolor="none")
        for handle in legend.legendHandles:
            handle.set_sizes([30.0])
        grid[1][column].axhspan(-5.0, -4.0, color=look.WATER, alpha=0.12, linewidth=0)
        look.name_axes(grid[1][column], "magnitudes; shaded: the paper's range", "time since breakdown [ms]", "magnitude")
    grid[1][0].sharex(grid[1][1])
    look.save(figure, path)


def make(runs, folder):
    rows = rows_of(runs)
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows))
    draw_thresholds(rows, folder / "summary.png")
    draw_fractures(runs, folder / "fractures.png")
    draw_events(runs["isotropic-2"], folder / "events.png")


if __name__ == "__main__":
    results_page.main("heavily_fractured", make, __doc__)
