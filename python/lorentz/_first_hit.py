"""First hits of arrays."""

from __future__ import annotations

from enum import IntEnum
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _lorentz
from ._lorentz import Answers, Error
from ._scene import SceneLike, native

Floats = npt.NDArray[np.float64]
#: What queries leave: None, one obstacle (lattice, atom, cell) of all, or columns of the three; a lattice
#: below 0 means none; or a list of N obstacles and None. Answers will do: then each query leaves what was hit.
StartFrom = Union[None, Answers, tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike], list[Any]]


class Outcome(IntEnum):
    """The codes of ``Answers.outcome`` (docs/formats.md)."""

    HIT = 0
    NEVER = 1
    INSIDE = 2
    LATER = 3
    UNDECIDED = 4
    ERROR = 5


class Engine:
    """An engine made ready for one scene: for who asks about it in many small arrays.

    Args:
        scene: whatever `Scene` takes.
        name: one of `engines`. ``batch`` is the fastest, and says UNDECIDED where it does not know;
            ``certified-batch`` is always exact, at nearly the same speed; ``oracle`` is the exact one.
        threads: for ``batch`` and ``certified-batch``; the answers are the same, to the bit.

    Any number of threads may use one; they wait for each other.

    Raises:
        Error: an unknown engine; a scene whose numbers are not all floats.
    """

    def __init__(self, scene: SceneLike, name: str = "batch", *, threads: int = 1) -> None:
        self._scene = native(scene)
        self._engine = _lorentz.Engine(self._scene, name, None, threads)

    def first_hit(self, x: npt.ArrayLike, v: npt.ArrayLike, *, max_time: npt.ArrayLike | None = None,
                  start_from: StartFrom = None, on_error: str = "raise", out: Answers | None = None) -> Answers:
        """As `lorentz.first_hit`, in this engine's scene.

        Args:
            out: Answers of as many queries, which are written over and returned, with what looks at them: new
                memory costs as much as some of the flights.
        """
        if on_error not in ("raise", "mark"):
            raise Error(f'on_error: "{on_error}" is none; there are "raise" and "mark"')
        positions, velocities = _vectors(x, "x"), _vectors(v, "v")
        count = len(positions)
        limits = None if max_time is None else np.broadcast_to(np.asarray(max_time, np.float64), (count,))
        return self._engine.first_hit(positions, velocities, limits,
                                      _columns(start_from, count, self._scene.dimension), on_error == "raise", out)


def first_hit(scene: SceneLike, x: npt.ArrayLike, v: npt.ArrayLike, radius: float | None = None, *,
              engine: str = "batch", threads: int = 1, max_time: npt.ArrayLike | None = None,
              start_from: StartFrom = None, on_error: str = "raise") -> Answers:
    """Which obstacle is hit first, and when?

    Args:
        scene: whatever `Scene` takes: a Scene, a dict, a file, a name of the catalogue.
        x: places, shape (N, d), in the scene's unit of length. Any layout; nothing is copied as a whole.
        v: velocities, shape (N, d), of any length but 0.
        radius: every ball gets this radius.
        engine, threads: as in `Engine`.
        max_time: a number, or shape (N,): the outcome is LATER where nothing is entered before.
        start_from: the obstacle that a query leaves, which it ignores: see `StartFrom`.
        on_error: ``"raise"``, or ``"mark"``: then a row that is no query has the outcome ERROR.

    Returns:
        Answers, in columns of N: ``outcome`` (codes of `Outcome`), ``lattice``, ``atom``, ``cell`` (N, d) of
        what is hit (or contains x), ``time`` in units in which x + t v is the place, NaN without a hit;
        ``time_is_rounded``: it is known to be correctly rounded; ``stage``: how it was decided
        (docs/formats.md). They are views of what the engine wrote, read-only. ``large_cells`` has the rows
        whose cells 64 bits do not hold, ``reasons`` why rows are errors, and whether only unsupported.

    Raises:
        Error: a row that is no query, by its number (``row 17: v is zero``); shapes that do not fit; an
            unknown engine.
    """
    from ._scene import Scene

    place = scene if radius is None else Scene(scene, radius)
    return Engine(place, engine, threads=threads).first_hit(x, v, max_time=max_time, start_from=start_from,
                                                            on_error=on_error)


def engines() -> list[str]:
    """The names of all engines."""
    return _lorentz.engines()


def _vectors(numbers: npt.ArrayLike, name: str) -> Floats:
    if isinstance(numbers, np.ma.MaskedArray):
        raise Error(f"{name}: is a masked array; fill it first")
    try:
        given = np.asarray(numbers)
        if given.dtype.kind in "cmM":
            raise TypeError(f"{given.dtype} is no type of real numbers")
        floats = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise Error(f"{name}: is no array of numbers: {error}") from None
    if given.dtype.kind in "iu" and given.dtype.itemsize == 8 and (abs(floats) >= 2.0**53).any():
        raise Error(f"{name}: has integers from 2**53 on, which floats may round; lorentz.oracle takes them as they are")
    return np.atleast_2d(floats)


def _columns(start_from: StartFrom, count: int, dimension: int) -> tuple[Any, Any, Any] | None:
    if start_from is None:
        return None
    if isinstance(start_from, Answers):
        if start_from.large_cells:
            raise Error(f"start_from: the cell of row {next(iter(start_from.large_cells))} does not fit 64 bits")
        left = np.where(start_from.outcome == Outcome.HIT, start_from.lattice, -1)
        return left.astype(np.int32), start_from.atom, start_from.cell
    if isinstance(start_from, list) and all(map(_is_obstacle_or_none, start_from)):
        return _columns(_columns_of(start_from, dimension), count, dimension)
    try:
        lattice, atom, cell = start_from
        return (np.broadcast_to(_integers(lattice, np.int32), (count,)),
                np.broadcast_to(_integers(atom, np.int32), (count,)),
                np.broadcast_to(_integers(cell, np.int64), (count, dimension)))
    except (TypeError, ValueError, OverflowError) as error:
        raise Error(f"start_from: needs lattice, atom, cell for {count} queries: {error}") from None


def _is_obstacle_or_none(row: Any) -> bool:
    return row is None or (isinstance(row, tuple) and len(row) == 3 and np.ndim(row[0]) == 0 and np.ndim(row[2]) == 1)


def _columns_of(rows: list[Any], dimension: int) -> Any:
    """Of a list of obstacles and None, as a judge's function gets it."""
    none = (-1, 0, (0,) * dimension)
    return tuple(np.array([(none if row is None else row)[k] for row in rows]) for k in range(3))


def _integers(numbers: npt.ArrayLike, kind: Any) -> npt.NDArray[Any]:
    array = np.asarray(numbers)
    if array.dtype.kind == "O":
        raise TypeError("there are integers beyond 64 bits, or other objects")
    if array.dtype.kind not in "iu":
        raise TypeError(f"{array.dtype} is no type of integers")
    return array.astype(kind, casting="same_kind", copy=False)
