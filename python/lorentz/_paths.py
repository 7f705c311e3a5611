"""Particles from collision to collision: arrays in floats, itineraries that are certain; and starts for them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from . import _lorentz
from ._first_hit import Floats, StartFrom, _columns, _vectors
from ._lorentz import Error, Paths
from ._numbers import Number, Obstacle, Vector, obstacle_dict, plain, text, time_limit, whole
from ._scene import SceneLike, native

#: What ``Paths.stop_code`` says: why a particle does not go on (docs of the C++ header trajectory.hpp).
STOPS: tuple[str, ...] = _lorentz.STOPS


def trajectories(scene: SceneLike, x: npt.ArrayLike, v: npt.ArrayLike, collisions: int, *,
                 start_from: StartFrom = None, until: float = math.inf, engine: str = "batch",
                 precision: str = "binary64") -> Paths:
    """Follows N particles, each for so many collisions or until a time, in floating point.

    Args:
        scene, x, v, start_from: as of `lorentz.first_hit`.
        collisions: C, of each particle, at most.
        until: a time after which nothing is recorded.
        engine: whose first hits; ``batch`` flies all particles together.
        precision: of the state, ``"binary64"`` or ``"double-double"``.

    Returns:
        Paths: ``time`` (N, C), ``place`` and ``velocity`` after it (N, C, d), ``lattice``, ``atom`` (N, C),
        ``cell`` (N, C, d) of each collision; ``count`` (N,), how many there were, and ``stop_code`` (N,), an
        index into `STOPS`. What did not happen is NaN, or 0 of integers. Read-only views.

    A Lorentz gas is chaotic: in floats a path is right for some collisions only. `itinerary` is certain.

    Raises:
        Error: a start that is none, by its row; a scene that the engine does not do.
    """
    if precision not in ("binary64", "double-double"):
        raise Error(f'precision: "{precision}" is none; there are "binary64", "double-double"')
    most = whole(collisions, "collisions", 0, 2**31 - 1)
    last = time_limit(until, "until")
    place, positions = native(scene), _vectors(x, "x")
    left = _columns(start_from, len(positions), place)
    return _lorentz.follow(place, positions, _vectors(v, "v"), left, most, math.inf if last is None else float(last),
                           engine, precision == "double-double")


@dataclass(frozen=True)
class CertifiedCollision:
    """A collision of which everything is certain. Numbers are decimal texts, correctly rounded; ``x`` and
    ``v`` (after it) are empty unless states were asked for. ``bits``: an error of the start has grown 2**bits
    times."""

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
    """Which obstacles a particle hits, one after another, proven. ``end``: "collisions", "time", "never",
    "inside" or "undecided"; ``bits``: the precision that it took; ``x``, ``v`` and ``distance`` from the origin
    at the end, decimal texts."""

    collisions: list[CertifiedCollision]
    end: str
    bits: int
    x: list[str]
    v: list[str]
    distance: str


def itinerary(scene: SceneLike, x: Vector, v: Vector, *, start_from: Obstacle | None = None,
              collisions: int | None = None, time: Number | None = None, digits: int = 17, states: bool = False,
              most_bits: int = 0) -> Itinerary:
    """Follows one particle, certainly: every obstacle is the true one, every digit correctly rounded.

    Args:
        scene, x, v: numbers are floats, ints, Fractions, or texts: "1/3", and in v also "sqrt(2)", "golden".
        collisions, time: how far; at least one of them.
        digits: significant decimal digits of times, places and velocities.
        states: place and velocity at each collision, too.
        most_bits: the precision at which to give up; 0: 2**18, or what the digits need.

    Source: docs/itineraries.md. Cost: 1000 collisions in 2D at r = 1e-3 some 0.4 s.

    Raises:
        Error: it is no scene or no start; neither collisions nor time.
    """
    if collisions is None and time is None:
        raise Error("needs collisions or time: how far to follow the particle")
    digits, most_bits = whole(digits, "digits", 1, 100_000), whole(most_bits, "most_bits", 0, 2**40)
    if collisions is not None:
        collisions = whole(collisions, "collisions", 1, 2**31 - 1)
    time_limit(time, "time")
    start = {"x": x, "v": v} | ({} if start_from is None else {"from": obstacle_dict(start_from)})
    until = plain(time, "time")
    limit = until.hex() if isinstance(until, float) else until  # as a text a float would be another number
    path = _lorentz.itinerary(native(scene), text(start), collisions, limit, digits, states, most_bits)
    path["collisions"] = [CertifiedCollision(**one) for one in path["collisions"]]
    return Itinerary(**path)


class Starts(NamedTuple):
    """Places and velocities (N, d), and what they leave, as `lorentz.first_hit` takes them."""

    x: Floats
    v: Floats
    start_from: tuple[npt.NDArray[np.int32], npt.NDArray[np.int32], npt.NDArray[np.int64]] | None


def draw_starts(scene: SceneLike, count: int, kind: str = "uniform", *, seed: int = 20161115,
                first: int = 0) -> Starts:
    """Starts in no obstacle, decided exactly; start n depends on scene, kind, seed and n alone.

    Args:
        kind: ``uniform`` (anywhere, in any direction), ``surface`` (off an obstacle by the cosine law),
            ``near-rational`` (beside small lattice vectors), ``grazing`` (past the edge of an obstacle).
        first: the number of the first.

    Velocities have length 1 up to rounding, but those of ``near-rational``. Raises Error where the obstacles
    leave nothing free.
    """
    return Starts(**_lorentz.draw(native(scene), whole(count, "count"), kind, whole(seed, "seed", 0, 2**64 - 1),
                                  whole(first, "first")))
