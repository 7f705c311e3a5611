"""Statistics of trajectories say what the command line says, and what theory does."""

import signal
import subprocess
import sys
import warnings
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

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
    with pytest.raises(lorentz.Error, match="on_error: 'warn' is unknown"):
        lorentz.scan(lorentz.mean_free_path, "square", on_error="warn")
    with pytest.raises(lorentz.Error, match="progress: 'yes' is unknown; expected True, False or None"):
        lorentz.scan(lorentz.mean_free_path, "square", progress="yes")


@pytest.mark.parametrize("stop", [KeyboardInterrupt, ZeroDivisionError, lorentz.Error])
def test_what_ends_a_scan_early_has_its_rows(stop):
    def stopped_at(scene, radius):
        if radius == 0.3:
            raise stop("enough")
        return radius

    with pytest.raises(stop) as seen:
        lorentz.scan(stopped_at, "square", [0.1, 0.2, 0.3, 0.4])
    assert [(row["radius"], row["value"]) for row in seen.value.rows] == [(0.1, 0.1), (0.2, 0.2)]
    assert seen.value.__notes__ == ["scan: 2 of 4 rows are done, stopped at square, radius 0.3; the rows are in the attribute "
                                    "`rows` of this exception (at a prompt: sys.last_value.rows)"]
    with pytest.raises(stop) as seen:
        lorentz.scan(stopped_at, lorentz.unit_scene(2, 0.1), [0.3])
    assert seen.value.rows == []
    assert seen.value.__notes__ == ["scan: 0 of 1 rows are done, stopped at a scene without a name, radius 0.3"]


def test_an_interrupt_keeps_the_rows_of_a_scan():
    program = """if True:
        import lorentz
        def function(scene, radius):
            if radius == 0.46:
                print("go", flush=True)
                return lorentz.diffusion(scene, radius, count=10**7)
            return lorentz.diffusion(scene, radius, count=100)
        try:
            lorentz.scan(function, "triangular", [0.45, 0.46])
        except KeyboardInterrupt as stop:
            print([row["radius"] for row in stop.rows])"""
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout.readline() == "go\n"
        child.send_signal(signal.SIGINT)
        assert child.stdout.read() == "[0.45]\n" and child.wait() == 0


class Bar:
    """What `scan` needs of tqdm."""

    def __init__(self, places, name):
        self.places, self.told = places, [name]
        Bar.last = self

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.told.append("closed")

    def __iter__(self):
        return iter(self.places)

    def set_postfix_str(self, text):
        self.told.append(text)


def test_progress_of_a_scan(monkeypatch, capsys):
    arguments = lorentz.mean_free_path, ["square", Path("honeycomb")]
    expected = lorentz.scan(*arguments)
    assert capsys.readouterr() == ("", "")
    monkeypatch.setitem(sys.modules, "tqdm", None)
    assert lorentz.scan(*arguments, progress=True) == expected
    assert capsys.readouterr() == ("", "scan: 1 of 2: square\nscan: 2 of 2: honeycomb\n")
    monkeypatch.setitem(sys.modules, "tqdm", SimpleNamespace(tqdm=Bar))
    assert lorentz.scan(*arguments, [0.1], progress=True) == lorentz.scan(*arguments, [0.1], progress=False)
    assert Bar.last.told == ["scan", "square, radius 0.1", "honeycomb, radius 0.1", "closed"]
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
    monkeypatch.setitem(sys.modules, "tqdm", None)
    for progress, lines in ((None, 2), (False, 0)):
        lorentz.scan(*arguments, progress=progress)
        assert capsys.readouterr().err.count("\n") == lines


def test_progress_by_tqdm(capsys):
    pytest.importorskip("tqdm")
    lorentz.scan(lorentz.mean_free_path, "square", [0.1, 0.2], progress=True)
    shown = capsys.readouterr().err
    assert "scan: 100%" in shown and "2/2" in shown and "square, radius 0.2" in shown


@pytest.mark.parametrize("call", [
    lambda scene: lorentz.lyapunov(scene), lambda scene: lorentz.diffusion(scene),
    lambda scene: lorentz.flights(scene)])
def test_scenes_that_leave_no_statistics(call):
    rows = {"dimension": 2, "lattices": [{"vectors": [[1, 0]], "atoms": [{"position": [0, 0], "radius": 0.25}]}]}
    for scene in (rows, lorentz.unit_scene(2, 0.9)):
        with pytest.raises(lorentz.Error):
            call(scene)
