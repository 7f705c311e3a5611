"""What the files of this folder say."""
import csv
import math
import statistics
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES = ("square", "superposition-pi-5", "superposition-pi-5-pi-7")
ENGINES = ("classical", "published", "reduction", "batch", "oracle")
SEEDS = range(1, 6)
LATTICES = {1: "square", 2: "superposition-pi-5", 3: "superposition-pi-5-pi-7", 4: HERE / "four-lattices.toml"}  # and how many


def rows_of(name):
    with (HERE / name).open() as file:
        return list(csv.DictReader(file))


def means(dimension):
    """{(engine, radius): the mean time for each seed}, and the mean path of each radius."""
    found, paths = {}, {}
    for row in rows_of(f"times-{dimension}d.csv"):
        found.setdefault((row["engine"], float(row["radius"])), []).append(float(row["ns_mean"]))
        paths.setdefault(float(row["radius"]), []).append(float(row["path_mean"]))
    return found, {r: statistics.mean(lengths) for r, lengths in paths.items()}


def slope(points):
    """By least squares on logarithms."""
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    x, y = statistics.mean(xs), statistics.mean(ys)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / sum((a - x) ** 2 for a in xs), x, y


def radii_of(found, engine):
    return sorted(r for name, r in found if name == engine)


FITTED = 0.1  # the largest radius of fits


def exponents(dimension, engine):
    """The exponent of each seed."""
    found, _ = means(dimension)
    radii = [r for r in radii_of(found, engine) if r <= FITTED]
    return [slope([(r, found[engine, r][i]) for r in radii])[0] for i in range(len(SEEDS))]


def crossings(dimension):
    """Below which radius `published` is faster than `classical`, for each seed."""
    found, _ = means(dimension)
    radii = radii_of(found, "classical")
    for i in range(len(SEEDS)):
        ratios = [math.log(found["classical", r][i] / found["published", r][i]) for r in radii]
        below = max(k for k in range(len(radii)) if ratios[k] > 0)
        if below == len(radii) - 1:
            yield radii[-1]
            continue
        share = ratios[below] / (ratios[below] - ratios[below + 1])
        yield math.exp(math.log(radii[below]) + share * math.log(radii[below + 1] / radii[below]))


def interval(numbers):
    """Their mean, and its 95 % interval by Student's distribution with 4 degrees."""
    half = 2.776 * statistics.stdev(numbers) / math.sqrt(len(numbers))
    return statistics.mean(numbers), half


def per_cell(dimension, engine):
    """The mean time in a cell, for each radius. A path crosses 4 / pi cells (2D) or 3 / 2 (3D) for each unit of its length."""
    found, paths = means(dimension)
    cells = 4 / math.pi if dimension == 2 else 1.5
    return [(r, statistics.mean(found[engine, r]) / (paths[r] * cells)) for r in radii_of(found, engine)]
