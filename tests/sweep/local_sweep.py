#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten runs on this machine by Snakemake: one is killed, seen, and resumed alone; the results are gathered."""

import os
import shutil
import signal
import subprocess
import sys

from sweep_test import LONG_RUN, SWEEP, TinySweep, check, skip, sweep

if shutil.which("snakemake") is None:
    skip("snakemake is not installed (scripts/setup --test)")
tiny = TinySweep(sys.argv[1])
sweep("new", "nowhere.toml", tiny.folder / "table.csv", "-o", tiny.folder / "other", "--crackle", sys.argv[1], code=1)
check("10 waiting" in sweep("status", tiny.folder), "nothing has run yet")

first = subprocess.Popen(["/usr/bin/python3", str(SWEEP), "local", str(tiny.folder), "--cores", "2"],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
tiny.wait_for(LONG_RUN, ("running", "done"))
os.kill(tiny.status(LONG_RUN)["process"], signal.SIGUSR1)
tiny.wait_for_file(LONG_RUN, "checkpoint_a.h5")
os.kill(tiny.status(LONG_RUN)["process"], signal.SIGSTOP)  # it would end before it is asked about
check(f"{LONG_RUN}: running" in sweep("status", tiny.folder), "it is seen to run")
check("under way" in sweep("row", tiny.folder, LONG_RUN, code=1), "and is not run twice at a time")
os.kill(tiny.status(LONG_RUN)["process"], signal.SIGKILL)
said = first.communicate(timeout=120)[0]
check(first.returncode == 1 and "1 of 10 runs are not done" in said, f"the killed run is seen: {said}")
check(f"{LONG_RUN}: killed" in sweep("status", tiny.folder), "and named")

before = tiny.starts()
check("10 done" in sweep("local", tiny.folder, "--cores", "2"), "all done")
tiny.check_resumed(before)
check("resumed from checkpoint_a.h5" in (tiny.folder / f"runs/{LONG_RUN}/run.log").read_text(encoding="utf-8"),
      "it went on from its checkpoint")
sweep("local", tiny.folder)
check(tiny.starts().items() >= before.items(), "nothing is run a third time")
tiny.check_gathered()

# a row that is changed is run again, and only that
table = tiny.folder / "table.csv"
table.write_text(table.read_text(encoding="utf-8").replace("-4.5 MPa", "-4.6 MPa"), encoding="utf-8")
check("1 waiting" in sweep("status", tiny.folder), "a changed row waits")
check("no row" in sweep("row", tiny.folder, "011", code=1), "unknown rows are refused")
print("ten runs, one killed and resumed alone")
