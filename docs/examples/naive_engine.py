#!/usr/bin/env python3
"""A first-hit engine to copy and to replace: cell by cell in floats, for balls on any lattices in 2D and 3D.

It reads a query stream on stdin and writes an answer stream on stdout; it never answers `never`. Try
    lorentz compare --scene square --count 1000 --engine "cmd:python3 docs/examples/naive_engine.py"
"""
import itertools, json, math, sys

MAX_CELLS = 30_000


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def inverse(m):
    """The rows w_i with w_i . u_j = (i == j), for the rows u_j of m."""
    if len(m) == 2:
        (a, b), (c, d) = m
        return [[d / (a * d - b * c), c / (b * c - a * d)], [b / (b * c - a * d), a / (a * d - b * c)]]
    cross = [[m[i-2][k-2] * m[i-1][k-1] - m[i-2][k-1] * m[i-1][k-2] for k in range(3)] for i in range(3)]
    return [[x / dot(m[0], cross[0]) for x in row] for row in cross]


class Lattice:
    def __init__(self, lattice):
        self.vectors = [list(map(float, u)) for u in lattice["vectors"]]
        self.dual = inverse(self.vectors)
        self.near = []  # (atom, radius, n - m, centre - m u): the obstacles n that reach into a cell m
        for number, atom in enumerate(lattice["atoms"]):
            p, r = list(map(float, atom["position"])), float(atom["radius"])
            spans = [(-dot(w, p), r * math.hypot(*w) + 1e-9) for w in self.dual]
            ranges = [range(math.ceil(c - e), math.floor(c + 1 + e) + 1) for c, e in spans]
            self.near += [(number, r, n, self.at(n, p)) for n in itertools.product(*ranges)]

    def at(self, n, p):
        return [q + dot(n, column) for q, column in zip(p, zip(*self.vectors))]

    def cells(self, x, v):
        """The cells along x + t v, each with the time at which it is left."""
        y, s = [dot(w, x) for w in self.dual], [dot(w, v) for w in self.dual]
        cell = [math.floor(a) for a in y]
        for _ in range(MAX_CELLS):
            leave = [(m + (b > 0) - a) / b if b else math.inf for a, b, m in zip(y, s, cell)]
            axis = leave.index(min(leave))
            yield cell, leave[axis]
            cell[axis] += 1 if s[axis] > 0 else -1


def first_hit(lattices, x, v, source, limit):
    best, inside, speed2 = None, None, dot(v, v)
    for number, lattice in enumerate(lattices):
        for step, (cell, leave) in enumerate(lattice.cells(x, v)):
            corner = lattice.at(cell, [-a for a in x])
            for atom, r, offset, place in lattice.near:
                n = [a + b for a, b in zip(cell, offset)]
                if (number, atom, n) == source:
                    continue
                w = [a + b for a, b in zip(corner, place)]
                if step == 0 and dot(w, w) < r * r:
                    inside = min(filter(None, [inside, (number, atom, n)]))
                t = dot(w, v) / speed2
                miss = [a - t * b for a, b in zip(w, v)]
                room = r * r - dot(miss, miss)
                if room > 0 and (enters := t - math.sqrt(room / speed2)) >= 0:
                    best = min(filter(None, [best, (enters, number, atom, n)]))
            if inside or (best and best[0] <= leave) or leave >= limit:
                break
        else:
            return {"outcome": "undecided"}
    if inside:
        return {"outcome": "inside"} | dict(zip(("lattice", "atom", "cell"), inside))
    if not best or best[0] >= limit:
        return {"outcome": "later"}
    return {"outcome": "hit"} | dict(zip(("time", "lattice", "atom", "cell"), best))


def answer(query, lattices):
    if lattices is None:
        return {"outcome": "error", "message": "no scene"}
    if not lattices:
        return {"outcome": "error", "message": "crystals of balls only", "reason": "unsupported"}
    source = (f := query.get("from")) and (f["lattice"], f["atom"], [int(n) for n in f["cell"]])
    return first_hit(lattices, query["x"], query["v"], source, float(query.get("max_time", math.inf)))


lattices = None
for line in filter(str.strip, sys.stdin):
    identity = None
    try:
        item = json.loads(line)
        identity = item.get("id")
        if "scene" in item:
            lattices, scene, d = None, item["scene"]["lattices"], item["scene"]["dimension"]
            mine = all(len(a["vectors"]) == d and all("radius" in b for b in a["atoms"]) for a in scene)
            lattices = [Lattice(a) for a in scene] if mine else []
            continue
        result = answer(item, lattices)
    except Exception as error:  # an invalid line does not end the stream
        result = {"outcome": "error", "message": repr(error)}
    print(json.dumps({"id": identity} | result), flush=True)
