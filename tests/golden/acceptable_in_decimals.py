"""What golden records list as acceptable, recomputed in decimals of 80 digits: every obstacle near the flight is tried.

acceptable_in_decimals.py LORENTZ COUNT [SEED]: for COUNT drawn flights in each precision. Shares nothing with lorentz.
"""
import json
import pathlib
import random
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "oracle"))
from verdicts_in_decimals import BITS, Flight, ulp  # noqa: E402

MOST = 16  # ulps


def records_of(lorentz, precision, flights):
    lines = []
    for number, flight in enumerate(flights):
        vectors = [[float(i == k) for k in range(len(flight.x))] for i in range(len(flight.x))]
        atom = {"position": [0.0] * len(flight.x), "radius": flight.r}
        lines += [{"scene": {"dimension": len(flight.x), "lattices": [{"vectors": vectors, "atoms": [atom]}]}},
                  {"id": number, "x": flight.x, "v": flight.v}]
    done = subprocess.run([lorentz, "golden", "make", "--queries", "-", "--precision", precision], capture_output=True,
                          text=True, input="\n".join(map(json.dumps, lines)), check=False)
    if done.returncode:
        sys.exit(done.stderr)
    return {record["source_id"]: record for record in map(json.loads, done.stdout.splitlines()) if "expect" in record}


def acceptable(flight):
    """The cells of all hits but the first that are excused, and by how many ulps."""
    others = [*flight.ahead[1:], *flight.missed]
    needed = {tuple(ball.cell): flight.verdict_on_obstacle(ball, None)[0] for ball in others}
    return {cell: ulps for cell, ulps in needed.items() if ulps <= MOST * 1.001}


def differs(record, flight, bits):
    right, expect = flight.ahead[0], record["expect"]
    if expect["outcome"] != "hit" or tuple(expect["cell"]) != tuple(right.cell):
        return f"expects {expect}, not {right.cell}"
    change = flight.change(right.derivatives())
    if abs(float(change) - record["time_change"]) > 1e-9 * record["time_change"]:
        return f"time_change {record['time_change']}, not {change}"
    if abs(float(change / ulp(float(right.t), bits)) - record["condition"]) > 1e-9 * record["condition"]:
        return f"condition {record['condition']} is another"
    listed = {}
    for other in record.get("acceptable", []):
        if other["outcome"] != "hit":
            return f"{other} is not expected"
        listed[tuple(other["cell"])] = other["ulps"]
    expected = acceptable(flight)
    for cell in {*listed, *expected}:
        if cell not in listed and expected[cell] > MOST * 0.999:
            continue
        if cell not in listed or cell not in expected or abs(listed[cell] - float(expected[cell])) > 1e-6 * listed[cell]:
            return f"{cell} by {listed.get(cell)} ulps, not {expected.get(cell)}"
    return None


def main():
    lorentz, count, rng = sys.argv[1], int(sys.argv[2]), random.Random(int(sys.argv[3]) if sys.argv[3:] else 1)
    lists = 0
    for precision, bits in BITS.items():
        flights = [Flight(rng, bits) for _ in range(count)]
        records = records_of(lorentz, precision, flights)
        if len(records) != count:
            sys.exit(f"{len(records)} records of {count} flights")
        for number, flight in enumerate(flights):
            if "needs-judge" in records[number]["tags"]:
                sys.exit(f"flight {number} needs a judge: {flight.x} along {flight.v}, r = {flight.r}")
            if why := differs(records[number], flight, bits):
                sys.exit(f"{precision}: {why}, from {flight.x} along {flight.v}, r = {flight.r}")
            lists += "acceptable" in records[number]
    print(f"{2 * count} records are the same, {lists} of them with other answers that are acceptable")
    return 0 if lists > count / 5 else 1


if __name__ == "__main__":
    sys.exit(main())
