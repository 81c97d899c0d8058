#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of cases/montney_dfit in milliseconds, from its sweep over the wellbore's radius: results.csv, figures, and the
table of the README.

    montney_dfit_results.py SWEEP_DIR -o cases/montney_dfit
"""

import matplotlib.pyplot as plt
import numpy as np

import fractures_figure
import look
import results_page

# Quasi-static cohesive theory, fluid in broken elements only, curve of Evans and Marathe with 3 G/f: radius [mm], [MPa]
THEORY = {50.0: 67.8, 30.0: 74.2, 25.4: 76.9}
PAPER = 76.0          # its simulation and the field, "~76 MPa"
HUBBERT_WILLIS = 55.61
COLORS = {50.0: look.WATER, 30.0: look.MODE_COLORS[3], 25.4: look.ACCENT}


def loading_line(run, injected):
    """Total pressure [Pa] once a volume [m2] is in an elastic hole: p = K_f (ln(1 + V/V0) - ln(1 + p/G))."""
    rock, fluid = run.case["rock"], run.case["fluid"]
    shear = 0.5 * rock["young_modulus"] / (1.0 + rock["poisson_ratio"])
    area = np.pi * run.wellbore_radius**2
    pressure = np.zeros_like(injected)
    for _ in range(60):
        pressure = fluid["bulk_modulus"] * (np.log1p(injected / area) - np.log1p(pressure / shear))
    return rock["pore_pressure"] + pressure


def row_of(run):
    history = run.history
    time, pressure, injected = history["time_s"], history["pressure_Pa"], history["injected_m2"]
    radius = run.wellbore_radius * 1e3
    formation, top = run.case["rock"]["pore_pressure"], run.summary["breakdown_pressure_Pa"]
    rising = (time < run.summary["breakdown_time_s"]) & (pressure > formation + 0.2 * (top - formation)) & (
        pressure < formation + 0.6 * (top - formation))
    stiffness = np.polyfit(injected[rising], pressure[rising], 1)[0]
    theory = np.polyfit(injected[rising], loading_line(run, injected[rising]), 1)[0]
    shut = shut_in(run)
    settled = time >= shut + 0.5 * (time[-1] - shut)
    broken = sum(history[f"broken_{mode}"] for mode in ("tensile", "shear", "mixed"))
    return {"run": run.folder.name, "radius_mm": radius, "breakdown_MPa": top * 1e-6, "theory_MPa": THEORY[round(radius, 1)],
            "over_theory_percent": 100.0 * (top * 1e-6 / THEORY[round(radius, 1)] - 1.0),
            "breakdown_ms": run.summary["breakdown_time_s"] * 1e3, "loading_GPa_per_m2": stiffness * 1e-9,
            "loading_theory_GPa_per_m2": theory * 1e-9, "loading_over_theory_percent": 100.0 * (stiffness / theory - 1.0),
            "shut_in_MPa": float(pressure[settled].mean() * 1e-6), "shut_in_spread_MPa": float(pressure[settled].std() * 1e-6),
            "shut_in_trend_MPa_per_ms": float(np.polyfit(time[settled] * 1e3, pressure[settled] * 1e-6, 1)[0]),
            "broken_after_shut_in": int(broken[-1] - broken[np.searchsorted(time, shut)]),
            "extent_x_mm": run.summary["extent_x_m"] * 1e3, "extent_y_mm": run.summary["extent_y_m"] * 1e3,
            "energy_residual_max": run.summary["energy_residual_max"], "triangles": run.summary["triangles"],
            "steps": run.summary["steps"]}


def shut_in(run):
    """[s]"""
    return run.case["fluid"]["pump"][0]["to"]


def table(rows):
    lines = [[f"{row['radius_mm']:g}", f"{row['breakdown_MPa']:.1f}",
              f"{row['theory_MPa']:.1f} ({row['over_theory_percent']:+.1f} %)",
              f"{row['loading_GPa_per_m2']:.1f}",
              f"{row['loading_theory_GPa_per_m2']:.1f} ({row['loading_over_theory_percent']:+.2f} %)",
              f"{row['shut_in_MPa']:.2f} ± {row['shut_in_spread_MPa']:.2f}", f"{row['shut_in_trend_MPa_per_ms']:+.3f}",
              str(row["broken_after_shut_in"]), f"{row['energy_residual_max']:.1e}"] for row in rows]
    header = ["radius [mm]", "breakdown, total [MPa]", "theory", "loading line [GPa/m2]", "theory", "shut in [MPa]",
              "its trend [MPa/ms]", "broken after", "energy residual"]
    return results_page.markdown(header, lines)


def draw_pressure(runs, rows, path):
    figure, (curves, radii) = plt.subplots(1, 2, figsize=(12.4, 4.8), width_ratios=[1.7, 1.0], layout="constrained")
    for run, row in zip(runs, rows):
        color = COLORS[round(row["radius_mm"], 1)]
        time, pressure = run.history["time_s"] * 1e3, run.history["pressure_Pa"] / 1e6
        curves.plot(time, pressure, color=color, linewidth=1.3,
                    label=f"radius {row['radius_mm']:g} mm: {row['breakdown_MPa']:.1f} MPa")
        rising = time <= row["breakdown_ms"]
        curves.plot(time[rising], loading_line(run, run.history["injected_m2"][rising]) / 1e6, color=look.INK, linewidth=0.9,
                    linestyle=(0, (2, 3)), label="elastic hole filled with water" if run is runs[0] else None)
        curves.plot(row["breakdown_ms"], row["breakdown_MPa"], "o", color=color, markersize=5)
        shut = shut_in(run) * 1e3
        curves.plot(shut, np.interp(shut, time, pressure), "v", color=color, markersize=6,
                    label="shut in" if run is runs[-1] else None)
    closure = (runs[0].case["rock"]["pore_pressure"] - runs[0].case["stress"]["xx"]) * 1e-6
    curves.axhline(closure, color=look.FAINT, linewidth=0.8)
    curves.text(curves.get_xlim()[1], closure, f"least total stress {closure:.2f} MPa ", fontsize=8, ha="right", va="top",
                color="#5b6873")
    look.name_axes(curves, "Total pressure in the wellbore, 1 m³/min per metre", "time [ms]", "pressure [MPa]")
    curves.legend(loc="upper right", fontsize=8)
    x = sorted(THEORY)
    radii.plot(x, [THEORY[r] for r in x], "-", color=look.INK, linewidth=1.0, label="cohesive theory, quasi-static")
    radii.plot(x, [THEORY[r] for r in x], "o", color=look.INK, markerfacecolor="white", markersize=7)
    radii.plot([row["radius_mm"] for row in rows], [row["breakdown_MPa"] for row in rows], "D", color=look.ACCENT,
               markersize=5, label="this code")
    radii.axhline(PAPER, color=look.WATER, linewidth=1.0, linestyle=(0, (5, 2)), label="paper and field, about 76 MPa")
    radii.axhline(HUBBERT_WILLIS, color=look.FAINT, linewidth=1.0, label="paper's formula (Hubbert-Willis), 55.6 MPa")
    radii.set_ylim(50.0, 82.0)
    look.name_axes(radii, "Breakdown over the wellbore's radius", "radius [mm]", "total pressure [MPa]")
    radii.legend(loc="center right", fontsize=8)
    look.save(figure, path)


def draw_shut_in(runs, rows, path):
    figure, grid = plt.subplots(1, len(runs), figsize=(4.1 * len(runs), 3.6), layout="constrained")
    for axes, run, row in zip(grid, runs, rows):
        time = run.history["time_s"]
        after = time >= shut_in(run)
        axes.plot((time[after] - shut_in(run)) * 1e3, run.history["pressure_Pa"][after] / 1e6, linewidth=1.1,
                  color=COLORS[round(row["radius_mm"], 1)])
        axes.axhline(row["shut_in_MPa"], color=look.INK, linewidth=0.8, linestyle=(0, (4, 2)))
        axes.set_ylim(row["shut_in_MPa"] - 1.0, row["shut_in_MPa"] + 1.0)
        look.name_axes(axes, f"radius {row['radius_mm']:g} mm: mean {row['shut_in_MPa']:.2f} MPa",
                       "time since shut-in [ms]", "total pressure [MPa]")
    look.save(figure, path)


def make(runs, folder):
    runs = list(runs.values())
    rows = [row_of(run) for run in runs]
    results_page.write_csv(folder / "results.csv", rows)
    results_page.put_between(folder / "README.md", "results", table(rows))
    draw_pressure(runs, rows, folder / "pressure.png")
    draw_shut_in(runs, rows, folder / "shut_in.png")
    fractures_figure.draw(runs[0], folder / "fractures.png")


if __name__ == "__main__":
    results_page.main("montney_dfit", make, __doc__)
