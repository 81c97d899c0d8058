#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every script parses, and those of the two commands explain themselves and refuse what they do not know."""

import ast
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCRIPTS = [p for top in ("scripts", ".ci", "cases", "tests") for p in (ROOT / top).rglob("*") if p.is_file()]


def interpreter(file):
    """The first line of a script, b"" of any other file."""
    with open(file, "rb") as stream:
        line = stream.readline()
    return line if line.startswith(b"#!") else b""


def command(*words, **more):
    return subprocess.run([str(w) for w in words], capture_output=True, text=True, stdin=subprocess.DEVNULL, **more)


class Scripts(unittest.TestCase):
    def test_python_parses(self):
        for file in SCRIPTS:
            if file.suffix == ".py" or b"python" in interpreter(file):
                with self.subTest(str(file)):
                    ast.parse(file.read_text(encoding="utf-8"), str(file))

    def test_bash_parses(self):
        for file in SCRIPTS:
            if b"bash" in interpreter(file):
                with self.subTest(str(file)):
                    self.assertEqual(command("bash", "-n", file).stderr, "")

    def test_help(self):
        for name in ("setup", "build", "run", "test", "check_style", "verification_table"):
            with self.subTest(name):
                result = command(ROOT / "scripts" / name, "--help")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertTrue(result.stdout.startswith(f"usage: scripts/{name}"))

    def test_unknown_case(self):
        result = command(ROOT / "scripts" / "run", "no/such/case.toml")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no/such/case.toml", result.stderr)

    def test_setup_without_apt(self):
        with tempfile.TemporaryDirectory() as folder:
            for tool in ("bash", "cat", "id"):
                os.symlink(f"/bin/{tool}" if os.path.exists(f"/bin/{tool}") else f"/usr/bin/{tool}", f"{folder}/{tool}")
            result = command("/bin/bash", ROOT / "scripts" / "setup", env={"PATH": folder})
        self.assertEqual(result.returncode, 1)
        self.assertIn("no apt-get", result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_setup_without_root_names_the_line_to_run(self):
        with tempfile.TemporaryDirectory() as folder:
            fakes = {"dpkg-query": "exit 1", "apt-get": "exit 9", "id": "echo 1000", "sudo": "exit 1"}
            for tool, body in fakes.items():
                file = pathlib.Path(folder, tool)
                file.write_text(f"#!/bin/bash\n{body}\n")
                file.chmod(0o755)
            result = command("/bin/bash", ROOT / "scripts" / "setup", "--test", env={"PATH": f"{folder}:/usr/bin:/bin"})
        self.assertEqual(result.returncode, 1)
        self.assertIn("apt-get install --no-install-recommends g++ cmake", result.stderr)
        self.assertIn("libgtest-dev", result.stderr)


if __name__ == "__main__":
    unittest.main()
