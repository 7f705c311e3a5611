"""Counts of large numbers of free flights, the theory for them, and the channels that are never blocked."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _lorentz
from ._answers import Floats
from ._columns import same
from ._first_hit import floats_of
from ._lorentz import Error, FileError
from ._numbers import finite, whole, word
from ._scene import Scene, SceneLike, common_radius, native


def _known(number: float | None) -> float:
    return math.nan if number is None else float(number)


@dataclass(frozen=True, repr=False, eq=False)
class FreePaths:
    """The statistics of many free flights. Lengths are in the scene's unit; the speed is 1.

    ``edges`` (K,): the edges of logarithmic bins, eight per octave; ``counts`` (K + 1,): flights below the
    first edge, in each bin, and beyond the last edge; ``beyond`` (K,): flights longer than each edge.
    ``report`` is the report of `lorentz flights --json`: mean, its error, the exact mean, laws and their
    fits, tails. `to_frame` and `save` give the bins as a table; ``pickle`` keeps the whole result.
    """

    scene: Scene
    start: str
    edges: Floats
    counts: npt.NDArray[np.uint64]
    beyond: npt.NDArray[np.uint64]
    report: dict[str, Any]

    @property
    def count(self) -> int:
        """The number of flights."""
        return int(self.report["count"])

    @property
    def mean(self) -> float:
        """The mean of the flights that end; nan if no flight ends. If the exact mean is infinite, as with open
        corridors for ``uniform`` starts, ``report["mean_remark"]`` says so."""
        return _known(self.report["mean"])

    @property
    def mean_error(self) -> float:
        """One standard error of the mean, statistical only; nan for fewer than two flights. It is too small
        where the exact variance is infinite: ``report["mean_remark"]`` says so."""
        return _known(self.report["mean_error"])

    def survival_function(self) -> Floats:
        """P(path > t) at ``edges``, shape (K,)."""
        return self.beyond / max(self.count - int(self.report["undecided"]), 1)

    @property
    def mean_free_path(self) -> float | None:
        """The exact mean between collisions, that is, for starts on the obstacles (``surface``), whatever the
        starts of these flights are; None if no formula is known."""
        return mean_free_path(self.scene)

    def density(self) -> Floats:
        """The density of the path in each bin between two edges, shape (K - 1,)."""
        return self.counts[1:-1] / (max(self.count - int(self.report["undecided"]), 1) * np.diff(self.edges))

    def laws(self) -> dict[str, Floats]:
        """P(path > t) at ``edges`` by each known law for the scene, by name."""
        return laws(self.scene, self.edges, start=self.start)

    def to_dict(self) -> dict[str, Any]:
        """The single numbers of the report, as one row of a table."""
        row = single_numbers(self.report)
        return {"start": row.pop("from")} | row

    def to_frame(self) -> Any:
        """The bins as a pandas DataFrame, one row for each bin with a flight. Its columns are those of
        `lorentz flights --csv`: ``from`` and ``to``, the edges; ``count``; ``density`` and ``density_error``, one
        standard error; ``survival_at_to``, the share of flights longer than ``to``; and for each law, under its
        name, ``LAW: density`` and ``LAW: survival_at_to``. pandas must be installed."""
        import pandas

        return pandas.DataFrame(self._bins())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the bins to a file whose name ends in ``.csv``, or the report to one that ends in ``.json``. A
        file of this name is replaced.

        The forms are those of `lorentz flights --csv` and ``--json`` (docs/formats.md). The bins are the
        logarithmic ones: ``pandas.read_csv``, ``csv.DictReader`` and ``numpy.genfromtxt`` read them. The report
        also has ``radius``, null if the obstacles differ; ``json.load`` reads it.

        Raises Error if the name ends otherwise, FileError if the file cannot be written.
        """
        if not isinstance(path, (str, os.PathLike)):
            raise Error(f"path: {path!r} is not the name of a file")
        name = os.fspath(path)
        if name.endswith(".csv"):
            text = _csv({"bins": np.full(np.count_nonzero(self.counts), "logarithmic")} | self._bins())
        elif name.endswith(".json"):
            radius = common_radius(self.scene)
            text = json.dumps({"scene": self.report["scene"], "radius": radius} | self.report) + "\n"
        else:
            raise Error(f"path: {name!r} ends neither in .csv (the bins) nor in .json (the report)")
        try:
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        except OSError as error:
            raise FileError(f"path: {name!r} cannot be written: {error.strerror}") from None

    def _bins(self) -> dict[str, npt.NDArray[Any]]:
        """The columns of the bins that have flights, from 0 to infinity. The last bin has no density."""
        edges = np.array([0, *self.edges, math.inf])
        total, width = max(self.count - int(self.report["undecided"]), 1), np.diff(edges)
        columns = {"density": self.counts / total / width, "density_error": np.sqrt(self.counts) / total / width,
                   "survival_at_to": np.append(self.beyond, 0) / total}
        for law, survival in laws(self.scene, edges[:-1], start=self.start).items():
            name = law.replace(",", ";")  # as in a file
            columns |= {f"{name}: density": -np.diff(survival, append=0) / width,
                        f"{name}: survival_at_to": np.append(survival[1:], 0)}
        for column in columns.values():
            column[-1] = math.nan
        seen, bins = np.flatnonzero(self.counts), {"from": edges[:-1], "to": edges[1:], "count": self.counts}
        return {name: column[seen] for name, column in (bins | columns).items()}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, FreePaths) and same(vars(self), vars(other))

    def __repr__(self) -> str:
        text = f"FreePaths({self.count} flights, start={self.start!r}, mean {self.mean:.6g} +- {self.mean_error:.2g})"
        remark = self.report.get("mean_remark")
        return f"{text}\n  {remark}" if remark else text


def _csv(columns: dict[str, npt.NDArray[Any]]) -> str:
    """A table with a header, in the form of the command line: numbers in the fewest digits, nothing for nan."""
    rows = zip(*(column.tolist() for column in columns.values()))
    lines = [",".join("" if field != field else str(field).removesuffix(".0") for field in row) for row in rows]
    return "\n".join([",".join(columns), *lines, ""])


def report_of(text: str, scene: Scene) -> dict[str, Any]:
    """The report in a text of JSON. Its ``scene`` is the name of the scene; None if it has none."""
    report: dict[str, Any] = json.loads(text)
    return report | {"scene": scene._name}


def single_numbers(report: dict[str, Any]) -> dict[str, Any]:
    """The members of a report for a table: numbers and texts, without lists."""
    return {key: value for key, value in report.items() if key != "scene" and not isinstance(value, (list, dict))}


def flights(scene: SceneLike, radius: float | None = None, *, count: int = 1_000_000, start: str = "uniform",
            seed: int = 20161115, engine: str = "batch", jobs: int = 1) -> FreePaths:
    """Flies drawn starts and counts free paths, in constant memory: 10^7 flights per second and thread in 2D.

    Args:
        scene, radius: as in `lorentz.first_hit`.
        count: the number of flights.
        start: ``uniform`` (anywhere, in any direction), or ``surface`` (on an obstacle, by the cosine law:
            paths between collisions). Their means differ: `mean_free_path` is that of ``surface``.
        seed: start n depends only on scene, start, seed and n.
        engine: ``batch`` leaves a few flights undecided and counts them; ``certified-batch`` leaves none.
        jobs: the number of threads; the counts do not depend on it.

    Source: docs/free_paths.md. Raises Error if the scene leaves no free space or the engine cannot fly it.
    """
    place = Scene(scene, radius)
    report, edges, counts, beyond = _lorentz.flights(
        native(place), whole(count, "count", 1, 2**52), word(start, "start"), whole(seed, "seed", 0, 2**64 - 1),
        word(engine, "engine"), whole(jobs, "jobs", 1, 1024))
    return FreePaths(place, start, edges, counts, beyond, report_of(report, place))


def laws(scene: SceneLike, times: npt.ArrayLike, *, start: str = "uniform") -> dict[str, Floats]:
    """P(path > t) by each known law for the scene, by name, in the shape of `times`; empty without a law."""
    t = floats_of(times, "times")
    return {name: np.asarray(survival) for name, survival in _lorentz.laws(native(scene), word(start, "start"), t)}


def mean_free_path(scene: SceneLike, radius: float | None = None) -> float | None:
    """The mean free path between collisions, exact up to rounding; None if no formula is known."""
    return _lorentz.mean_free_path(native(Scene(scene, radius)))


def horizon(scene: SceneLike, radius: float | None = None, *, min_width: float = 0.0,
            cylinders: bool = True) -> dict[str, Any]:
    """The infinite channels that a scene leaves open, decided exactly (docs/horizon.md).

    Returns the report of `lorentz horizon --json`: ``horizon`` ("finite", "infinite" or "undecided"),
    ``channels`` with their widths, ``cylinders`` in 3D, ``tail_constant`` C in P(path > t) ~ C / t; and
    ``verdict``, a summary in words.

    Args:
        min_width: the least width of the corridors and planar channels to find.
        cylinders: search for cylindrical channels, too (3D; this is the longer search among small obstacles).

    Raises:
        Error: the obstacles are so small that there are too many channels to list, or the scene is not a
            crystal.
    """
    if not finite(min_width, "min_width") >= 0:
        raise Error(f"min_width: {min_width} is below 0")
    place = Scene(scene, radius)
    text, verdict = _lorentz.horizon(native(place), min_width, cylinders)
    return report_of(text, place) | {"verdict": verdict}
