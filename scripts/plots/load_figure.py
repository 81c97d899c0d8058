# SPDX-License-Identifier: GPL-3.0-or-later
"""load.png: force of every load against its displacement, and over time."""

import matplotlib.pyplot as plt
import numpy as np

import look


def names(run):
    """Loads of a run that move something or push, by their columns in history.csv."""
    return [name[:-len("_force_x_N_m")] for name in run.history if name.endswith("_force_x_N_m")]


def along(run, name):
    """Force and displacement of a load, in the direction of its largest force."""
    axes = [(run.history[f"{name}_force_{a}_N_m"], run.history[f"{name}_displacement_{a}_m"]) for a in "xy"]
    return max(axes, key=lambda pair: np.max(np.abs(pair[0])))


def draw(run, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.2, 4.2), sharey=True)
    look.set_titles(figure, run, "Loads")
    for i, name in enumerate(names(run)):
        force, displacement = along(run, name)
        left.plot(displacement * 1e6, force / 1e3, linewidth=1.2, color=f"C{i}", label=name)
        right.plot(run.history["time_s"] * 1e3, force / 1e3, linewidth=1.2, color=f"C{i}")
    left.set_xlabel("displacement [µm]")
    left.set_ylabel("force [kN per m of thickness]")
    right.set_xlabel("time [ms]")
    left.legend()
    figure.tight_layout(rect=(0, 0, 1, look.below_titles(figure)))
    look.save(figure, path)
