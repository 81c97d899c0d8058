#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of a run into its folder: pressure.png, fractures.png, events.png, and load.png of a run with loads."""

import argparse
import pathlib
import sys

from run_data import Run, RunError

import events_figure
import field_time_figure
import fractures_figure
import load_figure
import look
import pressure_figure

FIGURES = {"pressure.png": pressure_figure.draw, "fractures.png": fractures_figure.draw,
           "events.png": events_figure.draw}
IN_FIELD_TIME = {"pressure.png": field_time_figure.draw_history, "fractures.png": field_time_figure.draw_fracture}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", metavar="RUN_DIR", help="folder that `crackle run` wrote")
    parser.add_argument("-o", "--output", metavar="DIR", help="where the figures go (default: RUN_DIR)")
    parser.add_argument("--small", action="store_true", help="small files, for a repository")
    arguments = parser.parse_args()
    if arguments.small:
        look.make_small()
    try:
        run = Run(arguments.run)
        folder = pathlib.Path(arguments.output or arguments.run)
        folder.mkdir(parents=True, exist_ok=True)
        figures = dict(IN_FIELD_TIME if field_time_figure.is_one(run) else FIGURES)
        if len(run.events.get("time_s", ())) > 0:
            figures["events.png"] = events_figure.draw
        if load_figure.names(run):
            figures["load.png"] = load_figure.draw
        for name, draw in figures.items():
            draw(run, folder / name)
            if arguments.small:
                look.shrink(folder / name)
    except (RunError, OSError) as error:
        sys.exit(f"draw_run: {error}")


if __name__ == "__main__":
    main()
