#!/usr/bin/env python3
"""Judges answers with a golden set alone (docs/golden.md).

runner.py SET ANSWERS [ULPS]: a line for each record, its id and a verdict; the counts on stderr.
ULPS is above 0 and at most 16. Status 1: an answer is wrong, missing, or an error; 2: a file is unfit.
"""
import collections
import json
import math
import sys

LARGEST = 3.4028235677973366e38  # from here on a binary32 is infinite


def integer(n):
    """The integer in a number, or in a decimal string (beyond 2^53); None for anything else."""
    try:
        return int(n) if isinstance(n, str) or n == int(n) else None
    except (TypeError, ValueError, OverflowError):
        return None


def same(answer, other):
    pairs = [(answer.get(key), other.get(key)) for key in ("lattice", "atom") if key in other]
    cells = [one.get("cell") or [] for one in (answer, other)]
    pairs += zip(*cells)
    return (answer.get("outcome") == other["outcome"] and len(cells[0]) == len(cells[1])
            and all(integer(n) is not None and integer(n) == integer(m) for n, m in pairs))


def ulp(t, binary32):
    if not binary32:
        return math.ulp(t)
    return 2.0 ** max(math.frexp(t)[1] - 24, -149) if t else 2.0 ** -149


def is_wrong_time(record, answer, ulps, binary32):
    t = record["expect"].get("time")
    if t is None or "time" not in answer:
        return False
    if t == "inf" or (answer["time"] == "inf" and binary32 and t > LARGEST):
        return answer["time"] != "inf"
    given = answer["time"] if isinstance(answer["time"], (int, float)) else math.inf
    return not abs(given - t) <= ulps * max(record.get("time_change", 0), ulp(t, binary32))


def verdict(record, answer, ulps, binary32):
    expect = record["expect"]
    if answer is None:
        return "missing"
    outcome = answer.get("outcome")
    if outcome in ("undecided", "later"):
        return "undecided"
    if outcome == "error" != expect["outcome"]:
        return "unsupported" if answer.get("reason") == "unsupported" else "error"
    if same(answer, expect):
        return "wrong-time" if is_wrong_time(record, answer, ulps, binary32) else "agree"
    if any(same(answer, other) and other["ulps"] <= ulps for other in record.get("acceptable", [])):
        return "ill-posed"
    return "needs-judge" if "needs-judge" in record["tags"] else "wrong"


def refuse(why):
    print(why, file=sys.stderr)
    sys.exit(2)


def lines(path):
    number = 0
    try:
        for number, line in enumerate(open(path), 1):
            if line.strip():
                if not isinstance(one := json.loads(line), dict):
                    raise ValueError("not an object")
                yield one
    except (OSError, ValueError) as why:
        refuse(f"{path}:{number}: {why}")


def tolerance(word):
    try:
        return float(word)
    except ValueError:
        return 0


def main(set_file, answer_file, ulps):
    answers, counts = {}, collections.Counter()
    for answer in lines(answer_file):
        if isinstance(answer.get("id"), str) and answers.setdefault(answer["id"], answer) is not answer:
            refuse(f"{answer_file}: the id {answer['id']} comes twice")
    first, *others = [*lines(set_file)] or [{}]
    header, records = first.get("golden"), [line for line in others if "expect" in line]
    if not isinstance(header, dict) or header.get("count") != len(records):
        refuse(f"{set_file}: needs a first line with `golden`, and as many records as its `count`")
    for record in records:
        found = verdict(record, answers.get(record["id"]), ulps, header.get("precision") == "binary32")
        counts[found] += 1
        print(record["id"], found)
    print(dict(counts), file=sys.stderr)
    return 1 if counts["wrong"] or counts["missing"] or counts["error"] else 0


if __name__ == "__main__":
    words = [*sys.argv[1:], "4"][:3]
    if len(words) < 3 or not 0 < tolerance(words[2]) <= 16:
        refuse("usage: runner.py SET ANSWERS [ULPS]; ULPS is above 0 and at most 16")
    sys.exit(main(*words[:2], tolerance(words[2])))
