"""Pictures, with Matplotlib: a scene with flights, paths, free paths. Each draws into axes and returns them.

    ax = lorentz.plot.scene("honeycomb")
    lorentz.plot.flights("honeycomb", x, v, answers, ax=ax)
    ax.figure.savefig("honeycomb.svg")
"""

from __future__ import annotations

from itertools import product
from typing import Any, Iterator

import matplotlib.pyplot as plt
import numpy as np
import numpy.typing as npt
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.patches import Ellipse

from ._first_hit import Outcome
from ._flights import FreePaths
from ._lorentz import Answers, Error, Paths
from ._numbers import finite
from ._scene import Scene, SceneLike

__all__ = ["flights", "free_paths", "scene", "survival", "trajectory"]

#: Obstacles of lattice 0, 1, ..; lines are drawn in the other colours.
OBSTACLES = ("#9db4c8", "#d8b48c", "#a9c9a4", "#c9a9c6")
FLIGHT, HIT = "#b3362b", "#202020"
MOST_OBSTACLES = 20_000

Box = tuple[float, float, float, float]


def scene(of: SceneLike, box: Box | None = None, *, ax: Any = None) -> Any:
    """The obstacles of a 2D scene in ``box`` = (x low, x high, y low, y high), else around some cells; each at
    least a dot."""
    place = _flat(of)
    limits = _around_cells(place) if box is None else _box(box)
    ax = _axes(ax)
    for number, lattice in enumerate(place.nearest().to_dict()["lattices"]):
        patches = list(_obstacles(lattice, limits))
        colour = OBSTACLES[number % len(OBSTACLES)]
        ax.add_collection(PatchCollection(patches, facecolor=colour, edgecolor="none", zorder=1))
        centres = np.reshape([patch.center for patch in patches], (-1, 2))
        ax.scatter(*centres.T, s=4, color=colour, linewidths=0, zorder=1)
    ax.set_xlim(limits[0], limits[1])
    ax.set_ylim(limits[2], limits[3])
    ax.set_aspect("equal")
    return ax


def flights(of: SceneLike, x: npt.ArrayLike, v: npt.ArrayLike, answers: Answers, *, ax: Any = None,
            longest: float = 40.0) -> Any:
    """Flights of a 2D scene (N at most some hundred) up to their hits; what is longer than ``longest``, or never
    ends, is cut and dashed. Without axes the scene is drawn, too."""
    starts, velocities = np.reshape(np.asarray(x, float), (-1, 2)), np.reshape(np.asarray(v, float), (-1, 2))
    if not isinstance(answers, Answers) or not len(answers) == len(starts) == len(velocities):
        raise Error(f"answers: needs the Answers to these {len(starts)} queries")
    lengths = np.linalg.norm(velocities, axis=1)
    hits = answers.outcome == Outcome.HIT
    shown = np.where(hits, np.minimum(answers.time * lengths, longest), longest)
    ends = starts + velocities * (shown / lengths)[:, None]
    flown = np.isin(answers.outcome, (Outcome.HIT, Outcome.NEVER, Outcome.LATER))
    whole = hits & (shown < longest)
    if ax is None:
        ax = scene(of, _around(np.concatenate([starts, ends[flown]])) if len(starts) else None)
    for mask, style in ((whole, "solid"), (flown & ~whole, "dashed")):
        lines = np.stack([starts[mask], ends[mask]], axis=1)
        ax.add_collection(LineCollection(list(lines), colors=FLIGHT, linestyles=style, linewidths=1, zorder=2))
    ax.plot(*starts.T, ".", color=FLIGHT, markersize=4, zorder=3)
    ax.plot(*ends[whole].T, ".", color=HIT, markersize=4, zorder=3)
    return ax


def trajectory(of: SceneLike, start: npt.ArrayLike, paths: Paths, particle: int = 0, *, ax: Any = None) -> Any:
    """The path of one particle in 2D, from its start through its collisions; without axes with the scene."""
    if not 0 <= particle < len(paths):
        raise Error(f"particle: there is no {particle}; there are {len(paths)}, from 0 on")
    count = int(paths.count[particle])
    points = np.concatenate([np.reshape(np.asarray(start, float), (1, 2)), paths.place[particle, :count]])
    if ax is None:
        ax = scene(of, _around(points))
    ax.plot(*points.T, "-", color=FLIGHT, linewidth=1, zorder=2)
    ax.plot(*points[1:].T, ".", color=HIT, markersize=4, zorder=3)
    ax.plot(*points[0], "o", color=FLIGHT, markersize=5, zorder=3)
    return ax


def free_paths(paths: FreePaths, *, ax: Any = None) -> Any:
    """The density of free paths on logarithmic axes, from counts."""
    ax = _axes(ax)
    density = paths.density()
    seen = density > 0
    middle = np.sqrt(paths.edges[1:] * paths.edges[:-1])
    ax.loglog(middle[seen], density[seen], ".", color=FLIGHT, markersize=4, label=_label(paths))
    ax.set_xlabel("free path t")
    ax.set_ylabel("density")
    ax.legend(frameon=False)
    return ax


def survival(paths: FreePaths, *, ax: Any = None) -> Any:
    """P(path > t) on logarithmic axes, with the laws that theory has of the scene."""
    ax = _axes(ax)
    measured = paths.survival()
    seen = (measured > 0) & (measured < 1)
    t = paths.edges[seen]
    for number, (name, law) in enumerate(paths.laws().items()):
        ax.loglog(t, law[seen], "-", color="#404040", alpha=1 / (number + 1), linewidth=1, label=name)
    ax.loglog(t, measured[seen], ".", color=FLIGHT, markersize=4, label=_label(paths))
    ax.set_xlabel("t")
    ax.set_ylabel("P(free path > t)")
    ax.legend(frameon=False)
    return ax


def _label(paths: FreePaths) -> str:
    return f"{paths.count:.3g} flights"


def _axes(ax: Any) -> Any:
    return plt.subplots(layout="constrained")[1] if ax is None else ax


def _flat(of: SceneLike) -> Scene:
    place = of if isinstance(of, Scene) else Scene(of)
    if place.dimension != 2:
        raise Error("pictures are of two dimensions; `lorentz scene draw` has those of three")
    return place


def _box(box: Any) -> Box:
    numbers = [finite(number, "box") for number in box]
    if len(numbers) != 4 or not (numbers[0] < numbers[1] and numbers[2] < numbers[3]):
        raise Error(f"box: {box!r} is not x low, x high, y low, y high")
    return numbers[0], numbers[1], numbers[2], numbers[3]


def _around(points: npt.NDArray[np.float64]) -> Box:
    low, high = points.min(axis=0), points.max(axis=0)
    margin = max(0.05 * float(np.max(high - low)), 0.5)
    return float(low[0]) - margin, float(high[0]) + margin, float(low[1]) - margin, float(high[1]) + margin


def _around_cells(place: Scene) -> Box:
    vectors = np.array(place.nearest().to_dict()["lattices"][0]["vectors"])
    return _around(np.array([n * vectors[0] + m * vectors[1] for n, m in product((-2, 2), repeat=2)]))


def _obstacles(lattice: dict[str, Any], box: Box) -> Iterator[Ellipse]:
    """Those of a lattice that reach into the box."""
    vectors = np.array(lattice["vectors"])
    for atom in lattice["atoms"]:
        position = np.array(atom["position"])
        width, height, angle = _shape(atom)
        reach = max(width, height) / 2
        for cell in _cells(vectors, position, box, reach):
            yield Ellipse(tuple(position + cell @ vectors), width, height, angle=angle)


def _cells(vectors: npt.NDArray[np.float64], position: npt.NDArray[np.float64], box: Box,
           reach: float) -> npt.NDArray[np.int64]:
    """Cells (K, 2) whose obstacle's centre is at most ``reach`` outside of the box."""
    corners = np.array([(a, b) for a in box[:2] for b in box[2:]], float)
    corners += reach * np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)])
    coordinates = (corners - position) @ np.linalg.inv(vectors)
    low, high = np.floor(coordinates.min(axis=0)), np.ceil(coordinates.max(axis=0))
    if np.prod(high - low + 1) > MOST_OBSTACLES:
        raise Error(f"box: has more than {MOST_OBSTACLES} cells; draw a smaller one")
    cells = np.array(list(product(*(range(int(a), int(b) + 1) for a, b in zip(low, high)))))
    centres = position + cells @ vectors
    inside = ((centres >= corners[0]) & (centres <= corners[3])).all(axis=1)
    kept: npt.NDArray[np.int64] = cells[inside]
    return kept


def _shape(atom: dict[str, Any]) -> tuple[float, float, float]:
    """Width, height and angle in degrees of a disc or an ellipse."""
    if "radius" in atom:
        return 2 * atom["radius"], 2 * atom["radius"], 0.0
    turned, sizes, _ = np.linalg.svd(np.array(atom["semiaxes"]).T)
    return 2 * sizes[0], 2 * sizes[1], float(np.degrees(np.arctan2(turned[1, 0], turned[0, 0])))
