#!/usr/bin/env python3
"""Exponents of the time to the first collision against the radius: least squares on logarithms of the mean times of
drawn flights, each engine alone; beside them what a power of ten in r costs. Reads files of `lorentz bench --csv`."""
import csv
import math
import sys


def slope(points):
    xs, ys = [math.log(r) for r, _ in points], [math.log(t) for _, t in points]
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    s = sum((a - x) * (b - y) for a, b in zip(xs, ys)) / sum((a - x) ** 2 for a in xs)
    rest = sum((b - y - s * (a - x)) ** 2 for a, b in zip(xs, ys))
    error = math.sqrt(rest / max(1, len(xs) - 2) / sum((a - x) ** 2 for a in xs))
    return s, error


print("scene,engine,exponent,error,from_radius,to_radius,ns_at_largest,ns_at_smallest")
for name in sys.argv[1:]:
    times = {}
    for row in csv.DictReader(open(name)):
        if row["difficulty"] == "drawn" and row["ns_mean"]:
            times.setdefault((row["scene"], row["engine"]), []).append((float(row["radius"]), float(row["ns_mean"])))
    for (scene, engine), points in times.items():
        points.sort()
        exponent, error = slope(points)
        print(f"{scene},{engine},{exponent:.3f},{error:.3f},{points[0][0]:g},{points[-1][0]:g},"
              f"{points[-1][1]:.1f},{points[0][1]:.1f}")
