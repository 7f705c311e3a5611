"""Odd arguments, one at a time, of all functions: an answer, or an Error that names the argument; never anything else."""

import math
import re
from decimal import Decimal
from fractions import Fraction

import lorentz
import numpy as np
import pytest

SCENE = lorentz.unit_scene(2, 0.2)
X, V = [0.5, 0.5], [1.0, 0.3]
ODD = [None, math.nan, math.inf, -math.inf, -1, 0, 0.5, 2**70, -(2**70), 1e308, True, "", "x", b"x", [], [[]], {}, (), object(),
       [1, 2, 3, 4], np.zeros((0, 2)), np.zeros((2, 2, 2)), np.array(["a"]), np.array([1 + 2j, 0]), Fraction(1, 3), Decimal("NaN"),
       1j, range(3), lambda: 0, np.float32(0.1), np.datetime64("2020-01-01"), [None, None], float]

# Function, arguments that are good, and those that are made odd in turn.
CALLS = [
    (lorentz.Scene, dict(source="square", radius=0.1), "source radius"),
    (lorentz.unit_scene, dict(dimension=2, radius=0.1), "dimension radius"),
    (lorentz.first_hit, dict(scene=SCENE, x=X, v=V, radius=0.1, engine="batch", jobs=1, max_time=5.0, start_from=None,
                             on_error="raise"), "scene x v radius engine jobs max_time start_from on_error"),
    (lorentz.Engine, dict(scene=SCENE, name="batch", jobs=1), "scene name jobs"),
    (lorentz.trajectories, dict(scene=SCENE, x=X, v=V, collisions=3, start_from=None, max_time=5.0, every=1, engine="batch",
                                precision="binary64"),
     "scene x v collisions start_from max_time every engine precision"),
    (lorentz.memory_of_trajectories, dict(particles=3, collisions=3, every=1, dimension=2), "particles collisions every dimension"),
    (lorentz.itinerary, dict(scene=SCENE, x=X, v=V, start_from=None, collisions=2, max_time=3, digits=17, most_bits=0),
     "scene x v start_from collisions max_time digits most_bits"),
    (lorentz.draw_starts, dict(scene=SCENE, count=2, start="uniform", seed=1, first=0), "scene count start seed first"),
    (lorentz.flights, dict(scene=SCENE, radius=0.1, count=10, start="uniform", seed=1, engine="batch", jobs=1),
     "scene radius count start seed engine jobs"),
    (lorentz.laws, dict(scene=SCENE, times=[1.0], start="uniform"), "scene times start"),
    (lorentz.mean_free_path, dict(scene=SCENE, radius=0.1), "scene radius"),
    (lorentz.horizon, dict(scene=SCENE, radius=0.3, min_width=0.1), "scene radius min_width"),
    (lorentz.lyapunov, dict(scene=SCENE, radius=0.2, collisions=10, seed=1, jobs=1), "scene radius collisions seed jobs"),
    (lorentz.diffusion, dict(scene=SCENE, radius=0.2, count=5, max_time=2.0, start="uniform", seed=1, jobs=1),
     "scene radius count max_time start seed jobs"),
    (lorentz.scan, dict(function=lorentz.mean_free_path, scenes=SCENE, radii=[0.1], on_error="raise", progress=False),
     "scenes radii on_error progress"),
    (lorentz.oracle.first_hit, dict(scene=SCENE, x=X, v=V, start_from=None, digits=0, max_time=5.0),
     "scene x v start_from digits max_time"),
    (lorentz.oracle.margin, dict(scene=SCENE, x=X, v=V, start_from=None), "scene x v start_from"),
    (lorentz.oracle.passed, dict(scene=SCENE, x=X, v=V, start_from=None), "scene x v start_from"),
    (lorentz.oracle.certificate, dict(scene=SCENE, x=X, v=V, start_from=None), "scene x v start_from"),
    (lorentz.oracle.entry_time, dict(scene=SCENE, x=[0.5, 0.1], v=[1.0, 0.0], obstacle=(0, 0, (1, 0))), "scene x v obstacle"),
    (lorentz.oracle.convergents, dict(rise=1.0, run=3.0), "rise run"),
    (lorentz.hit, dict(time=1.0, cell=(0, 0)), "time cell"),
    (lorentz.golden, dict(name_or_file="ties"), "name_or_file"),
    (lorentz.judge, dict(engine="reduction", questions=1, seed=1, jobs=1, ulps=4.0, precision="binary64", time_tolerance=None,
                         domain=None, starts_inside="inside"),
     "engine questions seed jobs ulps precision time_tolerance domain starts_inside"),
]
# What an argument is called in messages, where that is not its name.
ALSO = {"source": "scene", "scene": "dimension|lattices|file|catalogue", "name": "engine", "name_or_file": "file|set", "scenes": "scene",
        "radii": "radius|scene", "radius": "radi|scene|starts|sizes|obstacles", "x": "row 0|has", "v": "row 0", "start_from": "row 0|lattice|atom|cell", "engine": "threads",
        "max_time": "time", "times": "time", "particles": "count", "run": "slope", "rise": "slope"}
# What is asked for, and takes its time: two minutes of judging, flights of 10^21.
LONG = {("questions", None), ("max_time", 2**70), ("max_time", 1e308)}


def cases():
    for function, good, names in CALLS:
        for name in names.split():
            for odd in ODD:
                if (name, odd if isinstance(odd, (int, float)) else None) in LONG and function in (lorentz.judge, lorentz.diffusion):
                    continue
                yield pytest.param(function, good, name, odd, id=f"{function.__name__}-{name}-{odd!r:.24}")


@pytest.mark.parametrize("function, good, name, odd", cases())
def test_one_odd_argument(function, good, name, odd):
    try:
        function(**(good | {name: odd}))
    except lorentz.Error as error:
        named = f"{name}|{ALSO.get(name, name)}"
        assert re.search(named, str(error)), f"{error} does not name {name}"


def test_there_are_many():
    assert len(list(cases())) > 2000
