#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says "running", "success" or "failed" of a Slurm job, for Snakemake. Asks scontrol, which needs no accounting."""

import re
import subprocess
import sys

GOES_ON = ("PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED")

answer = subprocess.run(["scontrol", "-o", "show", "job", sys.argv[1]], capture_output=True, text=True, check=False)
state = re.search(r"JobState=(\w+)", answer.stdout)
if state is None:
    print("failed")  # forgotten by Slurm: the marker says whether the run was done
elif state[1] in GOES_ON:
    print("running")
else:
    print("success" if state[1] == "COMPLETED" else "failed")
