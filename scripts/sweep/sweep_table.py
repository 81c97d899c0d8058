# SPDX-License-Identifier: GPL-3.0-or-later
"""A sweep: a base case, a table of overrides, and a folder with one run a row.

    DIR/sweep.json     the base case and what a run may take
    DIR/table.csv      one row a run: `run` (name), `seed`, and any key of a case ("rock.density")
    DIR/runs/NAME      run folders; row.json in each says which row they are of
    DIR/failed/NAME-N  what was left of runs that failed, before they were run again

A run is done when its status.json says so and its row.json is that of the row as it stands now: a row that
was changed, or whose base case was, is run again. One that was interrupted or killed goes on from its checkpoint.
"""

import csv
import hashlib
import json
import math
import pathlib
import re
import socket
import time
import tomllib

SETTINGS = {"threads": 1, "memory_mb": 2000, "minutes": 60}
STATES = ("done", "running", "preparing", "interrupted", "failed", "killed", "waiting")
SILENT_S = 600  # a run on another machine that has not said anything for so long counts as killed


class SweepError(Exception):
    """One line for the user."""


def read_json(path):
    """{} where there is none, or where it was cut short."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def read_table(path):
    """[(name, {key: text})], rows as they stand; an empty cell overrides nothing."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file, skipinitialspace=True))
    except OSError as error:
        raise SweepError(f"{path}: {error.strerror}") from error
    rows = [row for row in rows if any(cell.strip() for cell in row)]
    if len(rows) < 2:
        raise SweepError(f"{path}: needs a first line with the keys and at least one row")
    names = [name.strip() for name in rows[0]]
    for name in names:
        if not re.fullmatch(r"run|seed|[a-z_0-9]+(\.[a-z_0-9]+)*", name) or names.count(name) > 1:
            raise SweepError(f'{path}: the column "{name}" is not "run", "seed" or a key such as rock.density, '
                             "or is there twice")
    found = []
    for number, row in enumerate(rows[1:], 1):
        if len(row) != len(names):
            raise SweepError(f"{path}: row {number} has {len(row)} cells for {len(names)} columns")
        cells = {name: cell.strip() for name, cell in zip(names, row) if cell.strip()}
        name = cells.pop("run", f"{number:03d}")
        if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name) or name in dict(found):
            raise SweepError(f'{path}: row {number}: "{name}" is no name for a folder, or another row has it')
        found.append((name, cells))
    return found


def case_files(path):
    """The case and what it includes, and so on."""
    try:
        included = tomllib.loads(path.read_text(encoding="utf-8")).get("include", [])
    except OSError as error:
        raise SweepError(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise SweepError(f"{path}: {error}") from error
    files = [path]
    for name in [included] if isinstance(included, str) else included:
        files += case_files(path.parent / name)
    return files


def is_alive(process):
    """Whether that process is there and is a crackle: numbers are used again."""
    try:
        return b"crackle" in pathlib.Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")[0]
    except OSError:
        return False


class Row:
    """A row of the table and its run."""

    def __init__(self, sweep, number, name, overrides):
        self.number, self.name, self.overrides = number, name, overrides
        self.folder = sweep.folder / "runs" / name
        self.fingerprint = hashlib.sha256((sweep.case_text + json.dumps(overrides, sort_keys=True)).encode()).hexdigest()

    def status(self):
        """status.json with a state of STATES."""
        status = read_json(self.folder / "status.json")
        if read_json(self.folder / "row.json").get("fingerprint") != self.fingerprint:
            return {"state": "waiting"}
        if not status:
            return {"state": "waiting"}
        if status["state"] in ("running", "preparing") and not self._goes_on(status):
            status["state"] = "killed"
        return status

    def is_done(self):
        return self.status()["state"] == "done"

    def can_be_resumed(self):
        return self.status()["state"] in ("interrupted", "killed") and (self.folder / "resolved.toml").exists()

    def _goes_on(self, status):
        if status["host"] == socket.gethostname():
            return is_alive(status["process"])
        return time.time() - (self.folder / "status.json").stat().st_mtime < SILENT_S

    def share(self):
        """Of the run that is behind it, 0 to 1."""
        status = self.status()
        if status["state"] == "waiting" or not status.get("end_time_s"):
            return 0.0
        return min(1.0, status["time_s"] / status["end_time_s"])

    def command(self, sweep):
        if self.can_be_resumed():
            return [sweep.crackle, "run", "--resume", str(self.folder), "-q", "-j", str(sweep.threads)]
        words = [sweep.crackle, "run", str(sweep.case), "-o", str(self.folder), "-q", "-j", str(sweep.threads)]
        for key, text in self.overrides.items():
            words += ["--seed", text] if key == "seed" else ["--set", f"{key}={text}"]
        return words


class Sweep:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        settings = read_json(self.folder / "sweep.json")
        if not settings:
            raise SweepError(f"{folder}: no sweep is here (sweep.json is missing); make one by: sweep.py new")
        self.case = pathlib.Path(settings["case"])
        self.crackle = settings["crackle"]
        self.threads, self.memory_mb, self.minutes = (int(settings[name]) for name in SETTINGS)
        self.case_text = "".join(file.read_text(encoding="utf-8") for file in case_files(self.case))
        table = read_table(self.folder / "table.csv")
        self.rows = [Row(self, number, name, cells) for number, (name, cells) in enumerate(table, 1)]

    def row(self, name):
        for row in self.rows:
            if row.name == name:
                return row
        raise SweepError(f'{self.folder}: no row is named "{name}"')

    def to_do(self):
        """Rows that are neither done nor under way."""
        return [row for row in self.rows if row.status()["state"] not in ("done", "running", "preparing")]

    def clear(self, row):
        """Makes room for a run: what an earlier one left goes to failed/."""
        if not row.folder.exists():
            return
        status = row.status()
        if status["state"] in ("running", "preparing"):
            raise SweepError(f"{row.folder}: this run is under way (process {status['process']} on {status['host']})")
        aside = self.folder / "failed"
        aside.mkdir(exist_ok=True)
        for n in range(1, 1_000_000):
            if not (aside / f"{row.name}-{n}").exists():
                row.folder.rename(aside / f"{row.name}-{n}")
                return

    def marker(self, row):
        """A file that is there when the run is done, for Snakemake."""
        return self.folder / "done" / row.name

    def renew_markers(self):
        (self.folder / "done").mkdir(exist_ok=True)
        for row in self.rows:
            if row.is_done():
                self.marker(row).touch()
            else:
                self.marker(row).unlink(missing_ok=True)

    def progress(self):
        """Lines that say how the whole sweep stands."""
        statuses = [row.status() for row in self.rows]
        share = sum(row.share() for row in self.rows) / len(self.rows)
        counts = {state: sum(status["state"] == state for status in statuses) for state in STATES}
        width = 30
        full = int(share * width)
        lines = [f"[{'#' * full}{'.' * (width - full)}] {100.0 * share:5.1f} %  " +
                 ", ".join(f"{count} {state}" for state, count in counts.items() if count)]
        spent = [(row.share(), status.get("wall_s", 0.0)) for row, status in zip(self.rows, statuses)]
        behind, wall = sum(s for s, _ in spent), sum(w for s, w in spent if s > 0.0)
        under_way = counts["running"] + counts["preparing"]
        if behind > 0.0 and under_way and not math.isclose(share, 1.0):
            lines.append(f"about {wall / behind * (len(self.rows) - behind) / under_way / 60.0:.1f} min left with "
                         f"{under_way} at a time")
        for row, status in zip(self.rows, statuses):
            if status["state"] not in ("done", "waiting"):
                lines.append(f"  {row.name}: {status['state']}, {100.0 * row.share():.0f} % in "
                             f"{status['wall_s']:.0f} s {status['reason']}".rstrip())
        return lines
