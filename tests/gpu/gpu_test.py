"""Flights on a graphics card, without one: the kernels run on the processor, behind a driver made for the tests.

gpu_test.py PROGRAM FAKE_CARD KERNELS: the folder of a libcuda.so.1 (fake_driver.cpp), and one with the PTX files below
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
TEXTS = sorted(Path(KERNELS).rglob("*_kernels/*.ptx"))
DRAWN = [file for file in TEXTS if file.parent.name == "drawn_kernels"]
SCENES = ["square --radius 0.1", "square --radius 1e-6", "triangular --radius 0.01", "cubic --radius 0.1",
          "cubic --radius 1e-6", "fcc --radius 1e-3", "honeycomb", "perovskite --radius 0.02",
          "superposition-pi-5 --radius 1e-3", "overlapping", "ellipse", "ellipses-mixed", "ellipsoid",
          "ellipsoids-mixed"]


def has_driver():
    try:
        return bool(ctypes.CDLL("libcuda.so.1"))
    except OSError:
        return False


def run(words, card=None, fake=True, asked=None):
    # A broken card's memory is nobody's to free: it goes with the card's context.
    environment = dict(os.environ, FAKE_CARD=card or "", ASAN_OPTIONS=f"detect_leaks={int(card != 'broken')}")
    if fake:
        environment["LD_LIBRARY_PATH"] = FAKE_CARD
    return subprocess.run([PROGRAM, *words.split()], capture_output=True, text=True, env=environment, input=asked)


def report(words):
    done = run(f"flights {words} --json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    found.pop("seconds", None)
    return found


FLIGHTS = "flights --scene square --engine gpu"
FIRST_HIT = "first-hit --scene square --engine gpu --x 0.5,0.5 --v 1,0.3"


class Refusals(unittest.TestCase):
    def refused(self, done, what, status=2):
        self.assertEqual((done.returncode, done.stdout), (status, ""))
        self.assertRegex(done.stderr, what)

    @unittest.skipIf(has_driver(), "there is a driver here")
    def test_without_a_driver(self):
        for words in (FLIGHTS, FIRST_HIT):
            self.refused(run(words, fake=False), "no libcuda.so.1 here.*certified-batch")

    def test_without_a_card(self):
        for words in (FLIGHTS, FIRST_HIT):
            self.refused(run(words, card="none"), "finds no graphics card.*certified-batch")

    @unittest.skipUnless(TEXTS, "this build has no kernels")
    def test_with_a_card_that_fails(self):
        for words in (FLIGHTS, FIRST_HIT):
            self.refused(run(words, card="broken"), "driver: cuLaunchKernel: FAKE_ERROR", status=3)

    @unittest.skipIf(TEXTS, "this build has kernels")
    def test_without_kernels(self):
        for words in (FLIGHTS, FIRST_HIT):
            self.refused(run(words), "no kernels.*clang")

    @unittest.skipUnless(TEXTS, "this build has no kernels")
    def test_beyond(self):
        for words, why in [("overlapping-3d --radius 0.7", "overlap"),
                           ("cubic --radius 1e-9", "does radii"),
                           ("cubic --radius 1e-9 --from surface", "does radii")]:
            self.refused(run(f"flights --scene {words} --engine gpu"), why)
        for scene in ("overlapping-3d --radius 0.7", "cubic --radius 1e-9"):
            told = run(f"first-hit --scene {scene} --engine gpu --x 0.5,0.5,0.5 --v 1,0.3,0.2")
            self.assertRegex(told.stdout, '"gpu does .*"reason":"unsupported"')

    @unittest.skipUnless(TEXTS, "this build has no kernels")
    def test_a_card_with_a_wrong_bit(self):
        self.refused(run(FLIGHTS, card="wrong"), "bits of the processor", status=3)
        self.refused(run(FIRST_HIT, card="wrong"), "1 of [0-9]+ flights to other bits than the processor", status=3)


@unittest.skipUnless(TEXTS, "this build has no kernels")
class Results(unittest.TestCase):
    def test_they_are_those_of_certified_batch(self):
        for scene in SCENES:
            asked = f"--scene {scene} --count 20000 --seed 7 --engine "
            self.assertEqual(report(asked + "gpu"), report(asked + "certified-batch"), scene)
        self.assertEqual(report(asked + "certified-gpu"), report(asked + "certified-batch"))

    def test_starts_on_surfaces(self):
        for scene in ("square --radius 1e-3", "honeycomb", "ellipsoid", "superposition-pi-5 --radius 1e-3"):
            asked = f"--scene {scene} --from surface --count 20000 --seed 8 --engine "
            self.assertEqual(report(asked + "gpu"), report(asked + "certified-batch"), scene)

    def test_parts_of_both_are_one_run(self):
        asked = "--scene cubic --radius 0.05 --count 400000 --seed 5"
        with tempfile.TemporaryDirectory() as folder:
            store = f"{folder}/store"
            report(f"{asked} --engine gpu --jobs 2 --time 1e-9 --store {store}")
            joined = report(f"{asked} --engine certified-batch --store {store}")
        self.assertEqual(joined, report(f"{asked} --engine certified-batch"))


@unittest.skipUnless(TEXTS, "this build has no kernels")
class Columns(unittest.TestCase):
    def same(self, asked, scene):
        there, here = (run(f"first-hit --engine {engine}", asked=asked) for engine in ("gpu", "certified-batch"))
        self.assertEqual((there.returncode, there.stdout), (here.returncode, here.stdout), scene)

    def test_they_are_those_of_certified_batch(self):
        for scene in SCENES:
            self.same(run(f"sample --scene {scene} --count 3000 --seed 11").stdout, scene)

    def test_limits_and_obstacles_that_are_left(self):
        for scene in ("square", "fcc", "honeycomb", "superposition-pi-5", "ellipse", "ellipsoids-mixed"):
            done = run(f"compare --engine gpu --scene {scene} --count 2000 --seed 12 --json")
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("boundary-starts", "near-rational", "crystals", "ellipsoids", "superpositions"):
            self.assertRegex(run(f"golden check {name} --engine gpu").stdout, " all +640 +640 +-", name)

    def test_rows_that_a_card_leaves(self):
        """Far cells, limits of all kinds, obstacles that are not there, and rows with flaws."""
        rows = [f'{{"x":[{x},0.25],"v":[{v},1],"from":{{"cell":[{cell},0]}},"max_time":{limit}}}'
                for x, cell in ((0.5, 1), (3e9, 3_000_000_000), (1e15, 10**15), (-4e18, -4 * 10**18), (0.5, 10**25))
                for v in (0.3, 1e-300, 1e300, 0) for limit in (1e-3, 5, 1e300)]
        rows += ['{"x":[0.5,0.5],"v":[0,0]}', '{"x":[0.5,0.5],"v":[1,0.3],"from":{"cell":[0,0],"atom":7}}',
                 '{"x":[0.1,0],"v":[1,0.3]}', '{"x":[0.5,0.5],"v":[1,0]}']
        for radius in (0.1, 1e-5):
            scene = f'{{"scene":{{"lattices":[{{"vectors":[[1,0],[0,1]],"atoms":[{{"radius":{radius}}}]}}]}}}}'
            self.same("\n".join([scene, *rows]) + "\n", radius)


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
        for file in DRAWN:
            if file.stem.endswith("_unit"):
                self.assertNotIn("ld.local", file.read_text(), file.name)

    @unittest.skipUnless(shutil.which("ptxas"), "there is no ptxas here")
    def test_an_assembler_takes_them(self):
        with tempfile.TemporaryDirectory() as folder:
            for file in TEXTS:
                subprocess.run(["ptxas", "-arch=sm_80", "-o", f"{folder}/out", file], check=True)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
