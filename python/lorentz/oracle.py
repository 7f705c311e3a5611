"""The exact oracle, one question at a time: first hits in ints and Fractions, margins, verdicts, proofs.

Every decision is the sign of an integer. Only values that are documented as rounded are rounded. A scene is
anything that `lorentz.Scene` takes; for many questions, make a Scene once, because it keeps the prepared
oracle. x and v are sequences of numbers. Lengths are in the scene's unit; the particle is at x + t v at the
time t. `first_hit` and `entry_time` take rational numbers, too; the other functions need floats, or numbers
that equal a float.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from typing import Any, Callable, Sequence

from . import _lorentz
from ._answer import Answer, ExactTime, nearest_float
from ._lorentz import Certificate, Error
from ._numbers import (Number, Obstacle, Vector, claim, exact, finite, integer, is_binary64, obstacle_dict, own_cell, parts,
                       plain, renamed, text, time_limit, vector, whole)
from ._scene import Scene, SceneLike, scene_of

__all__ = ["Approach", "Convergent", "Margin", "Verdict", "certificate", "check", "convergents", "entry_time",
           "first_hit", "is_free", "judge_answer", "margin", "passed"]


@renamed("from", "start_from")
def first_hit(scene: SceneLike, x: Vector, v: Vector, *, start_from: Obstacle | None = None, digits: int = 0,
              detail: bool = False, max_time: Number | None = None) -> Answer:
    """Which obstacle is hit first, exactly.

    Args:
        scene, x, v: numbers are floats, ints, Fractions, or texts such as "1/3", with their exact values; in v
            also "sqrt(2)" and "golden".
        start_from: the obstacle that the particle leaves, (lattice, atom, cell).
        digits: the number of significant decimal digits of the time that are also returned as
            ``time_decimal``.
        detail: also return ``point``, ``normal``, ``impact_parameter``, ``exit_time``, ``exit_point`` and
            ``exit_normal``, each correctly rounded.
        max_time: the outcome is "later" if no obstacle is entered before it.

    Returns:
        The Answer: cells in ints, ``time`` correctly rounded, ``exact_time`` the exact time. It is never
        "undecided" if all numbers are floats. If some are not, a certified itinerary of one collision
        answers. It answers "undecided" for a line that touches an obstacle, and with a root in v also if the
        limit is the very time of the hit; it has no ``detail``, and does not name the obstacle in which x lies.

    Raises:
        Error: the scene or the query is invalid.

    Cost: 5 us (2D) or 20 us (3D) per atom, and about 20 us for Python.
    """
    digits = whole(digits, "digits", 0, 100_000)
    if time_limit(max_time, "max_time") == math.inf:
        max_time = None
    place = scene_of(scene)
    query = _query(place, x, v, start_from)
    limit = None if max_time is None else exact(max_time, "max_time")
    if not (place.is_binary64 and _floats_only(query) and (limit is None or is_binary64(limit))):
        return _first_hit_of_rationals(place, x, v, start_from, digits, detail, limit)
    answer = Answer.from_line(
        _oracle(place).first_hit(text(query), digits, detail, None if limit is None else float(limit)))
    if answer.outcome != "hit":
        return answer
    return replace(answer, exact_time=entry_time(place, x, v, answer.obstacle))


def is_free(scene: SceneLike, x: Vector) -> bool:
    """True if x lies in no open obstacle. Numbers must be floats, or equal a float."""
    place = scene_of(scene)
    return _oracle(place).is_free(_text(place, x, [1] + [0] * (place.dimension - 1), None))


def entry_time(scene: SceneLike, x: Vector, v: Vector, obstacle: Obstacle | None) -> ExactTime:
    """The time at which the line x + t v enters this obstacle, ignoring all others; it may be below 0.

    In the coordinates in which the obstacle is the unit ball around 0, the line is w + t u, and the time is
    the smaller root of (u.u) t^2 + 2 (w.u) t + (w.w - 1). Raises Error if the line misses it.
    """
    if obstacle is None:
        raise Error("obstacle: there is none")
    place = scene_of(scene)
    position, velocity = _fractions(x, "x"), _fractions(v, "v")
    for numbers, name in ((position, "x"), (velocity, "v")):
        if len(numbers) != place.dimension:
            raise Error(f"{name}: has {len(numbers)} components, needs {place.dimension}")
    centre, axes = _centre_and_axes(place, obstacle)
    if not any(velocity):
        raise Error("v is zero")
    w = _solved(axes, [a - b for a, b in zip(position, centre)])
    u = _solved(axes, velocity)
    square = _dot(u, u)
    middle = -_dot(w, u) / square
    root = middle * middle - (_dot(w, w) - 1) / square
    if root < 0:
        raise Error("the line misses the obstacle")
    return ExactTime(middle, root)


@dataclass(frozen=True)
class Margin:
    """How hard a question is (docs/verdicts.md).

    ``margin``: the least number of ulps that each input must move, to first order, to change the answer; at
    most 2**20. It is None for "never" if a lattice has as many vectors as the scene has dimensions.
    ``condition``: the ulps of the time that one ulp in each input causes; None without a hit. The hardest
    decision: its kind ``decision`` is "containing", "meeting" or "order", ``decided`` is its result, and
    ``obstacle`` is its obstacle.
    """

    margin: float | None
    condition: float | None
    decision: str | None = None
    decided: bool | None = None
    obstacle: Obstacle | None = None


@renamed("from", "start_from")
def margin(scene: SceneLike, x: Vector, v: Vector, *, start_from: Obstacle | None = None) -> Margin:
    """How far the inputs are from a different answer. Cost: at least 100 us."""
    place = scene_of(scene)
    return Margin(**_oracle(place).margin(_text(place, x, v, start_from)))


@dataclass(frozen=True)
class Approach:
    """An obstacle near a flight: ``gap`` in units of its radius (below 0: the line meets it), the ``time`` at
    which the line is nearest to its centre, and the ``margin`` of that decision in ulps."""

    obstacle: Obstacle
    time: float
    gap: float
    margin: float


@renamed("from", "start_from")
def passed(scene: SceneLike, x: Vector, v: Vector, *, most: int = 5,
           start_from: Obstacle | None = None) -> list[Approach]:
    """At most ``most`` obstacles, the nearest to the flight, in order of time; the one hit is last."""
    place = scene_of(scene)
    return [Approach(**one) for one in _oracle(place).passed(_text(place, x, v, start_from), whole(most, "most"))]


@dataclass(frozen=True)
class Verdict:
    """The verdict on an answer compared with the exact one (docs/verdicts.md).

    ``verdict``: "agree", "ill-posed", "wrong", "undecided", "unsupported" or "error". ``wrong_time``: the
    obstacle is right, but its time is off by more than the rounding of the inputs explains;
    ``other_quantity``: by so much that it is not a time of that collision. ``ulps``: the error of the time,
    in its ulps. ``departs``: how far the inputs must move for the answer to be right. ``cause`` and
    ``sentence``: the fault, as `lorentz.judge` describes it (docs/judge.md).
    """

    verdict: str
    wrong_time: bool
    other_quantity: bool
    ulps: float | None
    departs: float
    cause: str | None
    sentence: str | None


@renamed("from", "start_from")
def judge_answer(scene: SceneLike, x: Vector, v: Vector, answer: Answer, *, start_from: Obstacle | None = None,
                 ulps: float = 4, precision: str = "binary64", time_tolerance: float | None = None,
                 starts_inside: str = "inside") -> Verdict:
    """Is this answer right? One that is right only if inputs move by up to `ulps` ulps is "ill-posed".

    Ulps are those of `precision`, "binary64" or "binary32". With `time_tolerance` T a time is right if it is off by at
    most T times itself. If T is infinite, times are not judged. `starts_inside` is the engine's rule if x lies in
    an obstacle: "inside", "miss", "zero" or "exit" (docs/verdicts.md).
    """
    tolerance = finite(ulps, "ulps")
    if not 0 <= tolerance < 1e300:
        raise Error("ulps: needs a number, 0 or above")
    place = scene_of(scene)
    return Verdict(**_oracle(place).judge(_text(place, x, v, start_from), _checked(answer).to_line(), tolerance,
                                          claim(precision, time_tolerance, None, starts_inside)))


@renamed("from", "start_from")
def certificate(scene: SceneLike, x: Vector, v: Vector, *, start_from: Obstacle | None = None) -> Certificate:
    """A proof of the exact answer (docs/certificates.md), which can be checked without trusting the oracle.

    Raises Error if it takes more steps than any checker goes: around obstacles hundreds of cells large.
    """
    place = scene_of(scene)
    return _oracle(place).prove(_text(place, x, v, start_from))


@renamed("from", "start_from")
def check(scene: SceneLike, x: Vector, v: Vector, answer: Answer, proof: Certificate, *,
          start_from: Obstacle | None = None) -> str | None:
    """None if the certificate proves the answer; else the reason why it does not.

    The proof covers the answer's outcome, obstacle, time and ``time_decimal``. The check shares no code with
    the searches.
    """
    if not isinstance(proof, Certificate):
        raise Error(f"proof: {type(proof).__name__} is not a Certificate; Certificate.from_dict makes one of a dict")
    decimal = _checked(answer).time_decimal
    if decimal is not None and (not isinstance(decimal, str) or not decimal or answer.outcome != "hit"):
        return "time_decimal: is not a text, or of an answer without a time"
    place = scene_of(scene)
    return _oracle(place).refutation(_text(place, x, v, start_from), answer.to_line(), decimal or "", proof)


@dataclass(frozen=True)
class Convergent:
    """A step of a continued fraction: partial quotient a, convergent p / q, exact remainder q m - p."""

    a: int
    p: int
    q: int
    remainder: Fraction


def convergents(rise: float, run: float = 1.0, limit: int = 1000) -> list[Convergent]:
    """The exact continued fraction of the slope rise / run of two floats, up to its end or `limit` terms."""
    terms = _lorentz.convergents(finite(rise, "rise"), finite(run, "run"), whole(limit, "limit"))
    return [Convergent(*one) for one in terms]


def _oracle(place: Scene) -> _lorentz.Oracle:
    if place._oracle is None:
        place._oracle = _lorentz.Oracle(place._scene)
    return place._oracle


def _query(place: Scene, x: Vector, v: Vector, start_from: Obstacle | None) -> dict[str, Any]:
    query: dict[str, Any] = {"x": vector(x, "x"), "v": vector(v, "v")}
    if start_from is not None:
        query["from"] = obstacle_dict(start_from, place._scene)
    return query


def _text(place: Scene, x: Vector, v: Vector, start_from: Obstacle | None) -> str:
    query = _query(place, x, v, start_from)
    if not _floats_only(query):
        raise Error("x, v: need floats, or numbers that are equal to one; first_hit and entry_time take others, too")
    return text(query)


def _floats_only(query: dict[str, Any]) -> bool:
    return all(isinstance(number, float) for key in "xv" for number in plain(query[key], key))


def _checked(answer: Answer) -> Answer:
    if not isinstance(answer, Answer):
        raise Error(f"answer: {answer!r} is no Answer")
    return answer


def _first_hit_of_rationals(scene: Scene, x: Vector, v: Vector, start_from: Obstacle | None, digits: int,
                            detail: bool, limit: Fraction | None) -> Answer:
    from ._paths import Itinerary, itinerary

    if detail:
        raise Error("detail: is of queries whose numbers are floats")
    def follow(limit: Fraction | None, decimals: int) -> Itinerary:
        return itinerary(scene, x, v, start_from=start_from, collisions=1, max_time=limit, digits=decimals)

    path = follow(limit, max(digits, 17))
    is_close = path.end == "undecided" and limit is not None  # the limit may be exactly the time of the hit
    if is_close:
        path = follow(None, max(digits, 17))
    if path.end == "time" or path.end == "never" and limit is not None:
        return Answer("later")
    if path.end != "collisions":
        return Answer(path.end)
    first = path.collisions[0]
    answer = Answer("hit", first.lattice, first.atom, first.cell)
    if any(exact(number) is None for number in [*x, *v]):  # with square roots
        def ends(decimals: int) -> tuple[Fraction, Fraction]:
            """The first and the last time that is rounded to this text with ``decimals`` digits."""
            number = Decimal(follow(None, decimals).collisions[0].time)
            half = Fraction(10) ** (number.adjusted() + 1 - decimals) / 2
            return Fraction(number) - half, Fraction(number) + half

        # At the limit itself a collision counts as one, of an itinerary: no number of decimals is enough then.
        if is_close or limit is not None and not any(ends(20 * 2**k)[1] < limit for k in range(7)):
            return Answer("undecided")
        return replace(answer, time=_float_of(ends),
                       time_decimal=follow(None, digits).collisions[0].time if digits else None)
    when = entry_time(scene, x, v, answer.obstacle)
    if limit is not None and not when < ExactTime(limit, Fraction(0)):
        return Answer("later")
    return replace(answer, exact_time=when, time=float(when), time_decimal=_decimal_text(when, digits))


def _float_of(ends: Callable[[int], tuple[Fraction, Fraction]]) -> float:
    """The float nearest to a number between such ends."""
    digits = 20
    while True:
        low, high = ends(digits)
        if nearest_float(low) == nearest_float(high) or digits > 1200:  # one midway between floats has fewer digits
            return nearest_float((low + high) / 2)
        digits *= 2


def _decimal_text(time: ExactTime, digits: int) -> str | None:
    """The time in the form of `time_decimal`."""
    if digits == 0:
        return None
    decimal = time.decimal(digits)
    return format(decimal, "f") if decimal.adjusted() == -7 else str(decimal).lower()


def _fractions(numbers: Vector, name: str) -> list[Fraction]:
    fractions = []
    for number in vector(numbers, name):
        fraction = exact(number, name)
        if fraction is None:
            raise Error(f"{name}: {number!r} is not a rational number")
        fractions.append(fraction)
    return fractions


def _centre_and_axes(scene: Scene, obstacle: Obstacle) -> tuple[list[Fraction], list[list[Fraction]]]:
    """The obstacle as centre + A y, |y| < 1: its centre, and the columns of A."""
    lattice_number, atom_number, cell = parts(obstacle, "obstacle")
    dimension = scene.dimension
    lattices = scene.to_dict()["lattices"]
    lattice = lattices[_number_of("lattice", lattice_number, len(lattices))]
    atom = lattice["atoms"][_number_of("atom", atom_number, len(lattice["atoms"]))]
    cell, rank = own_cell(cell, integer(lattice_number, "lattice"), scene._scene), len(lattice["vectors"])
    if len(cell) != rank:
        raise Error(f"cell: has {len(cell)} coordinates, needs {rank}")
    centre = _fractions(atom["position"], "position")
    for n, vector in zip(cell, lattice["vectors"]):
        centre = [c + n * component for c, component in zip(centre, _fractions(vector, "vectors"))]
    if "semiaxes" in atom:
        return centre, [_fractions(axis, "semiaxes") for axis in atom["semiaxes"]]
    radius = _fractions([atom["radius"]], "radius")[0]
    return centre, [[radius if i == k else Fraction(0) for i in range(dimension)] for k in range(dimension)]


def _number_of(name: str, value: Any, count: int) -> int:
    number = integer(value, name)
    if not 0 <= number < count:
        raise Error(f"{name}: there is no {number}; the scene has {count} there")
    return number


def _solved(columns: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    """The y with sum_k y_k column_k = right, by elimination. The columns must be independent."""
    count = len(right)
    rows = [[column[i] for column in columns] + [right[i]] for i in range(count)]
    for k in range(count):
        pivot = next(i for i in range(k, count) if rows[i][k] != 0)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [entry / rows[k][k] for entry in rows[k]]
        for i in range(count):
            if i != k:
                rows[i] = [a - rows[i][k] * b for a, b in zip(rows[i], rows[k])]
    return [row[count] for row in rows]


def _dot(a: Sequence[Fraction], b: Sequence[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b)), Fraction(0))
