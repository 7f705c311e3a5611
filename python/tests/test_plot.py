"""Pictures hold what they should."""

import pickle
import subprocess
import sys
from dataclasses import replace

import lorentz
import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest

matplotlib.use("Agg")
SEED = 20161115


@pytest.fixture(autouse=True)
def closed_afterwards():
    yield
    matplotlib.pyplot.close("all")


def patches(ax):
    return sum(len(c.get_paths()) for c in ax.collections if isinstance(c, matplotlib.collections.PatchCollection))


def test_a_scene_has_the_obstacles_in_the_box():
    ax = lorentz.plot.scene(lorentz.unit_scene(2, 0.1), (-0.5, 3.5, -0.5, 2.5))
    assert patches(ax) == 4 * 3 and ax.get_aspect() == 1
    reaching_in = lorentz.plot.scene(lorentz.unit_scene(2, 0.1), (0.05, 0.95, -0.5, 0.5))
    assert patches(reaching_in) == 2
    assert patches(lorentz.plot.scene("honeycomb", (0, 6, 0, 6))) > 20


@pytest.mark.parametrize("box", [(0, 1, 0), (1, 1, 0, 2), (0, 2, 1, 1), (1, 0, 0, 2), (0, 2, 1, 0)])
def test_a_box_has_sides(box):
    with pytest.raises(lorentz.Error, match="box: .* is not x low, x high, y low, y high"):
        lorentz.plot.scene("square", box)


def test_a_box_of_too_many_cells_is_refused(monkeypatch):
    monkeypatch.setattr(lorentz.plot, "MOST_OBSTACLES", 9)
    assert len(lorentz.plot._cells(np.eye(2), np.zeros(2), (0, 2, 0, 2), 0)) == 9
    with pytest.raises(lorentz.Error, match="box: has more than 9 cells"):
        lorentz.plot._cells(np.eye(2), np.zeros(2), (0, 2, 0, 3), 0)


def test_what_is_drawn_leaves_a_margin_of_a_twentieth_or_a_half():
    for size, margin in ((4, 0.5), (40, 2)):
        assert lorentz.plot._around(np.array([[0, 0], [size, 1]])) == (-margin, size + margin, -margin, 1 + margin)


def test_ellipses_are_turned():
    ellipse = next(lorentz.plot._obstacles({"vectors": [[9, 0], [0, 9]], "atoms": [
        {"position": [0, 0], "semiaxes": [[0.3, 0.4], [-0.08, 0.06]]}]}, (-1, 1, -1, 1)))
    assert ellipse.width == pytest.approx(1.0) and ellipse.height == pytest.approx(0.2)
    assert ellipse.angle % 180 == pytest.approx(np.degrees(np.arctan2(4, 3)))


def test_flights_end_where_they_hit(tmp_path):
    scene = lorentz.Scene("square", 0.2)
    x, v, _ = lorentz.draw_starts(scene, 10, seed=SEED)
    x[0], v[0] = [0.0, 0.5], [1.0, 0.0]  # for ever
    answers = lorentz.first_hit(scene, x, v)
    ax = lorentz.plot.flights(scene, x, v, answers, ax=lorentz.plot.scene(scene), longest=1000)
    solid, dashed = (c.get_segments() for c in ax.collections
                     if isinstance(c, matplotlib.collections.LineCollection))
    assert (len(solid), len(dashed)) == (9, 1)
    ends = np.array([line[1] for line in solid])
    distances = np.linalg.norm(ends - np.round(ends), axis=1)
    assert np.allclose(distances, 0.2, atol=1e-12)
    ax.figure.savefig(tmp_path / "flights.png")
    assert (tmp_path / "flights.png").stat().st_size > 10_000


def test_flights_of_one_start():
    v = [[1, 0.3], [0.3, 1], [-1, 0.2]]
    ax = lorentz.plot.flights("square", [0.5, 0.5], v, lorentz.first_hit("square", [0.5, 0.5], v))
    lines = next(c.get_segments() for c in ax.collections if isinstance(c, matplotlib.collections.LineCollection))
    assert [line[0].tolist() for line in lines] == [[0.5, 0.5]] * 3
    with pytest.raises(lorentz.Error, match="answers: needs the Answers to these 3 queries"):
        lorentz.plot.flights("square", [0.5, 0.5], v, lorentz.first_hit("square", [0.5, 0.5], v[:2]))


def test_a_path_goes_through_its_collisions():
    scene = lorentz.Scene("triangular", 0.3)
    x, v, _ = lorentz.draw_starts(scene, 1, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 10)
    ax = lorentz.plot.trajectory(scene, x[0], paths)
    line = ax.lines[0].get_xydata()
    assert np.array_equal(line, np.vstack([x, paths.place[0]]))
    x, v, _ = lorentz.draw_starts(scene, 3, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 10)
    of_all = lorentz.plot.trajectory(scene, x, paths, 2).lines[0].get_xydata()
    assert np.array_equal(of_all, np.vstack([x[2], paths.place[2]]))


def test_a_path_in_space_goes_among_what_it_hits():
    scene = lorentz.Scene("rock-salt")
    x, v, _ = lorentz.draw_starts(scene, 1, seed=SEED)
    paths = lorentz.trajectories(scene, x, v, 6)
    ax = lorentz.plot.trajectory(scene, x[0], paths)
    assert np.array_equal(np.array(ax.lines[0].get_data_3d()).T, np.vstack([x, paths.place[0]]))
    met = {(int(a), tuple(cell)) for a, cell in zip(paths.atom[0], paths.cell[0].tolist())}
    assert len(ax.collections) == len(met) > 1
    obstacle = scene.to_dict()["lattices"][0]["atoms"][paths.atom[0, 0]]
    on_surface = np.array(ax.collections[0]._vec)[:3].T
    vectors = np.array(scene.to_dict()["lattices"][0]["vectors"])
    centres = [np.array(obstacle["position"]) + np.array(cell) @ vectors for _, cell in met]
    assert any(np.allclose(np.linalg.norm(on_surface - centre, axis=1), obstacle["radius"]) for centre in centres)


@pytest.mark.parametrize("name", ["triangular", "rock-salt"])
def test_an_itinerary_is_drawn_as_the_path_in_floats(name):
    scene = lorentz.Scene(name)
    x, v, _ = lorentz.draw_starts(scene, 1, seed=SEED)
    path = lorentz.itinerary(scene, x[0], v[0], collisions=4, states=True)
    ax = lorentz.plot.trajectory(path)
    in_floats = lorentz.plot.trajectory(scene, x[0], lorentz.trajectories(scene, x, v, 4))
    lines = [np.array(one.lines[0].get_data_3d() if name == "rock-salt" else one.lines[0].get_data()) for one in (ax, in_floats)]
    assert lines[0].shape == (scene.dimension, 5) and np.allclose(*lines, rtol=0, atol=1e-8)
    assert len(ax.collections) == len(in_floats.collections)
    with pytest.raises(lorentz.Error, match="drawn alone"):
        lorentz.plot.trajectory(scene, x[0], path)
    with pytest.raises(lorentz.Error, match="states=True"):
        lorentz.plot.trajectory(lorentz.itinerary(scene, x[0], v[0], collisions=4))


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_free_paths_of_one_radius_and_of_several():
    runs = [lorentz.flights("square", radius, count=100_000, seed=SEED) for radius in (0.1, 0.01, 0.001)]
    for draw in (lorentz.plot.survival_function, lorentz.plot.density):
        ax = draw(runs[1])
        assert labels(ax) == ["Boca-Zaharescu, r -> 0", "1e+05 flights"]
        assert ax.get_title() == "square, r = 0.01, uniform starts" and ax.get_xscale() == ax.get_yscale() == "log"
        ax = draw(runs)
        assert labels(ax) == ["Boca-Zaharescu, r -> 0", "r = 0.1", "r = 0.01", "r = 0.001"]
        assert ax.get_title() == "square, uniform starts"
        dots = [line for line in ax.lines if line.get_marker() == "."]
        assert len({line.get_color() for line in dots}) == len(dots) == 3
    own = matplotlib.figure.Figure().subplots()
    own.set_title("Mine")
    assert lorentz.plot.density(runs[0], ax=own).get_title() == "Mine"
    several = lorentz.plot.density([lorentz.flights(name, 1e-3, count=1000) for name in ("square", "superposition-pi-5")])
    assert labels(several)[:2] == ["limit laws", "square"]


def points_of(ax):
    """Middles, densities and laws; the ends of the bars across, and of those along."""
    law, dots = ax.lines[0], ax.lines[1]
    across, along = (np.array(bars.get_segments()) for bars in ax.collections)
    return dots.get_xdata(), dots.get_ydata(), law.get_ydata(), across[:, :, 0], along[:, :, 1]


def test_a_density_has_bars_and_a_law_of_the_same_bins():
    run = lorentz.flights("square", 0.01, count=100_000, seed=SEED)
    t, density, law, across, along = points_of(lorentz.plot.density(run))
    low, high = across.T
    flown = density * (high - low) * run.count
    assert np.array_equal(low[1:], high[:-1]) and set(low) | set(high) <= set(run.edges) and np.allclose(t, np.sqrt(low * high))
    assert np.allclose(flown, np.round(flown), rtol=0, atol=1e-6) and flown.min() > 9.5 and flown.sum() == pytest.approx(100_000)
    assert np.allclose(along.T, density * [1 - flown**-0.5, 1 + flown**-0.5])
    survival = run.laws()["Boca-Zaharescu"]
    at = {edge: share for edge, share in zip(run.edges, survival)}
    assert np.allclose(law, [(at[a] - at[b]) / (b - a) for a, b in zip(low, high)], rtol=1e-9)
    assert (abs(density / law - 1) < 5 * flown**-0.5).all() and len(t) > 100


@pytest.mark.parametrize("count", [1, 9, 10, 19, 20])
def test_a_density_of_few_flights(count):
    run = lorentz.flights("square", 0.01, count=count, seed=SEED)
    _, density, _, across, _ = points_of(lorentz.plot.density(run))
    assert len(density) == max(count // 10, 1) and sum(density * np.diff(across)[:, 0]) == pytest.approx(1)


def test_a_density_without_an_end():
    rows = lorentz.Scene({"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [
        {"position": [0, 0], "radius": 0.25}]}]})
    run = lorentz.flights(rows, count=10, seed=SEED)
    none = replace(run, counts=0 * run.counts, beyond=run.count + 0 * run.beyond)
    assert len(lorentz.plot.density(none).lines[1].get_xdata()) == 0


def test_labels_of_free_paths_name_what_differs():
    def labelled(*runs):
        found = [lorentz.flights(*scene, count=100, **options) for scene, options in runs]
        shown = labels(lorentz.plot.density(found, ax=matplotlib.figure.Figure().subplots()))
        return [text for text in shown if text != "limit laws" and not text.startswith("Boca-Zaharescu")]

    assert labelled((("square", 0.1), {}), (("triangular", 0.1), {})) == ["square", "triangular"]
    assert labelled((("square", 0.1), {}), (("triangular", 0.2), {})) == ["square, r = 0.1", "triangular, r = 0.2"]
    assert labelled((("square", 0.1), {}), (("square", 0.1), {"start": "surface"})) == ["uniform", "surface"]
    assert labelled((("square", 0.1), {"seed": 1}), (("square", 0.1), {"seed": 2})) == ["seed 1", "seed 2"]
    assert labelled((("rock-salt",), {}), (("ellipse",), {})) == ["rock-salt", "ellipse"]
    unit = lorentz.unit_scene(2, 0.1)
    assert labelled(((unit,), {}), ((lorentz.Scene(unit, 0.2),), {})) == ["r = 0.1", "r = 0.2"]
    assert labelled(((unit,), {}), ((pickle.loads(pickle.dumps(lorentz.Scene("hexagonal", 0.1))),), {})) == ["scene 1", "hexagonal"]
    assert labelled((("square", 0.1), {}), (("square", 0.1), {})) == ["100 flights"] * 2
    assert labelled((("square", 0.1), {}))[0] == "100 flights"


def test_statistics_of_trajectories(tmp_path):
    found = lorentz.diffusion("triangular", 0.45, count=2000, max_time=20, seed=SEED)
    ax = lorentz.plot.displacements(found)
    assert ax.lines[0].get_ydata()[-1] == pytest.approx(found.displacements[-1].value / (4 * 20))
    ax.figure.savefig(tmp_path / "displacements.pdf")
    assert (tmp_path / "displacements.pdf").read_bytes().startswith(b"%PDF")


def test_what_cannot_be_drawn():
    for draw, name in ((lorentz.plot.displacements, "found"), (lorentz.plot.density, "runs"),
                       (lorentz.plot.survival_function, "runs")):
        for odd in ([], [1], {"a": 1}, 5, None):
            with pytest.raises(lorentz.Error, match=f"{name}: needs what lorentz"):
                draw(odd)
    for draw in (lambda: lorentz.plot.scene("cubic"), lambda: lorentz.plot.flights("cubic", [0, 0, 0.5], [1, 0, 0], None)):
        with pytest.raises(lorentz.Error, match="two dimensions"):
            draw()
    with pytest.raises(lorentz.Error, match="smaller"):
        lorentz.plot.scene("square", (0, 1e6, 0, 1e6))


def test_its_functions_are_listed_before_one_is_called():
    program = """if True:
        import sys, rlcompleter, lorentz
        functions = ["density", "displacements", "flights", "scene", "survival_function", "trajectory"]
        assert dir(lorentz.plot) == functions, dir(lorentz.plot)
        typed = rlcompleter.Completer({"lorentz": lorentz}).attr_matches("lorentz.plot.")
        assert {f"lorentz.plot.{name}(" for name in functions} == {text.rstrip(")") for text in typed}, typed
        assert "matplotlib" not in sys.modules
        sys.modules["matplotlib"] = None
        try:
            lorentz.plot.scene("square")
        except ImportError as error:
            assert "lorentz.plot needs Matplotlib: pip install matplotlib" in str(error), error
        else:
            assert False"""
    subprocess.run([sys.executable, "-c", program], check=True)


def test_rows_and_single_obstacles_are_drawn():
    row = {"dimension": 2, "lattices": [{"vectors": [[1, 1]], "atoms": [{"position": [0.5, 0], "radius": 0.25}]}]}
    assert patches(lorentz.plot.scene(row, (-1, 3, -1, 3))) == 4
    row["lattices"][0]["vectors"] = []
    assert patches(lorentz.plot.scene(row, (-1, 3, -1, 3))) == 1
    for name in ("grating", "impurity"):
        if lorentz.Scene(name).dimension == 2:
            assert patches(lorentz.plot.scene(name)) > 0
    path = lorentz.itinerary(row, [0.5, 2], [0, -1], collisions=1, states=True)
    assert path.end == "collisions" and patches(lorentz.plot.trajectory(path)) == 1
