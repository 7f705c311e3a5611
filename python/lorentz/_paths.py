"""Trajectories of particles: arrays in floats, certified itineraries, and starts for both."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from fractions import Fraction
from typing import Any, Literal, NamedTuple, Union

import numpy as np
import numpy.typing as npt

from . import _lorentz
from ._answer import nearest_float
from ._answers import Floats
from ._columns import Array, Column, Columns, by_component
from ._first_hit import StartFrom, _columns, _fits_64_bits, vectors_of
from ._lorentz import Error
from ._memory import free_memory
from ._numbers import Number, Obstacle, Vector, exact, finite, obstacle_dict, plain, renamed, text, time_limit, whole, word
from ._scene import Scene, SceneLike, native

#: The meaning of ``Paths.stop_code``: why a particle stopped (docs of the C++ header trajectory.hpp).
STOPS: tuple[str, ...] = _lorentz.STOPS
#: The collisions that are kept: each k-th, or only the last.
Every = Union[int, Literal["last"]]


class Paths(Columns):
    """Collisions of N particles, K kept for each, in columns. `lorentz.trajectories` returns them. Collisions
    that did not happen are NaN, or 0 for integers. ``paths[i]`` are the Paths of particle i alone."""

    __slots__ = ("every",)

    count = Column(np.int64, "(N,): number of collisions, kept or not.")
    stop_code = Column(np.uint8, "(N,): why the particle stopped, an index into `STOPS`.")
    time = Column(np.float64, "(N, K): time of each collision since the start.")
    lattice = Column(np.int32, "(N, K): lattice of the obstacle that is hit.")
    atom = Column(np.int32, "(N, K): its atom in that lattice.")
    cell = Column(np.int64, "(N, K, d): its cell.")
    place = Column(np.float64, "(N, K, d): place of the collision.")
    velocity = Column(np.float64, "(N, K, d): velocity after the collision.")

    def __init__(self, native: Any, columns: dict[str, Array] | None = None, every: Every = 1) -> None:
        super().__init__(native, columns)
        self.every = every  #: the collisions that are kept

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return int(self.place.shape[2])

    def kept(self) -> npt.NDArray[np.int64]:
        """(N,): the number of kept collisions of each particle."""
        kept: npt.NDArray[np.int64] = np.minimum(self.count, 1) if self.every == "last" else self.count // self.every
        return kept

    def to_dict(self) -> dict[str, Array]:
        """One row for each kept collision, by particle: ``particle``, ``collision`` (from 1), and the columns
        of the collision. ``place`` becomes ``place_0``, ``place_1`` .. A particle without a kept collision has
        no row; ``count`` and ``stop_code`` tell why."""
        kept = self.kept()
        happened = np.arange(self.time.shape[1]) < kept[:, None]
        particle, column = np.nonzero(happened)
        number = self.count[particle] if self.every == "last" else (column + 1) * self.every
        table = {"particle": particle, "collision": number}
        for name in self._NAMES[2:]:
            values = self._columns[name][happened]
            table |= {name: values} if values.ndim == 1 else by_component(name, values)
        return table

    def _row(self, i: int) -> Paths:
        return self._part(np.array([i]))

    def _part(self, rows: Array) -> Paths:
        return Paths(None, self._of_rows(rows), self.every)

    def _row_text(self, i: int) -> str:
        why = STOPS[self.stop_code[i]]
        text = f"{self.count[i]} collisions" + ("" if why == "collisions" else f", stopped by {why}")
        last = int(self.kept()[i]) - 1
        return text if last < 0 else f"{text}; at time {self.time[i, last]:.6g} at {self.place[i, last].tolist()}"

    def _headline(self) -> str:
        kept = self.time.shape[1]
        return f"Paths of {len(self)} particles in {self.dimension}D, at most {kept} collisions of each kept"

    def _rest(self) -> tuple[Any, ...]:
        return (self.every,)


@renamed("from", "start_from")
def trajectories(scene: SceneLike, x: npt.ArrayLike, v: npt.ArrayLike, collisions: int, *,
                 radius: Number | None = None, start_from: StartFrom = None, max_time: float = math.inf,
                 every: Every = 1, engine: str = "batch", precision: str = "binary64") -> Paths:
    """Follows N particles, each for a number of collisions or until a time, in floating point.

    Args:
        scene, x, v, radius, start_from: as in `lorentz.first_hit`.
        collisions: C, the most collisions of each particle.
        max_time: a time after which nothing is recorded.
        every: k: each k-th collision is kept, K = C // k for each particle; ``"last"``: only the last, K = 1.
        engine: the engine that computes the first hits; ``batch`` flies all particles together.
        precision: the precision of the state, ``"binary64"`` or ``"double-double"``.

    Returns:
        Paths: for each kept collision ``time`` (N, K), ``place`` and the ``velocity`` after it (N, K, d),
        ``lattice``, ``atom`` (N, K) and ``cell`` (N, K, d); ``count`` (N,), the number of collisions, and
        ``stop_code`` (N,), an index into `STOPS`.

    A Lorentz gas is chaotic: a path in floats is right only for its first collisions. `itinerary` is
    certified.

    Raises:
        Error: a row is not a start; the message has its number. Or the result does not fit into memory
            (`memory_of_trajectories`).
        UnsupportedError: the engine does not support the scene.
    """
    if word(precision, "precision") not in ("binary64", "double-double"):
        raise Error(f'precision: "{precision}" is unknown; expected "binary64" or "double-double"')
    most, stride = whole(collisions, "collisions", 0, 2**31 - 1), _stride(every)
    if stride > most > 0:
        raise Error(f"every: {stride} is above collisions, {most}: nothing would be kept")
    last = time_limit(max_time, "max_time")
    place = native(Scene(scene, radius))
    positions, velocities = vectors_of(x, v, place.dimension)
    _check_memory(len(positions), most, every, place.dimension)
    left = _columns(start_from, len(positions), place)
    until = math.inf if last is None or last == math.inf else finite(exact(last, "max_time"), "max_time")
    return Paths(_lorentz.follow(place, positions, velocities, left, most, stride, until, word(engine, "engine"),
                                 precision == "double-double"), every=every)


def memory_of_trajectories(particles: int, collisions: int, *, every: Every = 1, dimension: int = 2) -> int:
    """The most memory, in bytes, that `trajectories` needs for these numbers of particles and collisions."""
    count, most = whole(particles, "particles"), whole(collisions, "collisions", 0, 2**31 - 1)
    stride, dimension = _stride(every), whole(dimension, "dimension", 2, 3)
    columns = most // stride if stride else min(most, 1)
    a_collision, a_particle = 16 + 24 * dimension, 9 + _lorentz.BYTES_OF_START + 32 * dimension
    return count * (columns * a_collision + a_particle)


def _stride(every: Every) -> int:
    return 0 if isinstance(every, str) and every == "last" else whole(every, "every", 1, 2**31 - 1)


def _check_memory(particles: int, collisions: int, every: Every, dimension: int) -> None:
    needed, free = memory_of_trajectories(particles, collisions, every=every, dimension=dimension), free_memory()
    if needed > free:
        raise Error(f"collisions: {collisions} of {particles} particles need {needed / 1e9:.3g} GB, and "
                    f'{free / 1e9:.3g} GB are free; every="last" keeps the last ones alone, every=k each k-th')


@dataclass(frozen=True)
class CertifiedCollision:
    """A certified collision. Numbers are decimal texts, correctly rounded. ``x`` and ``v`` (after the
    collision) are empty unless states were requested. ``bits``: an error of the start has grown by the factor
    2**bits."""

    lattice: int
    atom: int
    cell: tuple[int, ...]
    time: str
    x: list[str]
    v: list[str]
    bits: int

    @property
    def obstacle(self) -> Obstacle:
        """(lattice, atom, cell)."""
        return self.lattice, self.atom, self.cell


@dataclass(frozen=True)
class Itinerary:
    """The proven sequence of obstacles that a particle hits. ``end``: "collisions", "time", "never", "inside"
    or "undecided"; ``bits``: the precision used; ``x``, ``v`` and ``distance`` from the origin at the end, as
    decimal texts; ``scene`` and ``start``: where it was followed, and from which place.

    ``time``, ``lattice``, ``atom``, ``cell``, ``place`` and ``velocity`` are the collisions as arrays, with the
    shapes of one particle of `Paths`; times, places and velocities are rounded to floats. `to_frame` is the table
    of them."""

    collisions: list[CertifiedCollision]
    end: str
    bits: int
    x: list[str]
    v: list[str]
    distance: str
    scene: Scene = field(repr=False)
    start: tuple[float, ...]

    @property
    def time(self) -> Floats:
        """(N,): time of each collision since the start."""
        return np.array([float(one.time) for one in self.collisions])

    @property
    def lattice(self) -> npt.NDArray[np.int32]:
        """(N,): lattice of each obstacle that is hit."""
        return np.array([one.lattice for one in self.collisions], np.int32)

    @property
    def atom(self) -> npt.NDArray[np.int32]:
        """(N,): its atom in that lattice."""
        return np.array([one.atom for one in self.collisions], np.int32)

    @property
    def cell(self) -> npt.NDArray[Any]:
        """(N, d): its cell, in int64. If 64 bits do not hold all cells, the array has the dtype object, of ints."""
        cells = [one.cell + (0,) * (len(self.start) - len(one.cell)) for one in self.collisions]
        kind = np.int64 if all(map(_fits_64_bits, cells)) else object
        return np.array(cells, kind).reshape(-1, len(self.start))

    @property
    def place(self) -> Floats:
        """(N, d): place of each collision. Raises Error if the states were not requested."""
        return self._vectors([one.x for one in self.collisions])

    @property
    def velocity(self) -> Floats:
        """(N, d): velocity after each collision. Raises Error if the states were not requested."""
        return self._vectors([one.v for one in self.collisions])

    def _vectors(self, texts: list[list[str]]) -> Floats:
        if not all(texts):
            raise Error("states: the itinerary has no places and velocities; ask for it with states=True")
        return np.array(texts, float).reshape(-1, len(self.start))

    def to_dict(self) -> dict[str, Any]:
        """The itinerary as dicts, lists and numbers."""
        return asdict(self) | {"scene": self.scene.to_dict()}

    def to_frame(self) -> Any:
        """A pandas DataFrame with one row for each collision: ``collision`` (from 1), ``time``, ``lattice``,
        ``atom``, ``cell_0``, ``cell_1`` .., with states also ``place_0`` .. and ``velocity_0`` ..; and ``bits``.
        pandas must be installed."""
        import pandas

        table: dict[str, Array] = {"collision": np.arange(1, 1 + len(self.collisions)), "time": self.time,
                                   "lattice": self.lattice, "atom": self.atom} | by_component("cell", self.cell)
        if all(one.x for one in self.collisions):
            table |= by_component("place", self.place) | by_component("velocity", self.velocity)
        return pandas.DataFrame(table | {"bits": np.array([one.bits for one in self.collisions], np.int64)})


@renamed("from", "start_from")
def itinerary(scene: SceneLike, x: Vector, v: Vector, *, radius: Number | None = None,
              start_from: Obstacle | None = None, collisions: int | None = None, max_time: Number | None = None,
              digits: int = 17, states: bool = False, most_bits: int = 0) -> Itinerary:
    """Follows one particle with certainty: every obstacle is the true one, every digit is correctly rounded.

    Args:
        scene, radius, x, v: numbers are floats, ints, Fractions, or texts: "1/3", and in v also "sqrt(2)", "golden".
        collisions, max_time: how far to follow the particle; at least one of them is required.
        digits: the number of significant decimal digits of times, places and velocities.
        states: return place and velocity at each collision, too.
        most_bits: the precision at which to give up; 0: 2**18, or the precision that the digits need.

    Source: docs/itineraries.md. Cost: 1000 collisions in 2D at r = 1e-3 take about 0.4 s.

    Raises:
        Error: the scene or the start is invalid, or neither collisions nor max_time is given.
    """
    if collisions is None and max_time is None:
        raise Error("needs collisions or max_time: how far to follow the particle")
    digits, most_bits = whole(digits, "digits", 1, 100_000), whole(most_bits, "most_bits", 0, 2**40)
    if collisions is not None:
        collisions = whole(collisions, "collisions", 1, 2**31 - 1)
    if time_limit(max_time, "max_time") == math.inf and collisions is not None:
        max_time = None
    place = Scene(scene, radius)
    start = {"x": x, "v": v} | ({} if start_from is None else {"from": obstacle_dict(start_from, native(place))})
    until = plain(max_time, "max_time")
    limit = until.hex() if isinstance(until, float) else until  # a float's text is another number
    path = _lorentz.itinerary(native(place), text(start), collisions, limit, digits, states, most_bits)
    path["collisions"] = [CertifiedCollision(**one) for one in path["collisions"]]
    return Itinerary(**path, scene=place, start=tuple(nearest_float(exact(number) or Fraction(0)) for number in x))


class Starts(NamedTuple):
    """Places and velocities (N, d), and the obstacles that they leave, as `lorentz.first_hit` takes them."""

    x: Floats
    v: Floats
    start_from: tuple[npt.NDArray[np.int32], npt.NDArray[np.int32], npt.NDArray[np.int64]] | None


@renamed("kind", "start")
def draw_starts(scene: SceneLike, count: int, start: str = "uniform", *, radius: Number | None = None,
                seed: int = 20161115, first: int = 0) -> Starts:
    """Starts outside all obstacles, decided exactly: places, velocities, and the obstacles that ``surface``
    starts leave. `first_hit` and `trajectories` take these as ``start_from``. Start n depends only on scene,
    start, seed and n.

    Args:
        start: ``uniform`` (anywhere, in any direction), ``surface`` (on an obstacle, by the cosine law),
            ``near-rational`` (beside small lattice vectors), ``grazing`` (past the edge of an obstacle).
        radius: every ball gets this radius. Give the same radius to the function that flies the starts.
        first: the number of the first start.

    Velocities have length 1 up to rounding, except those of ``near-rational``. Raises Error if the obstacles
    leave no free space.
    """
    return Starts(**_lorentz.draw(native(Scene(scene, radius)), whole(count, "count"), word(start, "start"),
                                  whole(seed, "seed", 0, 2**64 - 1), whole(first, "first")))
