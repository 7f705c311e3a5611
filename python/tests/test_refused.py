"""What the command line refuses is refused here, too; and numbers of NumPy are the integers that they are."""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from typing import Any, Callable

import numpy as np
import pytest

import lorentz
from lorentz import oracle

SQUARE = lorentz.unit_scene(2, 0.1)
X, V = [0.5, 0.5], [1, 0.3]
HIT = '{"outcome":"hit","lattice":0,"atom":0,"cell":[%s,1],"time":%s}'


def square_with_vector(length: str) -> lorentz.Scene:
    return lorentz.Scene({"dimension": 2, "lattices": [{"vectors": [[length, 0], [0, 1]], "atoms": [
        {"position": [0, 0], "radius": 0.1}]}]})


def one_window(begin: float) -> dict[str, Any]:
    return {"windows": [{"lattice": 0, "atom": 0, "from": begin, "to": 2, "basis": [[1, 0], [0, 1]]}]}


REFUSED: list[tuple[str, Callable[[], Any]]] = [
    ("digits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=2, digits=0)),
    ("digits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=2, digits=10**9)),
    ("digits", lambda: oracle.first_hit(SQUARE, X, V, digits=-5)),
    ("max_time", lambda: lorentz.itinerary(SQUARE, X, V, max_time=-7)),
    ("max_time", lambda: lorentz.itinerary(SQUARE, X, V, max_time=0)),
    ("max_time: inf", lambda: lorentz.itinerary(SQUARE, X, V, max_time=math.inf)),
    ("max_time", lambda: lorentz.itinerary(SQUARE, X, V, max_time=math.nan)),
    ("collisions", lambda: lorentz.itinerary(SQUARE, X, V, collisions=-1)),
    ("most_bits", lambda: lorentz.itinerary(SQUARE, X, V, collisions=1, most_bits=-1)),
    ("max_time", lambda: lorentz.trajectories(SQUARE, [X], [V], 3, max_time=math.nan)),
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
    ("jobs: 2.5", lambda: lorentz.Engine(SQUARE, jobs=2.5)),  # type: ignore[arg-type]
    ("jobs: -1 ", lambda: lorentz.flights(SQUARE, count=10, jobs=-1)),
    ("jobs: 'two'", lambda: lorentz.judge("reduction", jobs="two")),  # type: ignore[arg-type]
    ("seed: -1 ", lambda: lorentz.draw_starts(SQUARE, 3, seed=-1)),
    ("seed: 18446744073709551616 ", lambda: lorentz.judge("reduction", seed=2**64)),
    ("count: -3 ", lambda: lorentz.draw_starts(SQUARE, -3)),
    ("count: 0 ", lambda: lorentz.flights(SQUARE, count=0)),
    ("count: nan", lambda: lorentz.flights(SQUARE, count=math.nan)),  # type: ignore[arg-type]
    ("first: -1 ", lambda: lorentz.draw_starts(SQUARE, 3, first=-1)),
    ("collisions: -1 ", lambda: lorentz.trajectories(SQUARE, [X], [V], -1)),
    ("collisions: 1.5", lambda: lorentz.trajectories(SQUARE, [X], [V], 1.5)),  # type: ignore[arg-type]
    ("max_time: 'soon'", lambda: lorentz.trajectories(SQUARE, [X], [V], 1, max_time="soon")),  # type: ignore[arg-type]
    ("max_time: 'soon'", lambda: oracle.first_hit(SQUARE, X, V, max_time="soon")),  # type: ignore[arg-type]
    ("max_time: ", lambda: lorentz.first_hit(SQUARE, [X], [V], max_time="soon")),
    ("max_time: ", lambda: lorentz.first_hit(SQUARE, [X], [V], max_time=[1, 2])),
    ("max_time: has numbers that floats", lambda: lorentz.first_hit(SQUARE, [X], [V], max_time=Fraction(1, 3))),
    ("max_time: is not an array", lambda: lorentz.first_hit(SQUARE, [X], [V], max_time=True)),
    ("start_from: 2147483648", lambda: lorentz.first_hit(SQUARE, [X], [V], start_from=[(2**31, 0, (2**70, 0))])),
    ("start_from: 1099511627776", lambda: lorentz.first_hit(SQUARE, [X], [V], start_from=[(2**40, 0, (2**70, 0))])),
    ("most: -1 ", lambda: oracle.passed(SQUARE, X, V, most=-1)),
    ("limit: -1 ", lambda: oracle.convergents(0.5, limit=-1)),
    ("rise: 'x'", lambda: oracle.convergents("x")),  # type: ignore[arg-type]
    ("min_width: None", lambda: lorentz.horizon("square", min_width=None)),  # type: ignore[arg-type]
    ("ulps: 'x'", lambda: lorentz.judge("reduction", ulps="x")),  # type: ignore[arg-type]
    ("time: 'x'", lambda: lorentz.judge("reduction", time="x")),  # type: ignore[arg-type]
    ("rounded to binary64: .*radius", lambda: lorentz.unit_scene(2, "1e400").nearest()),
    ("rounded to binary64: .*radius", lambda: lorentz.unit_scene(2, "1e-400").nearest()),
    ("rounded to binary64: .*dependent", lambda: square_with_vector("1e-400").nearest()),
    ("start_from: .*int32", lambda: lorentz.first_hit(SQUARE, [X], [V], start_from=(2**32, 0, (0, 0)))),
    ("start_from: .*int32", lambda: lorentz.first_hit(SQUARE, [X], [V], start_from=(0, 2**32, (0, 0)))),
    ("start_from: .*int64", lambda: lorentz.first_hit(SQUARE, [X], [V], start_from=(0, 0, np.array([2**64 - 1, 0], np.uint64)))),
    ("start_from: .*int32", lambda: lorentz.trajectories(SQUARE, [X], [V], 1, start_from=(2**32, 0, (0, 0)))),
    ("start_from", lambda: oracle.first_hit(SQUARE, X, V, start_from=(0, 0))),  # type: ignore[arg-type]
    ("x: has numbers that floats would round", lambda: lorentz.first_hit(SQUARE, [[2**53 + 1, 0.0]], [V])),
    ("x: has numbers that floats would round", lambda: lorentz.first_hit(SQUARE, [[Fraction(1, 3), 0]], [V])),
    ("x: has numbers that floats would round", lambda: lorentz.first_hit(SQUARE, [[Decimal("0.1"), 0]], [V])),
    ("x: has numbers that floats would round", lambda: lorentz.first_hit(SQUARE, [[np.longdouble(1) / 3, 0]], [V])),
    ("v: is not an array of numbers", lambda: lorentz.first_hit(SQUARE, [X], np.array([[True, False]]))),
    ("x: is not an array of numbers", lambda: lorentz.first_hit(SQUARE, [["1", "2"]], [V])),
    ("x: ", lambda: oracle.first_hit(SQUARE, b"12", V)),  # type: ignore[arg-type]
    ("x: nan", lambda: oracle.first_hit(SQUARE, [math.nan, 0], V)),
    ("radius: inf", lambda: lorentz.unit_scene(2, math.inf)),
    ("rise: Fraction", lambda: oracle.convergents(Fraction(1, 3))),  # type: ignore[arg-type]
    ("rise: 9007199254740993", lambda: oracle.convergents(2**53 + 1)),
    ("x, v: need floats", lambda: oracle.margin(SQUARE, ["1/3", 0.4], V)),
    ("from: is not a finite number", lambda: lorentz.Certificate.from_dict(one_window(math.nan), 2)),
    ("from: is not a finite number", lambda: lorentz.Certificate.from_dict(one_window(-math.inf), 2)),
    ("certificate: .*KeyError", lambda: lorentz.Certificate.from_dict({"windows": [{"lattice": 0}]}, 2)),
    ("proof: dict", lambda: oracle.check(SQUARE, X, V, lorentz.never(), {})),  # type: ignore[arg-type]
    ("answer: None", lambda: oracle.judge_answer(SQUARE, X, V, None)),  # type: ignore[arg-type]
    ("answer: .*KeyError", lambda: lorentz.Answer.from_line("{}")),
    ("answer: ", lambda: lorentz.Answer.from_line("x")),
    ("answer: .*RecursionError", lambda: lorentz.Answer.from_line("[" * 100_000)),
    ("answer: .*is below 0", lambda: lorentz.Answer.from_line(
        '{"outcome":"inside","lattice":0,"atom":-1,"cell":[0,0]}')),
    ("answer: .*the outcome 'banana'", lambda: lorentz.Answer.from_line('{"outcome":"banana"}')),
    ("answer: .*not an integer", lambda: lorentz.Answer.from_line(HIT % ("27.5", "1"))),
    ("answer: .*not a number", lambda: lorentz.Answer.from_line(HIT % ("27", '"1"'))),
    ("answer: .*not a finite number", lambda: lorentz.Answer.from_line(HIT % ("27", "NaN"))),
    ("answer: .*KeyError", lambda: lorentz.Answer.from_line('{"outcome":"hit"}')),
    ("root: -1", lambda: lorentz.oracle.ExactTime(Fraction(1), Fraction(-1))),
    ("digits: 0 ", lambda: lorentz.oracle.ExactTime(Fraction(1), Fraction(1)).decimal(0)),
    ("engine: None", lambda: lorentz.Engine(SQUARE, None)),  # type: ignore[arg-type]
    ("out: needs .*got int", lambda: lorentz.Engine(SQUARE).first_hit([X], [V], out=5)),  # type: ignore[arg-type]
    ("max_time: True", lambda: lorentz.itinerary(SQUARE, X, V, max_time=True)),
    ("every: 0 ", lambda: lorentz.trajectories(SQUARE, [X], [V], 3, every=0)),
    ("every: 'first'", lambda: lorentz.trajectories(SQUARE, [X], [V], 3, every="first")),  # type: ignore[arg-type]
    ("jobs: 0 ", lambda: lorentz.lyapunov(SQUARE, jobs=0)),
    ("collisions: 0 ", lambda: lorentz.lyapunov(SQUARE, collisions=0)),
    ("max_time: None", lambda: lorentz.diffusion(SQUARE, max_time=None)),  # type: ignore[arg-type]
    ("max_time: inf", lambda: lorentz.diffusion(SQUARE, max_time=math.inf)),
    ("start", lambda: lorentz.diffusion(SQUARE, start="nowhere")),
    ("times: ", lambda: lorentz.laws("square", "x")),
    ("box: ", lambda: lorentz.plot.scene("square", (1, 0, 0, 1))),
    ("particle: there is no 1", lambda: lorentz.plot.trajectory(SQUARE, X, lorentz.trajectories(SQUARE, [X], [V], 2), 1)),
    ("answers: ", lambda: lorentz.plot.flights(SQUARE, [X, X], [V, V], lorentz.first_hit(SQUARE, [X], [V]))),
    ("start: has the shape .2, 2., needs .2,. or .1, 2.",
     lambda: lorentz.plot.trajectory(SQUARE, [X, X], lorentz.trajectories(SQUARE, [X], [V], 2))),
    ("paths: are in 2D, the scene is in 3D", lambda: lorentz.plot.trajectory("cubic", X, lorentz.trajectories(SQUARE, [X], [V], 2))),
    ("time: nan is not a number", lambda: lorentz.hit(math.nan, (0, 0))),
    ("time: None is not a number", lambda: lorentz.hit(None, (0, 0))),  # type: ignore[arg-type]
    ("^row 0: start_from names atom 5", lambda: lorentz.first_hit(SQUARE, X, V, start_from=(0, 5, (0, 0)))),
    ("^row 0: start_from names lattice 7", lambda: lorentz.trajectories(SQUARE, X, V, 1, start_from=[(7, 0, (0, 0))])),
    ("^start_from names lattice 7", lambda: oracle.margin(SQUARE, X, V, start_from=(7, 0, (0, 0)))),
    ("^start_from.cell: has 3", lambda: oracle.first_hit(SQUARE, X, V, start_from=(0, 0, (0, 0, 0)))),
    ("^start: \"surfaces\"", lambda: lorentz.draw_starts(SQUARE, 1, "surfaces")),
    ("engine: .*scene, x, v, start_from", lambda: lorentz.judge(lambda x, v: lorentz.never())),
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


def test_the_largest_integers_are_held() -> None:
    scene = lorentz.unit_scene(2, 0.125)
    far = np.array([[2**63 - 1, 0]])
    answer = lorentz.Engine(scene, "oracle").first_hit([[0.5, 0]], [[1, 0]], start_from=(np.array([0]), np.array([0]), far))
    assert answer.cell[0].tolist() == [1, 0]
    with pytest.raises(lorentz.Error, match="int32 does not hold"):
        lorentz.Engine(scene, "oracle").first_hit([[0.5, 0]], [[1, 0]], start_from=(np.array([2**31]), np.array([0]), far))


def test_errors_are_of_the_package() -> None:
    assert lorentz.Error.__module__ == "lorentz"


def test_equal_times_are_equal() -> None:
    scene = lorentz.unit_scene(2, 0.125)
    assert (oracle.entry_time(scene, [0.125, 0], [-1, 0], (0, 0, (0, 0))) ==
            oracle.entry_time(scene, [0, 0.125], [0, -2], (0, 0, (0, 0))))
    assert lorentz.oracle.ExactTime(Fraction(1, 8), Fraction(1, 64)).fraction() == 0


def test_times_are_ordered_exactly() -> None:
    Time = lorentz.oracle.ExactTime
    late = Time(Fraction(2), Fraction(2))  # 0.5857..
    tiny = Fraction(1, 10**300)
    times = [Time(Fraction(1), Fraction(2)), Time(Fraction(0), Fraction(0)), Time(Fraction(1, 2), Fraction(0)),
             late, Time(Fraction(2), Fraction(2) - tiny), Time(Fraction(2) + tiny, Fraction(2))]
    assert sorted(reversed(times), key=float)[3] is not late  # floats do not tell the last three apart
    assert sorted(reversed(times)) == times
    assert late < times[4] and not times[4] < late and not late < late and late >= Time(Fraction(2), Fraction(2))
    with pytest.raises(TypeError):
        late < 1  # type: ignore[operator]


def test_columns_of_other_lengths_are_no_answers() -> None:
    def longer(scene: Any, x: Any, v: Any, start_from: Any) -> Any:
        told = lorentz.first_hit(scene, x, v, engine="certified-batch")
        return {"outcome": told.outcome, "cell": told.cell, "time": [*told.time, 1.0]}

    report = lorentz.judge(longer, vectorized=True, time=0.5)
    assert report["verdict"] == "wrong"
    assert "time: has 2 rows, outcome has 1" in report["findings"][0]["given"]["message"]


def test_a_list_of_obstacles_and_none_is_left() -> None:
    x, v = [[0.5, 0.5], [0.1, 0.0]], [[1, 0.3], [1, 0.0]]
    left = lorentz.first_hit(SQUARE, x, v, start_from=[None, (0, 0, (0, 0))])
    assert left.cell.tolist() == [[2, 1], [1, 0]]


def test_an_exact_engine_of_first_hits_is_judged_right() -> None:
    report = lorentz.judge(lambda scene, x, v, left: lorentz.first_hit(scene, x, v, start_from=left,
                                                                       engine="certified-batch"),
                           vectorized=True, time=2, seed=5)
    assert report["verdict"] == "right" and report["findings"] == [], report["line"]


def test_a_judged_function_that_fails_with_many_queries_is_told_so() -> None:
    report = lorentz.judge(lambda scene, x, v, left: [lorentz.never()], vectorized=True, time=1, seed=5)
    assert "1 answers to" in report["text"]
