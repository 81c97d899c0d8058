#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws runs of cases/kgd over their limiting solutions, and prints the mean difference over the last two thirds.

    kgd_figure.py RUN_DIR ... -o FIGURE

A run without leak-off is held against the toughness vertex if K_m is above 4.8, else against the viscosity vertex;
one with Carter leak-off against the solution from toughness to leak-off.
"""

import argparse
import sys

import matplotlib.pyplot as plt
import numpy as np

import look
from run_data import Run, RunError


def reference(case, time):
    """Net pressure [Pa] and opening [m] at the well, half-length [m], and what they are."""
    rock, fluid = case["rock"], case["fluid"]
    modulus = rock["young_modulus"] / (1.0 - rock["poisson_ratio"] ** 2)
    toughness = np.sqrt(modulus * rock["fracture_energy_mode1"])
    rate = fluid["pump"][0]["rate"] / case["well"]["height"]
    mu = 12.0 * fluid["viscosity"]
    number = 4.0 * np.sqrt(2.0 / np.pi) * toughness / (modulus ** 3 * mu * rate) ** 0.25
    if fluid["leak_off"] == "carter":
        length = carter_length(modulus, toughness, rate, fluid["leak_off_coefficient"], time)
        name = "toughness and Carter leak-off"
    elif number > 4.8:
        length = (modulus * rate * time / (2.0 * np.sqrt(np.pi) * toughness)) ** (2.0 / 3.0)
        name = f"toughness vertex, K_m = {number:.2g}"
    else:
        scale = np.cbrt(mu / (modulus * time))
        unit = (modulus * rate ** 3 * time ** 4 / mu) ** (1.0 / 6.0)
        return 0.54482 * modulus * scale, 1.12583 * scale * unit, 0.61541 * unit, f"viscosity vertex, K_m = {number:.2g}"
    pressure = toughness / np.sqrt(np.pi * length)
    return pressure, 4.0 * pressure * length / modulus, length, name


def carter_length(modulus, toughness, rate, leak_off, time):
    """Q t = 2 sqrt(pi) K a^1.5/E' + 8 C_L int sqrt(t - t0(x)) dx, by pieces over which t0 is linear."""
    end = max(time[-1], 1.0)
    longest = (modulus * rate * end / (2.0 * np.sqrt(np.pi) * toughness)) ** (2.0 / 3.0)
    lengths, times = [0.0], [0.0]
    while times[-1] < end:
        lengths.append(longest * (len(lengths) / 400.0) ** 2)
        a, low, high = np.array(lengths), times[-1], 2.0 * end + 1e-9
        known = np.array(times)
        for _ in range(50):
            middle = 0.5 * (low + high)
            arrival = np.append(known, middle)
            pieces = ((middle - arrival[:-1]) ** 1.5 - (middle - arrival[1:]) ** 1.5) / np.diff(arrival)
            held = (2.0 * np.sqrt(np.pi) * toughness * a[-1] ** 1.5 / modulus
                    + 8.0 * leak_off * np.sum(np.diff(a) * pieces) * 2.0 / 3.0)
            low, high = (middle, high) if rate * middle < held else (low, middle)
        times.append(0.5 * (low + high))
    return np.interp(time, times, lengths)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN_DIR")
    parser.add_argument("-o", "--output", required=True, metavar="FIGURE")
    arguments = parser.parse_args()
    try:
        runs = [Run(folder) for folder in arguments.runs]
    except RunError as error:
        sys.exit(f"kgd_figure: {error}")
    look.make_small()
    figure, axes = plt.subplots(3, len(runs), figsize=(3.6 * len(runs), 7.0), squeeze=False, sharex="col")
    for column, run in zip(axes.T, runs):
        history, case = run.history, run.case
        keep = history["time_s"] > 0.02 * history["time_s"][-1]
        time = history["time_s"][keep]
        pressure, opening, length, name = reference(case, time)
        net = history["pressure_Pa"][keep] - case["rock"]["pore_pressure"] + case["stress"]["yy"]
        middle = history["half_length_m"][keep]
        late = time > time[-1] / 3.0
        print(name)
        for ax, ours, theirs, label, factor in (
                (column[0], net, pressure, "net pressure [MPa]", 1e-6),
                (column[1], history["opening_m"][keep], opening, "opening at the well [mm]", 1e3),
                (column[2], middle, length, "half-length [m]", 1.0)):
            ax.plot(time, theirs * factor, color=look.ACCENT, linewidth=2.4, alpha=0.5, label="solution")
            ax.plot(time, ours * factor, color=look.INK, linewidth=1.0, label="crackle")
            ax.set_ylim(0.0, 1.6 * np.max(theirs[late]) * factor)
            off = 100.0 * np.mean(ours[late] / theirs[late] - 1.0)
            print(f"  {label}: {off:+.2f} % on average")
            ax.set_title(f"{off:+.1f} %", loc="right", fontsize=8.5)
            ax.set_ylabel(label if ax in axes[:, 0] else "")
        column[0].set_title(name, loc="left", fontsize=8.5)
        column[2].set_xlabel("time [s]")
    axes[0, 0].legend()
    figure.tight_layout()
    look.save(figure, arguments.output)


if __name__ == "__main__":
    main()
