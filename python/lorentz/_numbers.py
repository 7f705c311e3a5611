"""Numbers in the form of the exchange formats: floats unchanged, fractions as texts."""

from __future__ import annotations

import json
import math
import re
from contextlib import contextmanager
from fractions import Fraction
from numbers import Integral, Rational
from typing import Any, Iterator, Sequence, Union

import numpy as np

from ._lorentz import Error

#: An exact number: a float (exactly its rational value), an int, a Fraction, or a text such as ``"1/3"``.
Number = Union[float, int, Fraction, str]
Vector = Union[Sequence[Number], "np.ndarray[Any, Any]"]
#: An obstacle: the number of its lattice, the number of its atom there, the coordinates of its cell.
Obstacle = tuple[int, int, Sequence[int]]


# The rational numbers that the formats accept. An exponent with more digits would take hours.
_DECIMAL = re.compile(r"[+-]?(\d+/0*[1-9]\d*|(\d+\.?\d*|\.\d+)(e[+-]?\d{1,5})?)", re.ASCII | re.IGNORECASE)
_HEXADECIMAL = re.compile(r"([+-]?)0x([0-9a-f]+)\.?([0-9a-f]*)(?:p([+-]?\d{1,5}))?", re.ASCII | re.IGNORECASE)


def rational(value: Any, name: str = "number") -> Fraction:
    """The exact rational value of a float, an int, a Decimal or a NumPy number. Raises Error."""
    if isinstance(value, Fraction):
        return value
    if not isinstance(value, (bool, np.bool_)):
        try:
            if isinstance(value, Integral):
                return Fraction(int(value))
            return Fraction(*map(int, value.as_integer_ratio()))
        except (AttributeError, TypeError):
            pass
        except (ValueError, OverflowError):
            raise Error(f"{name}: {value!r} is not a finite number") from None
    raise Error(f"{name}: {value!r} is not a number; numbers are floats, ints, Fractions, Decimals or texts like '1/3'")


def is_binary64(number: Rational) -> bool:
    """True if a float has exactly this value."""
    try:
        return Fraction(float(number)) == number
    except OverflowError:
        return False


def plain(value: Any, name: str = "number") -> Any:
    """A number, a sequence or a dict of numbers in the form of JSON, without changing any number: as an equal
    float if there is one, else as a text. Raises Error with the place of a value that is not a number."""
    if value is None or isinstance(value, float) and math.isfinite(value):
        return value
    if isinstance(value, str):
        number = exact(value)
        return float(number) if number is not None and is_binary64(number) else str(value)
    if isinstance(value, dict):
        return {str(key): item if key == "from" else plain(item, str(key)) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.ndim > 0 or isinstance(value, (list, tuple)):
        return [plain(item, name) for item in value]
    number = rational(value, name)
    return float(number) if is_binary64(number) else str(number)


def text(value: Any) -> str:
    """The same value as a line of JSON."""
    return json.dumps(plain(value), allow_nan=False)


@contextmanager
def renamed(name: str, argument: str) -> Iterator[None]:
    """Errors of the compiled module name the argument, instead of its own name for it."""
    try:
        yield
    except Error as error:
        error.args = (re.sub(rf"^(row \d+: )?{name}\b", rf"\1{argument}", str(error)),)
        raise


def word(value: Any, name: str) -> str:
    """Checks a name. Raises Error if it is not a text."""
    if not isinstance(value, str):
        raise Error(f"{name}: {value!r} is not a name")
    return value


def items(values: Any, name: str) -> list[Any]:
    """The items of a sequence as a list. Raises Error for a single value."""
    if isinstance(values, (str, bytes, dict)):
        raise Error(f"{name}: {values!r} is not a list")
    try:
        return list(values)
    except TypeError:
        raise Error(f"{name}: {values!r} is not a list") from None


def vector(numbers: Any, name: str) -> list[Any]:
    """The components of a place or a velocity. Raises Error if they are not a sequence of numbers."""
    if isinstance(numbers, (str, bytes, dict)) or np.ndim(numbers) != 1:
        raise Error(f"{name}: {numbers!r} is not a sequence of 2 or 3 numbers")
    return list(numbers)


def integer(value: Any, name: str) -> int:
    """The int that equals an int, a NumPy integer or a float without a fraction. Raises Error otherwise."""
    try:
        if np.ndim(value) or isinstance(value, (str, bytes, complex, np.complexfloating)):
            raise TypeError
        number = int(value)
    except (TypeError, ValueError, OverflowError):
        raise Error(f"{name}: {value!r} is not an integer") from None
    if number != value:
        raise Error(f"{name}: {value!r} is not an integer; round it, if that is meant")
    return number


def whole(value: Any, name: str, least: int = 0, most: int = 2**63 - 1) -> int:
    """An integer in this range. Raises Error if it is outside."""
    number = integer(value, name)
    if not least <= number <= most:
        raise Error(f"{name}: {number} is not from {least} to {most}")
    return number


def parts(obstacle: Any, name: str = "start_from") -> Obstacle:
    """Lattice, atom and cell of an obstacle. Raises Error if it does not have this form."""
    if not isinstance(obstacle, (tuple, list)) or len(obstacle) != 3 or np.ndim(obstacle[2]) != 1:
        raise Error(f"{name}: {obstacle!r} is not an obstacle (lattice, atom, cell)")
    return obstacle[0], obstacle[1], obstacle[2]


def own_cell(cell: Any, lattice: int, scene: Any) -> list[int]:
    """A cell with as many coordinates as its lattice has vectors: in arrays there are zeros behind these. `scene` is
    the compiled module's."""
    numbers = [integer(n, "cell") for n in cell]
    rank = scene.rank(lattice) if 0 <= lattice < 2**31 else scene.dimension
    return numbers[:rank] if len(numbers) == scene.dimension and not any(numbers[rank:]) else numbers


def obstacle_dict(obstacle: Obstacle, scene: Any) -> dict[str, Any]:
    """An obstacle as in the key `from` of a query of this scene."""
    lattice, atom, cell = parts(obstacle)
    number = integer(lattice, "lattice")
    # As texts, because cells may be too large for JSON's numbers.
    return {"lattice": number, "atom": integer(atom, "atom"), "cell": [str(n) for n in own_cell(cell, number, scene)]}


def finite(value: Any, name: str) -> float:
    """The float that equals a number. Raises Error if there is none."""
    number = rational(value, name)
    if not is_binary64(number):
        raise Error(f"{name}: {value!r} is not a number that a float can be")
    return float(number)


def claim(precision: Any, time_tolerance: Any, domain: Any = None, starts_inside: Any = "inside") -> str:
    """The claim of an engine, as the line that a program writes about itself (docs/formats.md). Raises Error."""
    precision, tolerance = _precision_and_tolerance(precision, time_tolerance)
    if word(starts_inside, "starts_inside") not in ("inside", "miss", "zero", "exit", "unsupported"):
        raise Error(f"starts_inside: {starts_inside!r} is not one of inside, miss, zero, exit, unsupported")
    said: dict[str, Any] = {"precision": precision, "inside": starts_inside}
    if tolerance is not None:
        said["time_tolerance"] = "inf" if tolerance == math.inf else tolerance
    if domain is not None:
        if not isinstance(domain, dict):
            raise Error(f"domain: {domain!r} is not a dict like {{'speed': (1e-3, 1e3)}}")
        unknown = set(domain) - {"speed", "coordinates", "radius", "flight", "shapes", "limits", "dimensions"}
        if unknown:
            raise Error(f"domain: {sorted(map(str, unknown))[0]!r} is not one of its keys")
        said |= {"dimensions": domain["dimensions"]} if "dimensions" in domain else {}
        said["domain"] = {key: value for key, value in domain.items() if key != "dimensions"}
    try:
        return json.dumps({"engine": said}, allow_nan=False, default=float)
    except (TypeError, ValueError) as error:
        raise Error(f"domain: {error}; use the text 'inf' for an open end") from None


def _precision_and_tolerance(precision: Any, time_tolerance: Any) -> tuple[str, float | None]:
    if word(precision, "precision") not in ("binary64", "binary32"):
        raise Error(f"precision: {precision!r} is neither 'binary64' nor 'binary32'")
    if time_tolerance is None or isinstance(time_tolerance, float) and time_tolerance == math.inf:
        return precision, time_tolerance
    tolerance = finite(time_tolerance, "time_tolerance")
    if tolerance < 0:
        raise Error(f"time_tolerance: {tolerance} is below 0")
    return precision, tolerance


def time_limit(value: Any, name: str) -> Any:
    """A time limit: above 0, possibly infinite; or None. Raises Error."""
    try:
        if value is None or np.ndim(value) == 0 and (exact(value) or 0 if isinstance(value, str) else value) > 0:
            return value
    except (TypeError, ValueError, ArithmeticError):
        pass
    raise Error(f"{name}: {value!r} is not a time above 0")


def exact(number: Any, name: str = "number") -> Fraction | None:
    """The exact rational value of a number; None for a text with a square root."""
    if not isinstance(number, str):
        return rational(number, name)
    if _DECIMAL.fullmatch(number):
        return Fraction(str(number))
    hexadecimal = _HEXADECIMAL.fullmatch(number)
    if not hexadecimal:
        return None
    sign, whole_part, part, exponent = hexadecimal.groups("")
    digits = Fraction(int(sign + whole_part + part, 16))
    return digits * Fraction(2) ** (int(exponent or 0) - 4 * len(part))
