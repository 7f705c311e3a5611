"""First hits in columns."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
import numpy.typing as npt

from ._answer import Answer
from ._columns import Array, Column, Columns, by_component

Floats = npt.NDArray[np.float64]


class Outcome(IntEnum):
    """The codes of ``Answers.outcome`` (docs/formats.md)."""

    HIT = 0
    NEVER = 1
    INSIDE = 2
    LATER = 3
    UNDECIDED = 4
    ERROR = 5


class Answers(Columns):
    """The answers to N queries, in columns. `lorentz.first_hit` returns them."""

    __slots__ = ("_large_cells", "_reasons")

    outcome = Column(np.int32, "(N,): codes of `Outcome`.")
    lattice = Column(np.int32, "(N,): lattice of the obstacle that is hit, or that contains x; otherwise 0.")
    atom = Column(np.int32, "(N,): its atom in that lattice; otherwise 0.")
    cell = Column(np.int64, "(N, d): its cell; 0 without an obstacle, and if 64 bits do not hold it: "
                  "see `large_cells`.")
    time = Column(np.float64, "(N,): time of the hit, so that x + time * v is the place; NaN without a hit.")
    time_is_rounded = Column(np.bool_, "(N,): True if the time is known to be correctly rounded.")
    stage = Column(np.uint8, "(N,): the precision that decided (docs/formats.md).")

    def __init__(self, native: Any, columns: dict[str, Array] | None = None,
                 large_cells: dict[int, tuple[int, ...]] | None = None,
                 reasons: dict[int, tuple[str, bool]] | None = None) -> None:
        super().__init__(native, columns)
        self._large_cells, self._reasons = large_cells or {}, reasons or {}

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return int(self.cell.shape[1])

    @property
    def large_cells(self) -> dict[int, tuple[int, ...]]:
        """The cells that do not fit into 64 bits, by row."""
        cells: dict[int, tuple[int, ...]] = self._large_cells if self._native is None else self._native.large_cells
        return cells

    @property
    def reasons(self) -> dict[int, tuple[str, bool]]:
        """By row: why the row is an error, and whether its query is valid but not supported by the engine."""
        reasons: dict[int, tuple[str, bool]] = self._reasons if self._native is None else self._native.reasons
        return reasons

    @property
    def hit(self) -> npt.NDArray[np.bool_]:
        """(N,): True for hits. ``answers[answers.hit]`` are the hits."""
        hits: npt.NDArray[np.bool_] = self.outcome == Outcome.HIT
        return hits

    def to_dict(self) -> dict[str, Array]:
        cell = self.cell
        if large := self.large_cells:
            cell = cell.astype(object)
            cell[list(large)] = list(large.values())
        columns = {name: column for name, column in self._columns.items() if name != "cell"}
        return columns | by_component("cell", cell)

    def to_frame(self) -> Any:
        """As `Columns.to_frame`, but outcomes are categories with their names."""
        import pandas

        names = [outcome.name.lower() for outcome in Outcome]
        return super().to_frame().assign(outcome=pandas.Categorical.from_codes(self.outcome, names))

    def _row(self, i: int) -> Answer:
        outcome = Outcome(int(self.outcome[i]))
        if outcome is Outcome.ERROR:
            message, unsupported = self.reasons.get(i, ("", False))
            return Answer("error", message=message, unsupported=unsupported)
        if outcome not in (Outcome.HIT, Outcome.INSIDE):
            return Answer(outcome.name.lower())
        cell = self.large_cells.get(i) or tuple(self.cell[i].tolist())
        time = float(self.time[i]) if outcome is Outcome.HIT else None
        return Answer(outcome.name.lower(), int(self.lattice[i]), int(self.atom[i]), cell, time)

    def _part(self, rows: Array) -> Answers:
        large, reasons = self.large_cells, self.reasons
        numbered = list(enumerate(rows.tolist())) if large or reasons else []
        return Answers(None, self._of_rows(rows), {i: large[row] for i, row in numbered if row in large},
                       {i: reasons[row] for i, row in numbered if row in reasons})

    def _row_text(self, i: int) -> str:
        answer = self._row(i)
        text = answer.outcome
        if answer.obstacle is not None:
            text += f" cell {answer.cell}, lattice {answer.lattice}, atom {answer.atom}"
        if answer.time is not None:
            text += f", time {answer.time!r}"
        return text + (f": {answer.message}" if answer.message else "")

    def _headline(self) -> str:
        counts = [(int(np.count_nonzero(self.outcome == outcome)), outcome.name.lower()) for outcome in Outcome]
        told = ", ".join(f"{count} {name}" for count, name in counts if count) or "none"
        return f"Answers to {len(self)} queries in {self.dimension}D: {told}"

    def _rest(self) -> tuple[Any, ...]:
        return self.large_cells, self.reasons
