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

    def test_the_paper(self):
        with tempfile.TemporaryDirectory() as folder:
            made("paper/first_discs.py", LORENTZ, folder)
            for name in "first-discs.csv", "first-discs.svg":
                self.same((pathlib.Path(folder) / name).read_text(), f"paper/{name}")
        times = [DATA / "paper" / f"times-{dimension}d.csv" for dimension in (2, 3)]
        self.same(made("paper/exponents.py", *times), "paper/exponents.csv")
        self.same(made("paper/per_cell.py", *times), "paper/times-per-cell.csv")

    def test_times_by_hand(self):
        """Only drawn flights that were timed. Through (0, 0), (-1, 1), (-2, 1) in decades the slope is -1/2, give or take 12^-1/2."""
        rows = ["scene,engine,radius,difficulty,queries,path_mean,ns_mean"]
        rows += [f"square,a,{radius},drawn,7,2,{ns}" for radius, ns in ((0.01, 10), (1, 1), (0.1, 10), (0.001, ""))]
        rows += ["square,a,1,hard,7,2,99", "square,b,1,drawn,7,4,1", "square,b,0.1,drawn,7,4,10"]
        with tempfile.TemporaryDirectory() as folder:
            times = pathlib.Path(folder) / "times.csv"
            times.write_text("\n".join(rows) + "\n")
            self.assertEqual(made("paper/exponents.py", times).splitlines()[1:],
                             ["square,a,-0.500,0.289,0.01,1,1.0,10.0", "square,b,-1.000,0.000,0.1,1,1.0,10.0"])
            self.assertEqual(made("paper/per_cell.py", times).splitlines()[1:],
                             ["square,a,0.01,7,2,5,3.927", "square,a,1,7,2,0.5,0.3927", "square,a,0.1,7,2,5,3.927",
                              "square,b,1,7,4,0.25,0.1963", "square,b,0.1,7,4,2.5,1.963"])

    def test_the_directions(self):
        self.same(made("examples/paper-89-directions.py"), "examples/paper-89-directions.queries.ndjson")

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
