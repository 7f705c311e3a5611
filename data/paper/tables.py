"""The tables of docs/paper.md."""
import json
import math
import statistics

from reading import ENGINES, HERE, LATTICES, SCENES, crossings, exponents, interval, means, per_cell, rows_of
from sections import mean_section

PAGE = HERE.parents[1] / "docs" / "paper.md"
PATHS = HERE.parents[1] / "docs" / "free_paths.md"


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]) + "\n"


def p_value(p):
    return "below 10^-300" if p < 1e-300 else f"{p:.2g}"


def densities_table():
    rows = []
    for number, scene in enumerate(SCENES, 1):
        its = json.loads((HERE / f"{scene}.json").read_text())
        low, high = its["tail_interval"]
        theory = its["theory"][0]
        rows.append((number, f"t^-{its['tail_exponent']:.3f}", f"{low:.3f} to {high:.3f}", f"{its['tail_count']:,}".replace(",", " "),
                     number + 1, p_value(theory["p_value"]), p_value(theory["p_value_of_1.02"])))
    return markdown(("lattices", "density falls like", "95 % interval", "from the longest", "theory", "p-value of the whole law",
                     "p-value of 1.02 times its survival"), rows)


def collisions_table():
    rows = []
    for row in rows_of("false-collisions.csv"):
        flights = int(row["flights"])
        rows.append((row["radius"], f"{int(row['predicted']):,}".replace(",", " "), f"{int(row['false']) / int(row['predicted']):.3f}",
                     f"{int(row['false_in_flights']) / flights:.4f}", row["most_in_a_flight"],
                     f"{int(row['lines_that_miss']) / flights:.4f}", f"{int(row['passed_over']) / flights:.4f}"))
    return markdown(("r", "predicted", "share missed", "share of flights with a missed one", "most in one flight",
                     "share of their lines that miss the first", "share of flights in which it is passed over"), rows)


def sections_table():
    rows = []
    for row in rows_of("sections.csv"):
        share = int(row["missed"]) / int(row["lines"])
        rows.append((row["start"], row["radius"], f"{share:.4f} +- {math.sqrt(share * (1 - share) / int(row['lines'])):.4f}"))
    rows.append(("a section, by areas", "any", f"1 - 1/{mean_section():.4f} = {1 - 1 / mean_section():.4f}"))
    return markdown(("line from", "r", "share that misses the first sphere whose cylinders it meets"), rows)


def exponents_table():
    paper = {("classical", 2): "-1.01", ("published", 2): "-0.20", ("classical", 3): "-2.25", ("published", 3): "-1.20"}
    rows = []
    for engine in ENGINES:
        cells = [engine if engine == "oracle" else f"`{engine}`"]
        for dimension in (2, 3):
            cells += ["{:.2f} +- {:.2f}".format(*interval(exponents(dimension, engine))), paper.get((engine, dimension), "")]
        rows.append(cells)
    lines = markdown(("", "2D", "paper", "3D", "paper"), rows)
    for dimension in (2, 3):
        found, _ = means(dimension)
        middle, half = interval(list(crossings(dimension)))
        gains = [statistics.median(c / p for c, p in zip(found["classical", r], found["published", r])) for r in (0.1, 0.01)]
        lines += (f"\nIn {dimension}D `published` is faster than `classical` below r = {middle:.2f} +- {half:.2f}; {gains[0]:.1f} times at "
                  f"r = 0.1, {gains[1]:.1f} times at 0.01.\n")
    return lines


def cells_table():
    rows = []
    for dimension in (2, 3):
        for engine in ENGINES[:3]:
            per = dict(per_cell(dimension, engine))
            rows.append((f"{dimension}D, `{engine}`", *(f"{per[r]:.3g}" if r in per else "" for r in (0.1, 0.01, 0.001))))
    return markdown(("", "r = 0.1", "0.01", "0.001"), rows)


def lattices_table():
    """Free paths among one to four lattices: what very many flights say, and the limit law."""
    rows = []
    for number in LATTICES:
        its = json.loads((HERE / f"lattices-{number}.json").read_text())
        low, high = its["tail_interval"]
        theory, tail = its["theory"][0], its["tails"][0]
        t, left = [(t, left) for t, left in its["survival"] if left >= 1000][-1]
        ratio = left / its["count"] * t**number / tail["constant"]
        rows.append((number, f"{its['count']:.0e}".replace("e+", " 10^").replace("^0", "^"), its["undecided"],
                     f"{its['tail_exponent']:.4f} ({low:.4f} to {high:.4f})", f"{theory['tail_exponent']:.4f}", number + 1,
                     f"{ratio:.3f} +- {ratio / math.sqrt(left):.3f}, {t:.0f}", p_value(theory["p_value"])))
    return markdown(("lattices", "flights", "undecided", "density falls like t to the minus .. (95 %)", "the limit law there", "in the end",
                     "P(path > t) t^N / C, at t", "p-value of the limit law"), rows)


TABLES = {"densities": densities_table, "collisions": collisions_table, "sections": sections_table, "exponents": exponents_table,
          "cells": cells_table}


PATHS_TABLES = {"lattices": lattices_table}


def page(tables=TABLES, of=PAGE):
    told = of.read_text()
    for name, make in tables.items():
        mark = f"<!-- {name} -->\n"
        before, _, after = told.split(mark)
        told = before + mark + make() + mark + after
    return told
