#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks who includes whom: the arrows between the rooms, and which room sees which library.

    include_arrows.py [ROOT]

Prints one line for each forbidden include, `file:line: what, and what is allowed`, and exits with 1
when there is any. ROOT is the project's folder (default: the one this file lies in).
"""

import pathlib
import re
import sys

# Which rooms a room may include besides itself.
STATE = {"state", "mesh", "core"}
PHYSICS = {"solid", "cohesive", "contact", "fluid", "seismic"}
ARROWS = {
    "core": set(),
    "mesh": {"core"},
    "state": {"mesh", "core"},
    **{room: STATE for room in PHYSICS},
    "solve": PHYSICS | STATE,
    "io": {"mesh", "state", "seismic", "analysis", "core"},
    "analysis": {"core"},
}
ARROWS["cli"] = set(ARROWS)

# Libraries that one room's sources hide from all others: pattern of the header, its only folder.
LIBRARIES = [
    ("CGAL", r"CGAL/", "src/mesh"),
    ("gmsh", r"gmshc?\.h", "src/mesh"),
    ("VTK", r"vtk\w*\.h", "src/io"),
    ("libdeflate", r"libdeflate\.h", "src/io"),
    ("pugixml", r"pugi\w+\.hpp", "src/io"),
    ("HDF5", r"(hdf5|H5\w*)\.h", "src/io"),
    ("toml++", r"toml(\+\+/|plusplus|\.hpp)", "src/io"),
    ("Eigen", r"(unsupported/)?Eigen/", "src/solve"),
    ("METIS", r"metis\.h", "src/solve"),
    ("UDUNITS-2", r"(udunits2?/)?udunits2?\.h", "src/core"),
    ("CLI11", r"CLI/", "src/cli"),
    ("GoogleTest or google-benchmark", r"(gtest|gmock|benchmark)/", "tests"),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def room_of(header, file, root):
    """The room a header belongs to: crackle/<room>/..., or a file of src/ named by a path; else None."""
    parts = header.split("/")
    if parts[0] == "crackle" and len(parts) > 2:
        return parts[1]
    for base in (file.parent, root / "src"):
        path = (base / header).resolve()
        for top in (root / "src", root / "include" / "crackle"):
            if path.is_file() and top.resolve() in path.parents:
                return path.relative_to(top.resolve()).parts[0]
    return None


def violations(root):
    """Yields (file, line number, message) for each forbidden include below root."""
    root = pathlib.Path(root)
    for top in (root / "include" / "crackle", root / "src"):
        for file in sorted(p for p in top.rglob("*") if p.suffix in {".hpp", ".cpp", ".h", ".cu", ".in"}):
            room = file.relative_to(top).parts[0]
            folder = f"{top.relative_to(root).as_posix()}/{room}"
            if room not in ARROWS:
                yield file, 1, f"'{room}' is not a room; rooms are {', '.join(ARROWS)}"
                continue
            for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                header = match.group(1)
                other = room_of(header, file, root)
                if other and other != room and other not in ARROWS[room]:
                    allowed = ", ".join(sorted(ARROWS[room])) or "no other room"
                    yield file, number, f"{room} must not include {other} ({header}); it may include {allowed}"
                if other and header.startswith(".."):
                    yield file, number, f'write "crackle/{other}/..." rather than a path with ".." ({header})'
                for library, pattern, only in LIBRARIES:
                    if not other and re.match(pattern, header) and folder != only:
                        yield file, number, f"{library} ({header}) may only be included in {only}"


def main(arguments):
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[3]
    found = list(violations(root))
    for file, number, message in found:
        print(f"{file}:{number}: {message}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
