# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run folder holds, for the figures: history, events, frames, title.

Reads what is there: a run that was interrupted has no summary.json, and its last row may be cut off.
"""

import json
import math
import pathlib
import sys
import tomllib
import xml.etree.ElementTree as ElementTree

MODULES_MISSING = 77

try:
    import matplotlib
    matplotlib.use("Agg")
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(f"{missing}; the figures need: apt-get install python3-numpy python3-matplotlib python3-vtk9, "
          "and /usr/bin/python3", file=sys.stderr)
    sys.exit(MODULES_MISSING)

MODES = {1: "tensile", 2: "shear", 3: "mixed"}


class RunError(Exception):
    """One line for the user."""


def read_csv(path):
    """Columns by name; numbers where every cell is one, else text. Rows cut short are left out."""
    if not path.is_file():
        return {}
    lines = path.read_text(encoding="utf-8").splitlines()
    names = lines[0].split(",") if lines else []
    rows = [cells for cells in (line.split(",") for line in lines[1:]) if len(cells) == len(names)]
    columns = {}
    for i, name in enumerate(names):
        cells = [row[i] for row in rows]
        try:
            columns[name] = np.array(cells, dtype=float)
        except ValueError:
            columns[name] = np.array(cells)
    return columns


def named_arrays(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i))
            for i in range(attributes.GetNumberOfArrays())}


class Frame:
    """A .vtu file: points (n, 2), cells (m, corners), and the fields of both."""

    def __init__(self, path):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        if reader.GetErrorCode() != 0:
            raise RunError(f"{path}: not a .vtu file that VTK can read")
        grid = reader.GetOutput()
        count = grid.GetNumberOfCells()
        self.points = (vtk_to_numpy(grid.GetPoints().GetData())[:, :2] if count else np.zeros((0, 2)))
        self.cells = (vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(count, -1)
                      if count else np.zeros((0, 3), dtype=int))
        self.point_fields = named_arrays(grid.GetPointData())
        self.cell_fields = named_arrays(grid.GetCellData())


class Fractures:
    """The lines of a frame that are fractures: segments (n, 2, 2), broken (n), mode (n).

    joint (n): joints that never had cohesion, which are not counted as broken; wet (n): with fluid in them."""

    def __init__(self, path=None):
        self.segments = np.zeros((0, 2, 2))
        self.broken = np.zeros(0, dtype=bool)
        self.mode = np.zeros(0, dtype=int)
        self.joint = self.wet = np.zeros(0, dtype=bool)
        if path is None:
            return
        frame = Frame(path)
        if frame.cells.shape[1] != 2:
            return
        segments = frame.points[frame.cells]
        # a frame without fractures holds one line of no length
        real = np.any(segments[:, 0] != segments[:, 1], axis=1)
        self.segments = segments[real]
        zero = np.zeros(len(frame.cells))
        self.broken = frame.cell_fields.get("broken", zero)[real] > 0.5
        self.mode = frame.cell_fields.get("mode", zero)[real].astype(int)
        self.joint = self.broken & (self.mode == 0)
        self.broken &= ~self.joint
        self.wet = frame.cell_fields.get("pressure_Pa", zero)[real] != 0.0


class Run:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{folder}: not a folder; give the folder of a run")
        if not any((self.folder / name).exists() for name in ("history.csv", "resolved.toml", "fields.pvd")):
            raise RunError(f"{folder}: holds no run (neither history.csv nor resolved.toml is there)")
        self.history = read_csv(self.folder / "history.csv")
        self.events = read_csv(self.folder / "events.csv")
        self.case = self._case()
        self.summary = self._summary()

    def _case(self):
        path = self.folder / "resolved.toml"
        if not path.is_file():
            return {}
        try:
            return tomllib.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{path}: not TOML: {error}") from error

    def _summary(self):
        path = self.folder / "summary.json"
        if not path.is_file():
            return {}
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise RunError(f"{path}: not JSON: {error}") from error

    @property
    def title(self):
        return self.case.get("title") or self.folder.resolve().name

    @property
    def wellbore_radius(self):
        """[m]; 0 without a wellbore"""
        return 0.5 * float(self.case.get("wellbore", {}).get("diameter", 0.0))

    def remarks(self):
        """What a reader of a figure wants to know, in one line."""
        parts = []
        stress = self.case.get("stress", {})
        if "xx" in stress and "yy" in stress:
            parts.append(f"far-field stress xx {stress['xx'] / 1e6:.4g} MPa, yy {stress['yy'] / 1e6:.4g} MPa")
        if self.summary.get("triangles"):
            parts.append(f"{self.summary['triangles']:,} triangles")
        if not self.summary:
            parts.append("not finished")
        elif self.summary.get("exit", "done") != "done":
            parts.append(shorten(self.summary["exit"], 60))
        return ", ".join(parts)

    def frames(self, kind):
        """[(time, path)] of "fields" or "fractures", in order of time."""
        collection = self.folder / f"{kind}.pvd"
        if not collection.is_file():
            return []
        try:
            root = ElementTree.parse(collection).getroot()
        except ElementTree.ParseError as error:
            raise RunError(f"{collection}: not XML: {error}") from error
        frames = [(float(entry.get("timestep")), self.folder / entry.get("file"))
                  for entry in root.iter("DataSet")]
        return [(time, path) for time, path in frames if path.is_file()]

    def slips(self):
        """Which events are slips of joints rather than breaking."""
        count = len(self.events.get("time_s", ()))
        return self.events.get("kind", np.full(count, "breaking")) == "slip"

    def breakdown(self):
        """(time [s], pressure [Pa]) of the largest wellbore pressure; None without a history.

        The summary looked at every step, the history holds some of them."""
        noted = self.summary.get("breakdown_time_s"), self.summary.get("breakdown_pressure_Pa")
        if all(finite(value) for value in noted):
            return noted
        pressure = self.history.get("pressure_Pa", np.zeros(0))
        if pressure.size == 0 or not np.isfinite(pressure).any():
            return None
        top = int(np.nanargmax(pressure))
        return float(self.history["time_s"][top]), float(pressure[top])

    def has_broken(self):
        counts = [self.history.get(f"broken_{mode}", np.zeros(1)) for mode in MODES.values()]
        return any(count.size and count[-1] > 0 for count in counts)


def shorten(text, length):
    text = " ".join(str(text).split())
    return text if len(text) <= length else text[:length - 1] + "…"


def finite(value):
    return value is not None and math.isfinite(value)
