"""First hits for arrays of queries."""

from __future__ import annotations

from typing import Any, Union, overload

import numpy as np
import numpy.typing as npt

from . import _card, _lorentz
from ._answer import Answer
from ._answers import Answers, Floats, Outcome
from ._card import CardAnswers, OnCard
from ._lorentz import Error
from ._numbers import Obstacle, integer, rational, renamed, whole, word
from ._scene import SceneLike, scene_of

#: The obstacles that queries leave: None, one obstacle (lattice, atom, cell) for all, columns of the three (a
#: lattice below 0 means none), or a list of N obstacles and None. With Answers, each query leaves the
#: obstacle that was hit.
StartFrom = Union[None, Answers, Answer, tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike], list[Any]]


class Engine:
    """An engine prepared for one scene. It saves time for many small arrays.

    Args:
        scene: anything that `Scene` takes.
        name: one of `engines`. ``certified-batch`` is always exact; ``batch`` is a little faster, but answers
            UNDECIDED if it cannot decide; ``oracle`` is the exact oracle; ``gpu`` is ``certified-batch`` on an
            NVIDIA card, and takes arrays in its memory (docs/gpu.md).
        jobs: the threads of ``batch``, ``certified-batch`` and ``gpu``. The answers are the same, to the bit.

    Any number of threads may use an engine.

    Raises:
        Error: the engine is unknown, or not all numbers of the scene are floats.
    """

    def __init__(self, scene: SceneLike, name: str = "certified-batch", *, jobs: int = 1) -> None:
        place = scene_of(scene)  # copies are made of it: a dict may change
        self._scene = place._scene
        self._arguments = place, name, jobs
        self._engine = _lorentz.Engine(self._scene, word(name, "engine"), None, whole(jobs, "jobs", 1, 1024))
        self._there: Any = None  # for arrays in a card's memory

    def __reduce__(self) -> Any:
        return _engine_of, self._arguments

    def __repr__(self) -> str:
        return f"Engine({self._engine.name!r}, {self._scene.dimension}D)"

    @overload
    def first_hit(self, x: OnCard, v: OnCard, *, max_time: OnCard | None = None,
                  start_from: CardAnswers | None = None, on_error: str = "raise") -> CardAnswers: ...

    @overload
    def first_hit(self, x: npt.ArrayLike, v: npt.ArrayLike, *, max_time: npt.ArrayLike | None = None,
                  start_from: StartFrom = None, on_error: str = "raise", out: Answers | None = None) -> Answers: ...

    @renamed("from", "start_from")
    def first_hit(self, x: Any, v: Any, *, max_time: Any = None, start_from: Any = None, on_error: str = "raise",
                  out: Answers | None = None) -> Answers | CardAnswers:
        """As `lorentz.first_hit`, for this engine's scene.

        Args:
            out: the result of an earlier call with the same number of queries. It is overwritten and
                returned, and its columns change. This saves the cost of new memory, which is as large as that
                of some of the flights. After an exception all of its outcomes are ERROR.
        """
        if word(on_error, "on_error") not in ("raise", "mark"):
            raise Error(f'on_error: "{on_error}" is unknown; expected "raise" or "mark"')
        if _card.is_there(x) or _card.is_there(v):
            if self._engine.name != "gpu" or out is not None:
                raise Error("x, v: are in a graphics card's memory, which the engine gpu takes, without out")
            self._there = self._there or _lorentz.CardEngine(self._scene)
            return _card.first_hit(self._there, self._scene.dimension, x, v, max_time, start_from, on_error)
        if out is not None and (not isinstance(out, Answers) or out._native is None):
            raise Error("out: needs the Answers that an earlier call returned, not a part or a copy of them; "
                        f"got {type(out).__name__}")
        positions, velocities = vectors_of(x, v, self._scene.dimension)
        count = len(positions)
        limits = None if max_time is None else _limits(max_time, count)
        rows = self._engine.first_hit(positions, velocities, limits, _columns(start_from, count, self._scene),
                                      on_error == "raise", None if out is None else out._native)
        return Answers(rows) if out is None else out


@overload
def first_hit(scene: SceneLike, x: OnCard, v: OnCard, radius: float | None = None, *, engine: str, jobs: int = 1,
              max_time: OnCard | None = None, start_from: CardAnswers | None = None,
              on_error: str = "raise") -> CardAnswers: ...


@overload
def first_hit(scene: SceneLike, x: npt.ArrayLike, v: npt.ArrayLike, radius: float | None = None, *,
              engine: str = "certified-batch", jobs: int = 1, max_time: npt.ArrayLike | None = None,
              start_from: StartFrom = None, on_error: str = "raise") -> Answers: ...


def first_hit(scene: SceneLike, x: Any, v: Any, radius: float | None = None, *, engine: str = "certified-batch",
              jobs: int = 1, max_time: Any = None, start_from: Any = None,
              on_error: str = "raise") -> Answers | CardAnswers:
    """Which obstacle is hit first, and when?

    Args:
        scene: anything that `Scene` takes: a Scene, a dict, a file, a name of the catalogue.
        x: places, shape (N, d) or (d,), in the scene's unit of length, in any layout. The array is not copied
            as a whole.
        v: velocities, shape (N, d) or (d,), of any length except 0. One place and many velocities, or the
            other way round, are broadcast.
        radius: every ball gets this radius.
        engine, jobs: as in `Engine`.
        max_time: a number, or shape (N,). The outcome is LATER if no obstacle is entered before it.
        start_from: the obstacle that a query leaves, which it ignores: one (lattice, atom, cell) for all,
            columns of the three (a lattice below 0 means none), or a list of N obstacles and None. With
            Answers (or an Answer in place of an obstacle), each query leaves the obstacle that was hit.
        on_error: ``"raise"`` or ``"mark"``. With ``"mark"`` a row that is not a query, or that the engine
            does not support, has the outcome ERROR.

    Returns:
        Answers, in columns with N rows. With ``gpu``, arrays in a card's memory (of CuPy, PyTorch or Numba;
        ``max_time`` and ``start_from`` there, too) give CardAnswers, whose columns stay there.

    Raises:
        Error: a row is not a query; the message has its number (``row 17: v is zero``). Or shapes do not fit,
            or the engine is unknown.
        UnsupportedError: a row is a valid query, but the engine does not support it.
    """
    from ._scene import Scene

    place = scene if radius is None else Scene(scene, radius)
    answers: Answers | CardAnswers = Engine(place, engine, jobs=jobs).first_hit(
        x, v, max_time=max_time, start_from=start_from, on_error=on_error)
    return answers


def _engine_of(scene: SceneLike, name: str, jobs: int) -> Engine:
    return Engine(scene, name, jobs=jobs)


def engines() -> list[str]:
    """The names of all engines."""
    return _lorentz.engines()


def vectors_of(x: npt.ArrayLike, v: npt.ArrayLike, dimension: int) -> tuple[Floats, Floats]:
    """Places and velocities of shape (N, d). A single place or velocity is used for all rows."""
    places, velocities = (_rows(floats_of(numbers, name), name, dimension) for numbers, name in ((x, "x"), (v, "v")))
    count = max(len(places), len(velocities)) if len(places) and len(velocities) else 0
    for numbers, name in ((places, "x"), (velocities, "v")):
        if len(numbers) not in (1, count):
            raise Error(f"{name}: has {len(numbers)} rows, the other {count}; they need as many, or one")
    return np.broadcast_to(places, (count, dimension)), np.broadcast_to(velocities, (count, dimension))


def _rows(numbers: Floats, name: str, dimension: int) -> Floats:
    if numbers.ndim not in (1, 2) or numbers.shape[-1] != dimension:
        raise Error(f"{name}: has the shape {numbers.shape}, needs (N, {dimension}) or ({dimension},)")
    return np.atleast_2d(numbers)


def _limits(max_time: npt.ArrayLike, count: int) -> Floats:
    limits = floats_of(max_time, "max_time")
    if limits.ndim > 1 or limits.ndim == 1 and limits.shape != (count,):
        raise Error(f"max_time: has the shape {limits.shape}, needs one number or ({count},)")
    return np.broadcast_to(limits, (count,))


def floats_of(numbers: npt.ArrayLike, name: str) -> Floats:
    """The numbers as an array of floats. Raises Error if they are not numbers, or if one would be rounded."""
    if isinstance(numbers, np.ma.MaskedArray):
        raise Error(f"{name}: is a masked array; fill it first")
    try:
        given = np.asarray(numbers)
        if numbers is None or given.dtype.kind in "bcmMSUV":
            raise TypeError(f"{given.dtype} is not a type of real numbers")
        floats = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise Error(f"{name}: is not an array of numbers: {error}") from None
    if not _is_kept(numbers, given, floats, name):
        raise Error(f"{name}: has numbers that floats would round; lorentz.oracle takes them as they are")
    return floats


def _is_kept(numbers: npt.ArrayLike, given: npt.NDArray[Any], floats: Floats, name: str) -> bool:
    """Whether every number equals its float. (Integers beyond 2**53, Fractions and long doubles may not.)"""
    if isinstance(numbers, (list, tuple)) and given.dtype == np.float64:
        given = np.asarray(numbers, dtype=object)  # `given` already has floats in place of ints
    if given.dtype == object:
        pairs = zip(given.ravel().tolist(), floats.ravel().tolist())
        return all(isinstance(number, float) or rational(number, name) == value for number, value in pairs)
    if given.dtype.kind in "iu" and given.dtype.itemsize == 8:
        large = abs(floats) >= 2.0**53
        return all(int(number) == value for value, number in zip(given[large].tolist(), floats[large].tolist()))
    return given.dtype.itemsize <= 8 or bool(((given == floats) | np.isnan(floats)).all())


#: Columns lattice, atom, cell, and the rows whose cells do not fit into 64 bits: (row, lattice, atom, cell).
_Left = tuple[Any, Any, Any, list[Any]]


def _columns(start_from: StartFrom, count: int, scene: Any) -> _Left | None:
    if start_from is None:
        return None
    if isinstance(start_from, Answers):
        return _columns_of_answers(start_from)
    if isinstance(start_from, Answer):
        start_from = [start_from] * count
    if isinstance(start_from, list):
        start_from = [_left(row) if isinstance(row, Answer) else row for row in start_from]
    try:
        if isinstance(start_from, (list, tuple)) and all(map(_is_obstacle_or_none, start_from)):
            return _columns_of_rows(list(start_from), count, scene)
        lattice, atom, cell = start_from
        if _is_obstacle_or_none(start_from) and isinstance(cell, (tuple, list)) and (
                len(cell) < scene.dimension or not _fits_64_bits(cell)):
            return _columns_of_rows([start_from] * count, count, scene)
        return (np.broadcast_to(_integers(lattice, np.int32), (count,)),
                np.broadcast_to(_integers(atom, np.int32), (count,)),
                np.broadcast_to(_integers(cell, np.int64), (count, scene.dimension)), [])
    except (TypeError, ValueError, OverflowError) as error:
        raise Error(f"start_from: needs lattice, atom, cell for {count} queries: {error}") from None


def _columns_of_answers(answers: Answers) -> _Left:
    left = np.where(answers.outcome == Outcome.HIT, answers.lattice, -1).astype(np.int32)
    large = [(row, int(left[row]), int(answers.atom[row]), cell)
             for row, cell in sorted(answers.large_cells.items()) if left[row] >= 0]
    left[[row for row, *_ in large]] = -1
    return left, answers.atom, answers.cell, large


def _left(answer: Answer) -> Obstacle | None:
    return answer.obstacle if answer.outcome == "hit" else None


def _is_obstacle_or_none(row: Any) -> bool:
    return row is None or (isinstance(row, tuple) and len(row) == 3 and np.ndim(row[0]) == 0 and np.ndim(row[2]) == 1)


def _whole_row(row: Any, scene: Any) -> tuple[int, int, tuple[int, ...]]:
    """An obstacle with its cell padded by zeros. A cell has one coordinate per vector of its lattice."""
    lattice, cell = _index(row[0]), tuple(integer(n, "cell") for n in row[2])
    rank = scene.rank(lattice)
    if len(cell) not in (rank, scene.dimension):
        raise ValueError(f"a cell of lattice {lattice} has {rank} coordinates, not {len(cell)}")
    return lattice, _index(row[1]), cell + (0,) * (scene.dimension - len(cell))


def _columns_of_rows(rows: list[Any], count: int, scene: Any) -> _Left:
    """Columns from a list of obstacles and None, in the form that a judged function gets."""
    if len(rows) != count:
        raise ValueError(f"there are {len(rows)}")
    none = (-1, 0, (0,) * scene.dimension)
    whole_rows = [none if row is None else _whole_row(row, scene) for row in rows]
    large = [(i, *row) for i, row in enumerate(whole_rows) if not _fits_64_bits(row[2])]
    for i, *_ in large:
        whole_rows[i] = none
    lattice, atom, cell = zip(*whole_rows) if rows else ((), (), ())
    return (_integers(np.array(lattice, int), np.int32), _integers(np.array(atom, int), np.int32),
            np.reshape(np.array(cell, np.int64), (count, scene.dimension)), large)


def _fits_64_bits(cell: Any) -> bool:
    return all(-2**63 <= n < 2**63 for n in cell)


def _index(value: Any) -> int:
    return whole(value, "start_from", -2**31, 2**31 - 1)


def _integers(numbers: npt.ArrayLike, kind: Any) -> npt.NDArray[Any]:
    array = np.asarray(numbers)
    if array.dtype.kind == "O":
        raise TypeError("there are integers beyond 64 bits, or other objects")
    if array.dtype.kind not in "iu":
        raise TypeError(f"{array.dtype} is not a type of integers")
    if array.size and not np.iinfo(kind).min <= int(array.min()) <= int(array.max()) <= np.iinfo(kind).max:
        raise OverflowError(f"there are integers that {np.dtype(kind)} does not hold")
    return array.astype(kind, copy=False)
