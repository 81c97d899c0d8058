#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs smoke variants of cases and compares a few scalars with those written down beside this script.

This only guards against change: the numbers are what crackle gave when they were last renewed, not what is right.
After a change that is meant, renew them and say in the commit why they changed:

    tests/regression/regression.py --renew [CASE...]
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FROM_SUMMARY = ["triangles", "steps", "events", "breakdown_pressure_Pa", "breakdown_time_s", "propagation_pressure_Pa",
                "broken_length_m", "extent_x_m", "extent_y_m", "magnitude_max"]
FROM_HISTORY = ["pressure_Pa", "cavity_volume_m2", "broken_tensile", "broken_shear", "broken_mixed", "energy_strain_J_m",
                "energy_fracture_J_m", "energy_friction_J_m", "energy_viscous_J_m"]  # the last row
# The bits are the same with every vector width, number of threads, build and compiler tried (same_bits.py); mathematical
# functions of another C library may differ in the last one.
TOLERANCE = 1e-6


def file_of(case):
    return pathlib.Path(__file__).parent / case.parent.name / f"{case.stem}.csv"


def scalars_of(crackle, case):
    """What a run of the case gives, by name; counts are int."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "run"
        ran = subprocess.run([crackle, "run", case, "-o", out, "-q", "-j", "1"], check=False)
        if ran.returncode != 0:
            sys.exit(f"regression: {case} ends with code {ran.returncode}")
        summary = json.loads((out / "summary.json").read_text())
        with open(out / "history.csv", newline="", encoding="utf-8") as history:
            last = list(csv.DictReader(history))[-1]
    scalars = {name: summary[name] for name in FROM_SUMMARY if summary[name] is not None}
    for name in FROM_HISTORY:
        if name in last:
            scalars[f"{name}.last"] = json.loads(last[name])
    return scalars


def renew(case, scalars):
    path = file_of(case)
    path.parent.mkdir(exist_ok=True)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["scalar", "value"])
        writer.writerows((name, repr(value)) for name, value in scalars.items())
    print(f"{path.relative_to(ROOT)}: {len(scalars)} scalars")


def differences(case, scalars):
    """One line for each scalar that is another than it was, and the largest relative difference."""
    path = file_of(case)
    if not path.exists():
        return [f"there is no {path.relative_to(ROOT)}"], 0.0
    with open(path, newline="", encoding="utf-8") as file:
        before = {row["scalar"]: json.loads(row["value"]) for row in csv.DictReader(file)}
    lines, worst = [], 0.0
    for name in sorted(before.keys() | scalars.keys()):
        was, now = before.get(name), scalars.get(name)
        if was == now:
            continue
        if was is None or now is None or isinstance(was, int) or isinstance(now, int):
            lines.append(f"{name}: was {was}, is {now}")
            continue
        relative = abs(now - was) / max(abs(was), abs(now))
        worst = max(worst, relative)
        if relative > TOLERANCE:
            lines.append(f"{name}: was {was:.10g}, is {now:.10g} (relative {relative:.1e})")
    return lines, worst


def not_guarded():
    """One line for each folder of cases without a smoke variant, and for each file of scalars without its case.
    Folders of a chart have points.csv instead, and a stage of CI of their own."""
    lines = []
    for folder in sorted(path for path in (ROOT / "cases").iterdir() if path.is_dir()):
        if not list(folder.glob("smoke*.toml")) and not (folder / "points.csv").exists():
            lines.append(f"cases/{folder.name} has no smoke variant")
    for path in sorted(pathlib.Path(__file__).parent.glob("*/*.csv")):
        if not (ROOT / "cases" / path.parent.name / f"{path.stem}.toml").exists():
            lines.append(f"{path.relative_to(ROOT)} is of no case")
    return lines


def main():
    parser = argparse.ArgumentParser(prog="regression.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--renew", action="store_true", help="write down the scalars of now")
    parser.add_argument("--cover", action="store_true", help="only see whether every case is guarded")
    parser.add_argument("--crackle", default=ROOT / "build/src/cli/crackle", help="the program (that in build/)")
    parser.add_argument("case", nargs="*", type=pathlib.Path, help="case files (default: cases/*/smoke*.toml)")
    options = parser.parse_args()
    if options.cover:
        sys.exit("\n".join(not_guarded()) or None)
    cases = [case.resolve() for case in options.case] or sorted(ROOT.glob("cases/*/smoke*.toml"))
    failed = False
    for case in cases:
        scalars = scalars_of(options.crackle, case)
        if options.renew:
            renew(case, scalars)
            continue
        lines, worst = differences(case, scalars)
        name = case.relative_to(ROOT)
        print(f"{name}: {len(scalars)} scalars, largest relative difference {worst:.1e}")
        for line in lines:
            print(f"  {line}")
        if lines:
            failed = True
            print(f"  This only guards against change. If it is meant: tests/regression/regression.py --renew {name}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
