"""Verdicts on answers in binary32, and with tolerances of times, recomputed in decimals of 80 digits.

verdicts_in_decimals.py LORENTZ COUNT [SEED]: draws flights among discs and balls on the unit lattice, answers that are
right, off in time, or name another obstacle, and compares what `lorentz compare` says of each with the definition.
Shares nothing with lorentz.
"""

import itertools
import json
import math
import random
import struct
import subprocess
import sys
import tempfile
from decimal import Decimal, getcontext
from pathlib import Path

getcontext().prec = 80
ULPS = 4
BITS = {"binary32": 24, "binary64": 53}


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def ulp(x, bits):
    smallest = -126 if bits == 24 else -1022
    return Decimal(2) ** (max(math.frexp(abs(x))[1] - 1, smallest) + 1 - bits)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Ball:
    """A ball of the unit lattice, as a flight meets it."""

    def __init__(self, cell, x, v, r):
        self.cell, self.r = cell, r
        self.c = [Decimal(n) - a for n, a in zip(cell, x)]  # seen from x
        self.v2, self.s = dot(v, v), dot(v, self.c)
        self.nearest = self.s / self.v2
        self.foot = [self.nearest * a - c for a, c in zip(v, self.c)]  # from the centre
        self.distance = dot(self.foot, self.foot).sqrt()
        self.met = self.distance < r
        if self.met:
            half = ((r * r - self.distance**2) / self.v2).sqrt()
            self.t, self.left = self.nearest - half, self.nearest + half
            self.normal = [(self.t * a - c) / r for a, c in zip(v, self.c)]
            self.slope = dot(self.normal, v)

    def derivatives(self):
        """The derivatives of the time by x, v and r."""
        by_x = [-n / self.slope for n in self.normal]
        return [*by_x, *(self.t * d for d in by_x), 1 / self.slope]


class Flight:
    def __init__(self, rng, bits):
        d = rng.choice([2, 3])
        number = single if bits == 24 else float
        while True:
            self.r = number(rng.choice([rng.uniform(0.2, 0.5), rng.uniform(0.5, 0.6)]))  # half of them overlap
            self.x = [number(rng.uniform(0, 1)) for _ in range(d)]
            self.v = [number(rng.gauss(0, 1)) for _ in range(d)]
            if rng.random() < 0.4:  # the line passes an obstacle's edge by some ulps
                self.aim(rng, bits, number)
            x, v, r = [Decimal(a) for a in self.x], [Decimal(a) for a in self.v], Decimal(self.r)
            balls = [Ball(cell, x, v, r) for cell in self.cells()]
            if any(dot(b.c, b.c) < r * r for b in balls):
                continue
            self.ahead = sorted((b for b in balls if b.met and b.s > 0), key=lambda b: b.t)
            passed = [b for b in balls if not b.met and b.s > 0 and b.distance < r * Decimal("1.001")]
            if len(self.ahead) < 3 or self.ahead[1].t > 6 / dot(v, v).sqrt():
                continue
            self.missed = passed
            self.passed = [b for b in passed if b.nearest < self.ahead[0].t]
            self.ulps = [*(max(ulp(a, bits), ulp(1, bits)) for a in self.x),
                         *(ulp(a, bits) for a in self.v), ulp(self.r, bits)]
            return

    def aim(self, rng, bits, number):
        cell = [rng.randint(-2, 2) for _ in self.x]
        to = [n - a for n, a in zip(cell, self.x)]
        side, length = [-to[1], to[0], 0], math.hypot(*to)
        sine = self.r * (1 + rng.choice([-1, 1]) * 2.0 ** rng.uniform(-bits, 5 - bits)) / length
        if sine < 1 and any(side):
            turn = length * sine / math.hypot(*side)
            self.v = [number(a * math.sqrt(1 - sine * sine) + turn * b) for a, b in zip(to, side)]

    def cells(self):
        speed = math.hypot(*self.v)
        seen = set()
        for k in range(65):
            place = [a + k / 8 * b / speed for a, b in zip(self.x, self.v)]
            base = [round(a) for a in place]
            seen.update(itertools.product(*([n - 1, n, n + 1] for n in base)))
        return seen

    def change(self, derivatives):
        return sum(abs(d) * u for d, u in zip(derivatives, self.ulps))

    def margin_of_meeting(self, ball):
        n = [a / ball.distance for a in ball.foot]
        change = self.change([*n, *(ball.nearest * a for a in n), 1])
        return abs(ball.distance - ball.r) / change

    def excused(self, earlier, time, tolerance):
        return (tolerance is not None and not tolerance.is_infinite() and
                time - earlier.t <= tolerance * earlier.t and time <= earlier.left)

    def verdict_on_obstacle(self, ball, tolerance):
        needed = self.margin_of_meeting(ball) if not ball.met else Decimal(0)
        time = ball.t if ball.met else ball.nearest
        for earlier in self.ahead:
            if earlier is ball or earlier.t > time or self.excused(earlier, time, tolerance):
                continue
            change = self.change([a - b for a, b in zip(ball.derivatives(), earlier.derivatives())]
                                 if ball.met else earlier.derivatives())
            spare = min(self.margin_of_meeting(earlier), (time - earlier.t) / change)
            needed = max(needed, spare)
        return needed, "ill-posed" if needed <= ULPS else "wrong"

    def verdict_on_time(self, time, bits, tolerance):
        right, off = self.ahead[0], abs(Decimal(time) - self.ahead[0].t)
        if tolerance is not None:
            return "agree" if tolerance.is_infinite() or off <= tolerance * right.t else "wrong-time"
        of_time = ulp(float(right.t), bits)
        return "agree" if off <= ULPS * max(self.change(right.derivatives()), of_time) else "wrong-time"


def answers_to(rng, flight, bits, tolerance):
    """(cell, time, verdict; "forgiven" is ill-posed by the tolerance alone) of answers whose verdicts are not within a thousandth of changing."""
    right = flight.ahead[0]
    allowed = (tolerance * right.t if tolerance is not None and not tolerance.is_infinite() else
               ULPS * max(flight.change(right.derivatives()), ulp(float(right.t), bits)))
    for factor in (0, 0.98, 1.02, 3, -0.98, -1.02, 2.0**40):
        time = float(right.t + Decimal(factor) * allowed)
        if factor == 0:
            time = single(time) if bits == 24 else time
        if abs(abs(Decimal(time) - right.t) - allowed) > ulp(float(right.t), 53):  # lorentz knows t rounded
            yield right.cell, time, flight.verdict_on_time(time, bits, tolerance)
    for ball in [*flight.ahead[1:3], *flight.passed[:2]]:
        needed, verdict = flight.verdict_on_obstacle(ball, tolerance)
        if not ULPS * Decimal("0.999") < needed < ULPS * Decimal("1.001"):
            forgiven = verdict != flight.verdict_on_obstacle(ball, None)[1]
            yield ball.cell, float(ball.t if ball.met else ball.nearest), "forgiven" if forgiven else verdict


def compare(lorentz, folder, precision, tolerance, asked):
    """What lorentz says of each answer that does not agree."""
    queries, answers = folder / "queries", folder / "answers"
    with queries.open("w") as q, answers.open("w") as a:
        for number, (flight, cell, time, _) in enumerate(asked):
            vectors = [[float(i == k) for k in range(len(flight.x))] for i in range(len(flight.x))]
            atom = {"position": [0.0] * len(flight.x), "radius": flight.r}
            print(json.dumps({"scene": {"dimension": len(flight.x), "lattices": [{"vectors": vectors, "atoms": [atom]}]}}),
                  json.dumps({"id": number, "x": flight.x, "v": flight.v}), sep="\n", file=q)
            print(json.dumps({"id": number, "outcome": "hit", "lattice": 0, "atom": 0, "cell": cell, "time": time}), file=a)
    found = folder / "found"
    done = subprocess.run([lorentz, "compare", "--queries", queries, "--answers", f"engine={answers}", "--times",
                           "--precision", precision, *(["--time-tolerance", str(tolerance).replace("Infinity", "inf")] if tolerance else []),
                           "--disagreements", found, "--json"], capture_output=True, text=True, check=False)
    if not done.stdout:
        sys.exit(done.stderr)
    counts = json.loads(done.stdout)
    if counts["not_asked"] or counts["engines"][0]["queries"] != len(asked):
        sys.exit(f"not all were asked: {done.stdout}{done.stderr}")
    lines = [json.loads(line) for line in found.read_text().splitlines()]
    return {line["id"]: line["verdict"] for line in lines if "id" in line}


def main():
    lorentz, count, rng = sys.argv[1], int(sys.argv[2]), random.Random(int(sys.argv[3]) if sys.argv[3:] else 1)
    seen = {}
    with tempfile.TemporaryDirectory() as name:
        for precision, tolerance in itertools.product(BITS, [None, Decimal("0.0001"), Decimal(4), Decimal("inf")]):
            bits, asked = BITS[precision], []
            for _ in range(count):
                flight = Flight(rng, bits)
                asked += [(flight, *answer) for answer in answers_to(rng, flight, bits, tolerance)]
            said = compare(lorentz, Path(name), precision, tolerance, asked)
            for number, (flight, cell, time, verdict) in enumerate(asked):
                if said.get(number, "agree") != verdict.replace("forgiven", "ill-posed"):
                    sys.exit(f"{precision}, {tolerance}: {verdict} expected, not {said.get(number, 'agree')}, of {cell} at "
                             f"{time!r} from {flight.x} along {flight.v}, r = {flight.r}")
                seen[precision, verdict] = seen.get((precision, verdict), 0) + 1
    for precision, verdict in itertools.product(BITS, ["agree", "wrong-time", "ill-posed", "wrong", "forgiven"]):
        if seen.get((precision, verdict), 0) < (1 if verdict == "forgiven" else count / 10):
            sys.exit(f"the answers are not what they should be: {seen}")
    print(f"{sum(seen.values())} verdicts are the same: {seen}")


if __name__ == "__main__":
    main()
