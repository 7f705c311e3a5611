"""Statistics of trajectories say what the command line says, and what theory does."""

import warnings
from dataclasses import replace

import lorentz
import pytest

SEED = 20161115


def test_exponents_of_small_discs():
    found = lorentz.lyapunov("square", 0.001, collisions=300_000, seed=SEED)
    value, error = found.exponents[0]
    assert abs(value - found.report["small_obstacles"]) < 5 * error + 1e-3 and 0 < error < 0.02
    in_time = found.exponents_in_time[0]
    assert in_time.value == pytest.approx(value / lorentz.mean_free_path("square", 0.001))
    whole = lorentz.lyapunov("cubic", 0.3, collisions=20_000, spectrum=True, jobs=2)
    assert len(whole.exponents) == 4 and abs(whole.report["sum"]) < 1e-10
    assert whole.report == lorentz.lyapunov("cubic", 0.3, collisions=20_000, spectrum=True).report


def test_diffusion_between_small_gaps():
    found = lorentz.diffusion("triangular", 0.49, count=4000, max_time=100, seed=SEED, jobs=2)
    value, error = found.coefficient
    assert value == pytest.approx(found.report["machta_zwanzig"], rel=0.5) and error < value / 5
    assert found.times[-1] == 100 and len(found.displacements) == len(found.times) == 17
    open_ways = lorentz.diffusion("square", 0.2, count=1000, max_time=20, seed=SEED)
    assert open_ways.coefficient is None and open_ways.report["open"] and open_ways.report["scene"] == "square"


def test_a_time_that_is_too_short_for_diffusion():
    found = lorentz.diffusion("triangular", 0.45, count=100, max_time=50)
    short = replace(found, report=found.report | {"too_short": True})
    for told in (lambda: short.coefficient, lambda: repr(short)):
        with pytest.warns(RuntimeWarning, match="max_time: .* too short") as seen:
            told()
        assert [warning.filename for warning in seen] == [__file__]
    with warnings.catch_warnings(action="error"):
        assert found.coefficient == replace(found, report=found.report | {"too_short": False}).coefficient and repr(found)


def test_estimates():
    estimate = lorentz.Estimate(0.0843017, 0.00042)
    assert float(estimate) == 0.0843017 and f"{estimate:.3f}" == "0.084" and str(estimate) == "0.0843 +- 0.0004"
    for value, error, text in ((0.084, 0.00096, "0.084 +- 0.001"), (12345.6, 250.0, "12300 +- 200"), (3, 1, "3 +- 1"),
                               (2.0, 0.0, "2 +- 0"), (1.5, None, "1.5 +- unknown"), (None, None, "unknown +- unknown")):
        assert str(lorentz.Estimate(value, error)) == text
    one = lorentz.diffusion("triangular", 0.45, count=1, max_time=5)
    assert repr(one).startswith("Diffusion(D = 0.267845 +- unknown; 1 particle")
    rows = lorentz.scan(lambda scene, radius: lorentz.Estimate(radius, 0.1), "square", [0.2, 0.3])
    assert rows[1] == {"scene": "square", "radius": 0.3, "value": 0.3, "error": 0.1}


def test_scans():
    rows = lorentz.scan(lorentz.lyapunov, "square", [0.1, 0.2], collisions=5000)
    assert [(row["scene"], row["radius"]) for row in rows] == [("square", 0.1), ("square", 0.2)]
    assert rows[0]["exponent_1"] > rows[1]["exponent_1"] > 2
    assert rows[1]["exponent_1"] == lorentz.lyapunov("square", 0.2, collisions=5000).exponents[0].value
    rows = lorentz.scan(lorentz.flights, ["square", "triangular"], [0.2], count=2000, start="surface")
    assert [row["start"] for row in rows] == ["surface"] * 2 and "from" not in rows[0]
    assert [row["mean_free_path"] for row in rows] == [lorentz.mean_free_path(name, 0.2) for name in ("square", "triangular")]
    assert [row["horizon"] for row in lorentz.scan(lorentz.horizon, "triangular", [0.4, 0.45])] == ["infinite", "finite"]
    assert [row["radius"] for row in lorentz.scan(lorentz.mean_free_path, ["honeycomb", "rock-salt"])] == [0.23, None]
    assert lorentz.scan(lorentz.mean_free_path, "square", 0.2) == lorentz.scan(lorentz.mean_free_path, "square", [0.2])
    marked = lorentz.scan(lorentz.lyapunov, "square", [0.2, 6], collisions=1000, on_error="mark")
    assert "exponent_1" in marked[0] and "reach over as many cells" in marked[1]["error"]
    with pytest.raises(lorentz.Error, match="reach over as many cells"):
        lorentz.scan(lorentz.lyapunov, "square", [0.2, 6], collisions=1000)


@pytest.mark.parametrize("call", [
    lambda scene: lorentz.lyapunov(scene), lambda scene: lorentz.diffusion(scene),
    lambda scene: lorentz.flights(scene)])
def test_scenes_that_leave_no_statistics(call):
    rows = {"dimension": 2, "lattices": [{"vectors": [[1, 0]], "atoms": [{"position": [0, 0], "radius": 0.25}]}]}
    for scene in (rows, lorentz.unit_scene(2, 0.9)):
        with pytest.raises(lorentz.Error):
            call(scene)
