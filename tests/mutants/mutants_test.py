"""The mutants of small sources are the ones meant, run when they are switched on, and note that they were reached.
What needs libclang is tested where it is installed: python3 tests/mutants/mutants_test.py"""

import os, pathlib, re, subprocess, sys, tempfile, unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ocaml_sites, python_sites, schemata, site_of  # noqa: E402

CPP = """#include <cstdio>
#include <cstdlib>
static int sum(const int* a, int n) {
  int total = 0;
  for (int i = 0; i < n; ++i) {
    if (a[i] < 0) continue;
    total += a[i];
  }
  return total;
}
int main(int, char** words) {
  const int a[] = {5, -1, 7};
  std::printf("%d", std::atoi(words[1]) ? sum(a, 3) : 0);
}
"""
PYTHON = "def least(a, b):\n    if a < b:\n        return a\n    return b\n"


def words_of(sites):
    return {(one.operator, one.after) for one in sites}


class Equivalent(unittest.TestCase):
    def test_lines_still_stand(self):
        """Each line of equivalent.tsv quotes the sources as they are, but for blanks."""
        here = pathlib.Path(__file__).resolve().parent
        for line in (here / "equivalent.tsv").read_text().splitlines():
            if line.startswith("#"):
                continue
            path, before, _, reason = line.split("\t")
            self.assertTrue(reason)
            source = (here.parents[1] / path).read_text()
            self.assertIn("".join(before.split()), "".join(source.split()), f"{path}: no such line any more")


class Folders(unittest.TestCase):
    def test_each_is_there(self):
        """No mutant would be drawn of a folder that moved, and none would survive."""
        here = pathlib.Path(__file__).resolve().parent
        listed = re.search(r"FOLDERS = \[(.*?)\]", (here / "run").read_text(), re.S)[1]
        folders = re.findall(r'"([^"]+)"', listed)
        self.assertGreater(len(folders), 20)
        for folder in folders:
            self.assertTrue((here.parents[1] / folder).is_dir(), f"{folder}: no such folder")


class Sites(unittest.TestCase):
    def test_python(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.py").write_text(PYTHON)
            found = words_of(python_sites.sites(pathlib.Path(folder), "a.py"))
        self.assertEqual(found, {("comparison's end", "if a <= b:"), ("comparison turned", "if a > b:"),
                                 ("guard dropped", "if False:"), ("condition turned", "if not (a < b):")})

    def test_ocaml_leaves_texts_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.ml").write_text('let f a = (* a < 1 *) if a < 7 then "a < b" else fst a\n')
            found = words_of(ocaml_sites.sites(pathlib.Path(folder), "a.ml"))
        start = "let f a = (* a < 1 *) if "
        self.assertIn(("comparison's end", start + 'a <= 7 then "a < b" else fst a'), found)
        self.assertIn(("constant", start + 'a < 8 then "a < b" else fst a'), found)
        self.assertIn(("guard dropped", start + 'false then "a < b" else fst a'), found)
        self.assertEqual(len([1 for operator, _ in found if operator == "comparison's end"]), 1)

    def test_equal_lines_are_told_apart_and_keep_their_rank(self):
        make = lambda source: site_of.numbered(
            [site_of.site("a", source, "sign", k, k + 1, "-", (0, 1), 0) for k in range(len(source)) if source[k:k + 1] == b"+"])
        one, other = make(b"a + b\na + b\n"), make(b"\n\na + b\na + b\n")
        self.assertEqual([s.nth for s in one], [0, 1])
        self.assertEqual([s.rank(1) for s in one], [s.rank(1) for s in other])
        self.assertNotEqual(one[0].rank(1), one[0].rank(2))

    def test_cpp(self):
        try:
            import cpp_sites
        except ImportError:
            self.skipTest("no libclang")
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "a.cpp").write_text(CPP)
            found = words_of(cpp_sites.sites(pathlib.Path(folder), "a.cpp", ["-x", "c++", "-std=c++20"]))
        for expected in [("last left out", "for (int i = 0; i < (n) - 1; ++i) {"), ("guard dropped", ";"),
                         ("comparison's end", "if (a[i] <= 0) continue;"), ("first for all", "total += a[0];"),
                         ("sign", "total -= a[i];"), ("dropped statement", ";"), ("first for all", "break; }"),
                         ("constant", "int total = 1;"), ("condition turned", "if (!(a[i] < 0)) continue;")]:
            self.assertIn(expected, found)
        self.assertFalse([after for _, after in found if "printf" in after])  # main is not mutated


class Schemata(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name)
        self.reached = self.path / "reached"

    def tearDown(self):
        self.folder.cleanup()

    def run_with(self, mutant, *command):
        self.reached.write_bytes(bytes(1 << 16))
        environment = {**os.environ, "LORENTZ_MUTANT": str(mutant), "LORENTZ_REACHED": str(self.reached)}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        marks = self.reached.read_bytes()
        return done.stdout, [n for n in range(1, 9) if marks[n]]

    def test_cpp(self):
        source = CPP.encode()
        body = (source.index(b"{\n  int total") + 1, source.index(b"}\nint main"), False)

        def change(words, text, here):
            at = source.index(words)
            return site_of.site("a.cpp", source, "", at, at + len(words), text, body, source.index(here))

        those = [(1, change(b"total += a[i]", "total -= a[i]", b"total +=")), (2, change(b"a[i] < 0", "false", b"if (a[i]"))]
        text = schemata.cpp(source, those)
        owners, lines = schemata.owners(text), text.decode().split("\n")
        self.assertEqual(sorted(set(owners.values())), [1, 2])
        last = max(n for n, line in enumerate(lines, 1) if "LORENTZ_REACHED" in line)  # of the body as it is
        self.assertEqual([owners.get(last), owners.get(len(lines) - 1)], [2, None])
        (self.path / "a.cpp").write_bytes(text)
        program = str(self.path / "a")
        subprocess.run(["c++", "-std=c++20", "-o", program, str(self.path / "a.cpp")], check=True)
        self.assertEqual(self.run_with(0, program, "1"), ("12", [1, 2]))
        self.assertEqual(self.run_with(0, program, "0"), ("0", []))
        self.assertEqual(self.run_with(1, program, "1")[0], "-12")
        self.assertEqual(self.run_with(2, program, "1")[0], "11")

    def test_python(self):
        file = self.path / "a.py"
        file.write_text(PYTHON + "import sys\nprint(least(*map(int, sys.argv[1:])))\n")
        sites = python_sites.sites(self.path, "a.py")
        turned = next(one for one in sites if one.operator == "comparison turned")
        schemata.python(self.path, "a.py", [(5, turned)])
        self.assertEqual(self.run_with(0, sys.executable, str(file), "1", "2"), ("1\n", [5]))
        self.assertEqual(self.run_with(5, sys.executable, str(file), "1", "2")[0], "2\n")
        self.assertEqual(self.run_with(7, sys.executable, str(file), "1", "2")[0], "1\n")  # of another file


if __name__ == "__main__":
    unittest.main()
