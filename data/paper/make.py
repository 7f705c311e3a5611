#!/usr/bin/env python3
"""The experiments of Kraemer, Kryukov and Sanders (2016) again: the files of this folder, and the tables of docs/paper.md."""
import argparse
import csv
import io
import itertools
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from pictures import pictures
from reading import ENGINES, HERE, LATTICES, SCENES, SEEDS
from tables import PAGE, PATHS, PATHS_TABLES, page

PARSER = argparse.ArgumentParser(description=f"{__doc__} Without an option all is made, in a quarter of an hour.")
PARSER.add_argument("build", type=Path, help="the folder of the program")
PARSER.add_argument("--long", action="store_true", help="fly the many flights of docs/free_paths.md (an hour and a half)")
PARSER.add_argument("--check", action="store_true", help="make what is the same on every machine once more (a minute), and say what "
                    "differs: counts, shares, exponents, p-values, pictures, tables. Status 1 if something does. Times are not measured again")
ASKED = PARSER.parse_args()
BUILD = ASKED.build


def printed(*words, given=None):
    return subprocess.run([str(word) for word in words], input=given, capture_output=True, text=True, check=True).stdout


def table_of(rows):
    """The rows as CSV."""
    out = io.StringIO()
    writer = csv.DictWriter(out, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue()


# ---- Data: file names, and what is in them.

def flights():
    for scene in SCENES:
        yield from flown(scene, scene, "1e8")


def many_flights():
    for number, scene in LATTICES.items():
        yield from flown(f"lattices-{number}", scene, "1e10")


def flown(name, scene, count):
    with tempfile.TemporaryDirectory() as folder:
        bins = Path(folder) / "bins.csv"
        report = json.loads(printed(BUILD / "lorentz", "flights", "--scene", scene, "--radius", "1e-4", "--count", count, "--jobs",
                                    2, "--json", "--csv", bins))
        table = bins.read_text()
    report.pop("seconds")
    report["scene"] = name
    yield f"{name}.json", json.dumps(report, separators=(",", ":")) + "\n"
    yield f"{name}.csv", table


def false_collisions():
    yield "false-collisions.csv", printed(BUILD / "false_collisions", 50000)


def first_discs():
    """The first disc in 90 000 directions from (0, 0.445), r = 0.1: one row for neighbouring directions with the same disc."""
    asked = ["x1,x2,v1,v2"]
    for i in range(90_000):
        angle = math.radians((i + 0.5) / 1000)
        asked.append(f"0,0.445,{math.cos(angle)!r},{math.sin(angle)!r}")
    told = csv.DictReader(io.StringIO(printed(BUILD / "lorentz", "first-hit", "--scene", "square", "--radius", "0.1", "--engine",
                                              "certified-batch", "--format", "csv", given="\n".join(asked) + "\n")))
    cells = [(row["cell1"], row["cell2"]) if row["outcome"] == "hit" else ("", "") for row in told]
    rows, begin = [], 0
    for (one, two), run in itertools.groupby(cells):
        end = begin + len(list(run))
        distance = math.dist((int(one), int(two)), (0, 0.445)) if one else math.inf
        rows.append({"from_degrees": f"{begin / 1000:g}", "to_degrees": f"{end / 1000:g}", "cell1": one, "cell2": two,
                     "distance": f"{distance:.6g}", "share": f"{(end - begin) / len(cells):.6f}"})
        begin = end
    yield "first-discs.csv", table_of(rows)


def sections():
    """What a line meets first of all cubic lattice points: the section of their three cylinders, seen along it."""
    yield "sections.csv", printed(BUILD / "false_collisions", "sections", 200000)


def flights_of(scene, radius):
    """How many are timed for each seed: as many as take some seconds."""
    if scene == "square" or radius >= 0.02:
        return 20_000
    return 10_000 if radius >= 0.01 else 4_000


def times():
    """Mean and median times of the same flights, one engine after the other, for each of five seeds."""
    for dimension, scene in ((2, "square"), (3, "cubic")):
        rows = []
        for radius in (0.4, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001):
            engines = ENGINES if scene == "square" or radius >= 0.005 else ENGINES[1:]
            for seed in SEEDS:
                rows += timed(scene, radius, engines, seed)
        yield f"times-{dimension}d.csv", table_of(rows)


def timed(scene, radius, engines, seed):
    asked = printed(BUILD / "lorentz", "sample", "--scene", scene, "--radius", radius, "--count", flights_of(scene, radius),
                    "--seed", seed)
    told = printed(BUILD / "lorentz", "first-hit", "--engine", "certified-batch", given=asked).splitlines()
    path = statistics.mean(float(json.loads(line)["time"]) for line in told)
    found = json.loads(printed(BUILD / "lorentz", "compare", "--queries", "-", "--engine", ",".join(engines), "--no-oracle",
                               "--json", given=asked))
    return [{"scene": scene, "radius": radius, "engine": engine["engine"], "seed": seed, "flights": engine["queries"],
             "ns_mean": f"{engine['ns_per_query']:.4g}", "ns_median": f"{engine['ns_median']:.4g}", "path_mean": f"{path:.6g}"}
            for engine in found["engines"]]


SAME_EVERYWHERE = (flights, false_collisions, first_discs, sections, pictures)


def pages():
    return (PAGE, page()), (PATHS, page(PATHS_TABLES, PATHS))


def check():
    differ = []
    for make in SAME_EVERYWHERE:
        for name, there in make():
            if (HERE / name).read_text() != there:
                differ.append(f"data/paper/{name}")
    differ += [f"docs/{file.name}" for file, told in pages() if file.read_text() != told]
    print("\n".join(f"{name}: is not what comes out now" for name in differ) or "the same counts, tables and pictures")
    return 1 if differ else 0


def main():
    if "LORENTZ_OPTIONS_ONLY" in os.environ:
        return 0
    if ASKED.check:
        return check()
    makers = (flights, false_collisions, first_discs, sections, times)
    for make in (*((many_flights,) if ASKED.long else makers), pictures):
        for name, there in make():
            (HERE / name).write_text(there)
            print(f"data/paper/{name}", flush=True)
    for file, told in pages():
        file.write_text(told)
    return 0


sys.exit(main())
