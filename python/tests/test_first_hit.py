"""Arrays in, arrays out: the engines' answers, without copies, errors by their row."""

import gc
import signal
import threading
import time

import lorentz
import numpy as np
import pytest
from lorentz import Outcome

SEED = 20161115
EXAMPLE_X = [[0, 0.445], [0, 0.445], [0, 0.445], [0.05, 0]]
EXAMPLE_V = [[0.9998476951563913, 0.01745240643728351], [1, 0], [1, 1e-20], [1, 0]]
COLUMNS = ("outcome", "stage", "time_is_rounded", "lattice", "atom", "cell", "time")


def same(a, b):
    return all(np.array_equal(getattr(a, name), getattr(b, name), equal_nan=name == "time") for name in COLUMNS)


def test_the_example_of_the_readme():
    answers = lorentz.first_hit("square", EXAMPLE_X, EXAMPLE_V, 0.1, engine="certified-batch")
    assert answers.outcome.tolist() == [Outcome.HIT, Outcome.NEVER, Outcome.HIT, Outcome.INSIDE]
    assert answers.cell[0].tolist() == [27, 1]
    assert answers.time[0] == 26.950854326278535 and answers.time[2] == 4.55e19
    assert np.isnan(answers.time[[1, 3]]).all()
    assert answers.large_cells == {2: (45500000000000001275, 1)}
    assert answers.time_is_rounded.tolist() == [True, False, True, False]


@pytest.mark.parametrize("name, radius", [("square", 0.01), ("cubic", 0.2), ("honeycomb", None), ("ellipsoid", None)])
def test_arrays_say_what_the_oracle_says_one_by_one(name, radius):
    scene = lorentz.Scene(name, radius)
    x, v, _ = lorentz.draw_starts(scene, 100, seed=SEED)
    answers = lorentz.first_hit(scene, x, v, engine="certified-batch")
    for i in range(len(x)):
        exact = lorentz.oracle.first_hit(scene, x[i], v[i])
        assert (exact.outcome, exact.lattice, exact.atom) == ("hit", answers.lattice[i], answers.atom[i])
        assert exact.cell == tuple(answers.cell[i]) and exact.time == answers.time[i]


def test_every_engine_of_the_program_answers():
    for engine in lorentz.engines():
        answers = lorentz.first_hit("square", EXAMPLE_X[:1], EXAMPLE_V[:1], 0.1, engine=engine)
        assert answers.cell.tolist() == [[27, 1]], engine


def test_nothing_is_copied():
    x, v, _ = lorentz.draw_starts("square", 5000, seed=SEED)
    answers = lorentz.first_hit("square", x, v)
    for name, address in answers._addresses.items():
        column = getattr(answers, name)
        assert column.__array_interface__["data"][0] == address, name
        assert not column.flags.owndata and not column.flags.writeable, name
        assert column.base is answers, name
    assert answers.cell.shape == (5000, 2) and len(answers) == 5000


def test_columns_outlive_their_answers():
    x, v, _ = lorentz.draw_starts("square", 5000, seed=SEED)
    answers = lorentz.first_hit("square", x, v)
    times, kept = answers.time, answers.time.copy()
    del answers
    gc.collect()
    [np.full(5000, -1.0) for _ in range(50)]  # would take the place of freed columns
    assert np.array_equal(times, kept)


def test_memory_is_used_again():
    engine = lorentz.Engine("square")
    x, v, _ = lorentz.draw_starts("square", 5000, seed=SEED)
    first = engine.first_hit(x, v)
    times, addresses = first.time, first._addresses
    again = engine.first_hit(x[::-1], v[::-1], out=first)
    assert again is first and again._addresses == addresses and np.array_equal(times, again.time)
    assert same(again, engine.first_hit(x[::-1], v[::-1]))
    with pytest.raises(lorentz.Error, match="out: is of 5000 queries in 2"):
        engine.first_hit(x[1:], v[1:], out=first)


def test_any_layout_and_type_of_input():
    x, v, _ = lorentz.draw_starts("cubic", 9000, seed=SEED)
    x, v = x.astype(np.float32).astype(float), v.astype(np.float32).astype(float)
    expected = lorentz.first_hit("cubic", x, v)
    wide = np.zeros((9000, 8))
    wide[:, 1:7:2] = x
    swapped = v.astype(">f8")
    odd = np.frombuffer(b"-" + v.tobytes(), np.uint8)[1:].view(np.float64).reshape(v.shape)  # on odd addresses
    assert not odd.flags.aligned
    for a, b in [(np.asfortranarray(x), v), (x[::-1][::-1], v[::-1][::-1]), (wide[:, 1:7:2], swapped),
                 (x.astype(np.float32), odd), (x.tolist(), v.tolist())]:
        assert same(lorentz.first_hit("cubic", a, b), expected)


def test_threads_change_nothing():
    x, v, _ = lorentz.draw_starts("cubic", 20000, seed=SEED)
    assert same(lorentz.first_hit("cubic", x, v, threads=3), lorentz.first_hit("cubic", x, v))


def test_limits_of_all_and_of_each():
    x, v, _ = lorentz.draw_starts("square", 1000, seed=SEED)
    free = lorentz.first_hit("square", x, v, 0.1)
    limits = np.linspace(0.1, 9, 1000)
    for limit in (2.0, limits):
        limited = lorentz.first_hit("square", x, v, 0.1, max_time=limit)
        later = ~(free.time < limit)
        assert 50 < later.sum() < 950
        assert np.array_equal(limited.outcome == Outcome.LATER, later)
        assert np.array_equal(limited.time[~later], free.time[~later])


def test_what_is_left_is_ignored():
    scene = lorentz.unit_scene(2, 0.25)
    x, v = np.array([[0.25, 0.0], [0.25, 0.0]]), np.array([[-1.0, 0.0], [1.0, 0.0]])
    engine = lorentz.Engine(scene, "certified-batch")
    assert engine.first_hit(x, v).cell.tolist() == [[0, 0], [1, 0]]
    left = engine.first_hit(x, v, start_from=(0, 0, [0, 0]))
    assert left.cell.tolist() == [[-1, 0], [1, 0]]
    some = engine.first_hit(x, v, start_from=([-1, 0], [0, 0], [[0, 0], [0, 0]]))
    assert some.cell.tolist() == [[0, 0], [1, 0]]
    then = engine.first_hit(x + v, v, start_from=left)  # each row's own: from within the obstacles just hit
    assert then.outcome.tolist() == [Outcome.HIT] * 2 and then.cell.tolist() == [[-2, 0], [2, 0]]


@pytest.mark.parametrize("engine", ["batch", "certified-batch", "oracle"])
def test_a_bad_row_is_named(engine):
    x, v, _ = lorentz.draw_starts("square", 9000, seed=SEED)
    v[8001] = 0
    x[8500, 1] = np.nan
    with pytest.raises(lorentz.Error, match="^row 8001: .*v"):
        lorentz.first_hit("square", x, v, engine=engine)
    marked = lorentz.first_hit("square", x, v, engine=engine, on_error="mark")
    assert np.flatnonzero(marked.outcome == Outcome.ERROR).tolist() == [8001, 8500]
    assert sorted(marked.reasons) == [8001, 8500] and not marked.reasons[8500][1]
    v[8001], x[8500, 1] = 1, 0.5
    good = lorentz.first_hit("square", x, v, engine=engine)
    others = np.delete(np.arange(9000), [8001, 8500])
    assert np.array_equal(marked.time[others], good.time[others], equal_nan=True)


def test_what_an_engine_does_not_do_is_no_fault_of_the_row():
    answers = lorentz.first_hit(lorentz.unit_scene(2, 0.6), [[0.5, 0.5]], [[1, 0.1]])
    assert answers.outcome.tolist() == [Outcome.ERROR] and answers.reasons[0][1]


@pytest.mark.parametrize("arguments, text", [
    (dict(x=[[0, 0]], v=[[1, 0], [0, 1]]), r"v: has the shape \(2, 2\), needs \(1, 2\)"),
    (dict(x=[[0, 0, 0]], v=[[1, 0, 0]]), r"x: has the shape \(1, 3\), needs \(1, 2\)"),
    (dict(x=[["a", 0]], v=[[1, 0]]), "x: is no array of numbers"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="bach"), "did you mean batch"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="cmd:cat"), "judge"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="oracle", threads=2), "threads: only the engines batch"),
    (dict(x=[[0, 0]], v=[[1, 0]], threads=0), "threads: needs"),
    (dict(x=[[0, 0]], v=[[1, 0]], on_error="ignore"), "on_error"),
    (dict(x=[[0, 0]], v=[[1, 0]], start_from=(0, 7, [0, 0]), on_error="raise"), "row 0"),
    (dict(x=[[0, 0]], v=[[1, 0]], start_from=(0.5, 0, [0, 0])), "start_from: .* no type of integers"),
    (dict(x=[[0, 0]], v=[[1, 0]], start_from=(0, 0, [0, 0, 0])), "start_from"),
    (dict(x=[[0, 0]], v=[[1, 0]], max_time=-1), "row 0: max_time must be above zero"),
])
def test_bad_arguments(arguments, text):
    with pytest.raises(lorentz.Error, match=text):
        lorentz.first_hit("square", **arguments)
    assert issubclass(lorentz.Error, ValueError)


def test_no_rows_are_no_fault():
    answers = lorentz.first_hit("square", np.zeros((0, 2)), np.zeros((0, 2)))
    assert len(answers) == 0 and answers.cell.shape == (0, 2)


def test_an_engine_is_for_many_threads():
    engine = lorentz.Engine("square", "batch")
    x, v, _ = lorentz.draw_starts("square", 30000, seed=SEED)
    expected, seen = engine.first_hit(x, v), []

    def ask():
        seen.extend(same(engine.first_hit(x, v), expected) for _ in range(5))

    threads = [threading.Thread(target=ask) for _ in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert seen == [True] * 15


def test_other_threads_run_meanwhile():
    x, v, _ = lorentz.draw_starts("cubic", 30000, seed=SEED)
    stamps, stop = [], threading.Event()

    def tick():
        while not stop.wait(0.001):
            stamps.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    lorentz.first_hit("cubic", x, v, engine="oracle")
    end = time.monotonic()
    stop.set()
    thread.join()
    middle = [t for t in stamps if 0.1 < (t - begin) / (end - begin) < 0.9]
    assert len(middle) >= 3


def test_an_interrupt_comes_through():
    x, v, _ = lorentz.draw_starts("cubic", 20000, seed=SEED)
    x, v = np.tile(x, (100, 1)), np.tile(v, (100, 1))
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        lorentz.first_hit("cubic", x, v, engine="oracle")
    timer.join()
