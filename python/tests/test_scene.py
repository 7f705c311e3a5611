"""Scenes from dicts, files and names; numbers as they are."""

import pickle
from fractions import Fraction

import lorentz
import numpy as np
import pytest
from lorentz import Outcome, oracle

SQUARE = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.1}]}]}


def test_a_dict_a_file_and_a_name_are_the_same_scene(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text("dimension = 2\n[[lattices]]\nvectors = [[1, 0], [0, 1]]\n"
                    "atoms = [{position = [0, 0], radius = 0.1}]\n")
    scenes = [lorentz.Scene(SQUARE), lorentz.Scene(file), lorentz.Scene(str(file)), lorentz.Scene("square", 0.1),
              lorentz.unit_scene(2, 0.1), pickle.loads(pickle.dumps(lorentz.Scene(SQUARE)))]
    assert all(scene == scenes[0] for scene in scenes)
    assert len({hash(scene) for scene in scenes}) == 1
    assert lorentz.Scene("square", 0.2) != scenes[0]


def test_the_catalogue():
    names = lorentz.catalogue()
    assert {"square", "cubic", "honeycomb", "diamond", "ellipsoid"} <= set(names)
    for name in names:
        scene = lorentz.Scene(name)
        assert lorentz.Scene(scene.to_dict()) == scene and scene.is_binary64


def test_numbers_mean_what_they_are():
    third = lorentz.unit_scene(2, Fraction(1, 3))
    assert not third.is_binary64
    assert third.to_dict()["lattices"][0]["atoms"][0]["radius"] == Fraction(1, 3)
    assert third.nearest().to_dict()["lattices"][0]["atoms"][0]["radius"] == 1 / 3
    assert lorentz.unit_scene(2, Fraction(1, 4)) == lorentz.unit_scene(2, 0.25)
    assert not lorentz.unit_scene(2, "0.1").is_binary64 and lorentz.unit_scene(2, 0.1).is_binary64
    assert lorentz.unit_scene(2, np.float64(0.1)) == lorentz.unit_scene(2, 0.1)


def test_arrays_need_floats():
    with pytest.raises(lorentz.Error, match="no binary64"):
        lorentz.first_hit(lorentz.unit_scene(2, "1/3"), [[0.5, 0.5]], [[1, 0]])


def without(*path):
    scene = lorentz.Scene(SQUARE).to_dict()
    place = scene
    for key in path[:-1]:
        place = place[key]
    del place[path[-1]]
    return scene


@pytest.mark.parametrize("scene, text", [
    (without("dimension"), "dimension is missing"),
    (without("lattices", 0, "atoms", 0, "radius"), r"lattices\[0\].atoms\[0\]: radius is missing"),
    (SQUARE | {"colour": 1}, '"colour" is not known'),
    ({"dimension": 2, "lattices": [{"vectors": [[1, 1], [1, 1]], "atoms": SQUARE["lattices"][0]["atoms"]}]},
     "dependent"),
    (SQUARE | {"dimension": float("nan")}, "finite"),
    (SQUARE | {"dimension": object()}, "numbers are"),
])
def test_what_is_no_scene(scene, text):
    with pytest.raises(lorentz.Error, match=text):
        lorentz.Scene(scene)


def test_names_that_are_none():
    with pytest.raises(lorentz.Error, match="did you mean square"):
        lorentz.Scene("squar")
    assert issubclass(lorentz.FileError, OSError) and issubclass(lorentz.FileError, lorentz.Error)
    with pytest.raises(lorentz.Error, match="radius"):
        lorentz.Scene("ellipse", 0.1)
    with pytest.raises(lorentz.Error, match="above"):
        lorentz.Scene("square", -1)


def test_a_text_that_is_a_float_is_one(tmp_path):
    file = tmp_path / "quarter.toml"
    file.write_text('dimension = 2\nlattices = [{vectors = [["1", 0], [0, "0x1p0"]], atoms = [{position = [0, 0], '
                    'radius = "1/4"}]}]\n')
    scene = lorentz.unit_scene(2, 0.25)
    for same in (lorentz.unit_scene(2, "0.25"), lorentz.unit_scene(2, Fraction(1, 4)), lorentz.Scene("square", "1/4"),
                 lorentz.Scene(file)):
        assert same == scene and hash(same) == hash(scene) and same.is_binary64
        assert lorentz.first_hit(same, [[0.5, 0.5]], [[1, 0.3]]).outcome.tolist() == [lorentz.Outcome.HIT]
    minus = lorentz.Scene({"dimension": 2, "lattices": [{"vectors": [[1, -0.0], [0, 1]], "atoms": [
        {"position": [0, 0], "radius": 0.25}]}]})
    assert minus == scene and hash(minus) == hash(scene)
    assert hash(lorentz.unit_scene(2, "1/3")) == hash(lorentz.unit_scene(2, Fraction(1, 3)))
    assert not lorentz.unit_scene(2, "0.1").is_binary64


def test_scenes_that_repeat_in_fewer_directions():
    ball = lorentz.Scene({"dimension": 3, "lattices": [{"vectors": [], "atoms": [{"position": [0, 0, 0], "radius": 1}]}]})
    assert ball == lorentz.Scene("ball") and ball.to_dict()["lattices"][0]["vectors"] == []
    x, v = [[-3, 0, 0], [-3, 2, 0], [0, 0, 0]], [[1, 0, 0]] * 3
    for engine in ("certified", "oracle", "reduction", "certified-batch"):
        answers = lorentz.first_hit(ball, x, v, engine=engine)
        assert answers.outcome.tolist() == [Outcome.HIT, Outcome.NEVER, Outcome.INSIDE] and answers.time[0] == 2
    row = lorentz.Scene("row")
    answer = oracle.first_hit(row, [0.25, -2, 0], [0.375, 1, 0])
    assert len(answer.cell) == 1
    for place in (ball, row, "grating"):
        with pytest.raises(lorentz.Error, match="crystals only"):
            lorentz.horizon(place)
