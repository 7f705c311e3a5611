#!/usr/bin/env python3
"""Makes docs/results.md, the results of this release, from the files that runs have left (./run results)."""
import argparse
import csv
import datetime
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/results.md"
GOLDEN = ROOT / "docs/results/golden.tsv"
FIGURES = tomllib.loads((ROOT / "docs/results/figures.toml").read_text(encoding="utf-8"))
ENGINES = ["classical", "published", "reduction", "certified", "oracle", "walk"]
FIRST = 96  # records of each golden set
COUNTS = ["wrong", "wrong_time", "ill_posed", "undecided", "unsupported", "error", "missing"]


def written(cell):
    """Integers in groups of three digits."""
    return f"{cell:,}".replace(",", " ") if isinstance(cell, int) and cell > 9999 else str(cell)


def table(columns, rows):
    lines = ["| " + " | ".join(map(written, line)) + " |\n" for line in (columns, *rows)]
    return lines[0] + "|---" * len(columns) + "|\n" + "".join(lines[1:])


def figures(name):
    one = FIGURES[name]
    return f"{one['made'][0].upper() + one['made'][1:]}.\n\n" + table(one["columns"], one["rows"])


def stored(path):
    """The comment at the top of a file of results, without who wrote it, and its rows as dicts."""
    lines = (ROOT / path).read_text(encoding="utf-8").splitlines()
    return lines[0].lstrip("# "), list(csv.DictReader(lines[1:], delimiter="\t"))


def ask_golden(lorentz):
    words = [lorentz, "golden", "check", "--engine", ",".join(ENGINES), "--first", str(FIRST), "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always"], capture_output=True, text=True, check=True).stdout.strip()
    processor = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))[1]
    lines = [f"# `lorentz {' '.join(words[1:-1])}`; commit {commit}; {datetime.date.today()}; {processor}, {os.cpu_count()} threads",
             "\t".join(["set", "engine", "records", *COUNTS])]
    for said in map(json.loads, done.stdout.splitlines()):  # a line for each engine
        for one in said["sets"]:
            lines.append("\t".join(map(str, [one["set"], said["engine"], one["records"], *(one[c] for c in COUNTS)])))
    GOLDEN.write_text("\n".join(lines) + "\n", encoding="utf-8")


def golden():
    made, rows = stored("docs/results/golden.tsv")
    sets = sorted({row["set"] for row in rows})
    of = {(row["set"], row["engine"]): row for row in rows}
    right = [e for e in ENGINES if all(of[s, e][c] == "0" for s in sets for c in COUNTS)]

    def named(engine, count):
        return ", ".join(f"{s} {of[s, engine][count]}" for s in sets if of[s, engine][count] != "0") or "none"

    def most(engine):
        counts = sorted(((int(of[s, engine]["undecided"]), s) for s in sets), reverse=True)
        return f"{sum(n for n, _ in counts)} of {FIRST * len(sets)}; most in " + ", ".join(f"{s} {n}" for n, s in counts[:4])

    rows = [[f"`{e}`", named(e, "wrong"), named(e, "wrong_time"), most(e)] for e in ENGINES if e not in right]
    return (f"{made}.\n\nThe first {FIRST} records of each set; a number is that of the records. "
            f"{' and '.join(f'`{e}`' for e in right)} give the exact answer to each.\n\n"
            + table(["engine", "wrong", "wrong times", "undecided"], rows))


def billion():
    made, rows = stored("tests/billion/results.tsv")
    return f"{made[0].upper() + made[1:]}.\n\n" + table(list(rows[0]), [[int(v) if v.isdigit() else v for v in row.values()] for row in rows])


def planted():
    made, rows = stored("fuzz/planted/results.tsv")
    found = [row for row in rows if row["cases"] and not row["found first by"].startswith("no")]
    seconds = [float(row["CPU seconds"]) for row in found]
    reasons = {}
    for row in rows:
        if row not in found:
            patch = (ROOT / "fuzz/planted" / f"{row['bug']}.patch").read_text(encoding="utf-8")
            why = re.search(r"^survives: (.*(?:\n(?!\w+:|diff |---|$).*)*)", patch, re.M)
            why = re.sub(r"\s+", " ", why[1]).removesuffix(".") if why else row["found first by"]
            reasons.setdefault(why, []).append(f"`{row['bug']}`")
    return (f"{made}.\n\nOf {len(rows)} planted bugs campaigns found {len(found)}, in {statistics.median(seconds):.0f} s of processor time "
            f"(the median; at most {max(seconds):.0f}). The others, with the reason that their patches give:\n\n"
            + "".join(f"- {', '.join(bugs)}: {why}.\n" for why, bugs in reasons.items()))


def mutants():
    made, rows = stored("tests/mutants/results.tsv")
    sums = {key: sum(int(row[key]) for row in rows) for key in ("mutants", "killed", "equivalent")}
    rate = 100 * sums["killed"] / (sums["mutants"] - sums["equivalent"])
    missed = [f"{row['folder']} {n}" for row in rows if (n := int(row["mutants"]) - int(row["killed"]) - int(row["equivalent"]))]
    return (f"{made}.\n\nOf {sums['mutants']} mutants the tests killed {sums['killed']}; {sums['equivalent']} change nothing that a user "
            f"could see. That is {rate:.0f} % of the others. Survivors: {', '.join(missed)}. Tests were written for this draw; another "
            "draw shows what tests see that know nothing of it:\n\n" + figures("mutants_of_another_seed"))


def ratios():
    lines = (ROOT / "tests/bench/ratios.tsv").read_text(encoding="utf-8").splitlines()[1:]
    groups, kinds = {}, ["2D, drawn", "3D, drawn", "2D, hard", "3D, hard"]
    for name, median, *_ in (line.split("\t") for line in lines):
        first, _, rest = name.partition(": ")
        space = re.match(r"cubic|fcc|triclinic|ellipsoid|motif of 4 in space|3D|a ball, 3D|(near-rational|grazing) 3D", rest)
        kind = f"{'3D' if space else '2D'}, {'hard' if re.match('near-rational|grazing', rest) else 'drawn'}"
        groups.setdefault(first, {}).setdefault(kind, []).append(float(median))

    def span(values):
        return " to ".join(f"{v:.3g}" for v in sorted({min(values), max(values)})) if values else ""

    rows = [[first, *(span(of.get(kind, [])) for kind in kinds)] for first, of in groups.items()]
    return ("Ratios of times by `build/speed_ratios --write`, medians over lattices and radii; commit not recorded; 2026-11; AMD EPYC "
            "(Zen 5, 2 cores). AVX3 is Highway's name for AVX-512; `single` is `reduction`, one flight at a time.\n\n"
            + table(["time / time", *kinds], rows))


def bench():
    with open(ROOT / "docs/results/bench.csv", encoding="utf-8") as file:
        cells = [c for c in csv.DictReader(file) if (c["radius"], c["difficulty"]) == ("0.001", "drawn") and c["engine"] != "published-float"]
    rows = [[c["scene"], f"`{c['engine']}`", c["ns_median"], c["wrong"], c["wrong_time"], c["ulp_99_percent"]] for c in cells if c["ns_median"]]
    return ("`lorentz bench --scene square,cubic`, r = 0.001, drawn flights, at most 2000 a cell; commit a030be1f; 2026-11-23; AMD EPYC, "
            "2 threads, AVX2.\n\n" + table(["scene", "engine", "ns, median", "wrong", "wrong times", "ulps that 99 % do not exceed"], rows)
            + "\n![error of the time against the time a query](results/speed_against_error.svg)\n"
            "\n![time against radius, with powers](results/time_against_radius.svg)\n")


def page():
    text = (ROOT / "docs/results/page.md.in").read_text(encoding="utf-8")
    own = {"golden": golden, "billion": billion, "planted": planted, "mutants": mutants, "ratios": ratios, "bench": bench}
    return re.sub(r"^@(\w+)@\n", lambda at: own[at[1]]() if at[1] in own else figures(at[1]), text, flags=re.M)


def main():
    parser = argparse.ArgumentParser(prog="./run results", description=__doc__.partition("\n")[0])
    parser.add_argument("--golden", metavar="LORENTZ", help="ask all engines the golden sets again first, some minutes (docs/results/golden.tsv)")
    parser.add_argument("--print", action="store_true", help="print the page, and write nothing")
    asked = parser.parse_args()
    if asked.golden:
        ask_golden(asked.golden)
    if asked.print:
        sys.stdout.write(page())
    else:
        PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
