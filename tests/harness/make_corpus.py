#!/usr/bin/env python3
"""Makes the seeds of the harnesses' corpora, corpus/NAME/seed-*, from data/ and from the bad lines below.

What a harness found is kept beside the seeds under a name of its own, and is left alone here.
"""
import json
import pathlib
import struct
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parent.parent / "data"
SQUARE = '{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.125}]}]}}'

BAD_LINES = {
    "no-json": SQUARE + '\n{"id":1,"x":[0.25,\n{"id":2}x\n[1,2]\n{"id":"a\\ud800"}\n{"id":01}\n\xff\n\0\0\n',
    "no-scene": '{"id":1,"x":[0,0],"v":[1,0]}\n{"scene":{"dimension":4,"lattices":[]}}\n{"id":2,"x":[0,0],"v":[1,0]}\n',
    "cut-scene": SQUARE + '\n{"scene":{"dimension":2,"latt\n{"id":2,"x":[0.5,0.5],"v":[1,0]}\n',
    "deep": '{"a":' + "[" * 70 + "]" * 70 + "}\n{" + '"a":{' * 70 + "}" * 71 + "\n",
    "twice": SQUARE + '\n{"id":1,"id":"b","x":[0],"x":[0.25,0.5],"v":[0,0],"v":[1,0]}\n',
    "one-word": SQUARE + "".join('\n{"id":"%s","x":[%s,0.5],"v":[1,0.5]}\n{"id":"%s","x":[0.5,0.5],"v":[1,%s]}' % (w, q, w, q)
                                 for w in ["NaN", "nan", "inf", "-inf", "Infinity", "1e999"] for q in ['"%s"' % w, w]),
    "words": SQUARE + '\n{"id":null,"x":["NaN",0],"v":["inf",1e999]}\n{"x":["0x1.8p-1","-0x1p-1074"],"v":["0x1p1023",-0.0]}\n',
    "ids": SQUARE + "".join('\n{"id":%s,"x":[0.5,0.5],"v":[1,0.5]}' % i
                            for i in ["27.0", "1e3", "9007199254740993", '"\\u0000\\n\\"\\\\"', "true", "[]", "-0"]),
    "blank": "\ufeff" + SQUARE + '\n\n \t\r\n{"golden":{}}\r\n{"id":1,"x":[0.5,0.5],"v":[1,0.5]}\r\n',
}
BAD_ANSWERS = """{"id":1,"outcome":"hit","lattice":0,"atom":0,"cell":[1,"-123456789012345678901234567890"],"time":1.5}
{"id":"b","outcome":"inside","lattice":0,"atom":1,"cell":[27.0,0,-3]}
{"id":"c","outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":"inf"}
{"outcome":"error","message":"v is zero\\n\\u0001","reason":"unsupported"}
{"id":4,"outcome":"later"}
{"id":5,"outcome":"undecided","golden":{}}
{"id":6,"outcome":"hit","lattice":-1,"atom":0,"cell":[]}
{"id":7,"outcome":"hit","lattice":0,"atom":0,"cell":[1,0],"time":-1}
{"id":8,"outcome":"maybe"}
"""
BAD_SCENES = {
    "empty": "",
    "only-comment": "# nothing\n",
    "no-radius.toml": 'dimension = 2\n[[lattices]]\nvectors = [[1,0],[0,1]]\n[[lattices.atoms]]\nposition = [0,0]\n',
    "hexadecimal.toml": 'dimension = 2\n[[lattices]]\nvectors = [["0x1p0",0],[0,"0x1.8p-1"]]\natoms = [{position = [0, -0.0], radius = "0x1p-3"}]\n',
    "nan.toml": 'dimension = 2\n[[lattices]]\nvectors = [[1,0],[0,inf]]\natoms = [{position = [0, nan], radius = 1e-400}]\n',
    "dates.toml": 'dimension = 1979-05-27T07:32:00Z\nlattices = [[]]\na.b."c.d" = 0x10\n"\\u00e9" = """x\\\n  y"""\n',
    "both.json": '{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":1,"semiaxes":[[1,0],[0,1]]}]}]}',
    "two-values.json": SQUARE + SQUARE,
    "dependent.json": '{"dimension":2,"lattices":[{"vectors":[[1,2],[2,4]],"atoms":[{"position":[0,0],"radius":1}]}]}',
    "cut.json": SQUARE[:70],
    "deep.json": "{" + '"scene":{' * 70,
    "deep.toml": "a = " + "[" * 300 + "\n",
}
# Claimed to miss both rows of balls, and hits the second.
NO_NEVER = ('{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.125},'
            '{"position":[0.5,0.5],"radius":0.125}]}]}}\n{"id":"a","tags":["t"],"x":[0.25,0.5],"v":[1,0],"expect":{"outcome":"never"},'
            '"certificate":{"rows":[{"lattice":0,"atom":0,"basis":[[1,0],[0,1]]},{"lattice":0,"atom":1,"basis":[[1,0],[0,1]]}]}}\n')
HEADER = '{"golden":{"format":1,"name":"n","count":1,"tags":{"t":"what it is"}}}\n'
EXPECT = '"expect":{"outcome":"hit","lattice":0,"atom":0,"cell":[1,2],"time":2}'
BAD_SETS = {
    "no-header": SQUARE + "\n",
    "format-2": '{"golden":{"format":2}}\n',
    "no-scene": HEADER + '{"id":"a","tags":["t"],"x":[0,0],"v":[1,0],"expect":{"outcome":"never"}}\n',
    "no-scene-no-query": HEADER + '{"id":"a","tags":["t"],"x":null,"v":[1,0],' + EXPECT + "}\n",
    "order": HEADER + SQUARE + '\n{"id":"a","x":[0,0],"v":[1,0],"tags":["t"],"expect":{"outcome":"never"}}\n',
    "twice": HEADER + SQUARE + '\n{"id":"a","tags":["t"],"tags":["u"],"x":[0.5,0],"v":[1,0],' + EXPECT + ',"margin":1,"margin":2}\n',
    "odd-tags": HEADER.replace('"t"', '"\\"],\\n"') + SQUARE
    + '\n{"id":"\\u0001","tags":["\\"],\\n","]"],"x":[0.5,0],"v":[1,0],"expect":{"outcome":"error","message":"\\t\\\\"}}\n',
    "odd-proof": HEADER + SQUARE + '\n{"id":"a","tags":["t"],"x":[0.5,0],"v":[1,0],' + EXPECT
    + ',"margin":"inf","certificate":{"windows":[{"lattice":0,"atom":0,"from":"-0x1f4p-3","to":"0x1p99","basis":[[1,0],[0,"1"]]}],'
    + '"rows":[{"lattice":0,"atom":0,"basis":[[1,0],["-9007199254740993",1]]}]}}\n',
}


def write(name, seed, content):
    folder = HERE / "corpus" / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"seed-{seed}").write_bytes(content if isinstance(content, bytes) else content.encode())


def records(path, most):
    """(scene line, record line) of `most` records spread over a golden set, short ones only."""
    pairs, scene = [], ""
    for line in path.read_text().splitlines()[1:]:
        if line.startswith('{"scene"'):
            scene = line
        elif len(scene) + len(line) < 1800:
            pairs.append((scene, line))
    return [pairs[(2 * i + 1) * len(pairs) // (2 * most)] for i in range(min(most, len(pairs)))]


def query_of(record):
    """The line without what a query stream has no use for."""
    parsed = json.loads(record)
    return json.dumps({key: parsed[key] for key in ("id", "x", "v", "from") if key in parsed}, separators=(",", ":"))


def answer_of(record):
    parsed = json.loads(record)
    return json.dumps({"id": parsed["id"], **parsed["expect"]}, separators=(",", ":"))


def looking_farther(record):
    """The record with a proof that looks four times as far as it need, in pieces: what it then leaves out may be less."""
    parsed, last = json.loads(record), {}
    windows = parsed["certificate"].get("windows", [])
    for window in windows:
        last[window["lattice"], window["atom"]] = window
    for window in last.values():
        if any(isinstance(window[end], str) for end in ("from", "to")):
            continue
        begin, end = window["from"], 4 * window["to"]
        cuts = [begin, *(begin + (end - begin) * part / 16 for part in (1, 2, 4, 8)), end]
        place = windows.index(window)
        windows[place : place + 1] = [{**window, "from": a, "to": b} for a, b in zip(cuts, cuts[1:])]
    return json.dumps(parsed, separators=(",", ":"))


class Encoder:
    """The inverse of decoder.cpp, where it has one."""

    def __init__(self, scene, query):
        self.bytes = bytearray()
        dimension, lattices = scene["dimension"], scene["lattices"]
        self.byte(dimension - 2 + 2 * (len(lattices) - 1))
        for lattice in lattices:
            self.lattice(lattice, dimension)
        self.numbers(query["x"])
        self.numbers(query["v"])
        start = query.get("from")
        self.byte(1 if start else 0)
        if start:
            for value in [start["lattice"], start["atom"], *start["cell"]]:
                self.byte(int(value) & 255)
        self.byte(1)  # another flight, back
        self.numbers([-component for component in query["v"]])

    def byte(self, value):
        self.bytes.append(value)

    def numbers(self, values):
        for value in values:
            number = float.fromhex(value) if isinstance(value, str) else float(value)
            self.byte(1 if number == 0 or 2.0**-200 < abs(number) < 2.0**200 else 0x41)
            self.bytes += struct.pack("<d", number)

    def lattice(self, lattice, dimension):
        atoms = lattice["atoms"]
        lone = len(atoms) == 1 and not any(atoms[0]["position"]) and "radius" in atoms[0]
        self.byte(1 + 2 * lone + 4 * (len(atoms) - 1) % 16)
        for vector in lattice["vectors"]:
            self.numbers(vector)
        for atom in atoms:
            if not lone:
                self.byte(0 if "radius" in atom else 3)
                self.numbers(atom["position"])
            if "radius" in atom:
                self.numbers([atom["radius"]])
            else:
                for axis in atom["semiaxes"]:
                    self.numbers(axis)


def main():
    sets = sorted((DATA / "golden").glob("*.ndjson"))
    good = [path for path in sets if path.stem != "bad-queries"]
    for path in sets:
        pairs = records(path, 3)
        write("queries", path.stem, "".join(f"{scene}\n{query_of(record)}\n" for scene, record in pairs[:2])
              if path in good else "\n".join([pairs[0][0], *(r for _, r in records(path, 12))]) + "\n")
        write("golden_sets", path.stem, HEADER + "".join(f"{scene}\n{record}\n" for scene, record in pairs[:2]))
    for path in good:
        for i, (scene, record) in enumerate(records(path, 2)):
            write("certificates", f"{path.stem}-{i}", f"{scene}\n{looking_farther(record) if i == 1 else record}\n")
        for i, (scene, record) in enumerate(records(path, 3)):
            write("first_hit", f"{path.stem}-{i}", bytes(Encoder(json.loads(scene)["scene"], json.loads(record)).bytes))
    write("certificates", "no-never", NO_NEVER)
    write("queries", "answers", "".join(answer_of(records(path, 1)[0][1]) + "\n" for path in good))
    write("queries", "bad-answers", BAD_ANSWERS)
    for name, text in BAD_LINES.items():
        write("queries", name, text.encode("latin-1") if name == "no-json" else text)
    for path in sorted((DATA / "scenes").glob("*.toml")):
        write("scenes", path.stem + ".toml", path.read_bytes())
    for name in ("diamond", "ellipses-mixed", "superposition-pi-5"):
        scene = tomllib.loads((DATA / "scenes" / f"{name}.toml").read_text())
        write("scenes", name + ".json", json.dumps(scene))
    for name, text in BAD_SCENES.items():
        write("scenes", name, text)
    for name, text in BAD_SETS.items():
        write("golden_sets", name, text)


main()
