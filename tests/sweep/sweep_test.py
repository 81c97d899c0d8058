# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of sweeps share: a sweep of ten tiny runs in a folder of its own."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SWEEP = ROOT / "scripts/sweep/sweep.py"
TINY = ROOT / "tests/sweep/tiny.toml"
SKIPPED = 77
LONG_RUN = "005"  # the one that is killed; 010 is the same, left alone

TABLE = """run, stress.yy, seed, run.safety
001, -4.9 MPa, 1,
002, -4.9 MPa, 2,
003, -5.5 MPa, 1,
004, -5.5 MPa, 2,
005, -6 MPa, 1, 0.2
006, -6 MPa, 2,
007, , ,
008, "-4.0 MPa", ,
009, -4.5 MPa, 3,
010, -6 MPa, 1, 0.2
"""


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def sweep(*words, code=0):
    """@returns what the command printed; fails where its exit code is another one."""
    result = subprocess.run(["/usr/bin/python3", str(SWEEP), *map(str, words)], capture_output=True, text=True,
                            check=False)
    print(result.stdout, result.stderr, sep="", end="")
    check(result.returncode == code, f"sweep.py {words[0]} ended with {result.returncode} instead of {code}")
    return result.stdout + result.stderr


class TinySweep:
    """Makes the sweep; the folder is removed with it."""

    def __init__(self, crackle):
        self.place = tempfile.TemporaryDirectory(prefix="crackle_sweep_")
        self.folder = pathlib.Path(self.place.name) / "sweep"
        table = pathlib.Path(self.place.name) / "table.csv"
        table.write_text(TABLE, encoding="utf-8")
        sweep("new", TINY, table, "-o", self.folder, "--crackle", crackle)

    def status(self, name):
        try:
            return json.loads((self.folder / "runs" / name / "status.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}

    def wait_for(self, name, states, seconds=60.0):
        end = time.monotonic() + seconds
        while self.status(name).get("state") not in states:
            check(time.monotonic() < end, f"run {name} did not get to {states}: {self.status(name)}")
            time.sleep(0.002)

    def wait_for_file(self, name, file, seconds=60.0):
        end = time.monotonic() + seconds
        while not (self.folder / "runs" / name / file).exists():
            check(time.monotonic() < end, f"run {name} wrote no {file}")
            time.sleep(0.002)

    def starts(self):
        """When every run that is done was started: what is run again shows."""
        return {path.parent.name: path.stat().st_mtime_ns for path in self.folder.glob("runs/*/row.json")
                if self.status(path.parent.name).get("state") == "done"}

    def check_resumed(self, before):
        """All ten are done, only the long one was run on, and it is the run that it would have been."""
        after = self.starts()
        check(len(before) == 9 and LONG_RUN not in before, f"nine were done before: {sorted(before)}")
        check(len(after) == 10, f"ten are done: {sorted(after)}")
        check({name for name in after if after[name] != before.get(name)} == {LONG_RUN}, "only one was run on")
        check(not (self.folder / f"failed/{LONG_RUN}-1").exists(), "and not from its beginning")
        for name in ("resolved.toml", "history.csv", "summary.json", "status.json"):
            check((self.folder / "runs" / LONG_RUN / name).is_file(), f"{name} is there")
        same = [(self.folder / "runs" / name / "history.csv").read_bytes() for name in (LONG_RUN, "010")]
        check(same[0] == same[1], "the run is the same as its twin that was not killed")

    def check_gathered(self):
        sweep("gather", self.folder, "--plot", "broken_length_m", "stress.yy")
        with open(self.folder / "gathered.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        check([row["run"] for row in rows] == [f"{i:03d}" for i in range(1, 11)], "one row a run, in order")
        check(all(row["state"] == "done" and float(row["breakdown_pressure_Pa"]) > 1e6 for row in rows), "with values")
        check([float(row["stress.yy"]) for row in rows][::3] == [-4.9e6, -5.5e6, -4.9e6, -6e6], "keys in SI")
        for name in ("pressure.png", "fractures.png", "broken_length_m-stress.yy.png"):
            check((self.folder / name).stat().st_size > 5000, f"{name} is drawn")
