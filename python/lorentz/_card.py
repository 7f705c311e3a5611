"""First hits of arrays in a graphics card's memory (CuPy, PyTorch, Numba), which stay there."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from . import _lorentz
from ._lorentz import Error


class OnCard(Protocol):
    """An array in a card's memory."""

    @property
    def __cuda_array_interface__(self) -> dict[str, Any]: ...


class CardArray:
    """A column in a card's memory. `cupy.asarray`, `torch.as_tensor` and `numba.cuda.as_cuda_array` take it as it is,
    `numpy.asarray` a copy."""

    def __init__(self, owner: Any, name: str, kind: str) -> None:
        self._owner = owner  # whose memory it is
        address, self._copy = getattr(owner, name)()
        rows: tuple[int, ...] = (owner.count,)
        strides = None
        if name == "cell":
            rows, strides = (owner.count, owner.dimension), (8, 8 * owner.count)
        self.__cuda_array_interface__ = {"shape": rows, "strides": strides, "typestr": kind, "data": (address, True),
                                         "version": 3, "stream": None}

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return np.asarray(self._copy().T, dtype)

    def __len__(self) -> int:
        return int(self._owner.count)


class CardAnswers:
    """The answers to N queries, in a card's memory. As `Answers`, but: `lattice` is -1 without an obstacle, and `time`
    0 without a hit."""

    def __init__(self, native: Any) -> None:
        self._native = native
        self.outcome, self.lattice, self.atom = (CardArray(native, name, "<i4") for name in ("outcome", "lattice", "atom"))
        self.cell, self.time = CardArray(native, "cell", "<i8"), CardArray(native, "time", "<f8")

    def __len__(self) -> int:
        return int(self._native.count)

    @property
    def reasons(self) -> dict[int, str]:
        """By row: why the row is an error."""
        return dict(self._native.errors)


def is_there(array: Any) -> bool:
    """True for an array in a card's memory."""
    return hasattr(array, "__cuda_array_interface__")


def first_hit(engine: Any, dimension: int, x: Any, v: Any, max_time: Any, start_from: Any, on_error: str) -> CardAnswers:
    """As `lorentz.first_hit`, for arrays (N, d) in a card's memory."""
    count, places = _place(x, "x", dimension)
    _, velocities = _place(v, "v", dimension, count)
    limits = None if max_time is None else _place(max_time, "max_time", None, count)[1][0]
    if start_from is not None and not (isinstance(start_from, CardAnswers) and len(start_from) == count
                                       and start_from._native.dimension == dimension):
        raise Error(f"start_from: needs the answers of {count} queries in {dimension} dimensions that the card gave, or None")
    answers = CardAnswers(engine.first_hits(dimension, count, places, velocities, limits,
                                            None if start_from is None else start_from._native))
    if on_error == "raise" and answers._native.errors:
        row, why = answers._native.errors[0]
        raise Error(f"row {row}: {why}")
    return answers


def _place(array: Any, name: str, dimension: int | None, count: int | None = None) -> tuple[int, tuple[int, int, int]]:
    """The number of rows; the address, and the steps from one row and one component to the next, in numbers."""
    if not is_there(array):
        raise Error(f"{name}: is not in the card's memory, as x or v is")
    its = array.__cuda_array_interface__
    rows = its["shape"][0] if its["shape"] else 0
    wanted = (rows if count is None else count,) + (() if dimension is None else (dimension,))
    if its["typestr"] != "<f8" or tuple(its["shape"]) != wanted:
        raise Error(f"{name}: is an array {tuple(its['shape'])} of {its['typestr']}, needs {wanted} of <f8 (binary64)")
    if its.get("mask") is not None:
        raise Error(f"{name}: is a masked array; fill it first")
    steps = its.get("strides") or (8 * (dimension or 1), 8)
    if dimension is None and rows > 1 and steps[0] != 8:
        raise Error(f"{name}: needs numbers one behind the other")
    if any(step % 8 or step < 0 for step in steps):
        raise Error(f"{name}: needs steps of whole numbers, forward")
    return rows, (its["data"][0], steps[0] // 8, steps[-1] // 8)
