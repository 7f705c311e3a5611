"""The pictures of docs/paper.md."""
import itertools
import math
import random
import statistics

from chart import PALETTE, Chart, circle, path, picture, text
from reading import ENGINES, FITTED, LATTICES, SCENES, means, per_cell, radii_of, rows_of, slope
from sections import area, cross, dot, section_of, unit

STYLES = {"classical": (PALETTE["classical"], ""), "published": (PALETTE["published"], ""), "reduction": (PALETTE["ours"], ""),
          "batch": (PALETTE["ours"], "9 5"), "oracle": (PALETTE["ours"], "2 4")}


def times_picture(dimension):
    found, _ = means(dimension)
    name = "square lattice of discs" if dimension == 2 else "cubic lattice of balls"
    chart = Chart(f"Time to the first collision: {name}", "radius", "mean time, ns", (8e-4, 0.5), (8, 3e5 if dimension == 2 else 1e7))
    for engine in ENGINES:
        colour, dash = STYLES[engine]
        points = [(r, statistics.mean(found[engine, r])) for r in radii_of(found, engine)]
        chart.curve(points, colour, engine, dash)
        chart.dots(points, colour)
        if engine in ENGINES[:2]:
            power, x, y = slope([point for point in points if point[0] <= FITTED])
            fit = [(r, math.exp(y + power * (math.log(r) - x))) for r in (1e-3, FITTED)]
            chart.curve(fit, PALETTE["grey"] if engine == "classical" else "#222222", f"fit of {engine}: r^{power:.2f}", "3 3", 1.6)
    return chart.svg()


def cells_picture(dimension):
    name = "square lattice of discs" if dimension == 2 else "cubic lattice of balls"
    chart = Chart(f"Time per cell: {name}", "radius", "ns per cell", (8e-4, 0.5), (1e-3 if dimension == 2 else 1e-5, 300), legend=180)
    for engine in ENGINES:
        colour, dash = STYLES[engine]
        points = per_cell(dimension, engine)
        chart.curve(points, colour, engine, dash)
        chart.dots(points, colour)
    return chart.svg()


def densities_picture(files, title, x, y):
    """Densities of one, two, .. lattices, the limit laws, and dashed the powers of their tails."""
    chart = Chart(title, "t", "density", x, y, legend=180)
    colours = (PALETTE["published"], PALETTE["classical"], PALETTE["third"], PALETTE["ours"])
    for number, (file, colour) in enumerate(zip(files, colours), 1):
        bins = [row for row in rows_of(file) if row["bins"] == "logarithmic" and int(row["count"]) >= 10]
        middle = [math.sqrt(float(row["from"]) * float(row["to"])) for row in bins]
        law = next(name for name in bins[0] if name.endswith(": density"))
        chart.dots([(t, float(row["density"])) for t, row in zip(middle, bins)], colour,
                   f"{number} lattice{'s' * (number > 1)}", 2.6)
        chart.curve([(t, float(row[law])) for t, row in zip(middle, bins)], colour, "its limit law", "", 1.4)
        end = next((t, 3 * float(row[law])) for t, row in zip(middle[::-1], bins[::-1]) if t < 0.9 * x[1])
        line = [(t, end[1] * (t / end[0]) ** -(number + 1)) for t in (end[0] / 30, end[0])]
        chart.curve(line, "#222222", dash="8 5", width=1.8)
        power = "\u207b" + "\u00b2\u00b3\u2074\u2075"[number - 1]
        beside = line[1][0], end[1] / 3 * (y[0] / y[1]) ** 0.075  # below the last point
        if beside[0] > x[1] / 1.5:
            beside = [1.5 * math.sqrt(line[0][i] * line[1][i]) for i in range(2)]
        chart.words(beside, f"t{power}", "#222222")
    return chart.svg()


def discs_picture():
    chart = Chart("First disc over directions: square, r = 0.1", "direction", "distance of the first disc", (0, 90), (0.3, 1000),
                  range(0, 91, 15), legend=24)
    for row in rows_of("first-discs.csv"):
        begin, end, distance = (float(row[name]) for name in ("from_degrees", "to_degrees", "distance"))
        if distance < 1000:
            chart.curve([(begin, distance), (max(end, begin + 0.2), distance)], PALETTE["published"], width=4)
    return chart.svg()


def tricylinder_picture():
    """The solid that three cylinders share, and what a line along v meets of it."""
    v = unit((0.83, 0.45, 0.33))
    size, left, right, middle = 165, 220, 660, 265
    body = text(left, 34, "Three cylinders share a solid around the ball", 20) + text(right, 34, "seen along a flight", 20)
    eye = unit((0.55, 0.30, 0.78))
    across = unit(cross((0, 0, 1), eye))
    up = cross(eye, across)
    body += circle(left, middle, size, "#cfe3f1", PALETTE["published"], 2)
    for axis, one, two in itertools.product(range(3), (1, -1), (1, -1)):
        for end in (1, -1)[:2 * (one == 1)]:  # each arc once
            arc = []
            for i in range(25):
                height = (i / 24 * 2 - 1) * math.sqrt(0.5)
                point = [0.0] * 3
                point[axis] = end * math.sqrt(1 - height * height)
                point[(axis + 1) % 3], point[(axis + 2) % 3] = one * height, two * height
                arc.append(point)
            hidden = dot(arc[12], eye) < 0
            flat = [(left + size * dot(p, across), middle - size * dot(p, up)) for p in arc]
            body += path(flat, "#222222", 1 if hidden else 2, "3 4" if hidden else "")
    corners = section_of(v)
    flat = [(right + size * a, middle - size * b) for a, b in corners]
    body += path(flat, "#222222", 2, fill="#fbe3d6", more="Z") + circle(right, middle, size, "#cfe3f1", PALETTE["published"], 2)
    drawn = random.Random(20161115)
    for _ in range(400):
        a, b = drawn.uniform(-1.5, 1.5), drawn.uniform(-1.5, 1.5)
        if inside(corners, (a, b)):
            missed = math.hypot(a, b) > 1
            body += circle(right + size * a, middle - size * b, 3.4, PALETTE["classical"] if missed else PALETTE["published"])
    share = 1 - math.pi / area(corners)
    body += text(left, 490, "the ball (blue) touches it along three circles", 18, "#444444")
    body += text(right, 490, f"dots: flights; orange ones miss the ball ({share:.2f} here)", 18, "#444444")
    return picture(880, 515, "Three cylinders and a ball", body)


def inside(corners, point):
    turns = [(b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0])
             for a, b in zip(corners, corners[1:] + corners[:1])]
    return min(turns) >= 0 or max(turns) <= 0


def oblique_picture():
    """Discs on an oblique lattice, and their image on the square one."""
    one, two, r = (1.0, 0.0), (0.45, 0.85), 0.22
    scale, left, right, middle = 105, 220, 660, 265
    body = text(left, 34, "discs on an oblique lattice", 20) + text(right, 34, "on the square lattice: ellipses", 20)
    inverse = ((1.0, -two[0] / two[1]), (0.0, 1 / two[1]))
    ring = [(math.cos(k * math.pi / 32), math.sin(k * math.pi / 32)) for k in range(64)]
    image = [(r * dot(inverse[0], p), r * dot(inverse[1], p)) for p in ring]
    largest = max(math.hypot(*p) for p in image)
    for i, j in itertools.product(range(-3, 4), repeat=2):
        x, y = i * one[0] + j * two[0], i * one[1] + j * two[1]
        if abs(x) < 1.75 and abs(y) < 1.75:
            body += circle(left + scale * x, middle - scale * y, scale * r, "#cfe3f1", PALETTE["published"])
        if abs(i) < 2 and abs(j) < 2:
            there = [(right + scale * (i + a), middle - scale * (j + b)) for a, b in image]
            body += path(there, PALETTE["published"], 1.5, fill="#cfe3f1", more="Z")
            body += circle(right + scale * i, middle - scale * j, scale * largest, "none", PALETTE["classical"], 1.8, "6 4")
    for origin, ends in ((left, (one, two)), (right, ((1, 0), (0, 1)))):
        for a, b in ends:
            body += path([(origin, middle), (origin + scale * a, middle - scale * b)], "#222222", 2.4)
            body += circle(origin + scale * a, middle - scale * b, 4, "#222222")
    body += text(left, 490, "black: the vectors of the cell", 18, "#444444")
    body += text(right, 490, f"dashed: the circles around them, r' = {largest / r:.2f} r", 18, "#444444")
    return picture(880, 515, "An oblique lattice and its ellipses", body)


def pictures():
    for dimension in (2, 3):
        yield f"times-{dimension}d.svg", times_picture(dimension)
        yield f"cells-{dimension}d.svg", cells_picture(dimension)
    yield "densities.svg", densities_picture([f"{scene}.csv" for scene in SCENES], "First free flight, r = 1e-4, 10\u2078 starts",
                                             (10, 1e6), (1e-13, 1e-3))
    yield "lattices.svg", densities_picture([f"lattices-{number}.csv" for number in LATTICES],
                                            "Free paths among one to four lattices, r = 1e-4", (10, 1e9), (1e-19, 1e-3))
    yield "first-discs.svg", discs_picture()
    yield "tricylinder.svg", tricylinder_picture()
    yield "oblique.svg", oblique_picture()
