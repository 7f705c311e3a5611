"""The answer to one query."""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from functools import total_ordering
from typing import Any, Callable, TypeVar

from ._lorentz import Error
from ._numbers import _HEXADECIMAL, Obstacle, integer, items, rational, whole

Rounded = TypeVar("Rounded")


def nearest_float(number: Fraction) -> float:
    """The float nearest to a number; an infinity beyond the range of floats."""
    try:
        return float(number)
    except OverflowError:
        return math.inf if number > 0 else -math.inf


def _each_once(members: list[tuple[str, Any]]) -> dict[str, Any]:
    fields = dict(members)
    if len(fields) < len(members):
        raise ValueError("a key comes twice in an object")
    return fields


@total_ordering
@dataclass(frozen=True)
class ExactTime:
    """The exact time ``rational - sqrt(root)`` at which a line enters an obstacle. Times can be compared."""

    rational: Fraction
    root: Fraction

    def __post_init__(self) -> None:
        if self.root < 0:
            raise Error(f"root: {self.root} is below 0")
        exact = self.fraction()  # so that equal times compare equal: a rational time has the root 0
        if exact is not None and self.root != 0:
            object.__setattr__(self, "rational", exact)
            object.__setattr__(self, "root", Fraction(0))

    def fraction(self) -> Fraction | None:
        """The time as one rational number; None if it is irrational."""
        numerator, denominator = self.root.numerator, self.root.denominator
        n, d = math.isqrt(numerator), math.isqrt(denominator)
        return self.rational - Fraction(n, d) if (n * n, d * d) == (numerator, denominator) else None

    def bounds(self, bits: int) -> tuple[Fraction, Fraction]:
        """A rational lower and upper bound of the time, at most 2**-bits apart."""
        bits = whole(bits, "bits")
        below = math.isqrt((self.root.numerator << 2 * bits) // self.root.denominator)
        return (self.rational - Fraction(below + 1, 1 << bits), self.rational - Fraction(below, 1 << bits))

    def __float__(self) -> float:
        """The time, correctly rounded, ties to even; an infinity beyond the range of floats."""
        return self._where_ends_agree(nearest_float)

    def decimal(self, digits: int) -> Decimal:
        """The time to ``digits`` significant digits, correctly rounded, ties to even."""
        context = Context(prec=whole(digits, "digits", 1, 10**6), rounding=ROUND_HALF_EVEN)
        rounded = self._where_ends_agree(lambda t: context.divide(Decimal(t.numerator), Decimal(t.denominator)))
        last = rounded.adjusted() + 1 - context.prec  # the place of the last digit; zeros up to there are digits, too
        return rounded if rounded == 0 else rounded.quantize(Decimal((0, (1,), last)), context=context)

    def __lt__(self, other: ExactTime) -> bool:
        """True if this time is earlier; decided exactly."""
        if not isinstance(other, ExactTime):
            return NotImplemented
        bits = 64
        while self != other:  # equal times have equal parts (see above); enough bits separate others
            (low, high), (other_low, other_high) = self.bounds(bits), other.bounds(bits)
            if high < other_low or other_high < low:
                return high < other_low
            bits *= 2
        return False

    def _where_ends_agree(self, rounded: Callable[[Fraction], Rounded]) -> Rounded:
        exact = self.fraction()
        if exact is not None:
            return rounded(exact)
        bits = 128
        while True:  # ends, because no irrational number is midway between two rounded ones
            low, high = (rounded(end) for end in self.bounds(bits))
            if low == high:
                return low
            bits *= 2


@dataclass(frozen=True)
class Answer:
    """The answer to a query.

    ``outcome`` is "hit", "never", "inside", "later", "undecided" or "error". "hit" and "inside" have
    ``lattice``, ``atom`` and ``cell`` (ints of any size). "hit" has ``time``, the t at which the particle is
    at x + t v; it may be infinite. The oracle's answers also have ``exact_time``; with `digits` they have
    ``time_decimal``; with `detail` they have the ``point`` of the collision, the unit outward ``normal`` and
    the ``impact_parameter``; and, "inside" too, the ``exit_time`` at which the line leaves the obstacle, with
    ``exit_point`` and ``exit_normal``. "error" has ``message``, and ``unsupported`` is true if the query is valid but
    this engine does not support it.
    """

    outcome: str
    lattice: int | None = None
    atom: int | None = None
    cell: tuple[int, ...] | None = None
    time: float | None = None
    exact_time: ExactTime | None = None
    time_decimal: str | None = None
    point: tuple[float, ...] | None = None
    normal: tuple[float, ...] | None = None
    impact_parameter: float | None = None
    exit_time: float | None = None
    exit_point: tuple[float, ...] | None = None
    exit_normal: tuple[float, ...] | None = None
    message: str | None = None
    unsupported: bool = False

    @property
    def obstacle(self) -> Obstacle | None:
        """(lattice, atom, cell): the start_from of a query that continues from a hit."""
        if self.lattice is None or self.atom is None or self.cell is None:
            return None
        return self.lattice, self.atom, self.cell

    def to_line(self) -> str:
        """The answer as a line of docs/formats.md, with the members that this format has."""
        line: dict[str, Any] = {"id": None, "outcome": self.outcome}
        if self.cell is not None:
            line |= {"lattice": integer(self.lattice, "lattice"), "atom": integer(self.atom, "atom"),
                     "cell": [str(integer(n, "cell")) for n in self.cell]}
        if self.time is not None:
            line["time"] = "inf" if self.time == math.inf else self.time
        if self.time_decimal is not None:
            line["time_decimal"] = self.time_decimal
        if self.exit_time is not None:
            line["exit_time"] = "inf" if self.exit_time == math.inf else self.exit_time
        if self.outcome == "error":
            line["message"] = self.message or ""
            line |= {"reason": "unsupported"} if self.unsupported else {}
        try:
            return json.dumps(line, allow_nan=False, default=_number)
        except (TypeError, ValueError) as error:
            raise Error(f"answer: {error}") from None

    @staticmethod
    def from_line(line: str) -> Answer:
        """Reads a line of that format. Raises Error if the line is invalid."""
        try:
            return Answer._from_fields(json.loads(line, object_pairs_hook=_each_once))
        except (AttributeError, KeyError, OverflowError, RecursionError, TypeError, ValueError) as error:
            raise Error(f"answer: {line!r:.80} has not the form of docs/formats.md: {error!r}") from None

    @staticmethod
    def _from_fields(fields: dict[str, Any]) -> Answer:
        outcome = fields["outcome"]
        if outcome not in ("hit", "never", "inside", "later", "undecided", "error"):
            raise ValueError(f"the outcome {outcome!r}")
        obstacle = _read_obstacle(fields) if outcome in ("hit", "inside") else (None, None, None)
        time, exit_time = (_time(fields[key]) if key in fields else None for key in ("time", "exit_time"))
        return Answer(
            outcome, *obstacle, time, time_decimal=fields.get("time_decimal"),
            point=_tuple(fields.get("point")), normal=_tuple(fields.get("normal")),
            impact_parameter=fields.get("impact_parameter"),
            exit_time=exit_time, exit_point=_tuple(fields.get("exit_point")), exit_normal=_tuple(fields.get("exit_normal")), message=fields.get("message"),
            unsupported=fields.get("reason") == "unsupported")


def hit(time: float, cell: Any, lattice: int = 0, atom: int = 0) -> Answer:
    """The answer of an engine that found a first hit: its time and obstacle."""
    try:
        number = float(time)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if math.isnan(number):
        raise Error(f"time: {time!r} is not a number")
    return Answer("hit", *_obstacle(lattice, atom, cell), number)


def inside(cell: Any, lattice: int = 0, atom: int = 0) -> Answer:
    """The answer of an engine if the start lies in an obstacle."""
    return Answer("inside", *_obstacle(lattice, atom, cell))


def never() -> Answer:
    """The answer of an engine if no obstacle is ever hit."""
    return Answer("never")


def undecided() -> Answer:
    """The answer of an engine that cannot decide."""
    return Answer("undecided")


def unsupported(message: str) -> Answer:
    """The answer of an engine to a valid query that it does not support."""
    return Answer("error", message=message, unsupported=True)


def _obstacle(lattice: Any, atom: Any, cell: Any) -> tuple[int, int, tuple[int, ...]]:
    return integer(lattice, "lattice"), integer(atom, "atom"), tuple(integer(n, "cell") for n in items(cell, "cell"))


def _read_obstacle(fields: dict[str, Any]) -> tuple[int, int, tuple[int, ...]]:
    cell = items(fields["cell"], "cell")
    lattice, atom, *numbers = (int(n) if isinstance(n, str) and re.fullmatch("-?[0-9]+", n) else integer(rational(n), "number")
                               for n in (fields["lattice"], fields["atom"], *cell))
    if lattice < 0 or atom < 0:
        raise ValueError("lattice or atom is below 0")
    return lattice, atom, tuple(numbers)


def _time(value: Any) -> float:
    if isinstance(value, str) and _HEXADECIMAL.fullmatch(value):
        return float.fromhex(value)
    return math.inf if value == "inf" else float(rational(value, "time"))


def _tuple(numbers: list[Any] | None) -> tuple[float, ...] | None:
    return None if numbers is None else tuple(float(n) for n in numbers)


def _number(value: Any) -> Any:
    if hasattr(value, "item"):  # a NumPy scalar
        return value.item()
    raise TypeError(f"{type(value).__name__} is not a number")
