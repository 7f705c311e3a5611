"""Results in columns, with the interfaces of arrays, lists and data frames."""

from __future__ import annotations

from typing import Any, ClassVar, Generic, Iterator, TypeVar

import numpy as np
import numpy.typing as npt

Self = TypeVar("Self", bound="Columns")
Number = TypeVar("Number", bound=np.generic)
Array = npt.NDArray[Any]


class Column(Generic[Number]):
    """A column of a result, under its name in the class. Its docstring describes the contents."""

    def __init__(self, kind: type[Number], doc: str) -> None:
        self.__doc__ = doc

    def __set_name__(self, owner: type[Columns], name: str) -> None:
        self._name = name
        owner._NAMES = (*owner._NAMES, name)

    def __get__(self, result: Columns, kind: Any = None) -> npt.NDArray[Number]:
        return self if result is None else result._columns[self._name]

    def __set__(self, result: Columns, value: Any) -> None:
        raise AttributeError(f"{self._name} is what the engine wrote; copy it to change it")


class Columns:
    """Columns of N rows. The columns of a whole result are read-only views of the memory that the engine
    wrote; those of a part, of a copy or of an unpickled result are separate arrays.

    ``result[i]`` is row i. ``result[rows]``, with a slice, a mask or an array of numbers, is a result with
    these rows. ``result["time"]`` is a column. A loop goes over the rows. Results can be pickled and copied.
    They are equal if all columns are equal. When an engine writes over the result (``out=``), columns and
    `to_dict` change; slices, copies and data frames do not.
    """

    __slots__ = ("_native", "_columns")
    _NAMES: ClassVar[tuple[str, ...]] = ()

    def __init__(self, native: Any, columns: dict[str, Array] | None = None) -> None:
        self._native = native  # None for a part or a copy
        self._columns = columns if columns is not None else {name: getattr(native, name) for name in self._NAMES}

    def __len__(self) -> int:
        return len(self._columns[self._NAMES[0]])

    def __getitem__(self: Self, rows: Any) -> Any:
        if isinstance(rows, str):
            if rows not in self._NAMES:
                raise KeyError(f"{rows}; the columns are {', '.join(self._NAMES)}")
            return self._columns[rows]
        if rows is None or isinstance(rows, (bool, np.bool_)):
            raise IndexError(f"{rows!r} is not a row, a slice, a mask or an array of numbers")
        if isinstance(rows, (int, np.integer)):
            if not -len(self) <= rows < len(self):
                raise IndexError(f"row {rows} of {len(self)}")
            return self._row(int(rows) % len(self))
        return self._part(np.arange(len(self))[rows])

    def __iter__(self) -> Iterator[Any]:
        return (self._row(i) for i in range(len(self)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self._rest() == other._rest() and same(self._columns, other._columns)

    def __repr__(self) -> str:
        shown = range(len(self)) if len(self) <= 6 else [0, 1, 2, -3, -2, -1]
        lines = [f"  {i % len(self)}: {self._row_text(i % len(self))}" for i in shown]
        if len(self) > 6:
            lines.insert(3, "  ..")
        return "\n".join([self._headline(), *lines])

    def __reduce__(self) -> Any:
        copies = {name: np.array(column) for name, column in self._columns.items()}
        return _unpickled, (type(self), copies, *self._rest())

    def __array__(self, *arguments: Any, **options: Any) -> Array:
        raise TypeError(f"{type(self).__name__} are columns ({', '.join(self._NAMES)}); take one of them")

    def to_frame(self) -> Any:
        """`to_dict` as a pandas DataFrame. pandas must be installed."""
        import pandas

        return pandas.DataFrame(self.to_dict())

    def to_dict(self) -> dict[str, Array]:
        """One-dimensional columns by name. ``cell`` becomes ``cell_0``, ``cell_1`` ..."""
        raise NotImplementedError

    def _of_rows(self, rows: Array) -> dict[str, Array]:
        """The columns with these rows only."""
        return _frozen({name: column[rows] for name, column in self._columns.items()})

    def _row(self, i: int) -> Any:
        raise NotImplementedError

    def _part(self: Self, rows: Array) -> Self:
        raise NotImplementedError

    def _row_text(self, i: int) -> str:
        raise NotImplementedError

    def _headline(self) -> str:
        raise NotImplementedError

    def _rest(self) -> tuple[Any, ...]:
        """The data besides columns: further arguments of the constructor."""
        return ()


def same(values: dict[str, Any], others: dict[str, Any]) -> bool:
    """True if all values are equal, arrays and others. A NaN equals a NaN."""
    return all(np.array_equal(value, others[name], equal_nan=np.asarray(value).dtype.kind == "f")
               for name, value in values.items())


def _frozen(columns: dict[str, Array]) -> dict[str, Array]:
    for column in columns.values():
        column.setflags(write=False)
    return columns


def _unpickled(kind: Any, columns: dict[str, Array], *rest: Any) -> Any:
    return kind(None, _frozen(columns), *rest)


def by_component(name: str, column: Array) -> dict[str, Array]:
    """One column for each component of an array (N, d)."""
    return {f"{name}_{k}": column[:, k] for k in range(column.shape[1])}
