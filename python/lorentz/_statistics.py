"""Statistics of many trajectories: Lyapunov exponents, diffusion; and scans."""

from __future__ import annotations

import math
import os
import sys
import warnings
from dataclasses import dataclass
from itertools import product
from numbers import Real
from typing import Any, Callable, Iterable, Iterator, NamedTuple, Sequence, Union

import numpy as np

from . import _lorentz
from ._answers import Floats
from ._flights import report_of, single_numbers
from ._lorentz import Error
from ._numbers import Number, finite, items, time_limit, whole, word
from ._scene import Scene, SceneLike, common_radius, native

SEED = 20161115


class Estimate(NamedTuple):
    """A number and its standard error. Either is None if it is not known. ``float()`` and formats such as
    ``f"{e:.3f}"`` take the number alone; ``print`` shows both, rounded to the first digit of the error."""

    value: float | None
    error: float | None

    def __float__(self) -> float:
        return math.nan if self.value is None else float(self.value)

    def __format__(self, form: str) -> str:
        return format(float(self), form) if form else str(self)

    def __str__(self) -> str:
        if self.value is None or not self.error or not 1e-12 < self.error < 1e12:
            return " +- ".join("unknown" if number is None else f"{number:.6g}" for number in self)
        places = -int(f"{self.error:.0e}"[2:])
        return " +- ".join(f"{round(number, places):.{max(places, 0)}f}" for number in (self.value, self.error))


@dataclass(frozen=True, repr=False)
class Reported:
    """A scene, and a report on it."""

    scene: Scene
    report: dict[str, Any]


@dataclass(frozen=True, repr=False)
class Lyapunov(Reported):
    """Lyapunov exponents in nats, the largest first. ``report`` is that of `lorentz lyapunov --json`, without
    the scene."""

    @property
    def exponents(self) -> list[Estimate]:
        """The exponents per collision."""
        return [Estimate(one["map"], one["map_error"]) for one in self.report["exponents"]]

    @property
    def exponents_in_time(self) -> list[Estimate]:
        """The exponents per unit of time, at speed 1."""
        return [Estimate(one["flow"], one["flow_error"]) for one in self.report["exponents"]]

    def to_dict(self) -> dict[str, Any]:
        """One row of a table: the single numbers, and the exponents by number."""
        row = single_numbers(self.report)
        for i, one in enumerate(self.report["exponents"], 1):
            row |= {f"exponent_{i}": one["map"], f"exponent_{i}_error": one["map_error"],
                    f"exponent_{i}_in_time": one["flow"], f"exponent_{i}_in_time_error": one["flow_error"]}
        return row

    def __repr__(self) -> str:
        told = ", ".join(map(str, self.exponents))
        return f"Lyapunov({told} a collision)"


@dataclass(frozen=True, repr=False)
class Diffusion(Reported):
    """Mean squared displacements. ``report`` is that of `lorentz diffusion --json`."""

    @property
    def coefficient(self) -> Estimate | None:
        """D in <|x|^2> ~ 2 d D t; None if corridors are open, because D then does not exist. A RuntimeWarning
        says if ``max_time`` is too short for D, below 20 mean free paths."""
        return self._coefficient()

    @property
    def times(self) -> Floats:
        """The times at which displacements were measured."""
        return np.array([one["t"] for one in self.report["displacements"]])

    @property
    def displacements(self) -> list[Estimate]:
        """<|x|^2> at these times, in units of the squared unit of length of the scene."""
        return [Estimate(one["msd"], one["msd_error"]) for one in self.report["displacements"]]

    def to_dict(self) -> dict[str, Any]:
        """One row of a table: the single numbers, and the last displacement."""
        last: dict[str, Any] = self.report["displacements"][-1]
        return single_numbers(self.report) | last

    def __repr__(self) -> str:
        coefficient = self._coefficient()
        told = "no coefficient, for corridors are open" if coefficient is None else f"D = {coefficient}"
        return f"Diffusion({told}; {self.report['particles']} particles followed until t = {self.times[-1]:g})"

    def _coefficient(self) -> Estimate | None:
        if self.report["D"] is None:
            return None
        if self.report.get("too_short"):
            warnings.warn("max_time: is below 20 mean free paths, too short for D", RuntimeWarning, stacklevel=3)
        return Estimate(self.report["D"], self.report["D_error"])


def lyapunov(scene: SceneLike, radius: Number | None = None, *, collisions: int = 1_000_000, spectrum: bool = False,
             seed: int = SEED, jobs: int = 1) -> Lyapunov:
    """Lyapunov exponents with standard errors, and theory for comparison.

    Args:
        scene, radius: as of `lorentz.first_hit`.
        collisions: about how many collisions are counted, for 4096 particles together.
        spectrum: compute the negative exponents, too.
        seed: the seed of the starts, which are on the obstacles.
        jobs: the number of threads; the result does not depend on it.

    Source: docs/chaos.md.

    Raises:
        Error: the scene leaves no free space, or rounding destroys the negative exponents. UnsupportedError:
            the engine ``batch`` does not support the scene.
    """
    place = Scene(scene, radius)
    return Lyapunov(place, report_of(_lorentz.lyapunov(
        native(place), whole(collisions, "collisions", 1, 2**52), bool(spectrum), _seed(seed), _jobs(jobs)), place))


def diffusion(scene: SceneLike, radius: Number | None = None, *, count: int = 100_000, max_time: float = 100.0,
              start: str = "uniform", seed: int = SEED, jobs: int = 1) -> Diffusion:
    """Mean squared displacements of many particles at unit speed, and theory for comparison.

    Args:
        scene, radius: as of `lorentz.first_hit`.
        count: the number of particles.
        max_time: T, the time until which they are followed.
        start: ``uniform`` or ``surface``, as in `flights`.
        seed, jobs: as in `lyapunov`.

    Source: docs/chaos.md. Raises as `lyapunov` does.
    """
    place = Scene(scene, radius)
    until = time_limit(max_time, "max_time")
    return Diffusion(place, report_of(_lorentz.diffusion(
        native(place), whole(count, "count", 1, 2**52), finite(until, "max_time"), word(start, "start"), _seed(seed),
        _jobs(jobs)), place))


def scan(function: Callable[..., Any], scenes: Union[SceneLike, Sequence[SceneLike]],
         radii: Number | Iterable[Number] | None = None, *, on_error: str = "raise",
         progress: bool | None = None, **options: Any) -> list[dict[str, Any]]:
    """A table of the results of a function for each scene at each radius.

    Args:
        function: `lyapunov`, `diffusion`, `flights`, `mean_free_path`, `horizon`, or another
            function of a scene and a radius.
        scenes: one scene, or a list of scenes.
        radii: every ball gets each of these in turn; without radii the scenes are unchanged.
        on_error: ``"raise"`` or ``"mark"``. With ``"mark"`` a refused scene and radius have the column
            ``error``.
        progress: show on stderr which scene and radius is next, by tqdm if it is installed, otherwise in
            lines. None: if stderr is a terminal.
        options: further arguments of the function.

    Returns:
        A dict for each scene and radius: ``scene`` as given, ``radius`` (without radii the scene's own, if
        all balls have the same), and the single numbers and texts of the result (``value`` if the function
        returns one number, ``value`` and ``error`` if an `Estimate`). ``pandas.DataFrame(scan(..))`` makes a
        table of them.

    Raises:
        Error: the function refused a scene or a radius, and ``on_error`` is ``"raise"``.

    An exception that ends a scan early, Ctrl-C (KeyboardInterrupt) too, has the rows of the scenes and radii
    before it in its attribute ``rows``. At a prompt it is ``sys.last_value``; in a program::

        try:
            rows = lorentz.scan(lorentz.lyapunov, "square", [0.1, 0.01, 0.001])
        except KeyboardInterrupt as stop:
            rows = stop.rows
    """
    if not callable(function):
        raise Error(f"function: {function!r} is not a function")
    if word(on_error, "on_error") not in ("raise", "mark"):
        raise Error(f'on_error: {on_error!r} is unknown; expected "raise" or "mark"')
    if progress is not None and not isinstance(progress, bool):
        raise Error(f"progress: {progress!r} is unknown; expected True, False or None")
    several = list(scenes) if isinstance(scenes, (list, tuple)) else [scenes]
    one = radii is None or isinstance(radii, (str, Real))
    sizes: list[Any] = [radii] if one else items(radii, "radii")
    places, rows = list(product(several, sizes)), []
    shown = sys.stderr.isatty() if progress is None else progress
    try:
        for scene, radius in _with_progress(places) if shown else places:
            rows.append(_row_at(scene, radius, function, on_error == "mark", options))
    except BaseException as stop:
        _keep(rows, places, stop)
        raise
    return rows


def _keep(rows: list[dict[str, Any]], places: list[tuple[Any, Any]], stop: BaseException) -> None:
    """Puts the rows of a scan that does not end into what ended it, and says so there."""
    setattr(stop, "rows", rows)
    told = "".join(f", stopped at {_told(place)}" for place in places[len(rows):len(rows) + 1])
    kept = "; the rows are in the attribute `rows` of this exception (at a prompt: sys.last_value.rows)" if rows else ""
    if hasattr(stop, "add_note"):  # from Python 3.11 on
        stop.add_note(f"scan: {len(rows)} of {len(places)} rows are done{told}{kept}")


def _row_at(scene: Any, radius: Any, function: Callable[..., Any], marks: bool, options: dict[str, Any]) -> dict[str, Any]:
    row = {"scene": scene, "radius": radius}
    try:
        found = function(scene, radius, **options)
        return row | ({"radius": common_radius(Scene(scene))} if radius is None else {}) | _row_of(found)
    except Error as error:
        if not marks:
            raise
        return row | {"error": str(error)}


def _with_progress(places: list[tuple[Any, Any]]) -> Iterator[tuple[Any, Any]]:
    """The places one by one, each shown on stderr before."""
    try:
        from tqdm import tqdm
    except ImportError:
        for number, place in enumerate(places, 1):
            print(f"scan: {number} of {len(places)}: {_told(place)}", file=sys.stderr, flush=True)
            yield place
        return
    with tqdm(places, "scan") as bar:
        for place in bar:
            bar.set_postfix_str(_told(place))
            yield place


def _told(place: tuple[Any, Any]) -> str:
    """A scene and a radius in words."""
    scene, radius = place
    name = scene if isinstance(scene, (str, os.PathLike)) else getattr(scene, "_name", None)
    told = ["a scene without a name" if name is None else os.fspath(name)] + ([] if radius is None else [f"radius {radius}"])
    return ", ".join(told)


def _row_of(found: Any) -> dict[str, Any]:
    if isinstance(found, Estimate):
        return found._asdict()
    if isinstance(found, dict):
        return single_numbers(found)
    return dict(found.to_dict()) if hasattr(found, "to_dict") else {"value": found}


def _seed(seed: int) -> int:
    return whole(seed, "seed", 0, 2**64 - 1)


def _jobs(jobs: int) -> int:
    return whole(jobs, "jobs", 1, 1024)
