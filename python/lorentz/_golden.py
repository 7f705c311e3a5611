"""Golden sets: hard queries with their exact answers and proofs."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Iterator

from . import _lorentz
from ._answer import Answer
from ._lorentz import Certificate, Error
from ._numbers import Obstacle
from ._scene import Scene, wrapped


@dataclass(frozen=True)
class GoldenRecord:
    """A record of a golden set (docs/golden.md).

    Attributes:
        question: the text of the query. If it is not a valid query, ``flaw`` is the reason, x, v and
            start_from are None, and the answer is "error".
        margin, condition, time_change: how hard the query is, in ulps of the set's precision
            (docs/verdicts.md).
        acceptable: obstacles (None: "never") that errors of at most 16 ulps in the inputs make right, with
            these ulps. The tag "needs-judge" marks records with too many to list.
        comment: the difficulty of the query. source_id: the id, as JSON, of the query from which it was made.
        certificate: the proof of the answer.
    """

    id: str
    tags: list[str]
    scene: Scene
    question: str
    flaw: str | None
    x: tuple[float, ...] | None
    v: tuple[float, ...] | None
    start_from: Obstacle | None
    answer: Answer
    margin: float | None
    condition: float | None
    time_change: float | None
    acceptable: list[tuple[Obstacle | None, float]]
    comment: str
    source_id: str
    certificate: Certificate | None


class GoldenSet:
    """An iterable of the records of a set. Each iteration reads them anew from the file, one by one.

    ``precision``, "binary64" or "binary32", applies to all numbers in the set and to the ulps of margins.

    Args:
        name_or_file: one of `golden_sets`, or a file.

    Raises:
        FileError: there is no such file. Error: no set has this name, or it is not a golden set; the message has the line.
    """

    def __init__(self, name_or_file: str | os.PathLike[str]) -> None:
        if not isinstance(name_or_file, (str, os.PathLike)):
            raise Error(f"name_or_file: {name_or_file!r} is not the name of a set, or a file")
        reader = _lorentz.GoldenReader(os.fspath(name_or_file))
        self.path, self.name, self.description = reader.path, reader.name, reader.description
        self.precision: str = reader.precision
        self._count = reader.count

    def __len__(self) -> int:
        """The number of records in the header."""
        return self._count

    def __iter__(self) -> Iterator[GoldenRecord]:
        reader = _lorentz.GoldenReader(self.path)
        seen: tuple[_lorentz.Scene, Scene] | None = None
        while True:
            try:
                fields = next(reader)
            except StopIteration:
                return
            if seen is None or seen[0] is not fields["scene"]:
                seen = fields["scene"], wrapped(fields["scene"])
            decimal = fields.pop("time_decimal")
            answer = replace(Answer.from_line(fields["answer"]), time_decimal=decimal)
            fields |= {"scene": seen[1], "answer": answer}
            yield GoldenRecord(**fields)

    def __repr__(self) -> str:
        return f"GoldenSet({self.path!r})"


def golden(name_or_file: str | os.PathLike[str]) -> GoldenSet:
    """The golden set with this name or file: ``for record in lorentz.golden("near-rational"): ..``"""
    return GoldenSet(name_or_file)


def golden_sets() -> list[str]:
    """The names of the sets that come with the package."""
    return [os.path.splitext(os.path.basename(path))[0] for path in _lorentz.golden_sets()]
