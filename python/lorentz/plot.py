"""Pictures with Matplotlib: a scene with flights, paths, free paths. Each draws into axes and returns them.

    ax = lorentz.plot.scene("honeycomb")
    lorentz.plot.flights("honeycomb", x, v, answers, ax=ax)
    ax.set_title("Honeycomb")
    ax.figure.savefig("honeycomb.pdf")  # or .svg, .png

For axes of other sizes pass ``plt.subplots(figsize=(4, 3))[1]`` as ``ax``. Matplotlib is imported by the first
picture; without it a picture raises ImportError.
"""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._answers import Answers, Floats, Outcome
from ._first_hit import floats_of, vectors_of
from ._flights import FreePaths
from ._lorentz import Error
from ._numbers import Obstacle, finite
from ._paths import Itinerary, Paths
from ._scene import Scene, SceneLike, common_radius, scene_of
from ._statistics import Diffusion

if TYPE_CHECKING:
    from matplotlib.patches import Ellipse

__all__ = ["density", "displacements", "flights", "scene", "survival_function", "trajectory"]

#: Colours of the obstacles of lattice 0, 1, ..; lines have the other colours.
OBSTACLES = ("#9db4c8", "#d8b48c", "#a9c9a4", "#c9a9c6")
FLIGHT, HIT = "#b3362b", "#202020"
COLOURS = ("#b3362b", "#2b62b3", "#3a8a4d", "#8a5ba8", "#b37f2b", "#2b9a9a")
MOST_OBSTACLES = 20_000
#: The fewest flights of a point of `density`.
FLIGHTS_OF_A_POINT = 10

Box = tuple[float, float, float, float]
#: One run of flights, or several in one figure.
Runs = Union[FreePaths, Sequence[FreePaths]]


def __dir__() -> list[str]:
    return __all__


def scene(of: SceneLike, box: Box | None = None, *, ax: Any = None) -> Any:
    """The obstacles of a 2D scene in ``box`` = (x low, x high, y low, y high), or around several cells
    without a box. Each obstacle is at least a dot."""
    place = _flat(of)
    limits = _around_cells(place) if box is None else _box(box)
    ax = _axes(ax)
    from matplotlib.collections import PatchCollection

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
    """Flights of a 2D scene (N at most several hundred) up to their hits. ``x`` and ``v`` are those that
    `lorentz.first_hit` answered, of shape (N, 2) or (2,). Flights that are longer than ``longest``, or never
    end, are cut and dashed. Without axes the scene is drawn, too."""
    starts, velocities = vectors_of(x, v, _flat(of).dimension)
    if not isinstance(answers, Answers) or len(answers) != len(starts):
        raise Error(f"answers: needs the Answers to these {len(starts)} queries")
    lengths = np.linalg.norm(velocities, axis=1)
    hits = answers.outcome == Outcome.HIT
    shown = np.where(hits, np.minimum(answers.time * lengths, longest), longest)
    ends = starts + velocities * (shown / lengths)[:, None]
    flown = np.isin(answers.outcome, (Outcome.HIT, Outcome.NEVER, Outcome.LATER))
    whole = hits & (shown < longest)
    if ax is None:
        ax = scene(of, _around(np.concatenate([starts, ends[flown]])) if len(starts) else None)
    from matplotlib.collections import LineCollection

    for mask, style in ((whole, "solid"), (flown & ~whole, "dashed")):
        lines = np.stack([starts[mask], ends[mask]], axis=1)
        ax.add_collection(LineCollection(list(lines), colors=FLIGHT, linestyles=style, linewidths=1, zorder=2))
    ax.plot(*starts.T, ".", color=FLIGHT, markersize=4, zorder=3)
    ax.plot(*ends[whole].T, ".", color=HIT, markersize=4, zorder=3)
    return ax


def trajectory(of: SceneLike | Itinerary, start: npt.ArrayLike = (), paths: Paths | None = None, particle: int = 0,
               *, ax: Any = None) -> Any:
    """The path of one particle, from its start (or the common start) through the kept collisions. Or an
    itinerary, given alone, that was followed with ``states=True``. Without axes it is drawn with the scene in
    2D, and with the obstacles that it hits in 3D."""
    if isinstance(of, Itinerary):
        place, points, met = of.scene, np.concatenate([[of.start], of.place]), {one.obstacle for one in of.collisions}
    else:
        place, points, met = _flown(scene_of(of), start, paths, particle)
    if ax is None:
        ax = scene(place, _around(points)) if place.dimension == 2 else _met_in_space(place, met)
    ax.plot(*points.T, "-", color=FLIGHT, linewidth=1, zorder=2)
    ax.plot(*points[1:].T, ".", color=HIT, markersize=4, zorder=3)
    ax.plot(*points[:1].T, "o", color=FLIGHT, markersize=5, zorder=3)
    return ax


def _flown(place: Scene, start: npt.ArrayLike, paths: Paths | None, particle: int) -> tuple[Scene, Floats, set[Obstacle]]:
    """The scene, the start and the places of the collisions, and the obstacles that are hit."""
    if not isinstance(paths, Paths):
        raise Error("paths: needs the Paths of lorentz.trajectories; an Itinerary is drawn alone")
    if not 0 <= particle < len(paths):
        raise Error(f"particle: there is no {particle}; there are {len(paths)}, from 0 on")
    kept = int(paths.kept()[particle])
    starts, dimension = np.atleast_2d(floats_of(start, "start")), paths.dimension
    if place.dimension != dimension:
        raise Error(f"paths: are in {dimension}D, the scene is in {place.dimension}D")
    if starts.shape not in ((1, dimension), (len(paths), dimension)):
        raise Error(f"start: has the shape {np.shape(start)}, needs ({dimension},) or ({len(paths)}, {dimension})")
    points = np.concatenate([starts[[particle if len(starts) > 1 else 0]], paths.place[particle, :kept]])
    met = zip(paths.lattice[particle, :kept], paths.atom[particle, :kept], paths.cell[particle, :kept].tolist())
    return place, points, {(int(lattice), int(atom), tuple(cell)) for lattice, atom, cell in met}


def density(runs: Runs, *, ax: Any = None) -> Any:
    """The density of free paths on logarithmic axes, from counts, with the known laws for each scene as lines.
    Each of several runs has its own colour. The title has the scene, the radius and the starts, as far as the
    runs share them; the legend has what differs.

    A point is the density in a bin, at the geometric mean of its edges. Neighbouring bins are joined until each
    has 10 flights, because a bin of one flight among empty ones would be drawn too high. The vertical bar is
    one standard error, that of Poisson's distribution: the density of n flights is known up to a factor of
    1 +- 1/sqrt(n). The bar of a single flight, if there are no more, reaches down to the axis. The horizontal
    bar is the width of the bin. Laws are averaged over the same bins (`FreePaths.laws`).

    Args:
        runs: a result of `lorentz.flights`, or several. Lengths are in the unit of their scenes.
        ax: the axes to draw into; a title that they have stays. None: new ones.

    Returns the axes. Raises Error if ``runs`` are not results of `lorentz.flights`.
    """
    labelled, title = _labelled(runs)
    ax = _logarithmic(ax)
    for number, (run, label) in enumerate(labelled):
        cuts = _cuts(run)
        edges, total = run.edges[cuts], max(run.count - int(run.report["undecided"]), 1)
        low, high = edges[:-1], edges[1:]
        flights_in = -np.diff(run.beyond[cuts].astype(float))
        measured, middle = flights_in / (total * (high - low)), np.sqrt(low * high)
        _draw_law(ax, labelled, number, middle, lambda law: -np.diff(law[cuts]) / (high - low))
        ax.errorbar(middle, measured, measured / np.sqrt(flights_in), [middle - low, high - middle], fmt=".",
                    color=_colour(number), markersize=4, elinewidth=0.8, label=label)
    return _explained(ax, "free path t", "density", title)


def survival_function(runs: Runs, *, ax: Any = None) -> Any:
    """P(path > t) on logarithmic axes, with the known laws for each scene as lines. Colours, title, legend and
    errors are those of `density`."""
    labelled, title = _labelled(runs)
    ax = _logarithmic(ax)
    for number, (run, label) in enumerate(labelled):
        measured = run.survival_function()
        seen = (measured > 0) & (measured < 1)
        _draw_law(ax, labelled, number, run.edges[seen], lambda law: law[seen])
        ax.plot(run.edges[seen], measured[seen], ".", color=_colour(number), markersize=4, label=label)
    return _explained(ax, "t", "P(free path > t)", title)


def displacements(found: Diffusion, *, ax: Any = None) -> Any:
    """MSD / (2 d t) over time, with standard errors. It is level if there is a diffusion coefficient."""
    _check_kind(found, Diffusion)
    ax = _axes(ax)
    scale = 2 * found.scene.dimension * found.times
    values = [np.array([np.nan if number is None else number for number in column]) / scale
              for column in zip(*found.displacements)]
    ax.errorbar(found.times, values[0], values[1], fmt=".-", color=FLIGHT, linewidth=1, capsize=2)
    ax.set_xscale("log")
    ax.set_xlabel("t")
    ax.set_ylabel(f"MSD / ({2 * found.scene.dimension} t)")
    return ax


def _check_kind(found: Any, kind: type) -> None:
    if not isinstance(found, kind):
        raise Error(f"found: needs what lorentz.{kind.__name__.lower()} returns, one of it; got {type(found).__name__}")


def _cuts(run: FreePaths) -> npt.NDArray[np.int64]:
    """The numbers of the edges among which each bin has `FLIGHTS_OF_A_POINT` flights; empty without a flight."""
    flown = np.flatnonzero(run.counts[1:-1])
    if not len(flown):
        return flown
    cuts, flights_since = [int(flown[0])], 0
    for i in flown.tolist():
        flights_since += int(run.counts[1 + i])
        if flights_since >= FLIGHTS_OF_A_POINT:
            cuts.append(i + 1)
            flights_since = 0
    return np.array([*cuts[:max(len(cuts) - 1, 1)], int(flown[-1]) + 1])  # the last bin takes the rest


def _labelled(runs: Runs) -> tuple[list[tuple[FreePaths, str]], str]:
    """Each run with its label: scene, radius, start, seed, engine, as far as they differ, or the number of
    flights; and a title: scene, radius and start as far as they do not."""
    several = [runs] if isinstance(runs, FreePaths) or not isinstance(runs, Iterable) else list(runs)
    if not several or not all(isinstance(run, FreePaths) for run in several):
        raise Error("runs: needs what lorentz.flights returns, one or a list")
    facts = [_facts(run, number) for number, run in enumerate(several, 1)]
    differ = [any(one[k][0] != first[0] for one in facts) for k, first in enumerate(facts[0])]
    labels = [", ".join(text for (_, text), other in zip(one, differ) if other and text) for one in facts]
    common = [several[0].scene._name, facts[0][1][1], f"{several[0].start} starts"]
    title = ", ".join(text for text, other in zip(common, differ) if text and not other)
    counts = [f"{run.count:.3g} flight{'s' * (run.count > 1)}" for run in several]
    return [(run, label or count) for run, label, count in zip(several, labels, counts)], title


def _facts(run: FreePaths, number: int) -> list[tuple[Any, str]]:
    """What may tell a run from others: values to compare, with their texts."""
    radius, seed, engine = common_radius(run.scene), run.report["seed"], run.report["engine"]
    alike = run.scene if radius is None else Scene(run.scene, 1)  # whatever the radius is
    return [(alike, run.scene._name or f"scene {number}"), (radius, "" if radius is None else f"r = {float(radius):g}"),
            (run.start, run.start), (seed, f"seed {seed}"), (engine, engine)]


def _colour(number: int) -> str:
    return COLOURS[number % len(COLOURS)]


def _met_in_space(place: Scene, met: set[Obstacle]) -> Any:
    """3D axes with these obstacles."""
    ax = _pyplot().figure(layout="constrained").add_subplot(projection="3d")
    lattices = place.nearest().to_dict()["lattices"]
    turn, tilt = np.meshgrid(np.linspace(0, 2 * np.pi, 25), np.linspace(0, np.pi, 13))
    sphere = np.stack([np.cos(turn) * np.sin(tilt), np.sin(turn) * np.sin(tilt), np.cos(tilt)])
    for lattice, atom, cell in sorted(met):
        obstacle, vectors = lattices[lattice]["atoms"][atom], np.reshape(lattices[lattice]["vectors"], (-1, 3))
        centre = np.asarray(obstacle["position"], float) + np.asarray(cell[:len(vectors)], float) @ vectors
        axes = obstacle["radius"] * np.eye(3) if "radius" in obstacle else np.transpose(obstacle["semiaxes"])
        surface = centre[:, None, None] + np.tensordot(axes, sphere, 1)
        ax.plot_surface(*surface, color=OBSTACLES[lattice % len(OBSTACLES)], alpha=0.5, linewidth=0)
    ax.set_aspect("equal")
    return ax


def _pyplot() -> Any:
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("lorentz.plot needs Matplotlib: pip install matplotlib, or on Debian apt-get install "
                          f"python3-matplotlib ({error})") from None
    return matplotlib.pyplot


def _axes(ax: Any) -> Any:
    return _pyplot().subplots(layout="constrained")[1] if ax is None else ax


def _logarithmic(ax: Any) -> Any:
    ax = _axes(ax)
    ax.set_xscale("log")
    ax.set_yscale("log")
    return ax


def _draw_law(ax: Any, labelled: list[tuple[FreePaths, str]], number: int, t: Floats,
              drawn: Callable[[Floats], Floats]) -> None:
    """The law for the run of this number, if one is known. The legend has one line for the laws of all runs."""
    names = {f"{law['name']}, {law['when']}" for run, _ in labelled for law in run.report["theory"]}
    label = names.pop() if len(names) == 1 else "limit laws"
    named = {line.get_label() for line in ax.lines}
    for survival in labelled[number][0].laws().values():
        ax.plot(t, drawn(survival), "-", color=_colour(number), alpha=0.6, linewidth=1.5,
                label=None if label in named else label)


def _explained(ax: Any, x: str, y: str, title: str) -> Any:
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.set_title(ax.get_title() or title)
    ax.legend(frameon=False)
    return ax


def _flat(of: SceneLike) -> Scene:
    place = scene_of(of)
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
    lattice = place.nearest().to_dict()["lattices"][0]
    vectors = np.reshape(lattice["vectors"], (-1, 2))
    return _around(lattice["atoms"][0]["position"] + np.array(list(product((-2, 2), repeat=len(vectors)))) @ vectors)


def _obstacles(lattice: dict[str, Any], box: Box) -> Iterator[Ellipse]:
    """The obstacles of a lattice that reach into the box."""
    from matplotlib.patches import Ellipse

    vectors = np.reshape(lattice["vectors"], (-1, 2))
    for atom in lattice["atoms"]:
        position = np.array(atom["position"])
        width, height, angle = _shape(atom)
        reach = max(width, height) / 2
        for cell in _cells(vectors, position, box, reach):
            yield Ellipse(tuple(position + cell @ vectors), width, height, angle=angle)


def _cells(vectors: npt.NDArray[np.float64], position: npt.NDArray[np.float64], box: Box,
           reach: float) -> npt.NDArray[np.int64]:
    """The cells (K, 2), or (K, 1) of a row, of obstacles whose centre is at most ``reach`` outside the box."""
    corners = np.array([(a, b) for a in box[:2] for b in box[2:]], float)
    corners += reach * np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)])
    coordinates = (corners - position) @ np.linalg.pinv(vectors)  # of the nearest points of a row, if it is one
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
