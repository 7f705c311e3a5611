#!/usr/bin/env python3
"""Does this ray hit this ball, and when? Four formulas that people use, judged (docs/ray_and_ball.md).

    ray_ball.py engine FORMULA       answers a query stream: textbook, q-form, nearest-point or projection
                                     (with --binary32: each operation is rounded to binary32)
    ray_ball.py questions KIND N     N rays beside the unit ball, of one kind
    ray_ball.py table [--write]      what each formula gets wrong, by kind of question
    ray_ball.py chart [--write]      the same against the distance of the ball, as SVG
    ray_ball.py binary32 [--write]   the same in binary32, as a table

In plain binary64 or binary32, as a ray tracer would have them; none knows a tolerance.
"""
import argparse
import json
import math
import pathlib
import random
import re
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/ray_and_ball.md"
BEGIN, END = "<!-- formulas: begin -->\n", "<!-- formulas: end -->\n"
BEGIN_32, END_32 = "<!-- binary32: begin -->\n", "<!-- binary32: end -->\n"


class Single(float):
    """A binary32. A sum, product, quotient or root of two of them is rounded once: binary64 has more than twice the bits."""

    def __new__(cls, value):
        return super().__new__(cls, struct.unpack("f", struct.pack("f", value))[0])

    def __add__(self, other): return Single(float(self) + float(other))
    def __sub__(self, other): return Single(float(self) - float(other))
    def __mul__(self, other): return Single(float(self) * float(other))
    def __rmul__(self, other): return self * other
    def __truediv__(self, other): return Single(float(self) / float(other))
    def __neg__(self): return Single(-float(self))


def root(a):
    return type(a)(math.sqrt(a))


# ---- The formulas: the time at which x + t v enters the ball of radius r around the origin, or nothing.

def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def textbook(x, v, r):
    """(-b - sqrt(b^2 - 4 a c)) / 2 a."""
    a, b, c = dot(v, v), 2 * dot(x, v), dot(x, x) - r * r
    square = b * b - 4 * a * c
    return (-b - root(square)) / (2 * a) if square > 0 else None


def q_form(x, v, r):
    """The root of larger size, and the other one from their product. Only the discriminant cancels."""
    a, b, c = dot(v, v), dot(x, v), dot(x, x) - r * r
    square = b * b - a * c
    if not square > 0:
        return None
    q = -(b + root(square)) if b >= 0 else -(b - root(square))
    return c / q if b < 0 else q / a


def nearest_point(x, v, r):
    """The distance to the centre along the line; the squared distance beside it is |x|^2 - along^2."""
    speed = root(dot(v, v))
    along = -dot(x, v) / speed
    square = r * r - (dot(x, x) - along * along)
    return (along - root(square)) / speed if square > 0 else None


def projection(x, v, r):
    """The part of x orthogonal to the flight as a vector: it is short even if x is long."""
    a, b, c = dot(v, v), dot(x, v), dot(x, x) - r * r
    across = [p - b / a * w for p, w in zip(x, v)]
    square = a * (r * r - dot(across, across))
    return c / (root(square) - b) if square > 0 and b < 0 else None


FORMULAS = {"textbook": textbook, "q-form": q_form, "nearest-point": nearest_point, "projection": projection}


def answer(formula, x, v, r):
    if dot(x, x) < r * r:
        return {"outcome": "inside", "lattice": 0, "atom": 0, "cell": []}
    try:
        time = formula(x, v, r)
    except (ZeroDivisionError, OverflowError, ValueError):
        time = None
    if time is None or not 0 <= time < math.inf:
        return {"outcome": "never"}
    return {"outcome": "hit", "lattice": 0, "atom": 0, "cell": [], "time": time}


def in_space(a):
    return [float(c) if not isinstance(c, str) else float.fromhex(c) for c in a] + [0.0] * (3 - len(a))


def engine(formula, number=float):
    ball = None
    for line in sys.stdin:
        query = json.loads(line)
        if "scene" in query:
            lattices = query["scene"]["lattices"]
            atoms = [atom for lattice in lattices for atom in lattice["atoms"]]
            ball = atoms[0] if len(atoms) == 1 and not lattices[0]["vectors"] and "radius" in atoms[0] else None
            continue
        if ball is None:
            said = {"outcome": "error", "message": "does single balls only", "reason": "unsupported"}
        elif "from" in query:  # the ball that the ray leaves: there is no other
            said = {"outcome": "never"}
        else:
            x = [a - c for a, c in zip(in_space(query["x"]), in_space(ball["position"]))]
            said = answer(formula, *([number(c) for c in part] for part in (x, in_space(query["v"]))), number(ball["radius"]))
        print(json.dumps({"id": query.get("id"), **said}), flush=True)


# ---- Questions. A ray begins at x, at the distance `far`, and passes the centre at the distance `beside`.

def unit(rng):
    a = [rng.gauss(0, 1) for _ in range(3)]
    return [c / math.sqrt(dot(a, a)) for c in a]


def aimed(rng, far, beside):
    along = unit(rng)
    aside = unit(rng)
    part = dot(aside, along)
    aside = [a - part * b for a, b in zip(aside, along)]
    size = math.sqrt(dot(aside, aside))
    return [beside * a / size - far * b for a, b in zip(aside, along)], along


def surface(rng):
    x = unit(rng)
    return x, [c + rng.choice([-2, 0, 2]) * p for c, p in zip(unit(rng), x)]


def stretched(rng):
    x, v = aimed(rng, 5, rng.uniform(0, 1.5))
    size = 10.0 ** rng.choice([rng.uniform(-300, -150), rng.uniform(150, 300)])
    return x, [c * size for c in v]


KINDS = {
    "plain": lambda rng: aimed(rng, rng.uniform(1.5, 10), rng.uniform(0, 2)),
    "grazing": lambda rng: aimed(rng, 10, 1 + rng.choice([-1, 1]) * 10 ** rng.uniform(-14, -4)),
    "far": lambda rng: aimed(rng, 10 ** rng.uniform(3, 9), rng.uniform(0, 1.5)),
    "very far": lambda rng: aimed(rng, 10 ** rng.uniform(9, 15), rng.uniform(0, 1.5)),
    "near the surface": lambda rng: aimed(rng, 1 + 10 ** rng.uniform(-12, -3), 0),
    "on the surface": surface,
    "long and short v": stretched,
}


def from_afar(power):
    return lambda rng: aimed(rng, 10 ** power, rng.uniform(0, 1.5))


def questions(kind, count, number=float):
    rng, draw = (random.Random(kind), KINDS[kind]) if kind in KINDS else (random.Random(str(kind)), from_afar(kind))
    scene = {"dimension": 3, "lattices": [{"vectors": [], "atoms": [{"position": [0, 0, 0], "radius": 1}]}]}
    yield {"scene": scene}
    for i in range(count):
        x, v = draw(rng)
        yield {"id": i, "x": [*map(number, x)], "v": [*map(number, v)]}


# ---- The table.

def judged(lorentz, kind, count, precision="binary64"):
    """The results of `compare` by formula. A number as `kind`: rays from 10 to that power radii away."""
    number, option = (Single, " --binary32") if precision == "binary32" else (float, "")
    stream = "".join(json.dumps(line) + "\n" for line in questions(kind, count, number))
    command = [lorentz, "compare", "--queries", "-", "--json", "--precision", precision]
    for name in FORMULAS:
        command += ["--engine", f"cmd:exec {sys.executable} {__file__} engine {name}{option}"]
    done = subprocess.run(command, input=stream, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(done.stderr)
    return json.loads(done.stdout)["engines"]


DISTANCES = (10, 1000, 4000, 10_000, 1_000_000)  # in radii: in binary32


def table(lorentz, count, first="rays", kinds=tuple((kind, kind) for kind in KINDS), precision="binary64"):
    lines = [f"| {first} | " + " | ".join(FORMULAS) + " |", "|---" * (len(FORMULAS) + 1) + "|"]
    for name_of_kind, kind in kinds:
        cells = []
        for one in judged(lorentz, kind, count, precision):
            share = [f"{100 * one[name] / one['queries']:.3g}" for name in ("wrong", "wrong_time")]
            cells.append(" and ".join(share))
        lines.append(f"| {name_of_kind} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def table_32(lorentz, count):
    kinds = [(f"{distance} radii", math.log10(distance)) for distance in DISTANCES]
    return table(lorentz, count, "from", kinds, "binary32")


def put(text, begin, end):
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(re.sub(re.escape(begin) + ".*?" + re.escape(end), lambda _: begin + text + end, page, flags=re.DOTALL),
                    encoding="utf-8")


# ---- The chart.

WIDTH, HEIGHT, LEFT, TOP, PLOT_WIDTH, PLOT_HEIGHT, FARTHEST = 680, 360, 50, 20, 440, 290, 15
CURVES = {"textbook": ("#c0392b", "textbook, q-form"), "nearest-point": ("#d68910", "nearest point"),
          "projection": ("#1e8449", "projection")}  # those of textbook and q-form are the same to a pixel


def at(power, percent):
    return f"{LEFT + PLOT_WIDTH * power / FARTHEST:.1f},{TOP + PLOT_HEIGHT * (1 - percent / 100):.1f}"


def text_at(power, percent, text, moved=(0, 0), anchor="middle"):
    x, y = (float(c) + m for c, m in zip(at(power, percent).split(","), moved))
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'


def chart(lorentz, count):
    powers = range(1, FARTHEST + 1)
    found = {power: dict(zip(FORMULAS, judged(lorentz, power, count))) for power in powers}
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" '
           'font-size="12">', '<rect width="100%" height="100%" fill="white"/>']
    for power in range(0, FARTHEST + 1, 3):
        out.append(f'<path d="M{at(power, 0)} L{at(power, 100)}" stroke="#ddd"/>')
        out.append(text_at(power, 0, f'10<tspan dy="-5" font-size="9">{power}</tspan>', (0, 18)))
    for percent in range(0, 101, 25):
        out.append(f'<path d="M{at(0, percent)} L{at(FARTHEST, percent)}" stroke="#ddd"/>')
        out.append(text_at(0, percent, f"{percent} %", (-6, 4), "end"))
    out.append(text_at(FARTHEST / 2, 0, "distance of the ball, in its radii", (0, 38)))
    for row, (name, (colour, label)) in enumerate(CURVES.items()):
        shares = [[100 * sum(found[power][name][key] for key in keys) / count for power in powers]
                  for keys in (("wrong",), ("wrong", "wrong_time"))]
        for share, dashes in zip(shares, ("", ' stroke-dasharray="5 3"')):
            points = " ".join(at(power, percent) for power, percent in zip(powers, share))
            out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"{dashes}/>')
        out.append(text_at(FARTHEST, 92 - 8 * row, f'<tspan fill="{colour}">{label}</tspan>', (12, 0), "start"))
    out.append(text_at(FARTHEST, 60, "solid: wrong", (12, 0), "start"))
    out.append(text_at(FARTHEST, 53, "dashed: or wrong in time", (12, 0), "start"))
    return "\n".join([*out, "</svg>"]) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = parser.add_subparsers(dest="part", required=True)
    answering = parts.add_parser("engine")
    answering.add_argument("formula", choices=FORMULAS)
    answering.add_argument("--binary32", action="store_true")
    asked = parts.add_parser("questions")
    asked.add_argument("kind", choices=KINDS)
    asked.add_argument("count", type=int)
    for part, count, place in (("table", 10_000, "docs/ray_and_ball.md"), ("chart", 1000, "docs/ray_and_ball.svg"),
                               ("binary32", 1000, "docs/ray_and_ball.md")):
        drawn = parts.add_parser(part)
        drawn.add_argument("--lorentz", default=str(ROOT / "build/lorentz"))
        drawn.add_argument("--count", type=int, default=count, help=f"rays of each kind ({count})")
        drawn.add_argument("--write", action="store_true", help=f"put it into {place}")
    given = parser.parse_args()
    if given.part == "engine":
        engine(FORMULAS[given.formula], Single if given.binary32 else float)
    elif given.part == "questions":
        for line in questions(given.kind, given.count):
            print(json.dumps(line))
    elif given.part == "chart":
        svg = chart(given.lorentz, given.count)
        if given.write:
            PAGE.with_suffix(".svg").write_text(svg, encoding="utf-8")
        else:
            print(svg, end="")
    else:
        make, begin, end = (table, BEGIN, END) if given.part == "table" else (table_32, BEGIN_32, END_32)
        made = make(given.lorentz, given.count)
        if given.write:
            put(made, begin, end)
        else:
            print(made, end="")


if __name__ == "__main__":
    main()
