"""Flies golden itineraries (data/golden/itineraries) again, in intervals of Python's integers; shares nothing with the
program. Of each record: every obstacle is entered, none is entered before it, and every digit of times, places and
velocities is right. `bits` only says with how much precision to begin.

Usage: check_itineraries.py [--quick] FILE...      --quick: of each scene the first record, unless it is long
Exit: 0 verified, 1 refuted (or not certain with the most bits), 2 bad input.
"""
import hashlib
import itertools
import json
import math
import re
import sys
from fractions import Fraction

COARSE = 224  # bits after the point that show of most obstacles that they are not entered
MOST_BITS = 1 << 15
MOST_COLUMNS = 10**7  # of cells along one flight
MOST_QUICK = 300  # collisions of a record that --quick flies
HEADER = {"format", "name", "description", "generator", "version", "digits", "count"}


class Refuted(Exception):
    """The record is wrong."""


class Undecided(Exception):
    """The intervals are too wide to know."""


# ---- INTERVALS. (mid +- rad) / 2^bits, in integers; what is rounded off is added to rad.
class Interval:
    __slots__ = ("mid", "rad", "bits")

    def __init__(self, mid, rad, bits):
        self.mid, self.rad, self.bits = mid, rad, bits

    def __add__(self, other):
        return Interval(self.mid + other.mid, self.rad + other.rad, self.bits)

    def __sub__(self, other):
        return Interval(self.mid - other.mid, self.rad + other.rad, self.bits)

    def __neg__(self):
        return Interval(-self.mid, self.rad, self.bits)

    def __mul__(self, other):
        return dot((self,), (other,))

    def low(self):
        return self.mid - self.rad

    def high(self):
        return self.mid + self.rad

    def sign(self):
        if self.low() > 0:
            return 1
        if self.high() < 0:
            return -1
        raise Undecided

    def with_bits(self, bits):
        """What contains it, in fewer bits."""
        shift = self.bits - bits
        return Interval(self.mid >> shift, (self.rad >> shift) + 2, bits)


def interval(number, bits):
    n, d = number.numerator << bits, number.denominator
    return Interval(n // d, 1 if n % d else 0, bits)


def dot(a, b):
    bits = a[0].bits
    mid = sum(x.mid * y.mid for x, y in zip(a, b))
    rad = sum(abs(x.mid) * y.rad + x.rad * (abs(y.mid) + y.rad) for x, y in zip(a, b))
    return Interval(mid >> bits, (rad >> bits) + 2, bits)


def square_root(x):
    """|sqrt(m +- r) - sqrt m| <= r / sqrt m."""
    if x.sign() < 0:
        raise Refuted("the square root of a negative number")
    root = math.isqrt(x.mid << x.bits)
    return Interval(root, (x.rad << x.bits) // root + 2, x.bits)


def reciprocal(x):
    """|1/(m +- r) - 1/m| <= r / (|m| (|m| - r))."""
    x.sign()  # Undecided, if zero may be in it
    size = abs(x.mid)
    return Interval((1 << 2 * x.bits) // x.mid, (x.rad << 2 * x.bits) // (size * (size - x.rad)) + 2, x.bits)


def linear(a, rows):
    """sum a_i rows_i."""
    return [dot(a, column) for column in zip(*rows)]


def through(rows, a):
    return [dot(row, a) for row in rows]


def cross(a, b):
    """v x w: in the plane one number."""
    if len(a) == 2:
        return [dot((a[0], -a[1]), (b[1], b[0]))]
    return [dot((a[i], -a[j]), (b[j], b[i])) for i, j in ((1, 2), (2, 0), (0, 1))]


def cross_again(v, h):
    """v x h where h = v x w."""
    return [v[1] * h[0], -(v[0] * h[0])] if len(v) == 2 else cross(v, h)


# ---- NUMBERS of starts: rational ones, square roots, the golden section, degrees.
def rational(value):
    if type(value) is str and not re.fullmatch(r"-?[0-9]+(/[0-9]+|(\.[0-9]+)?(e[+-]?[0-9]{1,4})?)", value):
        raise ValueError(f"no rational number: {value!r:.40}")
    if type(value) not in (str, int, float):
        raise ValueError(f"no number: {value!r:.40}")
    if type(value) is int:
        value = float(value)  # numbers without quotes are binary64
    return Fraction(value)


def surd(value, bits):
    if value == "golden":
        half = interval(Fraction(1, 2), bits)
        return half + half * surd("sqrt(5)", bits)
    root = re.fullmatch(r"(-?)sqrt\((.*)\)", value) if type(value) is str else None
    if not root:
        return interval(rational(value), bits)
    result = square_root(interval(rational(root[2]), bits))
    return -result if root[1] else result


def arc_tangent_of_inverse(n, bits):
    """1/n - 1/(3 n^3) + .. in units of 2^-bits, each term off by less than 1."""
    power, total, k = (1 << bits) // n, 0, 0
    while power:
        total += (-1) ** k * (power // (2 * k + 1))
        power, k = power // n**2, k + 1
    return Interval(total, 2 * k + 2, bits)


def cosine_and_sine(degrees, bits):
    """By pi = 16 arctan(1/5) - 4 arctan(1/239) and the power series; the angle is below 2 pi < 7."""
    work = bits + 64
    a, b = arc_tangent_of_inverse(5, work), arc_tangent_of_inverse(239, work)
    pi = Interval(16 * a.mid - 4 * b.mid, 16 * a.rad + 4 * b.rad, work)
    angle = pi * interval(degrees % 360 / 180, work)
    sums, term, k = [interval(Fraction(0), work)] * 2, interval(Fraction(1), work), 0
    while k < 16 or abs(term.mid) > term.rad:
        sums[k % 2] = sums[k % 2] + (-term if k & 2 else term)
        k += 1
        term = term * angle
        term = Interval(term.mid // k, term.rad // k + 2, work)
    tail = 2 * (abs(term.mid) + term.rad)  # from here on each term is less than half of the one before
    return [Interval(s.mid, s.rad + tail, work).with_bits(bits) for s in sums]


# ---- SCENES.
def inverse(rows):
    """The dual vectors: rows_i . dual_k is 1 if i = k, else 0."""
    n = len(rows)
    table = [list(row) + [Fraction(i == k) for k in range(n)] for i, row in enumerate(rows)]
    for i in range(n):
        pivot = next((k for k in range(i, n) if table[k][i]), None)
        if pivot is None:
            raise ValueError("vectors are dependent")
        table[i], table[pivot] = table[pivot], table[i]
        table[i] = [c / table[i][i] for c in table[i]]
        for k in range(n):
            if k != i:
                table[k] = [c - table[k][i] * d for c, d in zip(table[k], table[i])]
    return [[table[i][n + k] for i in range(n)] for k in range(n)]


def vector(value, size, read=rational):
    if type(value) is not list or len(value) != size:
        raise ValueError(f"no array of {size} items: {value!r:.40}")
    return [read(item) for item in value]


def matrix(value, size):
    return vector(value, size, lambda row: vector(row, size))


class Atom:
    """All obstacles c + sum u_i A_i, |u| < 1, with c = position + sum n_i b_i."""

    def __init__(self, atom, vectors, size):
        self.vectors = matrix(vectors, size)
        self.position = vector(atom["position"], size)
        self.is_ball = "radius" in atom
        if self.is_ball == ("semiaxes" in atom):
            raise ValueError("an atom has radius or semiaxes")
        if self.is_ball:
            radius = rational(atom["radius"])
            if radius <= 0:
                raise ValueError("a radius is not above zero")
            self.semiaxes = [[radius * (i == k) for k in range(size)] for i in range(size)]
        else:
            self.semiaxes = matrix(atom["semiaxes"], size)
        self.shape = inverse(self.semiaxes)  # u_k = y . shape_k
        self.dual = inverse(self.vectors)  # n_k = y . dual_k

    def centre(self, cell):
        return [p + sum(n * b[i] for n, b in zip(cell, self.vectors)) for i, p in enumerate(self.position)]


class Scene:
    def __init__(self, scene):
        self.size = scene["dimension"]
        if self.size not in (2, 3):
            raise ValueError("dimension is 2 or 3")
        self.atoms = {}
        for l, lattice in enumerate(scene["lattices"]):
            for a, atom in enumerate(lattice["atoms"]):
                self.atoms[l, a] = Atom(atom, lattice["vectors"], self.size)

    def obstacle(self, numbers):
        if type(numbers) is not list or not all(type(n) is int for n in numbers) or len(numbers) != 2 + self.size:
            raise ValueError(f"no obstacle: {numbers!r:.60}")
        if (*numbers[:2],) not in self.atoms:
            raise ValueError(f"there is no atom {numbers[:2]}")
        return *numbers[:2], (*numbers[2:],)


class Shape:
    """An atom in intervals."""

    def __init__(self, atom, speed2, bits):
        def intervals(rows):
            return [[interval(c, bits) for c in row] for row in rows]

        self.atom, self.bits = atom, bits
        self.semiaxes, self.shape, self.dual = intervals(atom.semiaxes), intervals(atom.shape), intervals(atom.dual)
        self.extent = [self.half_width(dual) for dual in atom.dual]
        self.known = None
        if atom.is_ball:  # |V|^2 and the normal's square never change
            inverse2 = interval(atom.shape[0][0] ** 2, bits)
            self.known = speed2 * inverse2, reciprocal(speed2 * inverse2), interval(atom.semiaxes[0][0] ** 2, bits)

    def half_width(self, dual):
        """Of the obstacle along n_k, rounded up: sqrt(sum (A_i . dual_k)^2)."""
        square = sum(sum(a * d for a, d in zip(axis, dual)) ** 2 for axis in self.atom.semiaxes)
        return math.isqrt((square.numerator << 2 * self.bits) // square.denominator) + 1

    def speeds(self, V):
        """|V|^2 and 1 / |V|^2."""
        if self.known:
            return self.known[:2]
        square = dot(V, V)
        return square, reciprocal(square)

    def inverse_square_of(self, normal):
        return self.known[2] if self.known else reciprocal(dot(normal, normal))


# ---- FLIGHTS. In coordinates in which an obstacle is the unit ball let W be its centre from the particle, V the velocity,
# S = V.W, H = V x W. The line meets it iff D = |V|^2 - H^2 > 0, at the times (S -+ sqrt D) / |V|^2; it is entered at
# the place u = (V x H - sqrt D V) / |V|^2, where the outward normal is sum u_k shape_k, and V.u = -sqrt D.
class Particle:
    def __init__(self, anchor, offset, v, speed2):
        self.anchor, self.offset, self.v, self.speed2 = anchor, offset, v, speed2  # place: anchor (exact) + offset
        self.bits = speed2.bits
        self.shapes = {}

    def shape(self, atoms, key):
        if key not in self.shapes:
            self.shapes[key] = Shape(atoms[key], self.speed2, self.bits)
        return self.shapes[key]

    def coarse(self, shapes):
        def short(a):
            return [x.with_bits(COARSE) for x in a]

        result = Particle(self.anchor, short(self.offset), short(self.v), self.speed2.with_bits(COARSE))
        result.shapes = shapes
        return result


class Approach:
    """W, V, S, H, D of a particle and an obstacle."""

    def __init__(self, particle, atoms, obstacle):
        *key, cell = obstacle
        self.shape = particle.shape(atoms, (*key,))
        centre = self.shape.atom.centre(cell)
        w = [interval(c - a, particle.bits) - q for c, a, q in zip(centre, particle.anchor, particle.offset)]
        self.centre, self.v = centre, particle.v
        self.W, self.V = through(self.shape.shape, w), through(self.shape.shape, particle.v)
        self.S, self.H = dot(self.V, self.W), cross(self.V, self.W)
        self.V2, self.inverse_V2 = self.shape.speeds(self.V)
        self.D = self.V2 - dot(self.H, self.H)

    def contains_start(self):
        return (dot(self.W, self.W) - interval(Fraction(1), self.V2.bits)).sign() < 0

    def time(self):
        self.root = square_root(self.D)
        return (self.S - self.root) * self.inverse_V2

    def reflected(self):
        """Offset from the centre, and velocity, after the collision; time() was asked."""
        u = [(h - self.root * c) * self.inverse_V2 for c, h in zip(self.V, cross_again(self.V, self.H))]
        normal = linear(u, self.shape.shape)
        push = self.root * self.shape.inverse_square_of(normal)
        push = push + push
        return linear(u, self.shape.semiaxes), [c + push * n for c, n in zip(self.v, normal)]


def flight_to(particle, atoms, target):
    approach = Approach(particle, atoms, target)
    if approach.contains_start():
        raise Refuted("the particle is in it already")
    if approach.D.sign() < 0:
        raise Refuted("the line misses it")
    if approach.S.sign() < 0:
        raise Refuted("it lies behind")
    return approach, approach.time()


def judge(particle, atoms, other, until):
    """Refutes the flight if `other` is entered before the time `until`."""
    approach = Approach(particle, atoms, other)
    if approach.contains_start():
        raise Refuted(f"the flight begins in {other}")
    if approach.D.sign() > 0 and approach.S.sign() > 0 and (approach.time() - until).sign() < 0:
        raise Refuted(f"{other} is entered before")


def columns(low, high):
    if high - low > MOST_COLUMNS:
        raise Refuted("the flight is too long for this checker")
    return range(low, high + 1)


def cells_along(particle, shape, until):
    """All cells whose obstacle of this atom may meet the flight up to `until`, and some more. Along the coordinate k in
    which the flight is fastest n_k is counted; at n_k the flight has the others at a line g + n_k slope, and an
    obstacle is no further from that than half its width there and, for its width along k, slope times that."""
    bits, size = particle.bits, len(particle.v)
    place = [interval(a - p, bits) + q for a, p, q in zip(particle.anchor, shape.atom.position, particle.offset)]
    start, speed = through(shape.dual, place), through(shape.dual, particle.v)
    k = max(range(size), key=lambda i: abs(speed[i].mid))
    others = [i for i in range(size) if i != k]
    end = start[k] + speed[k] * until
    low = min(start[k].low(), end.low()) - shape.extent[k] >> bits
    high = -(-max(start[k].high(), end.high()) - shape.extent[k] >> bits)
    inverse_speed = reciprocal(speed[k])
    lines = []
    for i in others:
        slope = speed[i] * inverse_speed
        g = start[i] - start[k] * slope
        steep = (abs(slope.mid) + slope.rad) * shape.extent[k] >> bits
        lines.append((g.mid, slope.mid, shape.extent[i] + steep + 1 + g.rad + max(abs(low), abs(high)) * slope.rad))
    for n in columns(low, high):
        ranges = [range(-(-(g + n * slope - room) >> bits), (g + n * slope + room >> bits) + 1) for g, slope, room in lines]
        if all(ranges):
            for rest in itertools.product(*ranges):
                yield (*rest[:k], n, *rest[k:])


def check_first(particle, coarse, atoms, leaving, target, until):
    for key in atoms:
        for cell in cells_along(coarse, coarse.shape(atoms, key), until.with_bits(COARSE)):
            other = *key, cell
            if other in (leaving, target):
                continue
            try:
                judge(coarse, atoms, other, until.with_bits(COARSE))
            except Undecided:
                judge(particle, atoms, other, until)


# ---- RECORDS.
def check_decimal(value, text, digits, what):
    parts = re.fullmatch(r"-?([0-9]+)\.([0-9]+)(?:e([+-][0-9]{1,5}))?", text)
    shown = (parts[1] + parts[2]).lstrip("0") if parts else ""
    if not parts or len(shown or parts[2]) != digits:
        raise Refuted(f"{what} has not {digits} digits: {text!r:.60}")
    half_unit = Fraction(10) ** (int(parts[3] or 0) - len(parts[2])) / 2
    off = value - interval(Fraction(text), value.bits)
    most = interval(half_unit, value.bits)
    if (most - Interval(abs(off.mid), off.rad, off.bits)).sign() < 0:
        raise Refuted(f"{what} is not {text}")


def start_of(record, scene, bits):
    if "v" in record:
        v = vector(record["v"], scene.size, lambda item: surd(item, bits))
        speed2 = dot(v, v)
    else:
        ((kind, value),) = record["direction"].items()
        if scene.size != 2 or kind not in ("degrees", "slope"):
            raise ValueError("no direction in the plane")
        v = cosine_and_sine(rational(value), bits) if kind == "degrees" else [surd(1, bits), surd(value, bits)]
        speed2 = interval(Fraction(1), bits) if kind == "degrees" else dot(v, v)
    x = vector(record["x"], scene.size)
    return Particle(x, [interval(Fraction(0), bits)] * scene.size, v, speed2)


def leaving_of(record, scene):
    if "from" not in record:
        return None
    return scene.obstacle([record["from"]["lattice"], record["from"]["atom"], *record["from"]["cell"]])


def fly(record, scene, digits, bits):
    particle, leaving = start_of(record, scene, bits), leaving_of(record, scene)
    time, times, coarse_shapes = interval(Fraction(0), bits), record["times"], {}
    for number, target in enumerate(record["itinerary"], 1):
        target = scene.obstacle(target)
        try:
            if target == leaving:
                raise Refuted("the particle leaves it")
            approach, until = flight_to(particle, scene.atoms, target)
            check_first(particle, particle.coarse(coarse_shapes), scene.atoms, leaving, target, until)
            particle.anchor, leaving, time = approach.centre, target, time + until
            particle.offset, particle.v = approach.reflected()
            if str(number) in times:
                check_decimal(time, times[str(number)], digits, "the time")
        except Refuted as flaw:
            raise Refuted(f"collision {number}, with {target}: {flaw}") from None
    for i in range(scene.size):
        place = interval(particle.anchor[i], bits) + particle.offset[i]
        check_decimal(place, record["end"]["x"][i], digits, f"the end's x[{i}]")
        check_decimal(particle.v[i], record["end"]["v"][i], digits, f"the end's v[{i}]")


def check_form(record, scene):
    _, *start = record  # the id is first: else it would be part of what it is the sum of
    start, rest = {*start[:-3]} - {"from"}, start[-3:]  # the id is that of what stands before the itinerary
    if start not in ({"x", "v"}, {"x", "direction"}) or rest != ["itinerary", "times", "end"]:
        raise ValueError(f"keys: {[*record]}")
    count, end = len(record["itinerary"]), record["end"]
    if not {"x", "v", "bits"} == {*end} or len(end["x"]) != scene.size or len(end["v"]) != scene.size:
        raise ValueError("the end has x, v, bits")
    if type(end["bits"]) is not int or end["bits"] < 0:
        raise ValueError("bits: an integer, not below 0")
    if str(count) not in record["times"] or not {*record["times"]} <= {str(n) for n in range(1, count + 1)}:
        raise ValueError("times: of collisions of the itinerary, the last one's among them")


def check_record(record, scene, digits):
    check_form(record, scene)
    bits = COARSE + 4 * digits + record["end"]["bits"] * 5 // 4 + 2 * len(record["itinerary"])
    while bits <= MOST_BITS:
        try:
            return fly(record, scene, digits, bits)
        except Undecided:
            bits = bits * 3 // 2
    raise Refuted(f"not certain with {MOST_BITS} bits")


def identity(scene_line, line):
    """Of the scene's line and of the start as it is written."""
    start = line[line.index(',"') + 1 : line.index(',"itinerary"')]
    return hashlib.sha256(f"{scene_line}\n{start}".encode()).hexdigest()[:16]


# ---- FILES.
def members(pairs):
    """An object of JSON, in which no key may come twice."""
    box = dict(pairs)
    if len(box) < len(pairs):
        raise ValueError(f"a key comes twice among {[key for key, _ in pairs]!r:.99}")
    return box


class File:
    def __init__(self, name, quick):
        self.name, self.quick = name, quick
        self.scene, self.scene_line, self.checked_one = None, "", False
        self.header, self.records, self.checked, self.ids, self.status = None, 0, 0, set(), 0

    def complain(self, status, number, flaw):
        self.status = max(self.status, status)
        print(f"{self.name}:{number}: {flaw}")

    def read_line(self, line):
        box = json.loads(line, object_pairs_hook=members)
        if self.header is None:
            self.header = box["golden"]
            if {*self.header} != HEADER or self.header["format"] != 1 or not 1 <= self.header["digits"] <= 10**6:
                raise ValueError(f"the header has {sorted(HEADER)}, and format 1")
        elif "scene" in box:
            self.scene, self.scene_line, self.checked_one = Scene(box["scene"]), line, False
        else:
            self.read_record(box, line)

    def read_record(self, record, line):
        self.records += 1
        if record["id"] in self.ids or record["id"] != identity(self.scene_line, line):
            raise Refuted(f"{record['id']}: the id does not belong, or is there twice")
        self.ids.add(record["id"])
        if self.quick and (self.checked_one or len(record["itinerary"]) > MOST_QUICK):
            return
        self.checked, self.checked_one = self.checked + 1, True
        try:
            check_record(record, self.scene, self.header["digits"])
        except Refuted as flaw:
            raise Refuted(f"{record['id']}: {flaw}") from None

    def check(self):
        number = 0
        with open(self.name, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                try:
                    self.read_line(line.rstrip("\n"))
                except Refuted as flaw:
                    self.complain(1, number, flaw)
                except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError) as flaw:
                    self.complain(2, number, f"{type(flaw).__name__}: {flaw}")
        if self.status == 0 and not self.header:
            self.complain(2, 1, "is empty: no header, and nothing to be checked")
        if self.status == 0 and self.header["count"] != self.records:
            self.complain(1, number, f"{self.records} records, not as many as the header says")
        if self.status == 0:
            print(f"{self.name}: {self.records} records, {self.checked} flown again, all right")
        return self.status


def main(arguments):
    quick = "--quick" in arguments
    names = [name for name in arguments if name != "--quick"]
    if not names or any(name.startswith("-") for name in names):
        print(__doc__, file=sys.stderr)
        return 2
    try:
        return max([File(name, quick).check() for name in names])
    except (OSError, UnicodeDecodeError) as flaw:
        print(flaw, file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
