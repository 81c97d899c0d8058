#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the seismic catalog of a run into its folder: events.png (map, magnitudes) and catalog.png (distance and
time, cumulative moment against pressure, number of magnitudes)."""

import argparse
import pathlib
import sys

from run_data import Run, RunError

import catalog_figure
import events_figure


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN_DIR", help="folder that `crackle run` wrote")
    parser.add_argument("-o", "--output", metavar="DIR", help="where the figures go (default: RUN_DIR)")
    parser.add_argument("--b", type=float, help="b-value to draw (`crackle catalog` gives it)")
    parser.add_argument("--completeness", type=float, help="magnitude from which on it holds")
    arguments = parser.parse_args()
    try:
        run = Run(arguments.run)
        folder = pathlib.Path(arguments.output or arguments.run)
        folder.mkdir(parents=True, exist_ok=True)
        events_figure.draw(run, folder / "events.png")
        catalog_figure.draw(run, folder / "catalog.png", arguments.b, arguments.completeness)
    except (RunError, OSError) as error:
        sys.exit(f"draw_catalog: {error}")


if __name__ == "__main__":
    main()
