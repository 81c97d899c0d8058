#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same on a Slurm cluster of this one machine: submit, kill a job, submit what is not done; then the changed rows
by Snakemake's profile."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from sweep_test import LONG_RUN, ROOT, TinySweep, check, skip, sweep

os.environ["PATH"] += ":/usr/sbin:/sbin"
for tool in ("sbatch", "slurmctld", "munged"):
    if shutil.which(tool) is None:
        skip(f"{tool} is not installed (scripts/setup --slurm)")
if os.getuid() != 0:
    skip("a Slurm cluster on the loopback address needs root")


def wait_for_empty_queue(seconds=180.0):
    end = time.monotonic() + seconds
    while subprocess.run(["squeue", "-h"], capture_output=True, text=True, check=True).stdout.strip():
        check(time.monotonic() < end, "the queue did not run empty")
        time.sleep(0.2)


def run_all():
    tiny = TinySweep(sys.argv[1])
    said = sweep("slurm", tiny.folder)
    check("rows 1,2,3,4,5,6,7,8,9,10" in said, "all are submitted")
    tiny.wait_for(LONG_RUN, ("running", "done"))
    array = said.split("job array ")[1].split(":")[0]
    subprocess.run(["scancel", f"{array}_{int(LONG_RUN)}"], check=True)
    wait_for_empty_queue()
    said = sweep("status", tiny.folder)
    check("9 done" in said and f"{LONG_RUN}: interrupted" in said, "the killed job is seen; Slurm let it end whole")
    check((tiny.folder / "runs" / LONG_RUN / "summary.json").is_file(), "with its files")

    before = tiny.starts()
    check(f"rows {int(LONG_RUN)}\n" in sweep("slurm", tiny.folder), "only it is submitted again")
    wait_for_empty_queue()
    tiny.check_resumed(before)
    check("nothing to do" in sweep("slurm", tiny.folder), "all are done")
    tiny.check_gathered()

    # by Snakemake, a job a run
    table = tiny.folder / "table.csv"
    table.write_text(table.read_text(encoding="utf-8").replace("-5.5 MPa", "-5.4 MPa"), encoding="utf-8")
    before = tiny.starts()
    subprocess.run(["snakemake", "-s", ROOT / "scripts/sweep/Snakefile", "--directory", tiny.folder, "--config",
                    f"sweep={tiny.folder}", "--profile", ROOT / "scripts/sweep/slurm_profile"], check=True)
    after = tiny.starts()
    check(sorted(name for name in after if after[name] != before[name]) == ["003", "004"], "the two changed rows")


with tempfile.TemporaryDirectory(prefix="crackle_slurm_") as place:
    cluster = pathlib.Path(place)
    script = ROOT / "scripts/sweep/loopback_slurm"
    os.environ["SLURM_CONF"] = str(cluster / "slurm.conf")
    subprocess.run([script, "start", cluster], check=True)
    try:
        run_all()
    finally:
        subprocess.run([script, "stop", cluster], check=True)
print("ten runs on Slurm, one killed and run again alone; two more by Snakemake's profile")
