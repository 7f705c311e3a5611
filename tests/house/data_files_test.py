"""The files in data/ that Python makes are what it makes: data_files_test.py LORENTZ PROJECT"""
import json, pathlib, subprocess, sys, tempfile, unittest

LORENTZ, PROJECT = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
DATA = PROJECT / "data"


def made(script, *arguments, folder=None, status=0):
    done = subprocess.run([sys.executable, DATA / script, *arguments], capture_output=True, text=True, cwd=folder)
    if done.returncode != status:
        raise AssertionError(done)
    return done.stdout + done.stderr


class Files(unittest.TestCase):
    def same(self, text, name):
        self.assertEqual(text, (DATA / name).read_text())

    def test_times_by_hand(self):
        """What data/paper says of times: two seeds, of which one is twice as slow; powers 1 and 1/2, which meet at 0.01."""
        rows = ["scene,radius,engine,seed,flights,ns_mean,ns_median,path_mean"]
        for seed, factor in ((1, 1), (2, 2)):
            for radius in (0.1, 0.01, 0.001):
                rows += [f"square,{radius},classical,{seed},9,{factor / radius},1,{1 / radius}",
                         f"square,{radius},published,{seed},9,{factor * 10 / radius**0.5},1,{1 / radius}"]
        sys.path.insert(0, str(DATA / "paper"))
        import reading
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "times-2d.csv").write_text("\n".join(rows) + "\n")
            reading.HERE, reading.SEEDS = pathlib.Path(folder), (1, 2)
            for engine, power in ("classical", -1), ("published", -0.5):
                for found in reading.exponents(2, engine):
                    self.assertAlmostEqual(found, power)
            for radius in reading.crossings(2):
                self.assertAlmostEqual(radius, 0.01)
            for radius, ns in reading.per_cell(2, "classical"):
                self.assertAlmostEqual(ns, 1.5 / (4 / 3.141592653589793))
            middle, half = reading.interval([1, 2, 3, 4, 5])
            self.assertAlmostEqual((middle, round(half, 3)), (3, 1.963))

    def test_the_directions(self):
        self.same(made("examples/paper-89-directions.py"), "examples/paper-89-directions.queries.ndjson")

    def test_a_slip_makes_nothing(self):
        self.assertIn("--chek", made("golden/itineraries/make", LORENTZ, "--chek", status=2))

    def test_logs(self):
        """Starts of 2D and of 3D, one of them twice, and what four programs said of them."""
        logs = {"tests-misc": """
E and C differ at x = [0.5, 0.25]; v = [1.0, 0.5]; r = 0.1: E = BigInt[3, 1], C = [2, -9007199254740993]
nothing
x = [0.5, 0.25]; v = [1.0, 0.5]; r = 0.1: E = [7, 7]
x = [0.5, 0.5]; v = [1.0, 0.5]; r = 0.1: myE = [4, 2]; MyC = [BigInt[1, 0]]
x = [0.5, 0.5]; v = [1.0, 0.5]; r = 2e-1: MyE = [5, 2]; myC = [1, 9007199254740992]
""", "tests3d_EvsC_ata": "x = [0.5, 0.25, 1e-3]; v = [1.0, 0.5, 0]; r = 0.1: C = [1, 2, 3]\n"}
        with tempfile.TemporaryDirectory() as folder:
            for name in ("tests-misc", "tests2d-example", "tests2d-example2", "tests2d-example_EvsC_ata", "tests2d-example_cap",
                         "tests3d-example", "tests3d_EvsC_ata"):
                (pathlib.Path(folder) / (name + ".dat")).write_text(logs.get(name, ""))
            self.assertEqual(made("examples/author-logs.py", folder, folder=folder), "")

            def lines(name):
                return [json.loads(line) for line in (pathlib.Path(folder) / (name + ".ndjson")).read_text().splitlines()]

            def scene(vectors, radius):
                atoms = [{"position": [0] * len(vectors), "radius": radius}]
                return {"scene": {"dimension": len(vectors), "lattices": [{"vectors": vectors, "atoms": atoms}]}}

            def said(place, *cell):
                return {"id": place, "outcome": "hit", "lattice": 0, "atom": 0, "cell": [*cell]}

            plane, space = [[1, 0], [0, 1]], [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
            self.assertEqual(lines("queries"), [
                scene(plane, 0.1), {"id": "tests-misc:2", "x": [0.5, 0.25], "v": [1, 0.5]},
                {"id": "tests-misc:5", "x": [0.5, 0.5], "v": [1, 0.5]}, scene(plane, 0.2),
                {"id": "tests-misc:6", "x": [0.5, 0.5], "v": [1, 0.5]}, scene(space, 0.1),
                {"id": "tests3d_EvsC_ata:1", "x": [0.5, 0.25, 0.001], "v": [1, 0.5, 0]}])
            self.assertEqual(lines("published"), [said("tests-misc:2", 3, 1)])
            self.assertEqual(lines("classical"), [said("tests-misc:2", 2, "-9007199254740993"), said("tests3d_EvsC_ata:1", 1, 2, 3)])
            self.assertEqual(lines("published-bigfloat"), [said("tests-misc:5", 4, 2), said("tests-misc:6", 5, 2)])
            self.assertEqual(lines("classical-bigfloat"), [said("tests-misc:5", 1, 0), said("tests-misc:6", 1, 2**53)])
            first = subprocess.run([LORENTZ, "first-hit", "queries.ndjson"], capture_output=True, text=True, cwd=folder)
            self.assertEqual(first.returncode, 0, first.stderr)
            (pathlib.Path(folder) / "tests2d-example.dat").unlink()
            self.assertIn("tests2d-example.dat: No such file", made("examples/author-logs.py", folder, folder=folder, status=1))


if __name__ == "__main__":
    unittest.main()
