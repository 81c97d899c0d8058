#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The include checker must see a forbidden include, and nothing in a sound tree."""

import pathlib
import tempfile
import unittest

from include_arrows import main, violations


class IncludeArrows(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("include/crackle/state/state.hpp", '#include "crackle/mesh/mesh.hpp"\n#include <vector>\n')
        self.write("src/solve/loop.cpp", '#include "crackle/fluid/cavity.hpp"\n#include <Eigen/Sparse>\n')
        self.write("src/mesh/cgal.cpp", '#include <CGAL/Mesh_2.h>\n#include "polygon.hpp"\n')
        self.write("src/mesh/polygon.hpp", "")

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def found(self):
        return [message for _, _, message in violations(self.root)]

    def assert_caught(self, path, include, word):
        self.write(path, f"// a comment\n  # include {include}\n")
        found = self.found()
        self.assertEqual(len(found), 1, found)
        self.assertIn(word, found[0])

    def test_sound_tree(self):
        self.assertEqual(self.found(), [])

    def test_physics_rooms_do_not_meet(self):
        self.assert_caught("src/solid/force.cpp", '"crackle/fluid/cavity.hpp"', "solid must not include fluid")

    def test_public_header(self):
        self.assert_caught("include/crackle/core/log.hpp", "<crackle/io/case.hpp>", "core must not include io")

    def test_solve_sees_no_io(self):
        self.assert_caught("src/solve/frames.cpp", '"crackle/io/output.hpp"', "solve must not include io")

    def test_private_header_of_another_room(self):
        self.assert_caught("src/state/build.cpp", '"solve/loop.cpp"', "state must not include solve")

    def test_library_in_a_public_header(self):
        self.assert_caught("include/crackle/mesh/cgal.hpp", "<CGAL/Mesh_2.h>", "CGAL")

    def test_libraries_in_other_rooms(self):
        for header in ("gmsh.h", "vtkPoints.h", "pugixml.hpp", "toml++/toml.h", "Eigen/Dense", "udunits2.h",
                       "CLI/CLI.hpp", "gtest/gtest.h"):
            with self.subTest(header):
                self.assert_caught("src/contact/pairs.cpp", f"<{header}>", header)

    def test_unknown_room(self):
        self.assert_caught("src/utils/misc.cpp", "<vector>", "not a room")

    def test_commented_include_is_no_include(self):
        self.write("src/core/log.cpp", '// #include "crackle/io/case.hpp"\n')
        self.assertEqual(self.found(), [])

    def test_exit_code(self):
        self.assertEqual(main([str(self.root)]), 0)
        self.write("src/core/log.cpp", '#include "crackle/io/case.hpp"\n')
        self.assertEqual(main([str(self.root)]), 1)


if __name__ == "__main__":
    unittest.main()
