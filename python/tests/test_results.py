"""Results behave as what NumPy's users know: broadcast, indexed, printed, pickled, tables."""

import copy
import pickle
import subprocess
import sys

import lorentz
import numpy as np
import pytest
from lorentz import Outcome

SEED = 20161115
LARGE = 45500000000000001275


def some_answers():
    """A hit, a hit of a cell beyond 64 bits, never, inside, and an error."""
    x = [[0, 0.445], [0, 0.445], [0, 0.445], [0.05, 0], [0, 0.445]]
    v = [[0.9998476951563913, 0.01745240643728351], [1, 1e-20], [1, 0], [1, 0], [0, 0]]
    return lorentz.first_hit("square", x, v, 0.1, on_error="mark")


def test_results_are_equal_if_their_values_are():
    answers, again = some_answers(), some_answers()
    assert answers == again == answers[:] and answers[:4] != answers[1:] and answers != 5 and answers != list(answers)
    columns, rest = {name: answers[name] for name in answers._NAMES}, (answers.large_cells, answers.reasons)
    assert lorentz.Answers(None, columns, *rest) == answers
    for name in columns:
        assert lorentz.Answers(None, columns | {name: columns[name] + np.ones(1, columns[name].dtype)}, *rest) != answers, name
    assert lorentz.Answers(None, columns, rest[0]) != answers != lorentz.Answers(None, columns, {}, rest[1])
    x, v, _ = lorentz.draw_starts("square", 3, seed=SEED)
    paths, again = (lorentz.trajectories("square", x, v, 4, max_time=5) for _ in range(2))
    assert np.isnan(paths.time).any() and paths == again != paths[:2] and paths != lorentz.trajectories("square", x, v, 4)
    for call in (lambda seed: lorentz.flights("square", 0.1, count=1000, seed=seed),
                 lambda seed: lorentz.lyapunov("square", 0.2, collisions=1000, seed=seed),
                 lambda seed: lorentz.diffusion("triangular", 0.45, count=100, max_time=5, seed=seed)):
        assert call(1) == call(1) != call(2)


def test_one_place_and_many_velocities_and_the_other_way_round():
    angles = np.linspace(0.1, 1.5, 50)
    v = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    many = lorentz.first_hit("square", [0.5, 0.5], v, 0.1)
    assert many == lorentz.first_hit("square", np.tile([0.5, 0.5], (50, 1)), v, 0.1)
    x = np.random.default_rng(SEED).uniform(0.3, 0.7, (50, 2))
    assert lorentz.first_hit("square", x, [1, 0.3], 0.1) == lorentz.first_hit("square", x, np.tile([1, 0.3], (50, 1)), 0.1)
    assert len(lorentz.first_hit("square", [0.5, 0.5], [1, 0.3], 0.1)) == 1
    assert len(lorentz.first_hit("square", np.zeros((0, 2)), [1, 0.3], 0.1)) == 0
    paths = lorentz.trajectories(lorentz.Scene("square", 0.1), [0.5, 0.5], v, 3)
    assert len(paths) == 50 and np.allclose(paths.time[:, 0], many.time, rtol=1e-14)


@pytest.mark.parametrize("x, v, text", [
    ([[0.5, 0.5]] * 2, [[1, 0.3]] * 3, "x: has 2 rows, the other 3"),
    ([0.5], [1, 0.3], r"x: has the shape \(1,\), needs \(N, 2\) or \(2,\)"),
    (0.5, [1, 0.3], r"x: has the shape \(\)"),
    ([0.5, 0.5], [[[1, 0.3]]], r"v: has the shape \(1, 1, 2\)"),
])
def test_shapes_that_do_not_fit(x, v, text):
    with pytest.raises(lorentz.Error, match=text):
        lorentz.first_hit("square", x, v, 0.1)


def test_the_usual_engine_is_exact():
    x, v = [[0.5, 0.5]] * 2000, np.array([[1, k / 2000 + 1e-15] for k in range(2000)])
    answers = lorentz.first_hit("square", x, v, 1e-7)
    assert not (answers.outcome == Outcome.UNDECIDED).any()
    assert lorentz.Engine("square")._engine.name == "certified-batch"


def test_a_row_is_an_answer():
    answers = some_answers()
    assert answers[0] == lorentz.hit(26.950854326278535, (27, 1)) and answers[-5] == answers[0]
    assert answers[1] == answers[-4] == lorentz.hit(4.55e19, (LARGE, 1))
    beyond = lorentz.first_hit(lorentz.unit_scene(2, 6), [0.5, 0.5], [1, 0.1], engine="batch", on_error="mark")
    assert beyond[0].outcome == "error" and beyond[0].unsupported
    assert answers[2] == lorentz.never() and answers[3] == lorentz.inside((0, 0))
    assert answers[4].outcome == "error" and "v" in answers[4].message and not answers[4].unsupported
    assert list(answers) == [answers[i] for i in range(5)] and len(answers) == 5
    for row in (5, -6, np.int64(7)):
        with pytest.raises(IndexError):
            answers[row]
    assert answers[0].obstacle == (0, 0, (27, 1))


def test_parts_keep_what_is_of_their_rows():
    answers = some_answers()
    for rows in (slice(1, None), [4, 1], np.array([False, True, False, False, True]), slice(None, None, -1)):
        part, numbers = answers[rows], np.arange(5)[rows]
        assert list(part) == [answers[i] for i in numbers]
        assert not part.time.flags.writeable
        assert part[::-1] == answers[numbers[::-1]]
    assert len(answers[answers.hit]) == 2 and len(answers[[]]) == 0
    next_hit = lorentz.first_hit("square", [[3.5, 0.5]] * 5, [[1, 0.3]] * 5, 0.1, start_from=answers[np.arange(5)])
    assert len(next_hit) == 5
    with pytest.raises(lorentz.Error, match="out: needs the Answers that an earlier call returned"):
        lorentz.Engine("square").first_hit([[0.5, 0.5]], [[1, 0.3]], out=answers[:1])


def test_columns_by_name_and_what_is_not_a_row():
    answers = some_answers()
    assert answers["time"] is answers.time
    with pytest.raises(KeyError, match="tine; the columns are outcome, lattice"):
        answers["tine"]
    for odd in (None, True, np.True_):
        with pytest.raises(IndexError, match="not a row"):
            answers[odd]
    with pytest.raises(TypeError, match="Answers are columns"):
        np.asarray(answers)
    with pytest.raises(AttributeError, match="time is what the engine wrote"):
        answers.time = 5


def test_an_answer_can_be_left():
    scene = lorentz.unit_scene(2, 0.25)
    first = lorentz.first_hit(scene, [[0.25, 0.0]], [[-1.0, 0.0]])[0]
    then = lorentz.first_hit(scene, [[0.25, 0.0]], [[-1.0, 0.0]], start_from=first)
    assert first.cell == (0, 0) and then[0].cell == (-1, 0)
    answers = some_answers()[:4]
    x, v = [[0.5, 0.5]] * 4, [[1, 0.3]] * 4
    assert list(lorentz.first_hit(scene, x, v, start_from=list(answers))) == list(lorentz.first_hit(scene, x, v, start_from=answers))


def test_radii_of_starts_are_those_of_their_flights():
    x, v, _ = lorentz.draw_starts("square", 2000, radius=0.4, seed=SEED)
    assert lorentz.first_hit("square", x, v, 0.4).hit.all()
    assert np.array_equal(x, lorentz.draw_starts(lorentz.Scene("square", 0.4), 2000, seed=SEED).x)
    paths = lorentz.trajectories("square", x[:3], v[:3], 2, radius=0.4)
    assert np.array_equal(paths.time, lorentz.trajectories(lorentz.Scene("square", 0.4), x[:3], v[:3], 2).time)
    assert (lorentz.itinerary("square", x[0], v[0], radius=0.4, collisions=3) ==
            lorentz.itinerary(lorentz.Scene("square", 0.4), x[0], v[0], collisions=3))
    with pytest.raises(lorentz.Error, match="radius: .* is not one number; `scan` takes several"):
        lorentz.mean_free_path("square", [0.1, 0.2])


def test_results_print_themselves():
    text = repr(some_answers())
    assert text.startswith("Answers to 5 queries in 2D: 2 hit, 1 never, 1 inside, 1 error\n")
    assert "0: hit cell (27, 1), lattice 0, atom 0, time 26.950854326278535" in text and "3: inside cell (0, 0)" in text
    assert "4: error: v is zero" in text
    x, v, _ = lorentz.draw_starts("square", 1000, seed=SEED)
    text = repr(lorentz.first_hit("square", x, v))
    assert len(text.split("\n")) == 8 and "  999: hit" in text
    assert "none" in repr(lorentz.first_hit("square", x[:0], v[:0]))
    text = repr(lorentz.trajectories("square", x, v, 3))
    assert text.startswith("Paths of 1000 particles in 2D") and "0: 3 collisions; at time " in text
    for result in (lorentz.flights("square", 0.1, count=1000), lorentz.lyapunov("square", 0.2, collisions=1000),
                   lorentz.diffusion("triangular", 0.45, count=100, max_time=5)):
        assert len(repr(result)) < 250 and repr(result).startswith(type(result).__name__ + "(")


@pytest.mark.parametrize("copied", [lambda one: pickle.loads(pickle.dumps(one)), copy.deepcopy, copy.copy])
def test_results_are_pickled_and_copied(copied):
    answers = some_answers()
    again = copied(answers)
    assert again == answers and list(again) == list(answers) and not again.time.flags.writeable
    scene = lorentz.Scene("cubic", 0.3)
    x, v, _ = lorentz.draw_starts(scene, 4, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 7, every=2)
    again = copied(paths)
    assert again.every == 2 and all(np.array_equal(getattr(again, name), getattr(paths, name)) for name in paths._NAMES)
    assert copied(lorentz.lyapunov("square", 0.2, collisions=1000)).exponents
    assert copied(lorentz.flights("square", 0.1, count=1000)).mean > 0
    engine = copied(lorentz.Engine("square", "batch"))
    assert list(engine.first_hit([0.5, 0.5], [1, 0.3])) == list(lorentz.first_hit("square", [0.5, 0.5], [1, 0.3]))


def test_a_pickled_result_does_not_change_with_its_engine():
    engine = lorentz.Engine("square")
    x, v, _ = lorentz.draw_starts("square", 10, seed=SEED)
    first = engine.first_hit(x, v)
    kept, times = copy.deepcopy(first), first.time.copy()
    again, part = copy.copy(first), first[:3]
    engine.first_hit(x[::-1], v[::-1], out=first)
    assert np.array_equal(again.time, times) and np.array_equal(part.time, times[:3])
    assert np.array_equal(kept.time, times) and not np.array_equal(first.time, times)


def test_results_are_tables():
    pandas = pytest.importorskip("pandas")
    answers = some_answers()
    frame = answers.to_frame()
    assert list(frame.outcome) == ["hit", "hit", "never", "inside", "error"]
    assert frame.cell_0[1] == LARGE and frame.cell_1[0] == 1 and frame.time[0] == 26.950854326278535
    assert answers[:1].to_frame().cell_0.dtype == np.int64
    scene = lorentz.Scene("cubic", 0.3)
    x, v, _ = lorentz.draw_starts(scene, 4, seed=SEED)
    frame = lorentz.trajectories(scene, x, v, 5).to_frame()
    assert len(frame) == 20 and {"particle", "collision", "time", "cell_2", "place_0", "velocity_1"} <= set(frame.columns)
    table = pandas.DataFrame(lorentz.scan(lorentz.mean_free_path, ["square", "triangular"], [0.1, 0.2]))
    assert list(table.columns) == ["scene", "radius", "value"] and len(table) == 4


@pytest.mark.parametrize("engine", ["batch", "reduction"])
def test_each_kth_collision_or_the_last(engine):
    scene = lorentz.unit_scene(2, 0.25)
    x, v = [[0.5, 0.5], [0.3, 0.45], [0, 0.5]], [[1, 0.3], [0.7, -0.6], [1, 0]]
    whole = lorentz.trajectories(scene, x, v, 7, engine=engine)
    third = lorentz.trajectories(scene, x, v, 7, engine=engine, every=3)
    last = lorentz.trajectories(scene, x, v, 7, engine=engine, every="last")
    assert third.time.shape == (3, 2) and last.time.shape == (3, 1)
    for name in ("time", "place", "velocity", "cell", "lattice", "atom"):
        a, b, c = (getattr(paths, name) for paths in (whole, third, last))
        assert np.array_equal(a[:, 2::3], b, equal_nan=a.dtype.kind == "f"), name
        assert np.array_equal(a[:2, 6:], c[:2]), name
    assert whole.count.tolist() == third.count.tolist() == last.count.tolist() == [7, 7, 0]
    assert third.kept().tolist() == [2, 2, 0] and last.kept().tolist() == [1, 1, 0]
    assert third.to_dict()["particle"].tolist() == [0, 0, 1, 1]
    assert third.to_dict()["collision"].tolist() == [3, 6, 3, 6] and last.to_dict()["collision"].tolist() == [7, 7]
    with pytest.raises(lorentz.Error, match="every: 3 is above collisions, 2: nothing would be kept"):
        lorentz.trajectories(scene, x, v, 2, every=3)
    alone = whole[1]
    assert len(alone) == 1 and np.array_equal(alone.time[0], whole.time[1])


def test_memory_is_estimated_and_what_is_too_much_refused():
    assert lorentz.memory_of_trajectories(10**6, 1000) > 64 * 10**9
    assert lorentz.memory_of_trajectories(10**6, 1000, every="last") < 2 * 10**9
    with pytest.raises(lorentz.Error, match='collisions: 2000000000 of 2 particles need .* GB.*every="last"'):
        lorentz.trajectories("square", [[0.5, 0.5]] * 2, [[1, 0.3]] * 2, 2_000_000_000)


def test_memory_is_as_estimated():
    program = """if True:
        import lorentz, re
        peak = lambda: 1024 * int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1])
        scene = lorentz.Scene("square", 0.2)
        x, v, _ = lorentz.draw_starts(scene, 20_000)
        lorentz.trajectories(scene, x[:10], v[:10], 3)
        before = peak()
        paths = lorentz.trajectories(scene, x, v, 200)
        print((peak() - before) / lorentz.memory_of_trajectories(20_000, 200))"""
    ratio = float(subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True).stdout)
    assert 0.8 < ratio < 1.05
