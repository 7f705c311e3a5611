"""The runners of docs/examples/golden judge as `lorentz compare` does: every record without `needs-judge`, of ten engines that
are wrong in different ways.

runners_test.py LORENTZ WORK [--all]: the runners that can be made here are made in the folder WORK; --all: all sets.
"""
import collections
import contextlib
import json
import math
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES, SETS = ROOT / "docs/examples/golden", ROOT / "data/golden"
FEW = ["smoke/smoke", "ball-2d-binary32", "boundary-starts-binary32", "rows-and-layers"]
ENGINES = ["classical", "published", "published-float", "reduction"]
UNANSWERED = ("undecided", "unsupported", "error", "missing")
KEYS = ("outcome", "lattice", "atom", "cell")


def answer_of(expect):
    return {key: expect[key] for key in (*KEYS, "time") if key in expect}


def acceptable(which):
    def made(record):
        others = record.get("acceptable")
        return {key: value for key, value in others[which].items() if key != "ulps"} if others else answer_of(record["expect"])
    return made


def never(record):
    return {"outcome": "never"}


def late(record):
    answer, change = answer_of(record["expect"]), record.get("time_change", 0)
    if isinstance(answer.get("time"), (int, float)):
        time = answer["time"] + change * (3.5 if int(record["id"], 16) % 2 else 4.5)
        answer["time"] = "inf" if math.isinf(time) else time
    return answer


def neighbour(record):
    answer = answer_of(record["expect"])
    if answer.get("cell"):
        first = int(answer["cell"][0]) + 1
        answer["cell"] = [first if abs(first) < 2**53 else str(first), *answer["cell"][1:]]
    return answer


def inside(record):
    answer = answer_of(record["expect"])
    if answer["outcome"] == "hit":
        answer["outcome"] = "inside"
        answer.pop("time", None)
    elif answer["outcome"] == "inside":
        answer |= {"outcome": "hit", "time": 0}
    return answer


FAULTS = {"first acceptable": acceptable(0), "last acceptable": acceptable(-1), "never": never, "late": late,
          "neighbour": neighbour, "inside": inside}


def runners(work):
    """Commands, by language; of those whose language is here."""
    found = {"Python": [sys.executable, str(EXAMPLES / "runner.py")]}
    if shutil.which("node"):
        found["JavaScript"] = ["node", str(EXAMPLES / "runner.js")]
    for name, compiler, source, options in (("C", "cc", "runner.c", ["-std=c11", "-lcjson", "-lm"]),
                                            ("C++", "c++", "runner.cpp", ["-std=c++17"])):
        program = work / f"runner-of-{source}"
        made = subprocess.run([compiler, "-O1", str(EXAMPLES / source), "-o", str(program), *options],
                              capture_output=True, text=True, check=False)
        if made.returncode == 0:
            found[name] = [str(program)]
        elif "No such file" not in made.stderr:  # of a library's header: then it is not here
            sys.exit(made.stderr)
    if rust := rust_runner(work):
        found["Rust"] = [rust]
    return found


def rust_runner(work):
    """Built with Debian's crates; None if they are not here."""
    crates = pathlib.Path("/usr/share/cargo/registry")
    if not shutil.which("cargo") or not list(crates.glob("serde_json-*")):
        return None
    folder = work / "rust"
    (folder / "src").mkdir(parents=True, exist_ok=True)
    shutil.copy(EXAMPLES / "runner.rs", folder / "src/main.rs")
    (folder / "Cargo.toml").write_text('[package]\nname = "runner"\nversion = "0.1.0"\nedition = "2021"\n'
                                       '[dependencies]\nserde_json = { version = "1", features = ["float_roundtrip"] }\n')
    made = subprocess.run(["cargo", "build", "--release", "--offline", "--config", 'source.crates-io.replace-with="debian"',
                           "--config", f'source.debian.directory="{crates}"'], cwd=folder, capture_output=True, text=True, check=False)
    if made.returncode:
        sys.exit(made.stderr)
    return str(folder / "target/release/runner")


def compared(lorentz, path, answers, precision, work):
    """What `compare` says of each record that departs, and how many are not answered in some way."""
    found = work / "disagreements"
    done = subprocess.run([lorentz, "compare", "--queries", path, "--answers", f"engine={answers}", "--precision", precision,
                           "--disagreements", found, "--times", "--json"], capture_output=True, text=True, check=False)
    if not done.stdout:
        sys.exit(done.stderr)
    lines = map(json.loads, found.read_text().splitlines())
    counts = json.loads(done.stdout)["engines"][0]
    return {line["id"]: line["verdict"] for line in lines if "id" in line}, {word: counts[word] for word in UNANSWERED}


def answers_of(lorentz, engine, path, records, work):
    answers = work / "answers"
    with answers.open("w") as out:
        if engine in ENGINES:
            with contextlib.suppress(subprocess.TimeoutExpired):  # along near-rational slopes `published` takes hours
                subprocess.run([lorentz, "first-hit", "--engine", engine, path], stdout=out, stderr=subprocess.DEVNULL,
                               check=False, timeout=30)
        else:
            for record in records:
                print(json.dumps({"id": record["id"], **FAULTS[engine](record)}), file=out)
    text = answers.read_text()
    answers.write_text(text[:text.rfind("\n") + 1])  # a line may be cut off; what is missing is missing for all
    return answers


def text_cells(answer):
    """The same answer, whose integers are all decimal strings."""
    return answer | {"cell": [str(n) for n in answer["cell"]]} if "cell" in answer else answer


def with_cells(answer, change):
    """The same answer with other numbers for the integers of its cell that are numbers."""
    return answer | {"cell": [change(n) if isinstance(n, int) else n for n in answer["cell"]]} if "cell" in answer else answer


def require_statuses(programs, work):
    """Status 0 if all answers are right, 1 if all are missing or have no outcome; a time that is not a number is wrong."""
    path, answers = SETS / "smoke/smoke.ndjson", work / "answers"
    records = [record for record in map(json.loads, path.read_text().splitlines()) if "expect" in record]
    right = [{"id": record["id"], **answer_of(record["expect"])} for record in records]
    untimed = [{**answer, "time": None} if "time" in answer else answer for answer in right]
    empty = [{"id": answer["id"]} for answer in right]
    halves, nulls, floats = ([with_cells(answer, change) for answer in right]
                             for change in (lambda n: n + 0.5 if n >= 0 else n - 0.5, lambda n: None, float))
    for told, status, word, least in ((halves, 1, "wrong", 40), (nulls, 1, "wrong", 40), (floats, 0, "agree", len(records)),
                                      (right, 0, "agree", len(records)), ([], 1, "missing", len(records)),
                                      (untimed, 0, "wrong-time", 50), (empty, 1, "wrong", 50)):
        answers.write_text("".join(json.dumps(answer) + "\n" for answer in told))
        for language, command in programs.items():
            done = subprocess.run([*command, path, answers], capture_output=True, text=True, check=False)
            count = sum(line.split()[1] == word for line in done.stdout.splitlines())
            if done.returncode != status or count < least:
                sys.exit(f"{language}: status {done.returncode}, {count} {word}: {done.stderr}")
    blank, cut = work / "blank", work / "cut"
    blank.write_text("\n" + "".join(json.dumps(text_cells(answer)) + "\n \n" for answer in right))
    cut.write_text(json.dumps(right[0]) + '\n{"id":"')
    gone = work / "not-there"
    for language, command in programs.items():
        for words, status in (([path, gone], 2), ([gone, blank], 2), ([path, cut], 2), ([cut, blank], 2), ([path, blank, "17"], 2),
                              ([path, blank, "0"], 2), ([path, blank, "x"], 2), ([path], 2), ([path, blank, "16"], 0)):
            done = subprocess.run([*command, *words], capture_output=True, text=True, check=False)
            if done.returncode != status or (cut in words and f"{cut}:2" not in done.stderr):
                sys.exit(f"{language}, {words}: status {done.returncode}, {done.stderr}")


def require_known_verdicts(lorentz, programs, work):
    """The answers in data/golden/smoke/answers are what make makes, and have the verdicts that stand beside them."""
    folder, path = SETS / "smoke/answers", SETS / "smoke/smoke.ndjson"
    made = work / "made"
    made.mkdir(exist_ok=True)
    subprocess.run([sys.executable, folder / "make", made], check=True)
    for file in made.iterdir():
        if file.read_bytes() != (folder / file.name).read_bytes():
            sys.exit(f"{folder / file.name} is not what make makes")
    names, *rows = [line.split("\t") for line in (folder / "verdicts.tsv").read_text().splitlines()]
    for column, name in enumerate(names[1:], 1):
        known = {row[0]: row[column] for row in rows}
        answers = folder / f"{name}.ndjson"
        departing, unanswered = compared(lorentz, path, answers, "binary64", work)
        if departing != {key: word for key, word in known.items() if word in ("wrong", "ill-posed", "wrong-time")}:
            sys.exit(f"{answers}: compare says {departing}")
        if unanswered != {word: [*known.values()].count(word) for word in UNANSWERED}:
            sys.exit(f"{answers}: compare says {unanswered}")
        for language, command in programs.items():
            done = subprocess.run([*command, path, answers], capture_output=True, text=True, check=False)
            if dict(line.split() for line in done.stdout.splitlines()) != known:
                sys.exit(f"{language}, {answers}: {done.stdout}")
    words = collections.Counter(word for row in rows for word in row[1:])
    if len(rows) != 100 or len(names) != 7 or len(words) != 8 or min(words.values()) < 10:
        sys.exit(f"the known verdicts are {words}")


def main():
    lorentz, work = sys.argv[1], pathlib.Path(sys.argv[2])
    work.mkdir(parents=True, exist_ok=True)
    programs = runners(work)
    require_statuses(programs, work)
    require_known_verdicts(lorentz, programs, work)
    every = sorted(str(path.relative_to(SETS))[:-7] for path in SETS.glob("**/*.ndjson") if not {"itineraries", "answers"} & {*path.parts})
    judged = needing = 0
    seen = {}
    for name in [name for name in every if name != "bad-queries"] if "--all" in sys.argv else FEW:
        path = SETS / f"{name}.ndjson"
        lines = [json.loads(line) for line in path.read_text().splitlines()]
        precision = lines[0]["golden"].get("precision", "binary64")
        records = {line["id"]: line for line in lines if "expect" in line}
        for engine in [*ENGINES, *FAULTS]:
            answers = answers_of(lorentz, engine, path, records.values(), work)
            said, unanswered = compared(lorentz, path, answers, precision, work)
            for language, command in programs.items():
                done = subprocess.run([*command, path, answers], capture_output=True, text=True, check=False)
                verdicts = dict(line.split() for line in done.stdout.splitlines())
                if verdicts.keys() != records.keys():
                    sys.exit(f"{language}: {len(verdicts)} verdicts on {len(records)} records of {name}: {done.stderr}")
                counts = {word: sum(verdict == word for verdict in verdicts.values()) for word in UNANSWERED}
                if counts != unanswered:
                    sys.exit(f"{language}, {engine}, {name}: {counts}, and `compare` says {unanswered}")
                for key, verdict in verdicts.items():
                    if verdict in UNANSWERED:
                        continue
                    if "needs-judge" in records[key]["tags"]:
                        needing += 1
                        continue
                    judged += 1
                    expected = said.get(key, "agree")
                    seen[expected] = seen.get(expected, 0) + 1
                    if verdict != expected:
                        sys.exit(f"{language}, {engine}, {name} {key}: {verdict}, and `compare` says {expected}")
    print(f"{', '.join(programs)}: {judged} verdicts are those of `compare`: {seen}; {needing} need a judge")
    return 0 if all(seen.get(one, 0) > 20 for one in ("agree", "ill-posed", "wrong", "wrong-time")) else 1


if __name__ == "__main__":
    sys.exit(main())
