#!/usr/bin/env python3
"""Makes answers to ../smoke.ndjson whose verdicts are known, to try a runner with (docs/golden.md).

make.py [FOLDER]: writes NAME.ndjson, and verdicts.tsv with a line for each record and a column for each NAME.
The tolerance is 4 ulps. The verdicts are those of docs/examples/golden/runner.py and of `lorentz compare`.
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[3] / "docs/examples/golden"))
import runner  # noqa: E402

OBSTACLE = ("lattice", "atom", "cell")


def right(number, record):
    return {key: record["expect"][key] for key in ("outcome", *OBSTACLE, "time") if key in record["expect"]}


def wrong(number, record):
    """Another obstacle, another outcome."""
    answer = right(number, record)
    if answer["outcome"] == "never":
        return {"outcome": "inside", "lattice": 0, "atom": 0, "cell": [0] * ranks[record["id"]]}
    if answer["cell"] and number % 2:
        return answer | {"cell": [1_000_000] * len(answer["cell"])}
    return {"outcome": "never"}


def timed(change):
    """Right answers whose finite times are changed."""
    def made(number, record):
        answer = right(number, record)
        if isinstance(answer.get("time"), (int, float)):
            answer["time"] = change(number, record, answer["time"])
        return answer
    return made


def ulps_off(number, record, time):
    return time + (3 if number % 2 else 6) * max(record["time_change"], math.ulp(time))


def acceptable(number, record):
    """The farthest of the acceptable answers."""
    others = record.get("acceptable")
    return {key: value for key, value in others[-1].items() if key != "ulps"} if others else right(number, record)


def odd(number, record):
    """What else a runner meets: it does not know, does not do this, fails, is silent, or says the same in other words."""
    answer = right(number, record)
    if "cell" in answer:
        answer["cell"] = [str(n) for n in answer["cell"]]
    untimed = {key: value for key, value in answer.items() if key != "time"}
    return (answer, {"outcome": "undecided"}, {"outcome": "later"}, {"outcome": "error", "message": "no", "reason": "unsupported"},
            {"outcome": "error", "message": "no"}, None, untimed, {"note": [number], **answer},
            untimed | ({"outcome": "inside"} if answer["outcome"] == "hit" else {}))[number % 9]


ANSWERS = {"right": right, "wrong": wrong, "15-digits": timed(lambda number, record, time: float(f"{time:.15g}")),
           "ulps": timed(ulps_off), "acceptable": acceptable, "odd": odd}


def main(folder=HERE):
    verdicts = {record["id"]: [] for record in records}
    for name, make in ANSWERS.items():
        with (pathlib.Path(folder) / f"{name}.ndjson").open("w", encoding="utf-8") as out:
            for number, record in enumerate(records):
                answer = make(number, record)
                verdicts[record["id"]].append(runner.verdict(record, answer, 4, False))
                if answer is not None:
                    print(json.dumps({"id": record["id"], **answer}, separators=(",", ":")), file=out)
    lines = ["\t".join(("id", *ANSWERS)), *("\t".join((one, *words)) for one, words in verdicts.items())]
    (pathlib.Path(folder) / "verdicts.tsv").write_text("\n".join(lines) + "\n", encoding="utf-8")


lines_of_set = [*map(json.loads, (HERE.parent / "smoke.ndjson").read_text(encoding="utf-8").splitlines())]
records, ranks, scene = [], {}, None
for one in lines_of_set:
    scene = one.get("scene", scene)
    if "expect" in one:
        records.append(one)
        ranks[one["id"]] = len(scene["lattices"][0]["vectors"])

if __name__ == "__main__":
    main(*sys.argv[1:])
