"""The tables of docs/bounds.md, "What is proved": made/constants.tsv, and what Gappa said (`make` first).

python3 oracle/proof/bounds/table.py [--check PAGE]
exit status: 0, 1 the page has others"""
import argparse, math, pathlib, re, sys

MADE = pathlib.Path(__file__).resolve().parent / "made"
HEADING = "## What is proved"

def number(text):
    return f"{float(text):.10g}"

def asked(name):
    """The least error that Gappa finds for inputs within 1, or relatively; nothing, if it has no script."""
    file = MADE / f"{name}.asked"
    if not file.exists(): return ""
    found = re.search(r"\|error\| in \[0, (?:[^{\]]*\{)?([0-9.e+]+)", file.read_text())
    return number(math.ceil(float(found[1]) * 1000) / 1000)

def bound_by(name):
    """What the script of it has to prove."""
    file = MADE / f"{name}.g"
    return number(re.search(r"<= ([0-9.e+]+) }", file.read_text())[1]) if file.exists() else ""

def row(line):
    constant, name, _, derived, proved, times, plus, needed, used, because = line.split("\t")
    gappa = f"{asked(name)} of {bound_by(name)}" if asked(name) else ""
    takes = f"{number(times)} ({because})" if because and times != "1" else because
    names = ", ".join(f"`{one}`" for one in constant.split(", "))
    return f"| {names} | {name.replace('_', ' ')} | {derived} | {number(proved)} | {takes} | {number(needed)} | {number(used)} | {gappa} |"

def tables():
    lines = (MADE / "constants.tsv").read_text().splitlines()
    out = []
    for unit in ("u", "u^2"):
        out += [f"| constant | claim, in {unit} | derived | proved | times | needed | used | Gappa |", "|---|---|--:|--:|---|--:|--:|--:|"]
        out += [row(line) for line in lines if line.split("\t")[2] == unit]
    return out

def ample():
    """The constants that are at least twice what they have to be, by all of their claims."""
    most = {}
    for line in (MADE / "constants.tsv").read_text().splitlines():
        constant, name, _, _, _, _, _, needed, used, *_ = line.split("\t")
        if "," not in constant: most[constant] = max(most.get(constant, 0), float(needed) / float(used))
    found = sorted((share, constant) for constant, share in most.items() if share <= 0.5)
    return ["| constant | times what is needed |", "|---|--:|"] + [f"| `{constant}` | {1 / share:.1f} |" for share, constant in found]

def on_page(page):
    section = pathlib.Path(page).read_text().partition(f"\n{HEADING}\n")[2].partition("\n## ")[0]
    return [line for table in section.split("\n\n") if table.startswith("| constant |") for line in table.split("\n") if line]

def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", metavar="PAGE")
    options = parser.parse_args()
    made = tables() + ample()
    if not options.check:
        print("\n".join(made))
        return 0
    there = on_page(options.check)
    if there == made: return 0
    print(f"{options.check}: its tables are not what is proved (`make -C oracle/proof/bounds table` prints those):", file=sys.stderr)
    for line in made:
        if line not in there: print(f"  missing: {line}", file=sys.stderr)
    for line in there:
        if line not in made: print(f"  not so:  {line}", file=sys.stderr)
    return 1

if __name__ == "__main__":
    sys.exit(main())
