#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs small scenes that break, again, with several numbers of threads and with other builds, and compares every byte.

Compared are history.csv, events.csv, events.xml, fields, fractures, resolved.toml, and summary.json but for its wall
times; run.log and status.json say when and how fast and are left out. Between builds energy_viscous_J_m and what follows
from it, energy_residual, are left out too: the viscous power of a block is summed in the order of the vector width that
the compiler takes. Nothing else follows from them.
"""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = ["mesh.size_fine=15 mm", "mesh.size_coarse=0.5 m", "run.end_time=110 us", "fluid.pump.0.rate=3 m2/s"]
SCENES = {  # case, settings, fewest events
    "elements on all edges": ("granite_wellbore/smoke_anisotropic.toml", SMALL, 10),
    "on demand": ("granite_wellbore/smoke_on_demand.toml", [*SMALL, "run.fast_forward=false"], 10),
    "joints": ("heavily_fractured/smoke_anisotropic.toml", [*SMALL, "mesh.fine_radius=0.1 m"], 10),
    "smeared damage in layers": ("layered_block/smoke_damage.toml", ["run.end_time=0.2 ms"], 5),
    "field time": ("free_paths/smoke.toml", ["run.end_time=1 s"], 0),
}


def results(folder):
    """Bytes of what a run left, by the file's name."""
    files = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_file() and name not in ("run.log", "status.json"):
            files[name] = path.read_bytes()
    files["summary.json"] = re.sub(rb'"(wall_s|core_ns_per_triangle_step)": [^,]*', b"", files["summary.json"])
    return files


def without_viscous_energy(files):
    """The same without the sum that another build takes in another order."""
    kept = dict(files)
    rows = [line.split(b",") for line in files["history.csv"].splitlines()]
    left_out = [i for i, name in enumerate(rows[0]) if name in (b"energy_viscous_J_m", b"energy_residual")]
    kept["history.csv"] = [[cell for i, cell in enumerate(row) if i not in left_out] for row in rows]
    kept["summary.json"] = re.sub(rb'"energy_residual_max": [^,]*', b"", files["summary.json"])
    return kept


def run(crackle, scene, threads, out):
    case, settings, _ = SCENES[scene]
    command = [crackle, "run", ROOT / "cases" / case, "-o", out, "-q", "-j", str(threads)]
    for setting in settings:
        command += ["--set", setting]
    code = subprocess.run(command, check=False).returncode
    if code != 0:
        sys.exit(f"same_bits: {scene}, {threads} threads: {crackle} ends with code {code}")
    return results(out)


def main():
    parser = argparse.ArgumentParser(prog="same_bits.py", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crackle", default=ROOT / "build/src/cli/crackle", help="the program (that in build/)")
    parser.add_argument("--threads", nargs="*", type=int, default=[], help="numbers of threads to run it with too")
    parser.add_argument("--other", nargs="*", default=[], help="programs of other builds to compare with")
    options = parser.parse_args()
    failed = False
    for scene in SCENES:
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            first = run(options.crackle, scene, 1, folder / "first")
            events = first["events.csv"].count(b"\n") - 1
            others = {"again": (options.crackle, 1)}
            others.update({f"{n} threads": (options.crackle, n) for n in options.threads})
            others.update({other: (other, 2) for other in options.other})
            print(f"{scene}: {len(first)} files, {events} events; the same bytes:", end="", flush=True)
            for name, (crackle, threads) in others.items():
                files = run(crackle, scene, threads, folder / name.replace("/", "_"))
                ours = first
                if crackle != options.crackle:
                    ours, files = without_viscous_energy(first), without_viscous_energy(files)
                differ = [f for f in sorted(ours.keys() | files.keys()) if ours.get(f) != files.get(f)]
                print(f" {name}{' NOT: ' + ', '.join(differ) if differ else ''};", end="", flush=True)
                failed = failed or bool(differ)
            print()
            if events < SCENES[scene][2]:
                sys.exit(f"same_bits: {scene}: {events} events are too few to say anything")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
