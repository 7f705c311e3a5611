"""Numbers as the exchange formats have them: every float as it is, fractions as texts."""

from __future__ import annotations

import json
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
        rational = Fraction(value)
        return float(rational) if is_binary64(rational) else str(rational)
    return float(value)


def text(value: Any) -> str:
    """The same as a line of JSON. Raises Error where a number is not finite."""
    try:
        return json.dumps(plain(value), allow_nan=False)
    except (TypeError, ValueError) as error:
        raise Error(f"{error}; numbers are finite floats, ints, Fractions or texts like '1/3'") from None


def obstacle_dict(obstacle: Obstacle) -> dict[str, Any]:
    """`from` of a query, and what an answer says of an obstacle."""
    lattice, atom, cell = obstacle
    # As texts, for cells may be larger than what JSON's numbers carry.
    return {"lattice": int(lattice), "atom": int(atom), "cell": [str(int(n)) for n in cell]}


def exact(number: Any) -> Fraction | None:
    """The rational number that it is; None of a text with a square root."""
    if isinstance(number, str):
        try:
            return Fraction(number)
        except ValueError:
            return None
    return Fraction(number) if isinstance(number, (Integral, Fraction)) else Fraction(float(number))
