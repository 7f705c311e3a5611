"""Free paths against theory, and horizons."""

import csv
import json

import lorentz
import numpy as np
import pytest

SEED = 20161115
# The first lines of `lorentz flights --scene square --radius 0.2 --count 20 --csv FILE`, and the last logarithmic one.
WRITTEN = """\
bins,from,to,count,density,density_error,survival_at_to,Boca-Zaharescu: density,Boca-Zaharescu: survival_at_to
logarithmic,0.40625,0.4375,1,1.6,1.6,0.95,0.35896492062485663,0.8343088837471397
logarithmic,0.5625,0.625,1,0.8,0.8,0.9,0.3422469253238667,0.7689977219329384
logarithmic,0.625,0.6875,1,0.8,0.8,0.85,0.3361676543053278,0.7479872435388554
logarithmic,0.6875,0.75,2,1.6,1.131370849898476,0.75,0.33008838328678713,0.7273567195834312
""", "logarithmic,384,416,1,0.0015625,0.0015625,0,3.18133130850771e-06,0.0012196374705468215\n"


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


def test_bins_are_saved_as_the_command_line_writes_them(tmp_path):
    paths, file = lorentz.flights("square", 0.2, count=20), tmp_path / "paths.csv"
    file.write_text("something longer" * 1000)
    paths.save(file)
    assert file.read_text().startswith(WRITTEN[0]) and file.read_text().endswith(WRITTEN[1])
    with file.open() as opened:
        assert sum(int(row["count"]) for row in csv.DictReader(opened)) == 20
    read = np.genfromtxt(file, delimiter=",", names=True, dtype=None, encoding=None)
    seen = paths.counts[1:-1] > 0
    assert np.array_equal(read["density"], paths.density()[seen]) and np.array_equal(read["to"], paths.edges[1:][seen])
    survival = paths.survival_function()[1:][seen]
    assert np.array_equal(read["survival_at_to"], survival)


def test_the_first_and_the_last_bin_of_a_file(tmp_path):
    paths = lorentz.flights("square", 0.2, count=20)
    paths.counts[0] += 1
    paths.counts[-1] += 2
    paths.save(str(tmp_path / "paths.csv"))
    lines = (tmp_path / "paths.csv").read_text().split("\n")
    assert lines[1].startswith(f"logarithmic,0,{float(paths.edges[0])!r},1,") and not lines[1].endswith(",")
    assert lines[-2] == f"logarithmic,{float(paths.edges[-1])!r},inf,2,,,,,"


def test_a_report_is_saved(tmp_path):
    for scene, radius in ((("square", 0.2), 0.2), (("rock-salt",), None)):
        paths = lorentz.flights(*scene, count=100)
        paths.save(tmp_path / "paths.json")
        assert json.loads((tmp_path / "paths.json").read_text()) == paths.report | {"scene": scene[0], "radius": radius}
    for path, text in (("paths.txt", "path: 'paths.txt' ends neither in .csv"), (5, "path: 5 is not the name of a file")):
        with pytest.raises(lorentz.Error, match=text):
            paths.save(path)
    with pytest.raises(lorentz.FileError, match="path: .* cannot be written: No such file or directory"):
        paths.save(tmp_path / "nowhere" / "paths.csv")


def test_bins_are_a_table(tmp_path):
    pandas = pytest.importorskip("pandas")
    paths = lorentz.flights("superposition-pi-5", 0.01, count=10_000, start="surface")
    frame = paths.to_frame()
    paths.save(tmp_path / "paths.csv")
    read = pandas.read_csv(tmp_path / "paths.csv", float_precision="round_trip")
    assert (read.pop("bins") == "logarithmic").all() and list(read.columns) == list(frame.columns)
    assert np.array_equal(read, frame) and frame["count"].sum() == 10_000
    seen, law = paths.counts[1:-1] > 0, "Boca-Zaharescu (2 incommensurate lattices)"
    assert np.array_equal(frame.density, paths.density()[seen])
    assert np.array_equal(frame[f"{law}: survival_at_to"], paths.laws()[law][1:][seen])
    assert np.allclose(frame.density_error * frame["count"] ** 0.5, frame.density)


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
