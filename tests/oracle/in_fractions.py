"""First hits among single obstacles, rows and layers, in fractions, by trying every obstacle near the line.

in_fractions.py COUNT COMMAND ..: asks the command, such as `lorentz first-hit -`, drawn queries in scenes of every rank
below the dimension, half of them in other words, and compares outcome, obstacle and the rounding of the time; and of the
exit, if the answers have it (--detail). Shares nothing with lorentz.
"""

import itertools
import json
import math
import random
import subprocess
import sys
from fractions import Fraction

MANY = 20_000  # obstacles near a line; flights with more are left out, as are those along a layer


class TooMany(Exception):
    pass


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def inverse(columns):
    """The rows of the inverse matrix."""
    if len(columns) == 2:
        (a, c), (b, d) = columns
        det = a * d - b * c
        return [[d / det, -b / det], [-c / det, a / det]]
    rows = [cross(columns[(i + 1) % 3], columns[(i + 2) % 3]) for i in range(3)]
    det = dot(rows[0], columns[0])
    return [[x / det for x in row] for row in rows]


def root_above(x):  # by 2^-40 of it, in any unit
    if x == 0:
        return x
    scale = Fraction(2) ** (40 - (x.numerator.bit_length() - x.denominator.bit_length()) // 2)
    return (math.isqrt(math.ceil(x * scale * scale)) + 1) / scale


def solve(rows, right):
    """x with rows x = right, by Cramer's rule, for up to two unknowns."""
    if len(rows) == 1:
        return [right[0] / rows[0][0]]
    (a, b), (c, d) = rows
    det = a * d - b * c
    return [(d * right[0] - b * right[1]) / det, (a * right[1] - c * right[0]) / det]


def cells_near(w, v, vectors):
    """Cells whose unit ball, at w in the cell 0, can touch the line t v."""
    if not vectors:
        return [()]
    gram = [[dot(a, b) for b in vectors] for a in vectors]
    along = [solve(gram, [int(k == i) for k in range(len(vectors))]) for i in range(len(vectors))]
    dual = [[sum(c * u[k] for c, u in zip(row, vectors)) for k in range(len(v))] for row in along]

    def across(a):  # what is perpendicular to the vectors
        parts = [dot(a, d) for d in dual]
        return minus(a, [sum(p * u[k] for p, u in zip(parts, vectors)) for k in range(len(v))])

    w_across, v_across = across(w), across(v)
    speed2 = dot(v_across, v_across)
    if speed2 == 0:
        if dot(w_across, w_across) >= 1:
            return []
        if len(vectors) == 2:
            raise TooMany
        times = [Fraction(0), 4 / root_above(dot(v, v)) + 2 * root_above(gram[0][0] / dot(v, v))]
    else:
        middle, room = dot(w_across, v_across) / speed2, dot(w_across, w_across) - 1
        square = middle * middle - room / speed2
        if square <= 0:
            return []
        times = [middle - root_above(square), middle + root_above(square)]
    ranges = []
    for d in dual:
        ends = [t * dot(v, d) - dot(w, d) for t in times]
        reach = root_above(dot(d, d))
        ranges.append(range(math.floor(min(ends) - reach), math.ceil(max(ends) + reach) + 1))
    if math.prod(len(r) for r in ranges) > MANY:
        raise TooMany
    return itertools.product(*ranges)


def sign(x):
    return (x > 0) - (x < 0)


def compare(one, other):
    """The sign of (a - sqrt b) - (c - sqrt d)."""
    left, right = one[0] - other[0], sign(one[1] - other[1])  # left against sqrt b - sqrt d
    if sign(left) != right:
        return sign(sign(left) - right)
    rest, four = left * left - one[1] - other[1], 4 * one[1] * other[1]  # left^2 against b + d - 2 sqrt(b d)
    return right * (sign(rest) if rest >= 0 and four == 0 else 1 if rest >= 0 else sign(four - rest * rest))


def first_hit(scene, query):
    best = inside = None
    left = query.get("from")
    for l, lattice in enumerate(scene["lattices"]):
        for a, atom in enumerate(lattice["atoms"]):
            d = scene["dimension"]
            axes = atom.get("semiaxes") or [[atom["radius"] * (i == k) for k in range(d)] for i in range(d)]
            to_ball = inverse([[Fraction(c) for c in axis] for axis in axes])
            image = lambda p: [dot(row, [Fraction(c) for c in p]) for row in to_ball]
            place, v = minus(image(atom["position"]), image(query["x"])), image(query["v"])
            vectors = [image(u) for u in lattice["vectors"]]
            for n in cells_near(place, v, vectors):
                if left == {"lattice": l, "atom": a, "cell": list(n)}:
                    continue
                c = [place[k] + sum(i * u[k] for i, u in zip(n, vectors)) for k in range(d)]
                s, v2 = dot(v, c), dot(v, v)
                square = s * s - v2 * (dot(c, c) - 1)
                entry = (s / v2, square / v2 / v2)
                if dot(c, c) < 1:
                    inside = min(inside or ((l, a, n), entry), ((l, a, n), entry))
                elif s > 0 and square > 0:
                    order = compare(entry, best[0]) if best else -1
                    if order < 0 or order == 0 and (l, a, n) < best[1]:
                        best = entry, (l, a, n)
    if inside:
        return "inside", *inside
    return ("hit", best[1], best[0]) if best else ("never", None, None)


def is_rounded(entry, time):
    """Is this the binary64 nearest to a - sqrt b?"""
    a, b = entry
    above = (Fraction(time) + Fraction(math.nextafter(time, math.inf))) / 2
    below = (Fraction(time) + Fraction(math.nextafter(time, -math.inf))) / 2
    return (above >= a or (a - above) ** 2 <= b) and (time == 0 or below <= a and (a - below) ** 2 >= b)


def is_exit(entry, time):
    """Is this the binary64 nearest to a + sqrt b?"""
    a, b = entry
    above = (Fraction(time) + Fraction(math.nextafter(time, math.inf))) / 2
    below = (Fraction(time) + Fraction(math.nextafter(time, -math.inf))) / 2
    return above >= a and (above - a) ** 2 >= b and (below <= a or (below - a) ** 2 <= b)


def is_right(entry, time, errs):
    """In a fast engine's answer the obstacle counts, and that the time is roughly its."""
    if not errs:
        return is_rounded(entry, time)
    return abs(float(entry[0]) - float(entry[1]) ** 0.5 - time) <= 1e-6 * abs(float(entry[0]))


def number(rng, kind):
    return [rng.uniform(-2, 2), rng.randint(-8, 8) / 4, rng.choice([0, 1, -1, 0.5, 0.25, rng.uniform(-1, 1)])][kind]


def drawn(rng, make, good):
    while True:
        made = make()
        try:
            if good(made):
                return made
        except ZeroDivisionError:
            pass


def drawn_lattice(rng, d, kind):
    vector = lambda: [number(rng, kind) for _ in range(d)]
    def independent(vectors):
        squares = [dot(u, u) for u in vectors]
        return all(s > 0.01 for s in squares) and (len(vectors) < 2 or dot(*[cross(*vectors)] * 2) > 0.1)
    def axes_good(axes):
        return all(abs(x) < 20 for row in inverse(axes) for x in row)
    k, atoms = rng.randint(0, d - 1), []
    for _ in range(rng.choice([1, 1, 2])):
        atom = {"position": vector()}
        if rng.random() < 0.7:
            atom["radius"] = rng.choice([0.25, 0.5, rng.uniform(0.05, 0.8), 1.0])
        else:
            atom["semiaxes"] = drawn(rng, lambda: [[rng.uniform(-0.6, 0.6) for _ in range(d)] for _ in range(d)],
                                     axes_good)
        atoms.append(atom)
    return {"vectors": drawn(rng, lambda: [vector() for _ in range(k)], independent), "atoms": atoms}


def drawn_query(rng, scene):
    d, kind = scene["dimension"], rng.randrange(3)
    x = [number(rng, kind) * rng.choice([1, 2, 4]) for _ in range(d)]
    v = [number(rng, kind) for _ in range(d)]
    if rng.random() < 0.4:
        atom = rng.choice(rng.choice(scene["lattices"])["atoms"])
        v = [a + rng.gauss(0, 0.4) - b for a, b in zip(atom["position"], x)]
    query = {"x": x, "v": v if any(v) else [1.0] + [0.0] * (d - 1)}
    if rng.random() < 0.15:
        l = rng.randrange(len(scene["lattices"]))
        lattice = scene["lattices"][l]
        query["from"] = {"lattice": l, "atom": rng.randrange(len(lattice["atoms"])),
                         "cell": [rng.randint(-1, 1) for _ in lattice["vectors"]]}
    return query


class OtherWords:
    """The same questions in other units, with other axes, another origin and, in half of the scenes, another basis."""

    def __init__(self, rng, scene):
        self.unit, self.speed = 2.0 ** rng.randint(-200, 200), 2.0 ** rng.randint(-90, 90)
        d = scene["dimension"]
        self.axes, self.signs = rng.sample(range(d), d), [rng.choice([1, -1]) for _ in range(d)]
        self.mixed = [rng.random() < 0.5 and self.can_mix(lattice["vectors"]) for lattice in scene["lattices"]]
        self.scene = {"dimension": d, "lattices": [
            {"vectors": [self.there(u) for u in self.basis(lattice["vectors"], mixed)],
             "atoms": [self.atom(atom) for atom in lattice["atoms"]]}
            for lattice, mixed in zip(scene["lattices"], self.mixed)]}

    @staticmethod
    def can_mix(vectors):  # without rounding
        return len(vectors) == 2 and all(Fraction(a) - 3 * Fraction(b) == a - 3 * b for a, b in zip(*vectors))

    @staticmethod
    def basis(vectors, mixed):
        return [[-c for c in vectors[1]], [a - 3 * b for a, b in zip(*vectors)]] if mixed else vectors

    def there(self, a, unit=None):
        return [a[axis] * s * (unit or self.unit) for axis, s in zip(self.axes, self.signs)]

    def atom(self, atom):
        sizes = {"radius": atom["radius"] * self.unit} if "radius" in atom else {
            "semiaxes": [self.there(axis) for axis in atom["semiaxes"]]}
        return {"position": self.there(atom["position"]), **sizes}

    def cell(self, lattice, n):  # n_0 u_0 + n_1 u_1 = -(3 n_0 + n_1) (-u_1) + n_0 (u_0 - 3 u_1)
        return [-3 * n[0] - n[1], n[0]] if self.mixed[lattice] else list(n)

    def query(self, query):
        asked = {"x": self.there(query["x"]), "v": self.there(query["v"], self.speed)}
        if "from" in query:
            left = query["from"]
            asked["from"] = {**left, "cell": self.cell(left["lattice"], left["cell"])}
        return asked

    def answer(self, answer):
        """None where ties and overlaps depend on the numbers of cells."""
        outcome, obstacle, entry = answer
        if obstacle and self.mixed[obstacle[0]]:
            return None
        factor = Fraction(self.unit) / Fraction(self.speed)
        return outcome, obstacle, entry and (entry[0] * factor, entry[1] * factor * factor)


def questions(rng, count):
    """Scene lines and queries with their answers: twenty of each scene, and the same again in other words."""
    asked = left_out = 0
    while asked < count:
        d, kind = rng.choice([2, 3]), rng.randrange(3)
        scene = {"dimension": d, "lattices": [drawn_lattice(rng, d, kind) for _ in range(rng.choice([1, 1, 1, 2]))]}
        plain, other, words = [], [], OtherWords(rng, scene)
        for _ in range(20):
            query = drawn_query(rng, scene)
            try:
                answer, reworded = first_hit(scene, query), first_hit(words.scene, words.query(query))
            except TooMany:
                left_out += 1
                continue
            carried = words.answer(answer)
            if carried and carried != reworded:
                sys.exit(f"this program contradicts itself: {carried}, {reworded}\n{json.dumps({'scene': scene})}\n{query}")
            plain.append((answer, scene, query))
            other.append((reworded, words.scene, words.query(query)))
        asked += len(plain) + len(other)
        yield from ((scene, plain), (words.scene, other))
    print(f"{left_out} queries left out")


def main():
    count, command, rng = int(sys.argv[1]), sys.argv[2:], random.Random(1)
    errs = "reduction" in command
    lines, expected = [], []
    for scene, asked in questions(rng, count):
        lines.append(json.dumps({"scene": scene}))
        lines += [json.dumps({"id": len(expected) + i, **query}) for i, (_, _, query) in enumerate(asked)]
        expected += asked
    count = len(expected)
    done = subprocess.run(command, input="\n".join(lines) + "\n", capture_output=True, text=True, check=False)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    if len(answers) != count:
        sys.exit(f"{len(answers)} answers to {count} queries\n{done.stderr[-1000:]}")
    outcomes, undecided, unsupported, exits = {}, 0, 0, 0
    for answer, ((outcome, obstacle, entry), scene, query) in zip(answers, expected):
        outcomes[outcome] = outcomes.get(outcome, 0) + 1
        named = obstacle and (answer.get("lattice"), answer.get("atom"), tuple(answer.get("cell", [])))
        if answer["outcome"] == "undecided" or answer.get("reason") == "unsupported":
            undecided += answer["outcome"] == "undecided"
            unsupported += answer["outcome"] != "undecided"
            continue
        right = answer["outcome"] == outcome and named == obstacle
        if right and outcome == "hit":
            right = is_right(entry, answer["time"], errs)
        if right and entry and "--detail" in command:
            right, exits = is_exit(entry, answer["exit_time"]), exits + 1
        if not right:
            sys.exit(f"expected {outcome} {obstacle}, not {answer}\n{json.dumps({'scene': scene})}\n{json.dumps(query)}")
    if min(outcomes.get(name, 0) for name in ("hit", "never", "inside")) < count / 30:
        sys.exit(f"the queries are not what they should be: {outcomes}")
    if undecided > count / 20 or unsupported > count / 2:
        sys.exit(f"{undecided} of {count} are undecided, {unsupported} unsupported")
    print(f"{count} answers are right, {exits} exits: {outcomes}; {undecided} undecided, {unsupported} unsupported")


main()
