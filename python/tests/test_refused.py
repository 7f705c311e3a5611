"""What the command line refuses is refused here, too; and numbers of NumPy are the integers that they are."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any, Callable

import numpy as np
import pytest

import lorentz
from lorentz import oracle

SQUARE = lorentz.unit_scene(2, 0.1)
X, V = [0.5, 0.5], [1, 0.3]

REFUSED: list[tuple[str, Callable[[], Any]]] = [
    ("digits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=2, digits=0)),
    ("digits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=2, digits=10**9)),
    ("digits", lambda: oracle.first_hit(SQUARE, X, V, digits=-5)),
    ("time", lambda: lorentz.itinerary(SQUARE, X, V, time=-7)),
    ("time", lambda: lorentz.itinerary(SQUARE, X, V, time=0)),
    ("time", lambda: lorentz.itinerary(SQUARE, X, V, time=math.nan)),
    ("collisions", lambda: lorentz.itinerary(SQUARE, X, V, collisions=-1)),
    ("most_bits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=1, most_bits=-1)),
    ("until", lambda: lorentz.trajectories(SQUARE, [X], [V], 3, until=math.nan)),
    ("min_width", lambda: lorentz.horizon("square", min_width=math.nan)),
    ("min_width", lambda: lorentz.horizon("square", min_width=-1)),
    ("max_time", lambda: oracle.first_hit(SQUARE, X, V, max_time=math.nan)),
    ("max_time", lambda: oracle.first_hit(SQUARE, X, V, max_time=0)),
    ("max_time", lambda: oracle.first_hit(SQUARE, ["1/2", "1/3"], V, max_time=-1)),
    ("rise", lambda: oracle.convergents(math.nan)),
    ("run", lambda: oracle.convergents(1.0, math.inf)),
    ("atom", lambda: oracle.entry_time(SQUARE, X, V, (0, -1, (2, 1)))),
    ("lattice", lambda: oracle.entry_time(SQUARE, X, V, (1, 0, (2, 1)))),
    ("cell", lambda: oracle.entry_time(SQUARE, X, V, (0, 0, (2, 1, 7)))),
    ("v is zero", lambda: oracle.entry_time(SQUARE, X, [0, 0], (0, 0, (2, 1)))),
    ("cell", lambda: lorentz.hit(1.0, [2.7, 1.2])),
    ("lattice", lambda: lorentz.hit(1.0, [2, 1], lattice=0.5)),  # type: ignore[arg-type]
    ("cell", lambda: oracle.first_hit(SQUARE, X, V, start_from=(0, 0, (0.7, 0)))),  # type: ignore[arg-type]
    ("engine", lambda: lorentz.judge(5)),  # type: ignore[arg-type]
    ("x: ", lambda: lorentz.first_hit(SQUARE, np.array([[0.5 + 1j, 0.5]]), [V])),
    ("x: ", lambda: lorentz.first_hit(SQUARE, np.ma.masked_array([X], [[True, False]]), [V])),
    ("x: ", lambda: lorentz.first_hit(SQUARE, np.array([[2**53 + 1, 0]]), [V])),
    ("x: ", lambda: lorentz.first_hit(SQUARE, [[10**400, 0.5]], [V])),
]


@pytest.mark.parametrize("name, call", REFUSED)
def test_what_has_no_answer_is_refused_by_its_name(name: str, call: Callable[[], Any]) -> None:
    with pytest.raises(lorentz.Error, match=name):
        call()


@pytest.mark.parametrize("kind", [np.int8, np.int64, np.uint64])
def test_integers_of_numpy_are_what_lists_of_ints_are(kind: Any) -> None:
    scene = lorentz.Scene({"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [
        {"position": [0.5, 0.5], "radius": 0.125}]}]})
    x, v = [40, 51], [70, 17]
    told = oracle.first_hit(scene, np.array(x, kind), np.array(v, kind))
    assert told == oracle.first_hit(scene, x, v)
    assert told.exact_time is not None and type(told.exact_time.rational.numerator) is int
    assert float(told.exact_time) == told.time and told.exact_time.decimal(15) is not None


def test_equal_times_are_equal() -> None:
    scene = lorentz.unit_scene(2, 0.125)
    assert (oracle.entry_time(scene, [0.125, 0], [-1, 0], (0, 0, (0, 0))) ==
            oracle.entry_time(scene, [0, 0.125], [0, -2], (0, 0, (0, 0))))
    assert lorentz.oracle.ExactTime(Fraction(1, 8), Fraction(1, 64)).fraction() == 0


def test_a_list_of_obstacles_and_none_is_left() -> None:
    x, v = [[0.5, 0.5], [0.1, 0.0]], [[1, 0.3], [1, 0.0]]
    left = lorentz.first_hit(SQUARE, x, v, start_from=[None, (0, 0, (0, 0))])
    assert left.cell.tolist() == [[2, 1], [1, 0]]


def test_an_exact_engine_of_first_hits_is_judged_right() -> None:
    report = lorentz.judge(lambda scene, x, v, left: lorentz.first_hit(scene, x, v, start_from=left,
                                                                       engine="certified-batch"),
                           vectorized=True, time=2, seed=5)
    # Its columns do not take obstacles beyond 64 bits to start from; nothing else may be wrong.
    assert all("beyond 64 bits" in finding["given"]["message"] for finding in report["findings"]), report["line"]


def test_a_judged_function_that_fails_with_many_queries_is_told_so() -> None:
    report = lorentz.judge(lambda scene, x, v, left: [lorentz.never()], vectorized=True, time=1, seed=5)
    assert "1 answers to" in report["text"]
