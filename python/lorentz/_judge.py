"""Judging of engines: the engines of the package, other programs, and Python functions."""

from __future__ import annotations

import inspect
import json
import os
from typing import Any, Callable, Iterable, Union

from . import _lorentz
from ._answer import Answer, hit, inside, unsupported
from ._answers import Answers, Outcome
from ._lorentz import Error, UnsupportedError
from ._numbers import Obstacle, claim, finite, whole
from ._scene import Scene, wrapped

#: ``engine(scene, x, v, start_from)`` returns the answer to one query, or to N (docs/python.md). start_from
#: is passed by name if it is not the fourth parameter, as in `first_hit`.
FirstHitFunction = Callable[..., Any]


def judge(engine: Union[str, FirstHitFunction], *, name: str | None = None, vectorized: bool = False,
          quick: bool = True, time: float | None = None, questions: int | None = None, seed: int = 20161115,
          jobs: int = 1, ulps: float = 4, precision: str = "binary64", time_tolerance: float | None = None,
          domain: dict[str, Any] | None = None, starts_inside: str = "inside", times: bool = False, html: str | os.PathLike[str] | None = None) -> dict[str, Any]:
    """A full report on one engine: its errors, their causes, and its speed (docs/judge.md).

    Args:
        engine: the name of an engine, ``"cmd:COMMAND"`` for an external program, ``"lib:FILE.so"`` for a shared
            library (docs/command_engines.md), or a function ``f(scene, x, v, start_from)``. Its arguments are
            a `Scene`, a place and a velocity of shape (d,), and the obstacle (lattice, atom, cell) that the
            particle leaves, or None. It returns an `Answer`: `hit`, `never`, `inside`, `undecided`,
            `unsupported`; or arrays of one row, as below. An exception counts as an error of the engine,
            except an UnsupportedError.
        vectorized: the function takes x and v of shape (N, d) and a list of N start_from. It returns N
            answers, or the `Answers` of `first_hit`, or a dict of such columns: ``outcome`` (codes of
            `Outcome`, or their names), ``cell`` (N, d), ``time``, ``lattice`` and ``atom`` if these are not
            all 0, and ``reasons`` as in `Answers`: why a row is an error, and whether it is only unsupported.
        name: the engine's name in the report; by default the function's own name.
        quick: at most 20 seconds, the default, instead of two minutes.
        time: at most about this many seconds instead.
        questions: the number of questions in each row, instead of a time. It is the same on every machine.
        seed: the seed of all drawn questions.
        jobs: the number of threads of the campaign, unless `questions` is given. A Python function still runs
            one call at a time.
        ulps: the tolerance of the verdicts; 0 means no tolerance.
        precision: the precision of the engine's numbers, "binary64" or "binary32". The questions consist of
            such numbers, and ulps are those of this precision.
        time_tolerance: T: a time is right if it is off by at most T times itself, instead of by ulps. With
            infinity times are not judged.
        domain: the questions that the engine is made for: intervals of "speed", "coordinates", "radius" and
            "flight", as in ``{"speed": (1e-3, 1e3)}``, "shapes", "dimensions", "limits" (docs/formats.md).
            Others are not asked.
        starts_inside: what the engine answers if x lies in an obstacle: "inside", "miss", "zero", "exit", or
            "unsupported" (docs/formats.md).
        times: wrong times count in the verdict.
        html: a file for the report as a page. It is written as a whole or not at all.

    Returns:
        The report of `lorentz judge --json`: ``verdict``, ``line`` (the verdict in one line),
        ``difficulties`` (rows with the questions and their results), ``findings`` (faults, each with its
        simplest case); and ``text``, the output of `lorentz judge --all`, with the number of calls with many
        queries that failed.

    Raises:
        Error: the engine is unknown. FileError: the page cannot be written, or the package has no page
            (docs/page.md).
    """
    if isinstance(engine, str):
        function, called, command = None, engine, f"lorentz.judge({engine!r})"
    else:
        if not callable(engine):
            raise Error(f"engine: {engine!r} is neither a name nor a function")
        function = _Asked(_with_four_parameters(engine), vectorized)
        called = str(name or getattr(engine, "__name__", type(engine).__name__))
        command = f"lorentz.judge({called})"
    page = None if html is None else os.fspath(html)
    seconds = None if time is None else finite(time, "time")
    report, text = _lorentz.judge(
        function, called, command, quick, seconds,
        None if questions is None else whole(questions, "questions", 1, 10**9), whole(seed, "seed", 0, 2**64 - 1),
        whole(jobs, "jobs", 1, 1024), finite(ulps, "ulps"), times, page,
        claim(precision, time_tolerance, domain, starts_inside))
    result: dict[str, Any] = json.loads(report)
    if function is not None and function.failed:
        text += (f"\n{function.failed} calls with many queries failed and were repeated one by one: "
                 f"{function.failure}\n")
    return result | {"text": text}


def _with_four_parameters(function: FirstHitFunction) -> FirstHitFunction:
    """The function with four arguments. Raises Error now, so that calls do not fail for two minutes."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):  # some functions written in C have no signature
        return function
    by_name = _is_fifth_or_named(list(signature.parameters.values()))
    try:
        signature.bind(None, None, None, **{"start_from": None}) if by_name else signature.bind(*[None] * 4)
    except TypeError as error:
        raise Error(f"engine: is called with scene, x, v, start_from: {error}") from None
    if not by_name:
        return function

    def called_by_name(scene: Scene, x: Any, v: Any, start_from: Any) -> Any:
        return function(scene, x, v, start_from=start_from)

    return called_by_name


def _is_fifth_or_named(parameters: list[inspect.Parameter]) -> bool:
    """Whether ``start_from`` exists but is not the fourth parameter."""
    return any(p.name == "start_from" and (p.kind is p.KEYWORD_ONLY or i > 3) for i, p in enumerate(parameters))


class _Asked:
    """Asks a function the judge's questions, and converts its answers into lines."""

    def __init__(self, function: FirstHitFunction, vectorized: bool) -> None:
        self.function, self.vectorized = function, vectorized
        self.seen: tuple[_lorentz.Scene, Scene] | None = None
        self.failed, self.failure = 0, ""  # failed calls with many queries, and the reason of the first

    def __call__(self, scene: _lorentz.Scene, x: Any, v: Any, start_from: list[Obstacle | None]) -> list[str]:
        place = self._scene(scene)
        if not self.vectorized:
            return [_line(self.function, place, *query) for query in zip(x, v, start_from)]
        try:
            lines = [answer.to_line() for answer in _answers(self.function(place, x, v, start_from))]
            if len(lines) == len(x):
                return lines
            raise Error(f"{len(lines)} answers to {len(x)} queries")
        except UnsupportedError as error:
            if len(x) == 1:
                return [unsupported(str(error)).to_line()]
        except Exception as error:
            message = _message(error)
            if len(x) == 1:
                return [_error(message)]
            self.failed, self.failure = self.failed + 1, self.failure or message
        # Asks the queries one by one, so that only the faulty ones fail.
        return [line for i in range(len(x)) for line in self(scene, x[i:i + 1], v[i:i + 1], start_from[i:i + 1])]

    def _scene(self, scene: _lorentz.Scene) -> Scene:
        if self.seen is None or self.seen[0] is not scene:
            self.seen = scene, wrapped(scene)
        return self.seen[1]


def _line(function: FirstHitFunction, scene: Scene, x: Any, v: Any, start_from: Obstacle | None) -> str:
    try:
        answer = function(scene, x, v, start_from)
        if isinstance(answer, (Answers, dict)):
            answers = list(_answers(answer))
            if len(answers) != 1:
                return _error(f"{len(answers)} answers to 1 query")
            answer = answers[0]
        if not isinstance(answer, Answer):
            return _error(f"{type(answer).__name__} is no Answer")
        return answer.to_line()
    except UnsupportedError as error:
        return unsupported(str(error)).to_line()
    except Exception as error:
        return _error(_message(error))


def _answers(given: Any) -> Iterable[Answer]:
    if isinstance(given, dict):
        count = len(given["outcome"])
        for name, column in given.items():
            if name != "reasons" and len(column) != count:
                raise Error(f"{name}: has {len(column)} rows, outcome has {count}")
        return [_answer(given, i, _outcome(code)) for i, code in enumerate(given["outcome"])]
    return list(given)


def _outcome(code: Any) -> Outcome:
    """The outcome with this code, or with a name such as ``"hit"``."""
    if isinstance(code, str):
        return Outcome[code.upper()]
    return Outcome(int(code))


def _answer(columns: dict[str, Any], i: int, outcome: Outcome) -> Answer:
    if outcome is Outcome.ERROR:
        message, unsupported = columns.get("reasons", {}).get(i, ("", False))
        return Answer("error", message=message, unsupported=unsupported)
    if outcome not in (Outcome.HIT, Outcome.INSIDE):
        return Answer(outcome.name.lower())
    place = [columns["cell"][i], *(columns[name][i] if name in columns else 0 for name in ("lattice", "atom"))]
    return hit(columns["time"][i], *place) if outcome is Outcome.HIT else inside(*place)


def _message(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"


def _error(message: str) -> str:
    return Answer("error", message=message).to_line()
