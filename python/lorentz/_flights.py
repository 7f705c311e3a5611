"""Very many free flights, counted, with theory beside them; and the ways that are free for ever."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _lorentz
from ._answers import Floats
from ._first_hit import floats_of
from ._lorentz import Error
from ._numbers import Vector, finite, vector, whole, word
from ._scene import Scene, SceneLike, native


def _known(number: float | None) -> float:
    return math.nan if number is None else float(number)


@dataclass(frozen=True, repr=False, eq=False)
class FreePaths:
    """What many free flights came to. Lengths are in the scene's unit, the speed is 1.

    ``edges`` (K,): of logarithmic bins, eight an octave; ``counts`` (K + 1,): flights below the first edge, in
    each bin, beyond the last; ``beyond`` (K,): flights longer than each edge. ``report`` is what
    `lorentz flights --json` says: mean, its error, the exact mean, laws and how they fit, tails.
    """

    scene: Scene
    start: str
    edges: Floats
    counts: npt.NDArray[np.uint64]
    beyond: npt.NDArray[np.uint64]
    report: dict[str, Any]

    @property
    def count(self) -> int:
        """Flights that were flown."""
        return int(self.report["count"])

    @property
    def mean(self) -> float:
        """Of the flights that end; nan if none does."""
        return _known(self.report["mean"])

    @property
    def mean_error(self) -> float:
        """One standard error of it, by chance alone; nan of fewer than two flights."""
        return _known(self.report["mean_error"])

    def survival_function(self) -> Floats:
        """P(path > t) at ``edges``, shape (K,)."""
        return self.beyond / max(self.count - int(self.report["undecided"]), 1)

    @property
    def mean_free_path(self) -> float | None:
        """The exact mean from collision to collision, of starts on the obstacles (``surface``), whatever the starts of
        these flights are; None where no formula is known."""
        return mean_free_path(self.scene)

    def density(self) -> Floats:
        """Of the path, in each bin between two edges, shape (K - 1,)."""
        return self.counts[1:-1] / (max(self.count - int(self.report["undecided"]), 1) * np.diff(self.edges))

    def laws(self) -> dict[str, Floats]:
        """P(path > t) at ``edges`` by each law that theory has of the scene, by name."""
        return laws(self.scene, self.edges, start=self.start)

    def to_dict(self) -> dict[str, Any]:
        """The numbers of the report that are single: one row of a table."""
        row = single_numbers(self.report)
        return {"start": row.pop("from")} | row

    def __repr__(self) -> str:
        return f"FreePaths({self.count} flights, start={self.start!r}, mean {self.mean:.6g} +- {self.mean_error:.2g})"


def single_numbers(report: dict[str, Any]) -> dict[str, Any]:
    """What a table has of a report: numbers and texts, without lists of them."""
    return {key: value for key, value in report.items() if key != "scene" and not isinstance(value, (list, dict))}


def flights(scene: SceneLike, radius: float | None = None, *, count: int = 1_000_000, start: str = "uniform",
            seed: int = 20161115, engine: str = "batch", jobs: int = 1) -> FreePaths:
    """Flies drawn starts, and counts their free paths; constant memory, 10^7 flights a second and thread in 2D.

    Args:
        scene, radius: as of `lorentz.first_hit`.
        count: how many.
        start: ``uniform`` (anywhere, in any direction), or ``surface`` (off an obstacle by the cosine law:
            paths from collision to collision). Their means differ: `mean_free_path` is that of ``surface``.
        seed: start n depends on scene, start, seed and n alone.
        engine: ``batch`` leaves a few flights undecided and counts them; ``certified-batch`` leaves none.
        jobs: threads; the counts are the same.

    Source: docs/free_paths.md. Raises Error where the scene leaves nothing free, or the engine cannot fly it.
    """
    place = Scene(scene, radius)
    report, edges, counts, beyond = _lorentz.flights(
        native(place), whole(count, "count", 1, 2**52), word(start, "start"), whole(seed, "seed", 0, 2**64 - 1),
        word(engine, "engine"), whole(jobs, "jobs", 1, 1024))
    return FreePaths(place, start, edges, counts, beyond, json.loads(report))


def laws(scene: SceneLike, times: npt.ArrayLike, *, start: str = "uniform") -> dict[str, Floats]:
    """P(path > t) by each law that is known for the scene, by name, in the shape of `times`; an empty dict where none is known."""
    t = floats_of(times, "times")
    return {name: np.asarray(survival) for name, _, survival in _lorentz.laws(native(scene), word(start, "start"), t)}


def mean_free_path(scene: SceneLike, radius: float | None = None) -> float | None:
    """From collision to collision, exact up to rounding; None where no formula is known."""
    return _lorentz.mean_free_path(native(Scene(scene, radius)))[0]


def horizon(scene: SceneLike, radius: float | None = None, *, min_width: float = 0.0,
            cylinders: bool = True, direction: Vector | None = None) -> dict[str, Any]:
    """The infinite channels that a scene leaves open, decided exactly (docs/horizon.md).

    Returns what `lorentz horizon --json` says: ``horizon`` ("finite", "infinite" or "undecided"), ``channels``
    with their widths, ``cylinders`` in 3D, ``tail_constant`` C of P(path > t) ~ C / t; and ``verdict``, all of
    it in words. A scene of rows has no channels and no tail, but ``closed``: the arcs of directions that are closed.

    Args:
        min_width: only corridors and planar channels at least that wide.
        cylinders: search for cylindrical channels, too (3D; among small obstacles the longer search).
        direction: of a layer, three floats: whether a way is ``open`` in this direction; if so ``point`` and ``radius``
            are those of a cylinder in it, but in directions along the layer.

    Raises:
        Error: the obstacles are so small that there are too many channels to list, or the scene is unsupported
            (single obstacles, layers without a direction, crystals beside other lattices, rows in different directions).
    """
    if not finite(min_width, "min_width") >= 0:
        raise Error(f"min_width: {min_width} is below 0")
    place = Scene(scene, radius)
    if direction is not None:
        numbers = [finite(number, "direction") for number in vector(direction, "direction")]
        if len(numbers) != 3:
            raise Error(f"direction: has {len(numbers)} components, not 3")
        along: dict[str, Any] = json.loads(_lorentz.open_direction(native(place), numbers))
        return {key: value for key, value in along.items() if key != "scene"}
    text, verdict = _lorentz.horizon(native(place), min_width, cylinders)
    found: dict[str, Any] = json.loads(text)
    return {key: value for key, value in found.items() if key != "scene"} | {"verdict": verdict}
