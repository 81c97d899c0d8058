# SPDX-License-Identifier: GPL-3.0-or-later
"""gathered.csv of a sweep and its figures: pressure.png (curves overlaid), fractures.png (side by side), and
VALUE-KEY.png for any value of summary.json against any key of the table."""

import csv
import pathlib
import sys
import tomllib

from sweep_table import SweepError, read_json

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "plots"))
import look
import matplotlib.pyplot as plt
import numpy as np
import overlay_pressure
from matplotlib.collections import LineCollection
from run_data import MODES, Fractures, Run, shorten


def resolved(row, key):
    """The value of a key in SI, from the case as it was run; the text of the table before it was."""
    try:
        place = tomllib.loads((row.folder / "resolved.toml").read_text(encoding="utf-8"))
        for part in ("mesh.seed" if key == "seed" else key).split("."):
            place = place[int(part)] if isinstance(place, list) else place[part]
        return place
    except (OSError, KeyError, IndexError, ValueError):
        return row.overrides.get(key, "")


def write_csv(sweep, path):
    """One row a run: the table's keys in SI, how it went, and every value of summary.json. @returns columns, rows"""
    keys = list(dict.fromkeys(key for row in sweep.rows for key in row.overrides))
    rows, values = [], []
    for row in sweep.rows:
        status, summary = row.status(), read_json(row.folder / "summary.json")
        if status["state"] != "done":
            summary = {}
        values += [name for name in summary if name not in values]
        rows.append({"run": row.name, **{key: resolved(row, key) for key in keys}, "state": status["state"], **summary})
    columns = ["run", *keys, "state", *values]
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    print(path)
    return columns, rows


def label(row):
    return shorten(", ".join(f"{key.split('.')[-1]} {text}" for key, text in row.overrides.items()) or row.name, 48)


def draw_all(sweep, folder, columns, rows, plots):
    done = [row for row in sweep.rows if row.is_done()]
    if not done:
        print("no run is done yet: no figures")
        return
    runs = [Run(row.folder) for row in done]
    overlay_pressure.draw(runs, [label(row) for row in done], folder / "pressure.png")
    draw_fractures(runs, [label(row) for row in done], folder / "fractures.png")
    keys = columns[1:columns.index("state")]
    for value, key in plots or [("breakdown_pressure_Pa", key) for key in keys]:
        for name in (value, key):
            if name not in columns:
                raise SweepError(f'gather: there is no "{name}"; there are: {", ".join(columns)}')
        draw_values([row for row in rows if row["state"] == "done"], value, key, folder / f"{value}-{key}.png")


def draw_fractures(runs, labels, path):
    """The broken elements of every run at its end, to one scale."""
    last = [Fractures(frames[-1][1]) if (frames := run.frames("fractures")) else Fractures() for run in runs]
    reach = max([1.6 * run.wellbore_radius for run in runs] +
                [1.05 * np.abs(f.segments[f.broken]).max() for f in last if f.broken.any()] + [1e-6]) * 1e3
    columns = min(len(runs), max(3, int(np.ceil(np.sqrt(1.5 * len(runs))))))
    lines = -(-len(runs) // columns)
    figure, grid = plt.subplots(lines, columns, figsize=(2.9 * columns + 0.5, 3.1 * lines + 0.5), squeeze=False,
                                sharex=True, sharey=True)
    for axes in grid.flat[len(runs):]:
        axes.set_visible(False)
    for axes, run, fractures, text in zip(grid.flat, runs, last, labels):
        for mode, name in MODES.items():
            chosen = fractures.broken & (fractures.mode == mode)
            axes.add_collection(LineCollection(fractures.segments[chosen] * 1e3, colors=look.MODE_COLORS[mode],
                                               linewidths=1.3, label=name))
        look.draw_wellbore(axes, run.wellbore_radius * 1e3)
        axes.set_aspect("equal")
        axes.set_xlim(-reach, reach)
        axes.set_ylim(-reach, reach)
        axes.set_title(look.plain(text), fontsize=8, loc="left")
    grid[0][0].legend(loc="upper right", fontsize=7)
    figure.supxlabel("x [mm]", fontsize=9)
    figure.supylabel("y [mm]", fontsize=9)
    figure.tight_layout()
    look.save(figure, path)


def draw_values(rows, value, key, path):
    """A value against a key; where the key is no number, its texts side by side."""
    pairs = [(row[key], row[value]) for row in rows if isinstance(row.get(value), (int, float))]
    texts = sorted({str(x) for x, _ in pairs}) if any(not isinstance(x, (int, float)) for x, _ in pairs) else []
    x = np.array([texts.index(str(a)) if texts else a for a, _ in pairs], dtype=float)
    y = np.array([b for _, b in pairs], dtype=float)
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    axes.plot(x, y, "o", color=look.WATER, markersize=5, alpha=0.8)
    places = np.unique(x)
    if len(places) < len(x):
        means = [y[x == place].mean() for place in places]
        spread = [y[x == place].std(ddof=1) if (x == place).sum() > 1 else 0.0 for place in places]
        axes.errorbar(places, means, spread, color=look.INK, linewidth=1.0, capsize=3, marker="_",
                      label="mean, standard deviation")
        axes.legend(loc="best")
    if texts:
        axes.set_xticks(range(len(texts)), [look.plain(shorten(text, 24)) for text in texts])
    axes.set_xlabel(f"{key}" if texts else f"{key} (SI)")
    axes.set_ylabel(value)
    figure.tight_layout()
    look.save(figure, path)
