#!/usr/bin/env python3
"""The league: engines of other people, asked the same questions and judged by what they claim (docs/league/README.md).

    league.py [NAME ..] [--fresh]    judges each engine of league.json, or those that are named
    league.py --write                puts what came of it into docs/league: table, chart, what goes wrong with each library
    league.py --baseline FILE        holds it against an earlier league.json: status 1 if an engine is worse anywhere

What came of an engine is kept in build/league/NAME.json: a run that was stopped goes on where it stood, and --fresh
asks again. `./run league` installs and builds what the engines need first.
"""
import argparse
import collections
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent.parent
LIST = HERE / "league.json"
KEPT = ROOT / "build/league"
PAGES = ROOT / "docs/league"
QUESTIONS = 1500  # per row of `lorentz judge`, unless league.json sets fewer for a slow engine
FAR = ("golden long-flight", "golden tiny-radius")
MOST = 4  # kinds of faults of an engine that are shown
COUNTS = ("queries", "agree", "wrong", "ill_posed", "undecided", "unsupported", "error", "missing", "wrong_time",
          "other_quantity")


# ---- Asking

def command_of(entry):
    return f"cmd:cd docs/examples/engines && exec {entry['command']}"


def judge_line(entry):
    return ["build/lorentz", "judge", "--engine", command_of(entry), "--questions",
            str(entry.get("questions", QUESTIONS)), "--timeout", "20"]


def introduction_of(entry):
    """The engine's claims, which it prints if its input is empty: name, version, precision, .."""
    said = subprocess.run(["sh", "-c", f"cd docs/examples/engines && exec {entry['command']}"], cwd=ROOT, text=True,
                          stdin=subprocess.DEVNULL, capture_output=True, check=True)
    return json.loads(said.stdout)["engine"]


def judged(entry):
    run = subprocess.run([*judge_line(entry), "--json"], cwd=ROOT, capture_output=True, text=True)
    if run.returncode not in (0, 1, 3) or not run.stdout.startswith("{"):  # 3: it died, or was given up in a scene
        sys.exit(f"{entry['name']}: `lorentz judge` ended with {run.returncode}: {run.stderr[-500:]}")
    return json.loads(run.stdout)


def one_row(row):
    return {key: row[key] for key in ("name", *COUNTS, "max_radii")}


def one_finding(finding):
    keys = ("cause", "title", "group", "explanation", "verdict", "count", "last_words", "share_of_plain", "share_of_hard", "where",
            "primitive", "commands", "drawing", "scene", "query", "given", "exact")
    return {key: finding.get(key) for key in keys}


def ask(entry):
    report = judged(entry)
    kept = {**introduction_of(entry), "questions": entry.get("questions", QUESTIONS),
            "seed": report["manifest"]["seed"], "machine": report["manifest"]["machine"],
            "engine_ns": report["engine_ns"], "rows": [one_row(row) for row in report["difficulties"]],
            "findings": [one_finding(finding) for finding in report["findings"]]}
    kept["name"] = entry["name"]
    KEPT.mkdir(parents=True, exist_ok=True)
    (KEPT / f"{entry['name']}.json").write_text(json.dumps(kept), encoding="utf-8")


def kept_of(entry):
    path = KEPT / f"{entry['name']}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


# ---- Counting

def kind_of(name):
    if name.startswith(("drawn ", "plain")) or name == "free paths":
        return "drawn"
    return "far" if name.removesuffix("-binary32") in FAR else "hard"


def sums(result, kind):
    total = dict.fromkeys(COUNTS, 0)
    for row in result["rows"]:
        if kind_of(row["name"]) == kind:
            for key in COUNTS:
                total[key] += row[key]
    total["answered"] = total["agree"] + total["wrong"] + total["ill_posed"]  # that name an outcome
    return total


def interval(count, number):
    """The Wilson interval at 95 %."""
    z, p = 1.96, count / number
    middle, half = p + z * z / (2 * number), z * math.sqrt(p * (1 - p) / number + z * z / (4 * number * number))
    return [max(0.0, (middle - half) / (1 + z * z / number)), (middle + half) / (1 + z * z / number)]


def two_digits(value):
    return f"{float(f'{value:.2g}'):,.0f}".replace(",", " ")


def in_percent(share):
    return f"{100 * share:.2g}" if share < 0.995 else "100"


def percent(total, key="wrong"):
    if total["answered"] == 0:
        return "–"
    count, number = total[key], total["answered"]
    low, high = interval(count, number)
    few = f", of {number} / {total['queries']}" if number < 0.5 * total["queries"] else ""
    if count == 0:
        return f"0 (< {in_percent(high)}){few}"
    return f"{in_percent(count / number)} ({in_percent(low)} to {in_percent(high)}){few}"


def largest_radii(result):
    radii = [row["max_radii"] for row in result["rows"] if row["max_radii"] is not None]
    return max(radii, default=None)


def simplest(result):
    """The finding to describe: the engine's first own fault; wrong obstacles come before wrong times."""
    faults = [f for f in result["findings"] if f["verdict"] in ("wrong", "error")]
    times = [f for f in result["findings"] if f["verdict"] == "wrong-time"]
    return (faults or times or [None])[0]


# ---- Writing

def library_of(entry):
    return re.search(r"(\w+)/engine", entry["command"])[1]


def mode_of(entry):
    return f"{entry['precision']}, {'cells' if entry['coordinates'] == 'cells' else 'world'}"


def anchor_of(title):
    """As GitHub makes it of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def table_row(entry, result, titles):
    radii, ns = largest_radii(result), result["engine_ns"]
    cells = [f"[{entry['title']}](libraries.md#{anchor_of(titles[library_of(entry)])}) {result['version']}", mode_of(entry),
             percent(sums(result, "drawn")), percent(sums(result, "hard")), percent(sums(result, "far")),
             "–" if radii is None else f"{radii:.1g}", "–" if ns is None else two_digits(ns)]
    return "| " + " | ".join(cells) + " |\n"


def table(results):
    titles = {}
    for entry, _ in results:
        titles.setdefault(library_of(entry), entry["title"])
    head = "| library | numbers, coordinates | drawn: % wrong | hard: % wrong | far: % wrong | largest error, radii | ns a query |\n"
    return head + "|---" * 7 + "|\n" + "".join(table_row(entry, result, titles) for entry, result in results)


WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 820, 470, 70, 20, 40, 60
X, Y = (2, 7), (-4, 0)  # powers of ten: ns a query, share of hard questions


def place(ns, share):
    def on(value, low, high):
        return (min(max(math.log10(value), low), high) - low) / (high - low)
    return (LEFT + on(ns, *X) * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - on(share, *Y) * (HEIGHT - TOP - BOTTOM))


def text_at(x, y, text, anchor="middle", extra=""):
    text = text.replace("&", "&amp;").replace("<", "&lt;")
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {extra}>{text}</text>'


def axes():
    out = []
    for power in range(X[0], X[1] + 1):
        x, _ = place(10.0 ** power, 1)
        out += [f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>',
                text_at(x, HEIGHT - BOTTOM + 18, ("100 ns", "1 µs", "10 µs", "100 µs", "1 ms", "10 ms")[power - X[0]])]
    for power in range(Y[0], Y[1] + 1):
        _, y = place(10.0, 10.0 ** power)
        label = "none" if power == Y[0] else f"{100 * 10.0 ** power:g} %"
        out += [f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>', text_at(LEFT - 8, y + 4, label, "end")]
    return [*out, text_at((LEFT + WIDTH) / 2, HEIGHT - 14, "time of the library's own calls, a query"),
            text_at(LEFT, TOP - 16, "hard questions answered wrongly", "start")]


def box_of(name, x, y, side):
    """The box of a label to the right, to the left, above or below its point."""
    width, height = 6.4 * len(name), 12
    left = {"right": x + 7, "left": x - 7 - width}.get(side, x - width / 2)
    top = {"above": y - 7 - height, "below": y + 7}.get(side, y - height / 2)
    return left, top, left + width, top + height


def overlap(one, other):
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]


def labels(points):
    """Places each name beside its point if there is room, else further away."""
    taken, out = [(x - 4, y - 4, x + 4, y + 4) for x, y, _, _ in points], []
    for x, y, name, colour in sorted(points):
        boxes = [box_of(name, x, y + down, side) for down in (0, 14, -14, 28, -28, 42)
                 for side in ("right", "left", "above", "below")]
        free = [box for box in boxes if LEFT < box[0] and box[2] < WIDTH and not any(overlap(box, t) for t in taken)]
        box = (free or boxes)[0]
        taken.append(box)
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>', text_at(box[0], box[3] - 2, name, "start")]
    return out


def chart(results):
    points = []
    for entry, result in results:
        total = sums(result, "hard")
        if result["engine_ns"] and total["answered"]:
            x, y = place(result["engine_ns"], max(total["wrong"] / total["answered"], 10.0 ** Y[0]))
            points.append((x, y, entry["name"], "#0b62a4" if entry["precision"] == "binary64" else "#c4570a"))
    key = [text_at(WIDTH - RIGHT, TOP - 16, "blue: binary64, orange: binary32", "end")]
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
                      'font-family="sans-serif" font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>',
                      *axes(), *key, *labels(points), "</svg>"]) + "\n"


def alone(library):
    """What the program prints that shows the fault: the library alone, one ray, one ball."""
    for program, command in ((HERE / library / "alone.mjs", ["node", "alone.mjs"]),
                             (HERE / library / "alone.cpp", ["./alone"])):
        if program.exists():
            printed = subprocess.run(command, cwd=program.parent, capture_output=True, text=True, check=True).stdout
            return (f"[{program.name}](../examples/engines/{library}/{program.name}), the library alone, "
                    f"prints\n\n```\n{printed}```\n\n")
    return ""


def wrapped(text, indent=""):
    return textwrap.fill(text, 110, break_long_words=False, break_on_hyphens=False, subsequent_indent=indent)


def in_json(value):
    return json.dumps(value, separators=(",", ":"))


def section(library, members):
    """What goes wrong with a library, by each of its engines, and the simplest case."""
    first, _ = members[0]
    text = f"## {first['title']}\n\n<{first['link']}>, {first['license']}; [how it is called](../examples/engines/{library}).\n\n"
    for entry, result in members:
        kinds = collections.Counter()
        for finding in result["findings"]:
            kinds[finding["title"]] += finding["count"] if finding["verdict"] != "ill-posed" else 0
        faults = [f"{title} {count}" for title, count in (+kinds).most_common(MOST)]
        faults += [f"{len(+kinds) - MOST} kinds more"] if len(+kinds) > MOST else []
        text += wrapped(f"- `{entry['name']}`: {', '.join(faults) if faults else 'nothing'}", "  ") + "\n"
    text += "\n"
    for entry, result in members:
        finding = simplest(result)
        if finding and finding["drawing"]:
            (PAGES / f"{library}.svg").write_text(finding["drawing"] + "\n", encoding="utf-8")
            text += (f"The simplest of `{entry['name']}` ({finding['title']}):\n\n![The flight, and what is named]({library}.svg)\n\n"
                     f"```\n{in_json({'scene': finding['scene']})}\n{in_json(finding['query'])}\n"
                     f"says  {in_json(finding['given'])}\nexact {in_json(finding['exact'])}\n```\n\n")
            break
    known = json.loads(LIST.read_text(encoding="utf-8"))["known"].get(library)
    return text + alone(library) + (wrapped(f"*Is it known?* {known}") if known else "").strip() + "\n\n"


HEAD = """# What goes wrong with each library

For those who use or write one of these libraries. Each section has the most frequent kinds of fault with their numbers, by
engine of [the league](README.md), and the simplest one. To ask the same again, with the `command` and the number of `questions`
(1500 if it has none) of [league.json](../examples/engines/league.json):

```
build/lorentz judge --engine 'cmd:cd docs/examples/engines && exec COMMAND' --questions 1500 --timeout 20
```

"""


def libraries(results):
    members = {}
    for entry, result in results:
        members.setdefault(library_of(entry), []).append((entry, result))
    return HEAD + "".join(section(library, those) for library, those in members.items()).rstrip("\n") + "\n"


BEGIN, END = "<!-- league: begin -->\n", "<!-- league: end -->\n"


def write(results):
    PAGES.mkdir(parents=True, exist_ok=True)
    readme = PAGES / "README.md"
    text = readme.read_text(encoding="utf-8")
    head, rest = text.split(BEGIN)
    machine = results[0][1]["machine"]
    about = f"\nOn {machine}; seed {results[0][1]['seed']}.\n"
    readme.write_text(head + BEGIN + table(results) + about + END + rest.split(END)[1], encoding="utf-8")
    (PAGES / "chart.svg").write_text(chart(results), encoding="utf-8")
    (PAGES / "libraries.md").write_text(libraries(results), encoding="utf-8")
    lines = [json.dumps({key: value for key, value in result.items() if key != "findings"}
                        | {"causes": {f["cause"] + "/" + f["verdict"]: f["count"] for f in result["findings"]}})
             for _, result in results]
    (PAGES / "league.json").write_text("[\n" + ",\n".join(lines) + "\n]\n", encoding="utf-8")


# ---- An earlier run

def worse(result, before):
    """Rows with more wrong answers to the same number of questions, and new causes."""
    rows = {row["name"]: row for row in before["rows"]}
    for row in result["rows"]:
        old = rows.get(row["name"])
        if old and old["queries"] == row["queries"] and row["wrong"] + row["missing"] > old["wrong"] + old["missing"]:
            yield f"{row['name']}: {row['wrong'] + row['missing']} wrong or missing, {old['wrong'] + old['missing']} before"
    for finding in result["findings"]:
        if finding["verdict"] == "wrong" and finding["cause"] + "/wrong" not in before["causes"]:
            yield f"new: {finding['explanation']}"


def against(path, results):
    before = {one["name"]: one for one in json.loads(pathlib.Path(path).read_text(encoding="utf-8"))}
    found = [f"{entry['name']}: {text}" for entry, result in results if entry["name"] in before
             for text in worse(result, before[entry["name"]])]
    print("\n".join(found) if found else "no engine is worse than before")
    return 1 if found else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="engines of league.json (default: all)")
    parser.add_argument("--fresh", action="store_true", help="ask again, whatever is kept")
    parser.add_argument("--write", action="store_true", help="write docs/league from what is kept")
    parser.add_argument("--baseline", metavar="FILE", help="an earlier docs/league/league.json")
    given = parser.parse_args()
    entries = json.loads(LIST.read_text(encoding="utf-8"))["engines"]
    unknown = set(given.names) - {entry["name"] for entry in entries}
    if unknown:
        parser.error(f"no engine of the league is called {', '.join(sorted(unknown))}; there are "
                     + ", ".join(entry["name"] for entry in entries))
    if "LORENTZ_OPTIONS_ONLY" in os.environ:
        return 0
    chosen = [entry for entry in entries if not given.names or entry["name"] in given.names]
    if not given.write and not given.baseline:
        for entry in chosen:
            if given.fresh or not kept_of(entry):
                print(entry["name"], flush=True)
                ask(entry)
    results = [(entry, kept_of(entry)) for entry in chosen if kept_of(entry)]
    if given.baseline:
        return against(given.baseline, results)
    if given.write:
        write(results)
    else:
        print(table(results), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
