"""Arrays in, arrays out: the engines' answers, without copies, errors by their row."""

import copy
import gc
import pickle
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


def same_rows(part, whole, rows):
    return all(np.array_equal(getattr(part, name), getattr(whole, name)[rows], equal_nan=name == "time")
               for name in COLUMNS)


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
    for engine in set(lorentz.engines()) - {"gpu", "golse"}:  # a card is needed, and a disc that is left
        answers = lorentz.first_hit("square", EXAMPLE_X[:1], EXAMPLE_V[:1], 0.1, engine=engine)
        assert answers.cell.tolist() == [[27, 1]], engine


def test_nothing_is_copied():
    x, v, _ = lorentz.draw_starts("square", 1_000_000, seed=SEED)
    answers = lorentz.first_hit("square", x, v)
    for name, address in answers._native._addresses.items():
        column = getattr(answers, name)
        assert column.__array_interface__["data"][0] == address, name
        assert not column.flags.owndata and not column.flags.writeable, name
        assert column.base is answers._native, name
    assert answers.cell.shape == (1_000_000, 2) and len(answers) == 1_000_000


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
    times, addresses = first.time, first._native._addresses
    again = engine.first_hit(x[::-1], v[::-1], out=first)
    assert again is first and again._native._addresses == addresses and np.array_equal(times, again.time)
    assert same(again, engine.first_hit(x[::-1], v[::-1]))
    with pytest.raises(lorentz.Error, match="out: is of 5000 queries in 2"):
        engine.first_hit(x[1:], v[1:], out=first)
    in_space = lorentz.first_hit("cubic", *lorentz.draw_starts("cubic", 5000, seed=SEED)[:2])
    with pytest.raises(lorentz.Error, match="out: is of 5000 queries in 3"):
        engine.first_hit(x, v, out=in_space)


def test_nothing_half_written_is_left_in_out():
    engine = lorentz.Engine("square")
    x, v, _ = lorentz.draw_starts("square", 9000, seed=SEED)
    out = engine.first_hit(x, v)
    v[8001] = 0
    with pytest.raises(lorentz.Error, match="row 8001"):
        engine.first_hit(x, v, out=out)
    assert (out.outcome == Outcome.ERROR).all() and np.isnan(out.time).all() and not out.cell.any()


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
    assert same(lorentz.first_hit("cubic", x, v, jobs=3), lorentz.first_hit("cubic", x, v))


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


@pytest.mark.parametrize("engine", ["batch", "oracle"])
def test_each_of_many_rows_has_its_own_start_and_limit(engine):
    scene = lorentz.Scene("rock-salt")  # two atoms
    x, v, start_from = lorentz.draw_starts(scene, 9000, "surface", seed=SEED)
    assert set(start_from[1]) == {0, 1} and len(np.unique(start_from[2], axis=0)) == 1
    shift = np.arange(27000).reshape(9000, 3) % 64
    vectors = np.array(scene.to_dict()["lattices"][0]["vectors"])
    x, start_from = x + shift @ vectors, (*start_from[:2], start_from[2] + shift)
    limits = np.linspace(0.1, 2, 9000)
    whole = lorentz.first_hit(scene, x, v, engine=engine, start_from=start_from, max_time=limits)
    assert 2000 < (whole.outcome == Outcome.HIT).sum() < 8000
    for rows in (slice(4000, 4200), slice(8900, 9000)):
        part = tuple(column[rows] for column in start_from)
        assert same_rows(lorentz.first_hit(scene, x[rows], v[rows], engine=engine, start_from=part,
                                           max_time=limits[rows]), whole, rows)


@pytest.mark.parametrize("engine", ["certified-batch", "oracle", "certified"])
def test_an_obstacle_beyond_64_bits_can_be_left(engine):
    x, v = np.full((9000, 2), 0.5), np.tile([1, 0.3], (9000, 1))
    x[[7, 5000]], v[[7, 5000]] = [0, 0.445], [1, 1e-20]
    first = lorentz.first_hit("square", x, v, 0.1, engine=engine)
    assert sorted(first.large_cells) == [7, 5000]
    obstacles = [None if i % 2 else (0, 0, first.large_cells.get(i, tuple(first.cell[i]))) for i in range(9000)]
    then = lorentz.first_hit("square", x, v, 0.1, engine=engine, start_from=first)
    some = lorentz.first_hit("square", x, v, 0.1, engine=engine, start_from=obstacles)
    for i in (6, 7, 8, 7 + 16, 7 + 4096, 4999, 5000):  # of other rows that fly together, too
        cell = first.large_cells.get(i, first.cell[i])
        exact = lorentz.oracle.first_hit(lorentz.Scene("square", 0.1), x[i], v[i], start_from=(0, 0, cell))
        assert exact.cell == then.large_cells.get(i, tuple(then.cell[i])) != tuple(cell)
        other = exact if i % 2 == 0 else lorentz.oracle.first_hit(lorentz.Scene("square", 0.1), x[i], v[i])
        assert other.cell == some.large_cells.get(i, tuple(some.cell[i]))
    left = (0, 0, first.large_cells[7])  # by all
    one = lorentz.first_hit("square", x[[7, 5000]], v[[7, 5000]], 0.1, engine=engine, start_from=left)
    assert one.large_cells == {0: then.large_cells[7], 1: then.large_cells[7]}


def test_an_answer_that_is_no_hit_is_not_left():
    x, v = [[0, 0]] * 2, [[1, 0.3]] * 2
    within = lorentz.first_hit("square", x, v, 0.1)
    for engine in ("certified-batch", "oracle"):
        for left in (within, [*within], within[0]):
            assert lorentz.first_hit("square", x, v, 0.1, engine=engine, start_from=left).outcome.tolist() == [Outcome.INSIDE] * 2


def test_the_first_row_at_fault_is_named():
    x, v = [[1e300, 0.5], [0.5, 0.5]], [[1, 0.25], [0, 0]]
    marked = lorentz.first_hit("square", x, v, engine="classical", on_error="mark")
    assert marked.outcome.tolist() == [Outcome.ERROR] * 2 and [marked.reasons[i][1] for i in (0, 1)] == [True, False]
    with pytest.raises(lorentz.UnsupportedError, match="row 0: "):
        lorentz.first_hit("square", x, v, engine="classical")
    with pytest.raises(lorentz.Error, match="row 0: ") as raised:
        lorentz.first_hit("square", x[::-1], v[::-1], engine="classical")
    assert not isinstance(raised.value, lorentz.UnsupportedError)


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
    query = lorentz.unit_scene(2, 6), [[0.5, 0.5]], [[1, 0.1]]
    with pytest.raises(lorentz.UnsupportedError, match="row 0: .*reach over"):
        lorentz.first_hit(*query, engine="batch")
    answers = lorentz.first_hit(*query, engine="batch", on_error="mark")
    assert answers.outcome.tolist() == [Outcome.ERROR] and answers.reasons[0][1]


@pytest.mark.parametrize("arguments, text", [
    (dict(x=[[0, 0]] * 3, v=[[1, 0], [0, 1]]), "v: has 2 rows, the other 3"),
    (dict(x=[[0, 0, 0]], v=[[1, 0, 0]]), r"x: has the shape \(1, 3\), needs \(N, 2\) or \(2,\)"),
    (dict(x=[["a", 0]], v=[[1, 0]]), "x: is not an array of numbers"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="bach"), "did you mean batch"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="cmd:cat"), "judge"),
    (dict(x=[[0, 0]], v=[[1, 0]], engine="oracle", jobs=2), "jobs: only the engines batch"),
    (dict(x=[[0, 0]], v=[[1, 0]], jobs=0), "jobs: 0 is not from 1 to 1024"),
    (dict(x=[[0, 0]], v=[[1, 0]], on_error="ignore"), "on_error"),
    (dict(x=[[0, 0]], v=[[1, 0]], start_from=(0, 7, [0, 0]), on_error="raise"), "row 0"),
    (dict(x=[[0, 0]], v=[[1, 0]], start_from=(0.5, 0, [0, 0])), "start_from: .* not a type of integers"),
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


MANY = np.full((2_000_000, 2), 0.5), np.full((2_000_000, 2), 0.3)


@pytest.mark.parametrize("work", [
    lambda: lorentz.first_hit("square", *MANY, engine="oracle"),
    lambda: lorentz.first_hit("square", *MANY, 1e-4, engine="published-256"),
    lambda: lorentz.draw_starts("kagome", 20_000_000, "near-rational"),
    lambda: lorentz.draw_starts("cubic", 20_000_000, "grazing"),
    lambda: lorentz.trajectories("square", [[0.5, 0.5]], [[1, 0.3]], 1_000_000, engine="oracle"),
    lambda: lorentz.itinerary("square", [0.5, 0.5], [1, 0.3], collisions=100_000),
    lambda: lorentz.flights("square", count=10**9),
    lambda: lorentz.judge("reduction", time=60),
    lambda: lorentz.lyapunov("square", 0.2, collisions=10**9),
    lambda: lorentz.diffusion("square", 0.2, count=10**8),
])
def test_an_interrupt_comes_through(work):
    begin = []

    def interrupt():
        begin.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(0.5, interrupt)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        work()
    timer.join()
    assert time.monotonic() - begin[0] < 5  # soon; a machine may be busy


def test_a_far_cell_is_left_by_its_own_row_only():
    count, far = 200, 2**70  # more rows than are asked together; the first leaves a cell beyond 64 bits
    x, v = np.tile([float(far), 0.0625], (count, 1)), np.tile([0.0, -1.0], (count, 1))
    answers = lorentz.first_hit("square", x, v, 0.25, engine="oracle", start_from=[(0, 0, [far, 0])] + [None] * (count - 1))
    assert answers.outcome[0] == Outcome.HIT and (answers.outcome[1:] == Outcome.INSIDE).all()


def test_cells_of_rows_and_single_obstacles():
    row = {"dimension": 2, "lattices": [{"vectors": [[1, 0]], "atoms": [{"position": [0, 0], "radius": 0.25}]}]}
    for cell in ([3], [3, 0]):
        one = lorentz.first_hit(row, [[3.125, 0]], [[1, 0]], start_from=(0, 0, cell))
        assert one.outcome[0] == Outcome.HIT and one.cell[0].tolist() == [4, 0] and one.time[0] == 0.625
        listed = lorentz.first_hit(row, [[3.125, 0]] * 2, [[1, 0]] * 2, start_from=[(0, 0, cell), None])
        assert listed.outcome.tolist() == [Outcome.HIT, Outcome.INSIDE]
    ball = {"dimension": 2, "lattices": [{"vectors": [], "atoms": [{"position": [0, 0], "radius": 1}]}]}
    assert lorentz.first_hit(ball, [[0.5, 0]], [[1, 0]], start_from=(0, 0, [])).outcome[0] == Outcome.NEVER
    for scene, cell in (("square", [3]), (row, [3, 1]), (ball, [1])):
        with pytest.raises(lorentz.Error, match="start_from|cell"):
            lorentz.first_hit(scene, [[3.25, 0.5]], [[1, 0]], start_from=(0, 0, cell))


def test_a_copy_of_an_engine_answers_for_its_scene():
    scene = lorentz.unit_scene(2, 0.1).to_dict()
    engine = lorentz.Engine(scene)
    scene["lattices"][0]["atoms"][0]["radius"] = 0.3
    for one in (copy.copy(engine), pickle.loads(pickle.dumps(engine))):
        assert one.first_hit([0.5, 0.45], [1, 0.3]).time[0] == engine.first_hit([0.5, 0.45], [1, 0.3]).time[0]


def test_large_integers_that_floats_are_equal_to():
    for number in (2**60, -(2**62), 2**53 + 2):
        assert lorentz.first_hit("square", np.array([[number, 0]]), [1, 0.3])[0].outcome == "inside"
    for number in (2**53 + 1, 2**63 - 1):
        with pytest.raises(lorentz.Error, match="floats would round"):
            lorentz.first_hit("square", np.array([[number, 0]]), [1, 0.3])
