"""Numbers as the exchange formats have them: every float as it is, fractions as texts."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from numbers import Integral, Rational
from typing import Any, Sequence, Union

import numpy as np

from ._lorentz import Error

#: A number that is exact: a float (the rational that it is), an int, a Fraction, or a text like ``"1/3"``.
Number = Union[float, int, Fraction, str]
Vector = Union[Sequence[Number], "np.ndarray[Any, Any]"]
#: An obstacle: number of its lattice, number of its atom there, the cell's coordinates.
Obstacle = tuple[int, int, Sequence[int]]


def is_binary64(number: Rational) -> bool:
    """True if a float has exactly this value."""
    try:
        return Fraction(float(number)) == number
    except OverflowError:
        return False


def plain(value: Any) -> Any:
    """What JSON can say of a number, a sequence or a dict of them, without a change of any number."""
    if isinstance(value, (bool, str)) or value is None:
        return value
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, (Integral, Fraction)):
        rational = _fraction(value)
        return float(rational) if is_binary64(rational) else str(rational)
    return float(value)


def text(value: Any) -> str:
    """The same as a line of JSON. Raises Error where a number is not finite."""
    try:
        return json.dumps(plain(value), allow_nan=False)
    except (TypeError, ValueError) as error:
        raise Error(f"{error}; numbers are finite floats, ints, Fractions or texts like '1/3'") from None


def integer(value: Any, name: str) -> int:
    """The int that an int, a NumPy integer or a float without a fraction is. Raises Error for all else."""
    try:
        number = int(value)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name}: {value!r} is no integer") from None
    if number != value:
        raise Error(f"{name}: {value!r} is no integer; round it, if that is meant")
    return number


def obstacle_dict(obstacle: Obstacle) -> dict[str, Any]:
    """`from` of a query, and what an answer says of an obstacle."""
    lattice, atom, cell = obstacle
    # As texts, for cells may be larger than what JSON's numbers carry.
    return {"lattice": integer(lattice, "lattice"), "atom": integer(atom, "atom"),
            "cell": [str(integer(n, "cell")) for n in cell]}


def finite(value: Any, name: str) -> float:
    """A float that is no NaN and not infinite. Raises Error."""
    number = float(value)
    if not math.isfinite(number):
        raise Error(f"{name}: {value!r} is no finite number")
    return number


def time_limit(value: float | None, name: str) -> float | None:
    """A limit of time: above 0, perhaps infinite; or None. Raises Error."""
    if value is not None and not value > 0:
        raise Error(f"{name}: {value!r} is no time above 0")
    return value


def exact(number: Any) -> Fraction | None:
    """The rational number that it is; None of a text with a square root."""
    if isinstance(number, str):
        try:
            return Fraction(number)
        except ValueError:
            return None
    return _fraction(number) if isinstance(number, (Integral, Fraction)) else Fraction(finite(number, "number"))


def _fraction(number: Any) -> Fraction:
    # An integer of NumPy would stay one inside the Fraction, and overflow there.
    return number if isinstance(number, Fraction) else Fraction(int(number))
