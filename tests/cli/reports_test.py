#!/usr/bin/env python3
"""Numbers in reports agree with each other, and with what they are numbers of: reports_test.py LORENTZ"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

LORENTZ = sys.argv.pop(1)
NEVER = "cmd:sed -u -n -E 's/.*\"id\":([^,]*),.*/{\"id\":\\1,\"outcome\":\"never\"}/p'"  # of every question


def lorentz(*arguments, status=0, text=None):
    done = subprocess.run([LORENTZ, *map(str, arguments)], capture_output=True, text=True, input=text)
    if done.returncode != status:
        raise AssertionError(done)
    return done.stdout


def number(cell):
    """The number in a cell of a table: "-" is 0, and "> 2^20", beyond which ulps are not told, is infinite."""
    return 0 if cell == "-" else float("inf") if cell.startswith(">") else float(cell)


def columns(table):
    """{row: {heading: number}} of a table whose cells do not hold two blanks."""
    lines = table.splitlines()
    heads = re.split(r"  +", lines[0])
    rows = [re.split(r"  +", line) for line in lines[2:]]
    return {row[0]: dict(zip(heads[1:], (number(cell) for cell in row[1:]))) for row in rows if len(row) == len(heads)}


class Reports(unittest.TestCase):
    def test_flights(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "bins.csv"
            for radius in (0.3, 0.01):
                its = json.loads(lorentz("flights", "--radius", radius, "--count", 1000, "--json", "--csv", file))
                self.assertEqual(its["hits"] + its["never"] + its["undecided"], its["count"])
                self.assertLess(its["shortest"], math.exp(its["mean_log"]))
                self.assertLess(math.exp(its["mean_log"]), its["mean"])
                self.assertLess(its["mean"], its["longest"])
                beyond = dict(map(tuple, its["survival"]))
                self.assertGreater(min(beyond, default=0) * 2, its["shortest"])
                self.assertLess(max(beyond), its["longest"])
                self.assertEqual(sorted(beyond.values(), reverse=True), list(beyond.values()))

    def test_judge(self):
        out = lorentz("judge", "--quick", "--time", 2, "--all", "--engine", "reduction")
        rows = columns(out[out.index("questions  "):].split("\n\n")[0])
        self.assertTrue(rows)
        outcomes = ("agree", "ill-posed", "wrong", "undecided", "unsupported", "error", "missing")
        for name, row in rows.items():
            self.assertEqual(sum(row[outcome] for outcome in outcomes), row["number"], name)
            self.assertEqual(row["wrong time"] + row["nonsense"], 0, name)

    def test_bench(self):
        out = lorentz("bench", "--radius", 0.1, "--count", 100, "--engine", "reduction")
        number, most, undecided = re.search(r"no wrong answer in (\d+) \(0 to (\S+) % of all, with 95 %\)(?:; (\d+))?", out).groups()
        self.assertTrue(3 / int(number) < float(most) / 100 < 4 / int(number), out)
        self.assertEqual(int(number) + int(undecided or 0), 600)

    def test_disagreements(self):
        """A query of each scene is written as that scene has it."""
        scenes = {d: {"dimension": d, "lattices": [{"vectors": [[float(i == k) for k in range(d)] for i in range(d)],
                                                    "atoms": [{"position": [0] * d, "radius": 0.25}]}]} for d in (2, 3)}
        queries = {d: [{"id": f"{d}/{i}", "x": [0.5] + [0] * (d - 1), "v": [1] + [0.01 * i] * (d - 1)} for i in range(4)] for d in (2, 3)}
        for order in ((2, 3), (3, 2)):
            stream = "".join(json.dumps(line) + "\n" for d in order for line in ({"scene": scenes[d]}, *queries[d]))
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / "wrong.ndjson"
                lorentz("compare", "--engine", NEVER, "--queries", "-", "--disagreements", file, status=1, text=stream)
                written = [json.loads(line) for line in file.read_text().splitlines()]
            self.assertEqual([line["scene"]["dimension"] for line in written if "scene" in line], list(order))
            those = [line for line in written if "id" in line]
            self.assertEqual([line["id"] for line in those], [query["id"] for d in order for query in queries[d]])
            for line in those:
                self.assertEqual([len(line["x"]), len(line["v"])], [int(line["id"][0])] * 2)


unittest.main()
