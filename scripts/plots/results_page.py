# SPDX-License-Identifier: GPL-3.0-or-later
"""What the scripts that make a case's results from a sweep share: the runs by name, tables, marked parts of a README."""

import argparse
import csv
import pathlib
import sys

import look
import numpy as np
from run_data import Run, RunError

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "sweep"))
from sweep_table import Sweep, SweepError


def runs_of(folder):
    """{name: Run} of a sweep, all of which have to be done."""
    try:
        sweep = Sweep(folder)
    except SweepError as error:
        raise RunError(str(error)) from error
    missing = [row.name for row in sweep.rows if not row.is_done()]
    if missing:
        raise RunError(f"{folder}: not done yet: {', '.join(missing)}; run them by: sweep.py local {folder}")
    return {row.name: Run(row.folder) for row in sweep.rows}


def broken(run, until=float("inf"), since=0.0):
    """(x, y, length) [m] of the elements that broke in a time, a row each."""
    events = run.events
    chosen = ~run.slips() & (events["time_s"] <= until) & (events["time_s"] >= since)
    return np.column_stack([events[name][chosen] for name in ("x_m", "y_m", "length_m")])


def write_csv(path, rows):
    """rows: dictionaries with the same keys; numbers to 6 digits"""
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()})
    print(path)


def markdown(header, rows):
    """A table; the first column to the left, others to the right."""
    lines = ["| " + " | ".join(header) + " |", "|---|" + "---:|" * (len(header) - 1)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def put_between(path, name, text):
    """Replaces what stands between <!-- name: begin --> and <!-- name: end --> in a page."""
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
    page = path.read_text(encoding="utf-8")
    if page.count(begin) != 1 or page.count(end) != 1:
        raise RunError(f"{path}: the lines {begin.strip()} and {end} have to be there once each")
    head, rest = page.split(begin)
    path.write_text(head + begin + text + end + rest.split(end)[1], encoding="utf-8")
    print(path)


def main(name, make, description):
    """A case's results from its sweep: make(runs, folder) writes them."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sweep", metavar="SWEEP_DIR")
    parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the case, with its README.md")
    arguments = parser.parse_args()
    look.make_small()
    folder = pathlib.Path(arguments.output)
    try:
        make(runs_of(arguments.sweep), folder)
        for figure in folder.glob("*.png"):
            look.shrink(figure)
    except (RunError, OSError) as error:
        sys.exit(f"{name}_results: {error}")
