#!/usr/bin/env python3
"""What is computed from exact answers and from committed times in data/paper comes out byte for byte."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

LORENTZ, ROOT = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1))
PAPER = ROOT / "data" / "paper"


def run(script, *arguments):
    return subprocess.run([sys.executable, PAPER / script, *arguments], capture_output=True, check=True).stdout


class Paper(unittest.TestCase):
    def test_first_discs(self):
        with tempfile.TemporaryDirectory() as folder:
            run("first_discs.py", LORENTZ, folder)
            for name in ("first-discs.csv", "first-discs.svg"):
                self.assertEqual((pathlib.Path(folder) / name).read_bytes(), (PAPER / name).read_bytes(), name)

    def test_of_times(self):
        times = [PAPER / "times-2d.csv", PAPER / "times-3d.csv"]
        for script, name in (("exponents.py", "exponents.csv"), ("per_cell.py", "times-per-cell.csv")):
            self.assertEqual(run(script, *times), (PAPER / name).read_bytes(), name)


unittest.main()
