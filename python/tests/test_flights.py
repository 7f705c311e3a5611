"""Free paths against theory, and horizons."""

import lorentz
import numpy as np
import pytest

SEED = 20161115


def test_the_mean_is_the_exact_one():
    paths = lorentz.flights("square", 0.2, count=300_000, start="surface", seed=SEED)
    exact = lorentz.mean_free_path("square", 0.2)
    assert exact == pytest.approx((1 - np.pi * 0.04) / 0.4, rel=1e-14)
    assert paths.count == 300_000 and abs(paths.mean - exact) < 5 * paths.mean_error
    assert 0 < paths.mean_error < 0.01
    assert np.isnan(lorentz.flights("square", 0.2, count=1, start="surface", seed=SEED).mean_error)


def test_an_infinite_mean_or_variance_is_said():
    for start, remark in (("uniform", "mean is infinite"), ("surface", "variance is infinite")):
        text = repr(lorentz.flights("square", 0.2, count=1000, start=start)).split("\n")
        assert text[0].startswith("FreePaths(1000 flights, ") and remark in text[1]
    assert "\n" not in repr(lorentz.flights("triangular", 0.45, count=1000))


def test_survival_follows_the_law():
    paths = lorentz.flights("square", 1e-3, count=300_000, seed=SEED)
    laws, measured = paths.laws(), paths.survival_function()
    assert list(laws) == ["Boca-Zaharescu"]
    expected = laws["Boca-Zaharescu"]
    error = np.sqrt(np.maximum(expected * (1 - expected), 1e-12) / paths.count)
    seen = (expected > 1e-3) & (expected < 0.999)
    assert seen.sum() > 100 and (np.abs(measured - expected)[seen] < 5 * error[seen]).all()
    assert (np.diff(measured) <= 0).all()
    inside = paths.counts[1:-1].sum() + paths.counts[0] + paths.counts[-1]
    assert inside == paths.report["hits"]
    assert (paths.density() * np.diff(paths.edges)).sum() <= 1 + 1e-12


def test_threads_and_seeds():
    one = lorentz.flights("cubic", 0.2, count=200_000, seed=1)
    two = lorentz.flights("cubic", 0.2, count=200_000, seed=1, jobs=2)
    other = lorentz.flights("cubic", 0.2, count=200_000, seed=2)
    assert np.array_equal(one.counts, two.counts) and one.mean == two.mean
    assert not np.array_equal(one.counts, other.counts)


def test_horizons():
    square = lorentz.horizon("square", 0.4)
    assert square["horizon"] == "infinite" and square["verdict"].startswith("infinite horizon")
    assert {tuple(c["direction"]): c["width"] for c in square["channels"]} == {
        (1, 0): pytest.approx(0.2), (0, 1): pytest.approx(0.2)}
    assert lorentz.horizon("triangular", 0.45)["horizon"] == "finite"
    assert lorentz.horizon("square", 0.01, min_width=0.9)["channels"]


@pytest.mark.parametrize("call, text", [
    (lambda: lorentz.flights("square", count=0), "count"),
    (lambda: lorentz.flights("square", count=10, start="nowhere"), "start"),
    (lambda: lorentz.flights("square", count=10, engine="bach"), "did you mean batch"),
    (lambda: lorentz.flights("square", count=10, jobs=0), "jobs"),
    (lambda: lorentz.flights("square", 0.9, count=10), "no free start"),
    (lambda: lorentz.horizon("square", 1e-9), "min_width"),
])
def test_bad_arguments(call, text):
    with pytest.raises(lorentz.Error, match=text):
        call()


def test_reports_name_their_scene():
    crystal = lorentz.Scene("triangular", 0.45)
    found = (lorentz.flights(crystal, count=10), lorentz.lyapunov(crystal, collisions=100),
             lorentz.diffusion(crystal, count=10, max_time=2))
    assert {one.report["scene"] for one in found} == {lorentz.horizon(crystal)["scene"]} == {"triangular"}
    assert lorentz.flights(lorentz.unit_scene(2, 0.1), count=10).report["scene"] is None
