"""The published algorithm's authors' own logs of disagreements, as query and answer streams.

While developing their programs the authors logged starts at which these disagreed (or agreed), and what each
program answered: tests-misc.dat, tests2d-example*.dat, tests3d*.dat in branch variant_efficient of the public
repository kriukov/efficient-lorentz. They are not part of this project. Given a folder with those files, this writes

    queries.ndjson, published.ndjson, classical.ndjson, published-bigfloat.ndjson, classical-bigfloat.ndjson

into the current folder, for

    lorentz compare --queries queries.ndjson --answers published=published.ndjson --answers classical=classical.ndjson ...

The printed numbers are taken as the exact inputs; a start that was logged twice is taken once.
"""
import argparse
import json
import pathlib
import re
import sys

FILES = ["tests-misc", "tests2d-example", "tests2d-example2", "tests2d-example_EvsC_ata", "tests2d-example_cap",
         "tests3d-example", "tests3d_EvsC_ata"]
PROGRAMS = {"E": "published", "C": "classical", "myE": "published-bigfloat", "MyE": "published-bigfloat",
            "myC": "classical-bigfloat", "MyC": "classical-bigfloat"}
START = re.compile(r"x = \[([^]]*)\]; v = \[([^]]*)\]; r = ([-+.0-9e]+)")
ANSWER = re.compile(r"\b(E|C|[mM]yE|[mM]yC) = \[?(?:BigInt)?\[([-0-9,\s]+)\]")


def numbers(text):
    return [float(part) for part in text.split(",")]


def scene(dimension, radius):
    vectors = [[int(i == k) for k in range(dimension)] for i in range(dimension)]
    return {"dimension": dimension, "lattices": [
        {"vectors": vectors, "atoms": [{"position": [0] * dimension, "radius": radius}]}]}


def main(folder):
    queries, answers, seen, current = [], {name: [] for name in PROGRAMS.values()}, set(), None
    for name in FILES:
        for number, line in enumerate((pathlib.Path(folder) / (name + ".dat")).read_text().splitlines(), 1):
            start = START.search(line)
            if not start or start.group(0) in seen:
                continue
            seen.add(start.group(0))
            x, v, radius = numbers(start.group(1)), numbers(start.group(2)), float(start.group(3))
            if current != (len(x), radius):
                current = (len(x), radius)
                queries.append({"scene": scene(*current)})
            queries.append({"id": f"{name}:{number}", "x": x, "v": v})
            for program, cell in ANSWER.findall(line[start.end():]):
                cell = [int(n) for n in cell.split(",")]
                answers[PROGRAMS[program]].append(
                    {"id": f"{name}:{number}", "outcome": "hit", "lattice": 0, "atom": 0,
                     "cell": [n if abs(n) <= 2**53 else str(n) for n in cell]})
    for name, lines in [("queries", queries), *answers.items()]:
        pathlib.Path(name + ".ndjson").write_text("".join(json.dumps(line) + "\n" for line in lines))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="with the authors' files: " + ", ".join(name + ".dat" for name in FILES))
    try:
        main(parser.parse_args().folder)
    except OSError as error:
        sys.exit(f"author-logs.py: {error.filename}: {error.strerror}")
