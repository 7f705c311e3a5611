#!/usr/bin/env python3
"""Time against k of a drift 2^-k out of a plane channel, as SVG.

  build/first_hit_benchmark --benchmark_filter=2^-k --benchmark_format=json | bench/channel_plot.py > docs/channel.svg
"""
import json
import sys
from collections import defaultdict

WIDTH, HEIGHT, LEFT, BOTTOM = 640, 360, 60, 45
COLOURS = ["#0b6", "#06c", "#c40"]

series = defaultdict(list)
for run in json.load(sys.stdin)["benchmarks"]:
    name, k = run["name"].rsplit("/", 1)
    if not run.get("undecided"):
        series[name].append((int(k), run["cpu_time"]))
top = 1.05 * max(ns for points in series.values() for _, ns in points)
right = max(k for points in series.values() for k, _ in points)


def place(k, ns):
    x = LEFT + (WIDTH - LEFT - 20) * k / right
    y = HEIGHT - BOTTOM - (HEIGHT - BOTTOM - 20) * ns / top
    return f"{x:.1f},{y:.1f}"


out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
       f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
       f'<polyline points="{place(0, top)} {place(0, 0)} {place(right, 0)}" fill="none" stroke="black"/>',
       f'<text x="{WIDTH / 2}" y="{HEIGHT - 8}" text-anchor="middle">k: the flight leaves its channel at a slope of 2^-k</text>',
       f'<text x="12" y="14">ns a query</text>']
for k in range(0, right + 1, 10):
    x, y = place(k, 0).split(",")
    out.append(f'<text x="{x}" y="{float(y) + 16:.1f}" text-anchor="middle">{k}</text>')
for tick in range(0, int(top), 500):
    x, y = place(0, tick).split(",")
    out.append(f'<text x="{float(x) - 6:.1f}" y="{float(y) + 4:.1f}" text-anchor="end">{tick}</text>')
for i, (name, points) in enumerate(sorted(series.items())):
    colour = COLOURS[i % len(COLOURS)]
    out.append(f'<polyline points="{" ".join(place(*p) for p in points)}" fill="none" stroke="{colour}" stroke-width="2"/>')
    out.append(f'<text x="{LEFT + 20}" y="{40 + 16 * i}" fill="{colour}">{name}</text>')
out.append("</svg>")
print("\n".join(out))
