"""The pages of results are what commands make of the stored results: results_test.py SOURCE"""

import difflib
import importlib.util
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
STORED = ["docs/results", "docs/results.md", "fuzz/planted", "tests/bench", "tests/mutants/results.tsv", "tests/billion/results.tsv"]


def printed(tree):
    return subprocess.run([sys.executable, tree / "tests/bench/results.py", "--print"], capture_output=True, text=True, check=True).stdout


class Results(unittest.TestCase):
    def test_the_page(self):
        page = (SOURCE / "docs/results.md").read_text()
        self.assertEqual(page, printed(SOURCE), "".join(difflib.unified_diff(
            page.splitlines(True), printed(SOURCE).splitlines(True), "docs/results.md", "./run results", n=0)))

    def test_the_league(self):
        place = SOURCE / "docs/examples/engines/league.py"
        spec = importlib.util.spec_from_file_location("league", place)
        league = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(league)
        results = {one["name"]: one for one in json.loads((league.PAGES / "league.json").read_text())}
        entries = [one for one in json.loads(league.LIST.read_text())["engines"] if one["name"] in results]
        table = league.table([(one, results[one["name"]]) for one in entries])
        self.assertGreater(table.count("\n"), 20)
        self.assertIn(league.BEGIN + table, (league.PAGES / "README.md").read_text())

    def test_each_stored_file_counts(self):
        """A changed figure changes the page."""
        page = printed(SOURCE)
        for name, old, new in [("fuzz/planted/results.tsv", "\tnot found", "\tleaving"), ("tests/mutants/results.tsv", "\t29\t0", "\t28\t0"),
                               ("tests/billion/results.tsv", "50399942", "50399941"), ("tests/bench/ratios.tsv", "8.017", "9.017"),
                               ("docs/results/golden.tsv", "\tpublished\t96\t51", "\tpublished\t96\t50"),
                               ("docs/results/figures.toml", "4478284", "4478285"),
                               ("docs/results/bench.csv", "square,0.001,drawn,reduction,", "square,0.002,drawn,reduction,")]:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                tree = Path(folder)
                for one in STORED:
                    (tree / one).parent.mkdir(parents=True, exist_ok=True)
                    (shutil.copytree if (SOURCE / one).is_dir() else shutil.copy)(SOURCE / one, tree / one)
                text = (tree / name).read_text()
                self.assertIn(old, text)
                (tree / name).write_text(text.replace(old, new, 1))
                self.assertNotEqual(page, printed(tree))


if __name__ == "__main__":
    unittest.main()
