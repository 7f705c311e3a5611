"""Itineraries among single obstacles, rows and layers, which end where the particle escapes: against a simulation in
decimal numbers of 120 digits that tries every ball near by. Shares nothing with lorentz.

escape_test.py LORENTZ SCENES
"""
import decimal
import itertools
import json
import random
import subprocess
import sys

decimal.getcontext().prec = 120
D = decimal.Decimal
# By the number of vectors: the cells that are tried, either way, and how steep a flight must be so that nothing farther
# away is met.
TRIED = {0: (0, 0), 1: (60, 0.05), 2: (20, 0.2)}


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def drawn_scene(rng):
    d = rng.choice([2, 3])
    rank = rng.randrange(d)
    vectors = [[4.0 if i == k else 0.0 for i in range(d)] for k in range(rank)]
    atoms = [{"position": [rng.randint(-8, 8) / 4 + 6 * a * (i == d - 1) / 2 for i in range(d)],
              "radius": rng.choice([0.75, 1.0, 1.25])} for a in range(rng.choice([2, 3]))]
    return {"dimension": d, "lattices": [{"vectors": vectors, "atoms": atoms}]}


def balls_of(scene):
    lattice = scene["lattices"][0]
    for a, atom in enumerate(lattice["atoms"]):
        cells = TRIED[len(lattice["vectors"])][0]
        for n in itertools.product(range(-cells, cells + 1), repeat=len(lattice["vectors"])):
            centre = [D(p) + sum(D(u[i]) * k for u, k in zip(lattice["vectors"], n))
                      for i, p in enumerate(atom["position"])]
            yield (a, n), centre, D(atom["radius"])


def flight(balls, x, v, leaving):
    """The first ball entered, and when; None if none is. ValueError if x is in a ball that it does not leave."""
    first = None
    for name, centre, r in balls:
        w = [c - p for c, p in zip(centre, x)]
        if name == leaving:
            continue
        if dot(w, w) < r * r:
            raise ValueError("inside")
        s, vv = dot(v, w), dot(v, v)
        square = s * s - vv * (dot(w, w) - r * r)
        if s > 0 and square > 0:
            time = (s - square.sqrt()) / vv
            if first is None or time < first[1]:
                first = name, time, centre
    return first


def simulated(scene, x, v, most):
    balls, hits, leaving = list(balls_of(scene)), [], None
    x, v = [D(c) for c in x], [D(c) for c in v]
    rank = len(scene["lattices"][0]["vectors"])
    while len(hits) < most:
        if dot(v[rank:], v[rank:]) < D(TRIED[rank][1]) ** 2 * dot(v, v):
            raise ValueError("too flat")
        first = flight(balls, x, v, leaving)
        if first is None:
            return hits, "never", x, v
        leaving, time, centre = first
        x = [p + time * w for p, w in zip(x, v)]
        n = [p - c for p, c in zip(x, centre)]
        kick = 2 * dot(v, n) / dot(n, n)
        v = [w - kick * q for w, q in zip(v, n)]
        hits.append(leaving)
    return hits, "collisions", x, v


def main():
    lorentz, scenes, rng = sys.argv[1], int(sys.argv[2]), random.Random(7)
    ends, collisions = {}, 0
    for index in range(scenes):
        scene = drawn_scene(rng)
        d = scene["dimension"]
        while True:
            x = [rng.uniform(-2, 6) for _ in range(d)]
            target = rng.choice(scene["lattices"][0]["atoms"])["position"]
            v = [c - p + rng.uniform(-0.5, 0.5) for c, p in zip(target, x)]
            try:
                hits, end, last, velocity = simulated(scene, x, v, 40)
                break
            except ValueError:
                continue
        text = json.dumps({"scene": scene}) + "\n" + json.dumps({"id": index, "x": x, "v": v}) + "\n"
        done = subprocess.run([lorentz, "trajectory", "--collisions", "40", "-"], input=text, capture_output=True,
                              text=True, check=False)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        said = [(line["atom"], tuple(line["cell"])) for line in lines[:-1]]
        if said != hits or not lines or lines[-1]["end"] != end:
            sys.exit(f"expected {hits} {end}, not {said} {lines[-1:]}\n{text}{done.stderr}")
        for given, mine in zip(lines[-1]["x"] + lines[-1]["v"], [*last, *velocity]):
            if abs(D(given) - mine) > D("1e-14") * (1 + abs(mine)):
                sys.exit(f"expected {mine}, not {given}\n{text}")
        ends[end] = ends.get(end, 0) + 1
        collisions += len(hits)
    if ends.get("never", 0) < scenes / 2 or collisions < scenes:
        sys.exit(f"the scenes are not what they should be: {ends}, {collisions} collisions")
    print(f"{scenes} itineraries agree: {ends}, {collisions} collisions")


main()
