"""Flights on a graphics card, without one: the kernels run on the processor, behind a driver made for the tests.

gpu_test.py PROGRAM FAKE_CARD KERNELS: the folder of a libcuda.so.1 (fake_driver.cpp), and that of the PTX files
"""
import ctypes
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, FAKE_CARD, KERNELS = sys.argv[1:4]
TEXTS = sorted(Path(KERNELS).glob("*.ptx"))
SCENES = ["square --radius 0.1", "square --radius 1e-6", "triangular --radius 0.01", "cubic --radius 0.1",
          "cubic --radius 1e-6", "fcc --radius 1e-3", "honeycomb", "perovskite --radius 0.02",
          "superposition-pi-5 --radius 1e-3", "overlapping", "ellipse", "ellipses-mixed", "ellipsoid",
          "ellipsoids-mixed"]


def has_driver():
    try:
        return bool(ctypes.CDLL("libcuda.so.1"))
    except OSError:
        return False


def flights(words, card=None, fake=True):
    environment = dict(os.environ, FAKE_CARD=card or "")
    if fake:
        environment["LD_LIBRARY_PATH"] = FAKE_CARD
    return subprocess.run([PROGRAM, "flights", *words.split()], capture_output=True, text=True, env=environment)


def report(words):
    done = flights(words + " --json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    found.pop("seconds", None)
    return found


class Refusals(unittest.TestCase):
    def refused(self, done, what, status=2):
        self.assertEqual((done.returncode, done.stdout), (status, ""))
        self.assertRegex(done.stderr, what)

    @unittest.skipIf(has_driver(), "there is a driver here")
    def test_without_a_driver(self):
        self.refused(flights("--scene square --engine gpu", fake=False), "no libcuda.so.1 here.*certified-batch")

    def test_without_a_card(self):
        self.refused(flights("--scene square --engine gpu", card="none"), "finds no graphics card.*certified-batch")

    @unittest.skipIf(TEXTS, "this build has kernels")
    def test_without_kernels(self):
        self.refused(flights("--scene square --engine gpu"), "no kernels.*clang")

    @unittest.skipUnless(TEXTS, "this build has no kernels")
    def test_beyond(self):
        for words, why in [("square --from surface", "surfaces"), ("overlapping-3d --radius 0.7", "overlap"),
                           ("cubic --radius 1e-9", "does radii")]:
            self.refused(flights(f"--scene {words} --engine gpu"), why)

    @unittest.skipUnless(TEXTS, "this build has no kernels")
    def test_a_card_with_a_wrong_bit(self):
        self.refused(flights("--scene square --engine gpu", card="wrong"), "bits of the processor", status=3)


@unittest.skipUnless(TEXTS, "this build has no kernels")
class Results(unittest.TestCase):
    def test_they_are_those_of_certified_batch(self):
        for scene in SCENES:
            asked = f"--scene {scene} --count 20000 --seed 7 --engine "
            self.assertEqual(report(asked + "gpu"), report(asked + "certified-batch"), scene)
        self.assertEqual(report(asked + "certified-gpu"), report(asked + "certified-batch"))

    def test_parts_of_both_are_one_run(self):
        asked = "--scene cubic --radius 0.05 --count 400000 --seed 5"
        with tempfile.TemporaryDirectory() as folder:
            one, other = f"{folder}/one", f"{folder}/other"
            report(f"{asked} --engine gpu --jobs 2 --shard 1/3 --store {one}")
            report(f"{asked} --engine certified-batch --shard 0/3 --store {other}")
            joined = report(f"{asked} --engine gpu --store {one} --add {other}")
        self.assertEqual(joined, report(f"{asked} --engine certified-batch"))


@unittest.skipUnless(TEXTS, "this build has no kernels")
class Texts(unittest.TestCase):
    """What the driver's compiler gets: operations that are rounded as the processor's are, and nothing else."""

    def test_operations(self):
        exact = ("abs neg mov selp setp ld st max min cvt".split())
        for file in TEXTS:
            found = set(re.findall(r"^\s+(?:@!?%p\d+ )?([a-z0-9_.]+\.f64[a-z0-9.]*)\s", file.read_text(), re.M))
            self.assertTrue(found)
            for operation in found:
                name = operation.split(".")[0]
                if name == "cvt":
                    self.assertRegex(operation, r"cvt\.(rni|rmi|rpi|rzi|rn)\.")
                elif name not in exact:
                    self.assertRegex(operation, r"^(add|sub|mul|div|fma|sqrt|rcp)\.rn\.f64$", file.name)

    def test_nothing_is_missing(self):
        for file in TEXTS:
            self.assertNotIn(".extern", file.read_text(), file.name)

    def test_flights_on_unit_lattices_stay_in_registers(self):
        for file in TEXTS:
            if file.stem.endswith("_unit"):
                self.assertNotIn("ld.local", file.read_text(), file.name)

    @unittest.skipUnless(shutil.which("ptxas"), "there is no ptxas here")
    def test_an_assembler_takes_them(self):
        with tempfile.TemporaryDirectory() as folder:
            for file in TEXTS:
                subprocess.run(["ptxas", "-arch=sm_80", "-o", f"{folder}/out", file], check=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
