"""Makes the figures of Kraemer, Kryukov and Sanders (2016) as figure-*.svg (docs/paper.md has the numbers).

    python3 docs/examples/paper_figures.py [FOLDER]

The first free flight among one, two and three superposed lattices; the first disc as a function of the
direction; the time of a query against the radius. Takes about twenty seconds.
"""

import sys
import time
from pathlib import Path

import lorentz
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

SEED = 20161115
LATTICES = ("square", "superposition-pi-5", "superposition-pi-5-pi-7")


def axes(x_label: str, y_label: str) -> Axes:
    ax = plt.subplots(figsize=(6, 4.2), layout="constrained")[1]
    ax.set_xlabel(x_label)
    ax.set_ylabel(y_label)
    return ax


def first_free_flight(count: int = 3_000_000, radius: float = 1e-4) -> Axes:
    """The densities, with their limit laws, and dashed the paper's lines: t^-2, t^-3, t^-4."""
    runs = [lorentz.flights(name, radius, count=count, seed=SEED) for name in LATTICES]
    ax: Axes = lorentz.plot.density(runs, ax=axes("", ""))
    for number, run in enumerate(runs, start=1):
        last = np.flatnonzero(run.counts[1:-1] >= 10)[-1]
        t, end = run.edges[last], run.density()[last] / 4
        ax.plot([t / 10, t], [end * 10 ** (number + 1), end], "k--", linewidth=1)
        ax.annotate(f"$t^{{-{number + 1}}}$", (t, end), ha="right", va="top")
    ax.set_xlim(1, None)
    return ax


def first_disc_over_directions(count: int = 90_000, radius: float = 0.1) -> Axes:
    """For the paper's example, x = (0, 0.445). Near discs hide most; far ones stand in corridors between."""
    degrees = np.linspace(0, 90, count, endpoint=False)
    v = np.column_stack([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    answers = lorentz.first_hit("square", [0, 0.445], v, radius)
    hits = answers.hit
    ax = axes("direction, degrees", "distance of the first disc")
    ax.semilogy(degrees[hits], answers.time[hits], ",", color=lorentz.plot.FLIGHT)
    ax.set_title(f"{len(np.unique(answers.cell[hits], axis=0))} discs")
    return ax


def time_against_radius(dimension: int = 2, count: int = 2000) -> Axes:
    """Mean times over the same drawn flights. The time of classical grows like 1 / r."""
    radii = np.geomspace(1e-1, 1e-3, 7)
    ax = axes("radius", "time of a query, s")
    for engine in ("classical", "published", "reduction", "batch", "oracle"):
        means = [mean_time(lorentz.unit_scene(dimension, radius), engine, count) for radius in radii]
        ax.loglog(radii, means, ".-", linewidth=1, label=engine)
    ax.legend(frameon=False)
    return ax


def mean_time(scene: lorentz.Scene, engine: str, count: int) -> float:
    x, v, _ = lorentz.draw_starts(scene, count, seed=SEED)
    ready = lorentz.Engine(scene, engine)
    ready.first_hit(x[:100], v[:100])
    begin = time.process_time()
    ready.first_hit(x, v)
    return (time.process_time() - begin) / count


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for figure in (first_free_flight, first_disc_over_directions, time_against_radius):
        file = folder / f"figure-{figure.__name__.replace('_', '-')}.svg"
        figure().figure.savefig(file)
        print(file)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
