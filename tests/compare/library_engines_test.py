"""Adapters of other libraries (docs/examples/engines): GLM, which is built here if its headers are installed, and cannon-es,
if npm has installed it. library_engines_test.py LORENTZ SOURCE [GLM_ENGINE]"""

import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

LORENTZ, SOURCE = sys.argv.pop(1), Path(sys.argv.pop(1)).resolve()
GLM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
ENGINES = SOURCE / "docs" / "examples" / "engines"
CANNON = ENGINES / "node_modules" / "cannon-es" / "package.json"
UNIT = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.125}]}]}
BALL = {"dimension": 3, "lattices": [{"vectors": [], "atoms": [{"position": [4, 0, 0], "radius": 0.5}]}]}
ROW = {"dimension": 2, "lattices": [{"vectors": [[1, 0]], "atoms": [{"position": [0, 0], "radius": 0.125}]}]}
ELLIPSE = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]],
                                         "atoms": [{"position": [0, 0], "semiaxes": [[0.25, 0], [0, 0.125]]}]}]}
FLAT = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0}]}]}


def scene(what):
    return json.dumps({"scene": what})


class Adapter:
    """What holds for each; `command` and `version` are the adapter's."""

    def lines(self, *stream, arguments=()):
        done = subprocess.run([*self.command, *arguments], input="".join(line + "\n" for line in stream), text=True,
                              stdout=subprocess.PIPE, check=True)
        return [json.loads(line) for line in done.stdout.splitlines()]

    def answers(self, *stream):
        *answers, last = self.lines(*stream)
        self.assertEqual(list(last), ["engine_time"])
        return answers

    def compare(self, scene, count, precision, *arguments):
        command = "cmd:exec " + " ".join([*self.command, *arguments])
        done = subprocess.run([LORENTZ, "compare", "--scene", scene, "--radius", "0.2", "--count", str(count), "--json",
                               "--precision", precision, "--engine", command], text=True, stdout=subprocess.PIPE)
        return json.loads(done.stdout)["engines"][0]

    def test_claim(self):
        [line] = self.lines()
        claim = line["engine"]
        self.assertEqual((claim["version"], claim["precision"], claim["dimensions"]),
                         (self.version, "binary64", [2, 3]))
        self.assertTrue(claim["name"])

    def test_drawn_flights(self):  # compare's default seed
        for name in ("square", "cubic"):
            one = self.compare(name, 500, "binary64")
            self.assertEqual((one["wrong"], one["other_quantity"]), (0, 0), name)
            self.assertEqual((one["error"], one["missing"], one["unsupported"]), (0, 0, 0), name)
            self.assertGreaterEqual(one["agree"], 490, name)  # the walks of some flights along the axes are too long

    def test_hexadecimal_numbers(self):
        [answer] = self.answers(scene(BALL), '{"id":1,"x":["0x0p0",0,0],"v":["0x1.0p-2",0,"-0x0p+0"]}')
        self.assertEqual((answer["outcome"], answer["time"]), ("hit", 14))

    def test_single_ball(self):
        source = {"lattice": 0, "atom": 0, "cell": []}
        hit, missed, inside, leaving = self.answers(
            scene(BALL), '{"id":"hit","x":[0,0,0],"v":[0.25,0,0]}', '{"id":"missed","x":[0,1,0],"v":[1,0,0]}',
            '{"id":"inside","x":[4,0.25,0],"v":[1,0,0]}',
            json.dumps({"id": "leaving", "x": [4, 0.25, 0], "v": [1, 0, 0], "from": source}))
        self.assertEqual(hit, {"id": "hit", "outcome": "hit", **source, "time": 14})
        self.assertEqual(missed, {"id": "missed", "outcome": "never"})
        self.assertEqual(inside, {"id": "inside", "outcome": "inside", **source})
        self.assertEqual(leaving, {"id": "leaving", "outcome": "never"})

    def test_from(self):
        [first, second] = self.answers(
            scene(UNIT), '{"id":1,"x":[0.5,0],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":[1,0]}}',
            '{"id":2,"x":[0.5,0],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":["1","0"]}}')
        self.assertEqual((first["cell"], first["time"]), ([2, 0], 1.375))
        self.assertEqual((second["cell"], second["time"]), ([2, 0], 1.375))

    def test_inside_of_two(self):
        wide = json.loads(json.dumps(UNIT).replace("0.125", "0.75"))
        [answer] = self.answers(scene(wide), '{"id":1,"x":[0.5,0.25],"v":[1,0]}')
        self.assertEqual(answer, {"id": 1, "outcome": "inside", "lattice": 0, "atom": 0, "cell": [0, 0]})

    def test_bad_queries_are_answered_with_an_error(self):
        bad = ['{"id":"a","x":[0.5,0.5],"v":[0,0]}', '{"id":"b","x":[0.5],"v":[1,0]}', '{"id":"c","v":[1,0]}',
               '{"id":"d","x":[0.5,true],"v":[1,0]}', '{"id":"e","x":[1e999,0.5],"v":[1,0]}', "{",
               '{"id":"f","x":[0.5,0.5],"v":[1,0],"from":{"lattice":0,"atom":1,"cell":[0,0]}}',
               '{"id":"g","x":[0.5,0.5],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":[0.5,0]}}',
               '{"id":"h","x":[0.5,"0.5"],"v":[1,0]}', '{"id":"i","x":[0.5,"0x1p"],"v":[1,0]}',
               '{"id":"j","x":[0.5,0.5],"v":[1,0],"from":{"lattice":0,"atom":0,"cell":[0,"1e3"]}}']
        answers = self.answers(scene(UNIT), *bad, '{"id":"good","x":[0.5,0],"v":[1,0]}')
        self.assertEqual([one["outcome"] for one in answers], ["error"] * len(bad) + ["hit"])
        self.assertTrue(all("message" in one and "reason" not in one for one in answers[:-1]))
        # An identity that could be read is kept; a number too large ends the reading of a line in some libraries.
        self.assertEqual([one["id"] for one in answers if one["id"] not in (None, "e")], [*"abcdfghij", "good"])

    def test_bad_scenes(self):
        before, bad, after, good = self.answers('{"id":0,"x":[0,0],"v":[1,0]}', scene(FLAT), '{"id":1,"x":[0.5,0],"v":[1,0]}',
                                                scene(UNIT), '{"id":2,"x":[0.5,0],"v":[1,0]}')
        self.assertEqual([one["outcome"] for one in (before, bad, after, good)], ["error", "error", "error", "hit"])
        self.assertEqual([one["id"] for one in (before, bad, after, good)], [0, None, 1, 2])

    def test_unsupported(self):
        for what in (ELLIPSE, ROW):
            [answer] = self.answers(scene(what), '{"id":1,"x":[0.5,0.5],"v":[1,0]}')
            self.assertEqual((answer["id"], answer["outcome"], answer["reason"]), (1, "error", "unsupported"))

    def test_engine_time(self):
        number = 300
        *answers, last = self.lines(scene(UNIT), "", *(f'{{"id":{k},"x":[0.5,0.5],"v":[1,{k}]}}' for k in range(number)))
        self.assertEqual([one["id"] for one in answers], list(range(number)))
        self.assertEqual(last["engine_time"]["queries"], number)
        self.assertGreater(last["engine_time"]["seconds"], 0)


@unittest.skipUnless(GLM, "GLM or nlohmann-json is not installed")
class Glm(Adapter, unittest.TestCase):
    command = [GLM]

    @classmethod
    def setUpClass(cls):
        text = "#include <glm/glm.hpp>\nGLM_VERSION_MESSAGE\n"
        done = subprocess.run(["c++", "-E", "-x", "c++", "-"], input=text, text=True, stdout=subprocess.PIPE, check=True)
        cls.version = re.search(r'"GLM: version ([\d.]+)"\s*$', done.stdout).group(1)

    def test_binary32_in_coordinates_of_cells(self):
        [line] = self.lines(arguments=["float"])
        self.assertEqual(line["engine"]["precision"], "binary32")
        world = self.compare("square", 1000, "binary32", "float")
        cells = self.compare("square", 1000, "binary32", "float", "cells")
        self.assertEqual((world["queries"], cells["queries"]), (1000, 1000))
        self.assertGreater(world["wrong"], 0)
        self.assertEqual((cells["wrong"], cells["other_quantity"]), (0, 0))


@unittest.skipUnless(shutil.which("node") and CANNON.exists(), "cannon-es is not installed: npm ci in docs/examples/engines")
class Cannon(Adapter, unittest.TestCase):
    command = ["node", str(ENGINES / "cannon" / "engine.mjs")]

    @classmethod
    def setUpClass(cls):
        cls.version = json.loads(CANNON.read_text())["version"]


class League(unittest.TestCase):
    def test_the_list_names_adapters_that_are_there(self):
        engines = json.loads((ENGINES / "league.json").read_text())["engines"]
        self.assertGreaterEqual(len(engines), 9)
        self.assertEqual(len({one["name"] for one in engines}), len(engines))
        for one in engines:
            words = one["command"].split()
            file = ENGINES / (words[1] if words[0] == "node" else words[0].rstrip("0123456789") + ".cpp")
            self.assertTrue(file.exists(), file)
            self.assertIn(one["precision"], ("binary32", "binary64"))
            self.assertEqual("cells" in words or one["name"] == "embree", one["coordinates"] == "cells", one["name"])
            self.assertIn(f"| `{file.parent.name}` |", (ENGINES / "README.md").read_text())

    def test_the_lock_file_names_no_host(self):
        self.assertNotIn("resolved", (ENGINES / "package-lock.json").read_text())


if __name__ == "__main__":
    unittest.main()
