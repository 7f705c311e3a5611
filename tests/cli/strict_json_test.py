"""All JSON that the program writes is read back by a strict parser: strict_json_test.py LORENTZ

Names and ids hold quotes, backslashes, line ends and letters beyond ASCII. Which subcommands have --json is asked of
the program: each must have a line in COMMANDS.
"""

import json
import os
import re
import sqlite3
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import strict_json

LORENTZ = str(Path(sys.argv.pop(1)).resolve())
SCENE = 'we"ird\\ \n\u00fc\u2028.toml'
IDS = ['"', "\\", "a\nb", "\u00fc\u2028\U0001f600", "\x7f\x01", "</script>", ""]
ANSWERS = f'{SCENE}.answers'
CAMPAIGN = ["--target", "grazing", "--engine", "published", "--count", "10"]

# How each subcommand with --json is called here, and the pages it writes.
COMMANDS = {
    "compare": (["--queries", "queries.ndjson", "--answers", f'na"me\n\u00fc={ANSWERS}', "-e", "published",
                 "--disagreements", "wrong.ndjson"], []),
    "judge": (["-e", "cmd:cat > /dev/null # \"\\ \u00fc", "--time", "0.2", "--html", "page.html"], ["page.html"]),
    "convergents": (["0.4142135"], []),
    "horizon": ([SCENE], []),
    "bench": (["--scene", SCENE, "--radius", "0.1", "-e", "published", "--count", "50",
               "--html", "page.html"], ["page.html"]),
    "doctor": ([], []),
    "scene show": ([SCENE], []),
    "golden list": ([], []),
    "golden check": (["ties", "-e", "published", "--first", "40"], []),
    "fuzz": (CAMPAIGN + ["--store", "store"], []),
    "fuzz show": (["ID", "--store", "store", "--html", "page.html"], ["page.html"]),
    "flights": (["--scene", SCENE, "--count", "1000", "--store", "flights", "--html", "page.html"], ["page.html"]),
    "lyapunov": (["--scene", SCENE, "--collisions", "20000", "--store", "lyapunov"], []),
    "diffusion": (["--scene", SCENE, "--count", "1000", "--time", "5", "--store", "diffusion"], []),
}
MANY_LINES = {"flights"}


def has_option(words):
    out = subprocess.run([LORENTZ, *words, "--help"], capture_output=True, text=True, check=True).stdout
    return re.search(r"^ +--json", out, re.MULTILINE) is not None


def with_json():
    found = set()
    for name in candidates():
        found |= {name} if has_option([name]) else set()
        found |= {f"{name} {word}" for word in candidates(name) if is_subcommand(name, word) and has_option([name, word])}
    return found


def candidates(*words):
    out = subprocess.run([LORENTZ, *words, "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  ([\w-]+)", out.partition("Subcommands:\n")[2].split("\n\n")[0], re.MULTILINE)


def is_subcommand(*words):
    out = subprocess.run([LORENTZ, *words, "--help"], capture_output=True, text=True).stdout
    return f"Usage: lorentz {' '.join(words)} " in out


class StrictJson(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        (cls.path / SCENE).write_text('# we"ird\\ \u00fc\ndimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, 1]]\n'
                                      "[[lattices.atoms]]\nposition = [0, 0]\nradius = 0.3\n")
        starts = [{"id": one, "x": [0.5, 0.5], "v": [1, 0.3 + 0.01 * i]} for i, one in enumerate(IDS)]
        scene = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.3}]}]}
        cls.lines("queries.ndjson", [{"scene": scene}, *starts])
        cls.lines("starts.ndjson", starts)
        cls.lines(ANSWERS, [{"id": one, "outcome": "hit", "lattice": 0, "atom": 0, "cell": [9, 9], "time": 1} for one in IDS])
        cls.run_program("fuzz", *CAMPAIGN, "--store", "store")
        cls.pages = subprocess.run([LORENTZ, "flights", "--count", "10", "--html", os.devnull],
                                   capture_output=True).returncode == 0

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def lines(cls, name, objects):
        (cls.path / name).write_text("".join(json.dumps(one) + "\n" for one in objects))

    @classmethod
    def run_program(cls, *words):
        done = subprocess.run([LORENTZ, *words], cwd=cls.path, capture_output=True)
        if done.returncode not in (0, 1, 3) or not done.stdout and done.returncode == 3:
            raise AssertionError(f"{words}: {done.returncode}, {done.stderr}")
        return done.stdout

    def ids_in(self, lines):
        return [line["id"] for line in lines]

    def test_every_report(self):
        self.assertEqual(with_json(), set(COMMANDS))
        for name, (words, pages) in COMMANDS.items():
            with self.subTest(name):
                if not self.pages:
                    words = [word for word in words if word not in ("--html", "page.html")]
                if "ID" in words:
                    listed = strict_json.read(self.run_program("fuzz", "show", "--store", "store", "--json"))
                    words = [listed["findings"][0]["id"] if word == "ID" else word for word in words]
                out = self.run_program(*name.split(), *words, "--json")
                read = strict_json.read_lines(out) if name in MANY_LINES else [strict_json.read(out)]
                self.assertTrue(all(isinstance(one, dict) and one for one in read))
                for page in pages if self.pages else []:
                    self.assertTrue(strict_json.read_page((self.path / page).read_bytes()))
                if SCENE in words and "scene" in read[0] and name != "scene show":
                    self.assertEqual(read[0]["scene"], SCENE)

    def test_every_stream(self):
        scene = ["--scene", SCENE]
        answers = strict_json.read_lines(self.run_program("first-hit", "queries.ndjson", "--detail", "-e", "oracle", "--digits", "20"))
        self.assertEqual(self.ids_in(answers), IDS)
        collisions = strict_json.read_lines(self.run_program("trajectory", "starts.ndjson", "--collisions", "2", *scene))
        self.assertEqual({line["id"] for line in collisions}, set(IDS))
        self.assertEqual(len(strict_json.read_lines(self.run_program("sample", "--count", "20", *scene))), 21)
        self.run_program("compare", "--queries", "queries.ndjson", "--answers", f"a={ANSWERS}", "--disagreements", "wrong.ndjson")
        wrong = strict_json.read_lines((self.path / "wrong.ndjson").read_bytes())
        self.assertEqual(self.ids_in(wrong[1:]), IDS)
        self.assertEqual(self.ids_in(line["given"] for line in wrong[1:]), IDS)
        made = strict_json.read_lines(self.run_program("golden", "make", "--set", "ties", "--count", "5"))
        self.assertIn("golden", made[0])

    def test_stores(self):
        self.run_program("lyapunov", "--scene", SCENE, "--collisions", "20000", "--store", "kept")
        pieces = sqlite3.connect(self.path / "kept").execute("SELECT number, text FROM piece").fetchall()
        self.assertGreater(len(pieces), 10)
        for _, text in pieces:
            strict_json.read(text)


if __name__ == "__main__":
    unittest.main()
