#!/usr/bin/env python3
"""Which disc is hit first, as a function of the direction: r = 0.1, the start of the paper's example, (0, 0.445), 90 000
directions evenly from 0 to 90 degrees. Flies them with `lorentz first-hit`, exactly, and writes
  first-discs.csv  of neighbouring directions with the same first disc one row: the interval, the disc, how far its
                   centre is from the start, the share of all directions
  first-discs.svg  the same as a picture
  first_discs.py LORENTZ FOLDER"""
import csv
import io
import itertools
import math
import subprocess
import sys

PER_DEGREE, DEGREES, START = 1000, 90, (0, 0.445)
COUNT = PER_DEGREE * DEGREES


def first_discs(lorentz):
    """The cell of the first disc for each direction, "" for none."""
    rows = ["x1,x2,v1,v2"]
    for i in range(COUNT):
        angle = math.radians((i + 0.5) / PER_DEGREE)
        rows.append(f"{START[0]},{START[1]},{math.cos(angle)!r},{math.sin(angle)!r}")
    out = subprocess.run([lorentz, "first-hit", "--scene", "square", "--radius", "0.1", "--engine", "certified-batch",
                          "--format", "csv"], input="\n".join(rows) + "\n", capture_output=True, text=True, check=True).stdout
    return [(int(row["cell1"]), int(row["cell2"])) if row["outcome"] == "hit" else ""
            for row in csv.DictReader(io.StringIO(out))]


def intervals(cells):
    """(first direction, last + 1, cell, distance) of each run of directions with one first disc."""
    begin = 0
    for cell, run in itertools.groupby(cells):
        end = begin + len(list(run))
        yield begin, end, cell, math.dist(cell, START) if cell else math.inf
        begin = end


WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 800, 600, 100, 772, 50, 500
LEAST, MOST = 0.3, 1000


def at(degrees, distance):
    """In the picture: distances are logarithmic."""
    return (LEFT + (RIGHT - LEFT) * degrees / DEGREES,
            BOTTOM - (BOTTOM - TOP) * math.log(distance / LEAST) / math.log(MOST / LEAST))


def words(x, y, text, style='text-anchor="middle"'):
    return f'<text x="{x:.1f}" y="{y:.1f}" {style}>{text}</text>\n'


def axes():
    svg = '<g stroke="#d4d4d4" fill="none">\n'
    for degrees in range(0, 91, 15):
        svg += f'<path d="M{at(degrees, 1)[0]:.1f} {BOTTOM}V{TOP}"/>\n'
    for distance in (1, 10, 100):
        svg += f'<path d="M{LEFT} {at(0, distance)[1]:.1f}H{RIGHT}"/>\n'
    svg += f'<path d="M{LEFT} {TOP}H{RIGHT}V{BOTTOM}H{LEFT}Z" stroke="#222222" stroke-width="1.4"/>\n</g>\n'
    for degrees in range(0, 91, 15):
        svg += words(at(degrees, 1)[0], BOTTOM + 26, f"{degrees}°")
    for distance, label in ((1, "1"), (10, "10"), (100, "10²"), (1000, "10³")):
        svg += words(LEFT - 9, at(0, distance)[1] + 7, label, 'text-anchor="end"')
    svg += words((LEFT + RIGHT) / 2, BOTTOM + 56, "direction, in degrees from the axis")
    return svg + words(0, 0, "distance of the first disc", 'text-anchor="middle" transform="translate(24 275) rotate(-90)"')


def picture(found):
    """A stroke for each interval, at the distance of its disc."""
    strokes = ""
    for begin, end, _, distance in found:
        if distance < MOST:
            x, y = at(begin / PER_DEGREE, distance)
            strokes += f"M{x:.1f} {y:.1f}h{max(1.5, at(end / PER_DEGREE, distance)[0] - x):.1f}"
    title = "First disc over directions: square, r = 0.1"
    note = f"from x = {START}, {COUNT} directions, exact; peaks are directions of corridors"
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}" '
            f'font-family="sans-serif" font-size="20">\n<title>{title}</title>\n'
            f'<rect width="100%" height="100%" fill="white"/>\n{axes()}'
            f'<path d="{strokes}" fill="none" stroke="#0072b2" stroke-width="4"/>\n'
            + words(LEFT, 33, title, 'font-size="22" font-weight="bold"')
            + words(14, HEIGHT - 14, note, 'font-size="17" fill="#444444"') + "</svg>\n")


lorentz, folder = sys.argv[1:]
found = list(intervals(first_discs(lorentz)))
with open(f"{folder}/first-discs.csv", "w") as out:
    out.write("from_degrees,to_degrees,cell1,cell2,distance,share\n")
    for begin, end, cell, distance in found:
        cell1, cell2 = cell or ("", "")
        out.write(f"{begin / PER_DEGREE:g},{end / PER_DEGREE:g},{cell1},{cell2},{distance:.6g},{(end - begin) / COUNT:.6f}\n")
with open(f"{folder}/first-discs.svg", "w") as out:
    out.write(picture(found))
