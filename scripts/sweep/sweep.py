#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a base case once for each row of a table of overrides, here or on a Slurm cluster, and gathers the results.

    sweep.py grid --axis rock.density "2500 kg/m3" "2700 kg/m3" --seeds 1 2 3 -o table.csv
    sweep.py new cases/granite_wellbore/smoke_isotropic.toml table.csv -o runs/my_sweep
    sweep.py local runs/my_sweep --cores 2        again after a failure: runs only what is not done
    sweep.py slurm runs/my_sweep                  the same as a Slurm job array
    sweep.py status runs/my_sweep --watch 5
    sweep.py gather runs/my_sweep --plot breakdown_pressure_Pa rock.density
"""

import argparse
import csv
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

from sweep_table import SETTINGS, Sweep, SweepError, case_files, read_table

HERE = pathlib.Path(__file__).resolve().parent


def grid(arguments):
    """Every combination of the axes' values, the last axis fastest."""
    axes = [(axis[0], axis[1:]) for axis in arguments.axis]
    if arguments.seeds:
        axes.append(("seed", arguments.seeds))
    if not axes or any(not values for _, values in axes):
        raise SweepError("grid: give --axis KEY VALUE ... with at least one value, or --seeds N ...")
    rows = list(itertools.product(*(values for _, values in axes)))
    digits = max(3, len(str(len(rows))))
    with open(arguments.output, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["run"] + [key for key, _ in axes])
        for number, row in enumerate(rows, 1):
            table.writerow([f"{number:0{digits}d}", *row])
    print(f"{arguments.output}: {len(rows)} rows")


def find_crackle(given):
    for path in [given] if given else [HERE.parents[1] / "build/src/cli/crackle", shutil.which("crackle")]:
        if path and os.access(path, os.X_OK):
            return str(pathlib.Path(path).resolve())
    raise SweepError("new: no crackle is built in build/ or on the path; say where it is by --crackle FILE")


def new(arguments):
    folder, case = pathlib.Path(arguments.output), pathlib.Path(arguments.case).resolve()
    if (folder / "sweep.json").exists():
        raise SweepError(f"{folder}: a sweep is here already; its rows are in {folder}/table.csv")
    case_files(case)
    rows = read_table(arguments.table)
    settings = {"case": str(case), "crackle": find_crackle(arguments.crackle)}
    settings |= {name: getattr(arguments, name) for name in SETTINGS}
    folder.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(arguments.table, folder / "table.csv")
    (folder / "sweep.json").write_text(json.dumps(settings, indent=2) + "\n", encoding="utf-8")
    print(f"{folder}: {len(rows)} runs of {case}")


def row(arguments):
    """Becomes the run of one row, by its name or (in a job array) its number."""
    sweep = Sweep(arguments.sweep)
    if arguments.number:
        if not 1 <= arguments.number <= len(sweep.rows):
            raise SweepError(f"{arguments.sweep}: no row {arguments.number}; there are {len(sweep.rows)}")
        chosen = sweep.rows[arguments.number - 1]
    else:
        chosen = sweep.row(arguments.name)
    if chosen.is_done():
        return
    words = chosen.command(sweep)
    if not chosen.can_be_resumed():
        sweep.clear(chosen)
        chosen.folder.mkdir(parents=True)
        (chosen.folder / "row.json").write_text(
            json.dumps({"fingerprint": chosen.fingerprint, "overrides": chosen.overrides}, indent=2) + "\n",
            encoding="utf-8")
    os.execv(words[0], words)  # signals of Slurm or of a user so reach crackle itself


def local(arguments):
    """By Snakemake on this machine; what it says goes to snakemake.log."""
    sweep = Sweep(arguments.sweep)
    if shutil.which("snakemake") is None:
        raise SweepError("local: snakemake is not installed (Debian: apt-get install snakemake)")
    sweep.folder.joinpath("done").mkdir(exist_ok=True)
    words = ["snakemake", "--snakefile", str(HERE / "Snakefile"), "--directory", str(sweep.folder), "--config",
             f"sweep={sweep.folder}", "--cores", str(arguments.cores), "--keep-going", "--nolock"]
    environment = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
    with open(sweep.folder / "snakemake.log", "a", encoding="utf-8") as log:
        snakemake = subprocess.Popen(words, stdout=log, stderr=log, env=environment)
        shown = ""
        try:
            while snakemake.poll() is None:
                time.sleep(0.2)
                line = sweep.progress()[0]
                if line != shown:
                    print(line, end="\r" if sys.stdout.isatty() else "\n", flush=True)
                shown = line
        except KeyboardInterrupt:
            snakemake.wait()
    print("\n".join(sweep.progress()))
    if snakemake.returncode != 0 or sweep.to_do():
        raise SweepError(f"{len(sweep.to_do())} of {len(sweep.rows)} runs are not done (log: {sweep.folder}/"
                         f"snakemake.log); run them by: sweep.py local {arguments.sweep}")


def slurm(arguments):
    """One job array of the rows that are neither done nor under way."""
    sweep = Sweep(arguments.sweep)
    numbers = ",".join(str(row.number) for row in sweep.to_do())
    if not numbers:
        print(f"{arguments.sweep}: nothing to do; {len(sweep.rows)} runs are done or under way")
        return
    if shutil.which("sbatch") is None:
        raise SweepError("slurm: sbatch is not installed here")
    (sweep.folder / "slurm").mkdir(exist_ok=True)
    result = subprocess.run(
        ["sbatch", "--parsable", f"--array={numbers}", f"--cpus-per-task={sweep.threads}", f"--mem={sweep.memory_mb}",
         f"--time={sweep.minutes}", f"--output={sweep.folder}/slurm/%A_%a.log", *arguments.sbatch,
         str(HERE / "slurm_array.sbatch"), str(HERE / "sweep.py"), str(sweep.folder)],
        capture_output=True, text=True, check=False)
    if result.returncode != 0:
        raise SweepError("slurm: " + " ".join(result.stderr.split()))
    print(f"job array {result.stdout.strip()}: rows {numbers}")


def status(arguments):
    while True:
        sweep = Sweep(arguments.sweep)
        print("\n".join(sweep.progress()), flush=True)
        if not arguments.watch or all(row.is_done() for row in sweep.rows):
            return
        time.sleep(arguments.watch)


def gather(arguments):
    from sweep_figures import draw_all, write_csv  # needs matplotlib, which the other commands do not
    sweep = Sweep(arguments.sweep)
    output = pathlib.Path(arguments.output or sweep.folder)
    output.mkdir(parents=True, exist_ok=True)
    columns, rows = write_csv(sweep, output / "gathered.csv")
    draw_all(sweep, output, columns, rows, arguments.plot)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(name, function, what):
        sub = commands.add_parser(name, help=what, description=what)
        sub.set_defaults(function=function)
        return sub

    sub = command("grid", grid, "write a table of every combination of some values")
    sub.add_argument("--axis", nargs="+", action="append", default=[], metavar=("KEY", "VALUE"))
    sub.add_argument("--seeds", nargs="+", metavar="N", help="of the mesh: a last axis")
    sub.add_argument("-o", "--output", required=True, metavar="TABLE")
    sub = command("new", new, "make the folder of a sweep")
    sub.add_argument("case", metavar="CASE")
    sub.add_argument("table", metavar="TABLE")
    sub.add_argument("-o", "--output", required=True, metavar="DIR")
    sub.add_argument("--crackle", metavar="FILE", help="the program (default: of build/, or on the path)")
    for name, value in SETTINGS.items():
        sub.add_argument("--" + name.replace("_", "-"), type=int, default=value, metavar="N",
                         help=f"of one run (default: {value})")
    sub = command("local", local, "run what is not done, on this machine")
    sub.add_argument("sweep", metavar="DIR")
    sub.add_argument("--cores", type=int, default=2, metavar="N")
    sub = command("slurm", slurm, "submit what is not done as a job array")
    sub.add_argument("sweep", metavar="DIR")
    sub.add_argument("sbatch", nargs="*", metavar="OPTION", help="of sbatch, after --: a partition, an account")
    sub = command("row", row, "run one row (what Snakemake and the job array call)")
    sub.add_argument("sweep", metavar="DIR")
    sub.add_argument("name", nargs="?", metavar="RUN")
    sub.add_argument("--number", type=int, metavar="N", help="of the row, from 1")
    sub = command("status", status, "say how the whole sweep stands")
    sub.add_argument("sweep", metavar="DIR")
    sub.add_argument("--watch", type=float, metavar="SECONDS", help="again and again until all is done")
    sub = command("gather", gather, "collect the results into gathered.csv and draw them")
    sub.add_argument("sweep", metavar="DIR")
    sub.add_argument("-o", "--output", metavar="DIR", help="where they go (default: the sweep's folder)")
    sub.add_argument("--plot", nargs=2, action="append", default=[], metavar=("VALUE", "KEY"),
                     help="a value of summary.json against a key (default: breakdown pressure, every key)")
    return parser.parse_args()


def main():
    arguments = parse()
    try:
        arguments.function(arguments)
    except SweepError as error:
        sys.exit(f"sweep: {error}")


if __name__ == "__main__":
    main()
