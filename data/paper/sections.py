"""The section of three cylinders of radius 1 around a ball, in a plane across a direction."""
import itertools
import math


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / math.hypot(*a) for x in a)


def section_of(v):
    """Its corners for radius 1, in a plane across v."""
    one = unit(cross(v, (0.3, -0.5, 0.8)))
    two = cross(v, one)
    corners = [(3, 3), (-3, 3), (-3, -3), (3, -3)]
    for k in range(3):
        normal = unit(cross(v, [float(i == k) for i in range(3)]))
        for sign in (1, -1):
            side = sign * dot(normal, one), sign * dot(normal, two)
            corners = clipped(corners, side)
    return corners


def clipped(corners, side):
    kept = []
    for a, b in zip(corners, corners[1:] + corners[:1]):
        here, there = 1 - dot(a, side), 1 - dot(b, side)
        if here >= 0:
            kept.append(a)
        if here * there < 0:
            kept.append(tuple(p + (q - p) * here / (here - there) for p, q in zip(a, b)))
    return kept


def area(corners):
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(corners, corners[1:] + corners[:1]))) / 2


def mean_section(n=40):
    """Over all directions, by midpoints, in units of the disc."""
    total = 0.0
    for i, j in itertools.product(range(n), repeat=2):
        height, angle = (i + 0.5) / n, (j + 0.5) / n * math.pi / 2
        width = math.sqrt(1 - height * height)
        total += area(section_of((width * math.cos(angle), width * math.sin(angle), height)))
    return total / n**2 / math.pi
