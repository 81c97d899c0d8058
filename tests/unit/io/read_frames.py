#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the frames of the sample run (sample_run.cpp) by VTK and by meshio and checks what is in them."""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree

try:
    import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as missing:
    print(missing)
    sys.exit(77)

LINE_FIELDS = {"opening_m", "slip_m", "damage", "mode", "pressure_Pa", "broken"}


def arrays(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i))
            for i in range(attributes.GetNumberOfArrays())}


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, path
    return reader.GetOutput()


def collection(run, name):
    root = ElementTree.parse(run / f"{name}.pvd").getroot()
    frames = [(float(d.get("timestep")), run / d.get("file")) for d in root.iter("DataSet")]
    assert len(frames) == 4 and frames[0][0] == 0.0, frames
    assert [t for t, _ in frames] == sorted(t for t, _ in frames)
    return frames


def check_both(path, time, kind):
    """The two readers agree; gives VTK's grid."""
    grid, mesh = read(path), meshio.read(path)
    assert arrays(grid.GetFieldData())["TimeValue"] == [time]
    assert mesh.field_data["TimeValue"] == [time]
    assert set(mesh.cells_dict) == {kind}
    assert len(mesh.points) == grid.GetNumberOfPoints()
    assert len(mesh.cells_dict[kind]) == grid.GetNumberOfCells()
    assert np.array_equal(mesh.points, vtk_to_numpy(grid.GetPoints().GetData()))
    connectivity = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    assert np.array_equal(mesh.cells_dict[kind].ravel(), connectivity)
    for name, values in arrays(grid.GetCellData()).items():
        assert np.array_equal(mesh.cell_data[name][0], values), name
    for name, values in arrays(grid.GetPointData()).items():
        assert np.array_equal(mesh.point_data[name], values), name
    return grid


def main():
    run = pathlib.Path(sys.argv[1])
    for time, path in collection(run, "fields"):
        grid = check_both(path, time, "triangle")
        assert grid.GetNumberOfPoints() == 3 * grid.GetNumberOfCells() == 3 * 24 * 12 * 2
        points, cells = arrays(grid.GetPointData()), arrays(grid.GetCellData())
        assert set(points) == {"displacement_m", "velocity_m_s"} and set(cells) == {"stress_Pa", "region"}
        assert points["displacement_m"].shape[1] == 3 and not points["displacement_m"][:, 2].any()
        stress = grid.GetCellData().GetArray("stress_Pa")
        assert [stress.GetComponentName(i) for i in range(3)] == ["xx", "yy", "xy"]
        assert grid.GetBounds()[1] - grid.GetBounds()[0] > 1.9

    seen = []
    for time, path in collection(run, "fractures"):
        grid = check_both(path, time, "line")
        cells = arrays(grid.GetCellData())
        assert set(cells) == LINE_FIELDS, set(cells)
        assert set(cells["broken"]) <= {0.0, 1.0} and set(cells["mode"]) <= {0.0, 1.0, 2.0, 3.0}
        seen.append(int(cells["broken"].sum()))
    assert seen[0] == 0 and seen[-1] > 3, seen
    print("frames read by VTK and meshio; broken lines in them:", seen)


if __name__ == "__main__":
    main()
