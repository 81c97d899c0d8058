#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints the tables of a case's README: runs beside a reference.csv, and which of its bounds they keep.

reference.csv has the columns kind (value, least, most), quantity, unit, one column a run, source.
"""

import argparse
import csv
import json
import pathlib
import sys

# name in the table: (unit, digits after the point)
ROWS = {"breakdown_pressure": ("MPa", 2), "breakdown_time": ("ms", 3), "propagation_pressure": ("MPa", 2),
        "extent_x": ("mm", 0), "extent_y": ("mm", 0), "extent_ratio": ("-", 2), "broken_length": ("mm", 0),
        "events": ("-", 0), "magnitude_min": ("-", 2), "magnitude_max": ("-", 2), "magnitude_share": ("-", 3),
        "energy_residual_max": ("-", 6), "triangles": ("-", 0), "steps": ("-", 0)}
USUAL_MAGNITUDES = (-6.0, -3.5)


def numbers_of(folder):
    folder = pathlib.Path(folder)
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    numbers = {name: summary[name] for name in ROWS if name in summary}
    numbers["breakdown_pressure"] = summary["breakdown_pressure_Pa"] / 1e6
    numbers["propagation_pressure"] = summary["propagation_pressure_Pa"] / 1e6
    numbers["breakdown_time"] = summary["breakdown_time_s"] * 1e3
    for name in ("extent_x", "extent_y", "broken_length"):
        numbers[name] = summary[f"{name}_m"] * 1e3
    if numbers["extent_y"] > 0.0:
        numbers["extent_ratio"] = numbers["extent_x"] / numbers["extent_y"]
    with open(folder / "events.csv", newline="", encoding="utf-8") as file:
        magnitudes = [float(row["magnitude"]) for row in csv.DictReader(file) if row["magnitude"]]
    if magnitudes:
        low, high = USUAL_MAGNITUDES
        numbers["magnitude_share"] = sum(low <= m <= high for m in magnitudes) / len(magnitudes)
    return numbers


def print_row(cells):
    print("| " + " | ".join(cells) + " |")


def print_head(cells):
    print_row(cells)
    print("|---|" + "---:|" * (len(cells) - 1))


def print_numbers(runs, reference):
    print_head(["quantity"] + list(runs))
    for name, (unit, digits) in ROWS.items():
        label = name.replace("_", " ") + ("" if unit == "-" else f" [{unit}]")
        print_row([f"**{label}, crackle**"] +
                  [f"**{numbers[name]:.{digits}f}**" if name in numbers else "" for numbers in runs.values()])
        for row in reference:
            if row["kind"] == "value" and row["quantity"] == name:
                print_row([f"{row['source']}"] + [row[run] for run in runs])


def print_bounds(runs, reference):
    """@returns how many bounds are broken"""
    broken = 0
    print_head(["bound"] + list(runs))
    for row in reference:
        if row["kind"] == "value":
            continue
        name = row["quantity"]
        sign, unit = ("≥", "≤")[row["kind"] == "most"], "" if row["unit"] == "-" else f" [{row['unit']}]"
        cells = []
        for run, numbers in runs.items():
            if not row[run]:
                cells.append("")
                continue
            bound, value = float(row[run]), numbers.get(name, float("nan"))
            holds = value >= bound if row["kind"] == "least" else value <= bound
            broken += not holds
            cells.append(f"{value:.4g} {sign} {row[run]}: {'holds' if holds else '**does not hold**'}")
        remark = f", {row['source']}" if row["source"] else ""
        print_row([f"{name.replace('_', ' ')}{unit}{remark}"] + cells)
    return broken


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("reference", metavar="REFERENCE_CSV")
    parser.add_argument("runs", metavar="NAME=RUN_DIR", nargs="+", help="NAME is a column of the reference")
    arguments = parser.parse_args()
    try:
        with open(arguments.reference, newline="", encoding="utf-8") as file:
            reference = list(csv.DictReader(file))
        runs = {}
        for text in arguments.runs:
            name, _, folder = text.partition("=")
            if not folder or name not in reference[0]:
                sys.exit(f"case_table: {text}: give NAME=RUN_DIR, NAME one of the columns of {arguments.reference}")
            runs[name] = numbers_of(folder)
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"case_table: {error}")
    print_numbers(runs, reference)
    print()
    sys.exit(1 if print_bounds(runs, reference) else 0)


if __name__ == "__main__":
    main()
