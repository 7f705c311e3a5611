"""Particles in floats and in certainty."""

import math
from dataclasses import replace
from fractions import Fraction

import lorentz
import numpy as np
import pytest

SEED = 20161115


def test_problem_2_of_the_100_digit_challenge():
    scene, start = lorentz.Scene("square", Fraction(1, 3)), dict(x=[Fraction(1, 2), Fraction(1, 10)], v=[1, 0])
    path = lorentz.itinerary(scene, **start, max_time=10, digits=50, states=True)
    assert path.distance == "0.99526291944335416089031180942672162102946692273415"
    assert path.end == "time" and len(path.collisions) == 14 and path.collisions[0].cell == (1, 0)
    assert len(path.collisions[0].x) == 2 and path.collisions[-1].bits > path.collisions[0].bits
    # 1/3 and 1/10 are not floats: the floats next to them are another problem.
    rounded = lorentz.itinerary(scene.nearest(), [0.5, 0.1], [1.0, 0.0], max_time=10, digits=20)
    assert rounded.distance.startswith("0.9952621335999704")
    # The time is the rational number that a float is.
    assert lorentz.itinerary(scene, **start, max_time=Fraction(1, 10)).x != lorentz.itinerary(scene, **start, max_time=0.1,
                                                                                       digits=40).x
    golden = lorentz.itinerary("square", [0.5, 0.5], ["1", "golden"], collisions=2)
    assert len(golden.collisions) == 2


def test_floats_follow_the_truth_for_a_while():
    scene = lorentz.Scene("square", 0.3)
    x, v, _ = lorentz.draw_starts(scene, 20, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 4)
    assert paths.place.shape == (20, 4, 2) and paths.count.tolist() == [4] * 20
    for i in range(20):
        truth = lorentz.itinerary(scene, x[i], v[i], collisions=4, states=True)
        for k, collision in enumerate(truth.collisions):
            assert collision.cell == tuple(paths.cell[i, k])
            assert abs(paths.time[i, k] - float(collision.time)) < 1e-9
            assert np.allclose(paths.place[i, k], [float(c) for c in collision.x], rtol=0, atol=1e-9)
            assert np.allclose(paths.velocity[i, k], [float(c) for c in collision.v], rtol=0, atol=1e-8)
        assert truth.time.tolist() == [float(collision.time) for collision in truth.collisions]
        for column in ("time", "place", "velocity"):
            assert getattr(truth, column).shape == getattr(paths, column)[i].shape
            assert np.allclose(getattr(truth, column), getattr(paths, column)[i], rtol=0, atol=1e-8)
        for column in ("lattice", "atom", "cell"):
            assert getattr(truth, column).dtype == getattr(paths, column).dtype
            assert np.array_equal(getattr(truth, column), getattr(paths, column)[i])


def test_an_itinerary_without_states_has_times_alone():
    path = lorentz.itinerary("square", ["1/2", Fraction(1, 10)], [1, 0.3], radius=0.3, collisions=3)
    assert path.time.shape == (3,) and path.start == (0.5, 0.1) and path.scene == lorentz.Scene("square", 0.3)
    assert path.to_dict()["scene"] == path.scene.to_dict()
    for column in ("place", "velocity"):
        with pytest.raises(lorentz.Error, match="states=True"):
            getattr(path, column)
    free = lorentz.itinerary("square", [0.5, 0.5], [1, 0], max_time=1, states=True)
    assert free.place.shape == free.cell.shape == (0, 2) and free.lattice.shape == free.atom.shape == (0,)


def test_cells_of_an_itinerary_in_an_array():
    scene = lorentz.Scene("rock-salt")
    x, v, _ = lorentz.draw_starts(scene, 1, seed=SEED)
    path = lorentz.itinerary(scene, x[0], v[0], collisions=8)
    assert path.atom.tolist() == [one.atom for one in path.collisions] and set(path.atom) == {0, 1}
    assert path.cell.dtype == np.int64 and path.cell.shape == (8, 3)
    far = lorentz.itinerary("square", [0, 0.445], [1, "1/100000000000000000000000"], radius=0.1, collisions=2)
    assert far.cell.dtype == object and [tuple(cell) for cell in far.cell] == [one.cell for one in far.collisions]
    assert far.cell[0, 0] > 2**64 and isinstance(far.cell[0, 1], int)
    one = far.collisions[0]
    for cell, kind in (((2**63, -1), object), ((2**63 - 1, -(2**63)), np.int64)):  # a uint64 beside an int64 is a float
        path = replace(far, collisions=[replace(one, cell=cell)])
        assert path.cell.dtype == kind and tuple(path.cell[0]) == cell


def test_an_itinerary_is_a_table():
    pytest.importorskip("pandas")
    scene = lorentz.Scene("triangular", 0.45)
    x, v, _ = lorentz.draw_starts(scene, 1, seed=SEED)
    path = lorentz.itinerary(scene, x[0], v[0], collisions=4, states=True)
    frame, floats = path.to_frame(), lorentz.trajectories(scene, x, v, 4).to_frame()
    assert list(frame.columns) == [*floats.columns.drop("particle"), "bits"]
    for column in frame.columns.drop("bits"):
        assert np.allclose(frame[column], floats[column], rtol=0, atol=1e-8), column
        assert frame[column].dtype == floats[column].dtype, column
    assert frame.bits.tolist() == [one.bits for one in path.collisions]
    without = lorentz.itinerary(scene, x[0], v[0], collisions=4).to_frame()
    assert list(without.columns) == ["collision", "time", "lattice", "atom", "cell_0", "cell_1", "bits"]
    nothing = lorentz.itinerary("square", [0.5, 0.5], [1, 0], max_time=1, states=True).to_frame()
    assert len(nothing) == 0 and "cell_1" in nothing.columns


@pytest.mark.parametrize("precision", ["binary64", "double-double"])
def test_together_as_one_by_one(precision):
    scene = lorentz.Scene("cubic", 0.3)
    x, v, left = lorentz.draw_starts(scene, 50, "surface", seed=SEED)
    both = [lorentz.trajectories(scene, x, v, 12, start_from=left, engine=engine, precision=precision)
            for engine in ("batch", "reduction")]
    for name in ("count", "stop_code", "time", "lattice", "atom", "cell", "place", "velocity"):
        a, b = (getattr(paths, name) for paths in both)
        assert np.array_equal(a, b, equal_nan=a.dtype.kind == "f"), name
        assert not a.flags.owndata and not a.flags.writeable
    assert lorentz.STOPS[both[0].stop_code[0]] == "collisions"


@pytest.mark.parametrize("name", ["rock-salt", "superposition-pi-5", "ellipses-mixed"])
def test_each_collision_is_with_what_is_hit_first(name):
    scene = lorentz.Scene(name)
    x, v, _ = lorentz.draw_starts(scene, 40, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 2)
    first = lorentz.first_hit(scene, x, v)
    numbers = {(int(a), int(b)) for a, b in zip(first.lattice, first.atom)}
    assert len(numbers) == sum(len(lattice["atoms"]) for lattice in scene.to_dict()["lattices"]) > 1
    for field in ("lattice", "atom", "cell"):
        assert np.array_equal(getattr(paths, field)[:, 0], getattr(first, field)), field
    assert np.allclose(paths.time[:, 0], first.time, rtol=1e-12)
    assert np.allclose(paths.place[:, 0], x + first.time[:, None] * v, rtol=0, atol=1e-12)
    then = lorentz.first_hit(scene, paths.place[:, 0], paths.velocity[:, 0], start_from=first)
    for field in ("lattice", "atom", "cell"):
        assert np.array_equal(getattr(paths, field)[:, 1], getattr(then, field)), field
    assert np.allclose(paths.time[:, 1], first.time + then.time, rtol=1e-9)


def test_paths_that_end():
    scene = lorentz.unit_scene(2, 0.25)
    starts = dict(x=[[0.5, 0], [0, 0.5], [0, 0]], v=[[1, 0], [1, 0], [1, 0]], collisions=3)
    free = lorentz.trajectories(scene, **starts)
    assert [lorentz.STOPS[code] for code in free.stop_code] == ["collisions", "never", "inside"]
    paths = lorentz.trajectories(scene, **starts, max_time=1.0)
    assert [lorentz.STOPS[code] for code in paths.stop_code] == ["time", "time", "inside"]
    assert paths.count.tolist() == [2, 0, 0]
    assert paths.time[0, :2].tolist() == [0.25, 0.75] and np.isnan(paths.time[0, 2])
    assert np.isnan(paths.place[1:]).all() and paths.place[0, 0].tolist() == [0.75, 0.0]


def test_starts_are_numbered():
    whole = lorentz.draw_starts("honeycomb", 50, "surface", seed=7)
    part = lorentz.draw_starts("honeycomb", 20, "surface", seed=7, first=30)
    assert np.array_equal(whole.x[30:], part.x) and np.array_equal(whole.start_from[2][30:], part.start_from[2])
    assert not np.array_equal(lorentz.draw_starts("honeycomb", 50, seed=8).x, whole.x)
    with pytest.raises(lorentz.Error, match="near-rational"):
        lorentz.draw_starts("honeycomb", 1, "far")


def test_bad_starts():
    with pytest.raises(lorentz.Error, match="row 1"):
        lorentz.trajectories("square", [[0.5, 0.5], [0.5, 0.5]], [[1, 0], [0, 0]], 3)
    with pytest.raises(lorentz.Error, match="precision"):
        lorentz.trajectories("square", [[0.5, 0.5]], [[1, 0]], 3, precision="float")
    with pytest.raises(lorentz.Error, match="collisions or max_time"):
        lorentz.itinerary("square", [0.5, 0.5], [1, 0])
    with pytest.raises(lorentz.Error, match="time"):
        lorentz.itinerary("square", [0.5, 0.5], [1, 0], max_time="soon")
    with pytest.raises(lorentz.Error, match="the engine batch does not do obstacles"):
        lorentz.trajectories(lorentz.unit_scene(2, 6), [[0.5, 0.5]], [[1, 0]], 3)


def test_starts_beyond_the_range_of_floats():
    path = lorentz.itinerary("square", [10**400, Fraction(445, 1000)], [1, Fraction(3, 10)], collisions=1)
    assert path.start == (math.inf, 0.445) and path.collisions[0].cell[0] > 10**399


def test_limits_of_trajectories_are_floats_and_infinity_is_none():
    assert lorentz.trajectories("square", [0.5, 0.45], [1, 0.3], 3, max_time="1/4").count[0] == 0
    one, other = (lorentz.itinerary("square", [0.5, 0.45], [1, 0.3], collisions=2, max_time=limit) for limit in (None, math.inf))
    assert one == other and len(one.collisions) == 2
    for limit in ("1/3", 10**400):
        with pytest.raises(lorentz.Error, match="max_time: .* is not a number that a float can be"):
            lorentz.trajectories("square", [0.5, 0.45], [1, 0.3], 3, max_time=limit)
