"""Exact answers in ints and Fractions, margins, verdicts, proofs."""

import math
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction

import lorentz
import numpy as np
import pytest
from lorentz import oracle

SEED = 20161115


def test_cells_of_any_size():
    answer = oracle.first_hit(lorentz.Scene("square", 0.1), [0, 0.445], [1, 1e-20])
    assert answer.cell == (45500000000000001275, 1) and answer.time == 4.55e19
    assert oracle.first_hit(lorentz.Scene("square", 0.1), [0.05, 0], [1, 0]).outcome == "inside"
    assert oracle.first_hit(lorentz.Scene("square", 0.1), [0, 0.445], [1, 0]).outcome == "never"


def test_a_time_by_hand():
    # (t - 1/2)^2 + 1/100 = 1/9: the disc of cell (1, 0).
    answer = oracle.first_hit(lorentz.unit_scene(2, Fraction(1, 3)), [Fraction(1, 2), Fraction(1, 10)], [1, 0])
    assert answer.obstacle == (0, 0, (1, 0))
    assert answer.exact_time == lorentz.ExactTime(Fraction(1, 2), Fraction(91, 900))
    assert answer.time == float(answer.exact_time) == pytest.approx(0.5 - math.sqrt(91 / 900), rel=1e-15)
    # Along the axis the root is a square: (1 - t)^2 = 1/9.
    along = oracle.first_hit(lorentz.unit_scene(2, "1/3"), ["1/2", 0], [1, 0])
    assert along.exact_time.fraction() == Fraction(1, 6) and along.time == 1 / 6
    assert answer.exact_time.fraction() is None


@pytest.mark.parametrize("name", ["square", "cubic", "hcp", "ellipse", "ellipsoid", "superposition-pi-5"])
def test_the_exact_time_rounds_to_the_time(name):
    """Two ways: the oracle's C++ integers, and Fractions of the obstacle alone."""
    scene = lorentz.Scene(name)
    x, v, _ = lorentz.draw_starts(scene, 30, seed=SEED)
    for i in range(len(x)):
        answer = oracle.first_hit(scene, x[i], v[i], digits=40)
        assert float(answer.exact_time) == answer.time
        low, high = answer.exact_time.bounds(200)
        assert low <= high and high - low <= Fraction(1, 2**200) and float(low) == answer.time
        assert Fraction(str(answer.exact_time.decimal(40))) == Fraction(answer.time_decimal)


def test_rational_inputs_are_taken_as_they_are():
    """A start on the edge of a corridor, which floats cannot name: 1/3 is free at radius 1/3, and never hits."""
    scene = lorentz.unit_scene(2, Fraction(1, 3))
    assert oracle.first_hit(scene, [Fraction(1, 2), Fraction(1, 3)], [1, 0]).outcome == "never"
    below = oracle.first_hit(scene, [Fraction(1, 2), Fraction(1, 3) - Fraction(1, 10**30)], [1, 0])
    assert below.outcome == "hit" and below.cell == (1, 0)
    as_floats = oracle.first_hit(lorentz.unit_scene(2, 0.1), [0.5, Fraction(1, 8)], [1, 2])
    assert as_floats == oracle.first_hit(lorentz.unit_scene(2, 0.1), [0.5, 0.125], [1.0, 2.0])
    assert oracle.first_hit(scene, ["1/2", "1/10"], [1, 0], max_time=0.1).outcome == "later"


def test_detail():
    answer = oracle.first_hit(lorentz.unit_scene(2, 0.25), [-1.5, 0], [1, 0], detail=True)
    assert answer.point == (-1.25, 0.0) and answer.normal == (-1.0, 0.0) and answer.impact_parameter == 0
    assert answer.exit_time == 0.75 and answer.exit_point == (-0.75, 0.0) and answer.exit_normal == (1.0, 0.0)
    within = oracle.first_hit(lorentz.unit_scene(2, 0.25), [0, 0], [0, -2], detail=True)
    assert within.outcome == "inside" and within.exit_time == 0.125 and within.exit_normal == (0.0, -1.0)
    assert within.point is None and lorentz.Answer.from_line(within.to_line()).exit_time == 0.125
    with pytest.raises(lorentz.Error, match="detail"):
        oracle.first_hit(lorentz.unit_scene(2, "1/3"), [0.5, 0.5], [1, 0], detail=True)


def test_lines_are_read_as_the_formats_say():
    assert lorentz.Answer.from_line(
        '{"outcome":"hit","lattice":0,"atom":0,"cell":["27",1.0],"time":"0x1p3","exit_time":"inf"}'
    ) == replace(lorentz.hit(8, (27, 1)), exit_time=math.inf)


def test_where_nothing_is():
    scene = lorentz.unit_scene(2, 0.25)
    assert oracle.is_free(scene, [0.5, 0.5]) and not oracle.is_free(scene, [1, 1.1])
    assert oracle.is_free(scene, [0.25, 0])  # the obstacle is open


def test_margins():
    """The line passes the disc of (1, 0) by 4 ulps of its y; then the decision about it is the hardest."""
    radius = 0.25
    y = radius + 4 * math.ulp(radius)
    passing = oracle.margin(lorentz.unit_scene(2, radius), [0.5, y], [1, 0.001])
    assert passing.condition is not None
    grazing = oracle.margin(lorentz.unit_scene(2, radius), [0.5, math.nextafter(radius, 0)], [1, 2**-60])
    assert grazing.decision == "meeting" and grazing.decided and grazing.obstacle == (0, 0, (1, 0))
    assert 0 < grazing.margin < 2
    assert oracle.margin(lorentz.unit_scene(2, radius), [0, 0.5], [1, 0]).margin is None
    easy = oracle.margin(lorentz.unit_scene(2, radius), [0.5, 0], [1, 0.1])
    assert easy.margin > 1e6


def test_what_was_passed():
    near = oracle.passed(lorentz.unit_scene(2, 0.1), [0, 0.445], [0.9998476951563913, 0.01745240643728351], most=3)
    assert len(near) == 3 and near[-1].obstacle == (0, 0, (27, 1)) and near[-1].gap < 0
    assert [one.time for one in near] == sorted(one.time for one in near) and near[0].gap > 0


def test_verdicts():
    scene, x, v = lorentz.unit_scene(2, 0.1), [0, 0.445], [1, 0.0175]
    exact = oracle.first_hit(scene, x, v)
    assert lorentz.judge_answer(scene, x, v, exact).verdict == "agree"
    a_few_ulps = replace(exact, time=exact.time + 3 * math.ulp(exact.time))
    verdict = lorentz.judge_answer(scene, x, v, a_few_ulps)
    assert (verdict.verdict, verdict.ulps, verdict.wrong_time) == ("agree", 3, False)
    assert lorentz.judge_answer(scene, x, v, a_few_ulps, ulps=0).wrong_time
    single = replace(exact, time=float(np.nextafter(np.float32(exact.time), np.float32(0))))
    assert lorentz.judge_answer(scene, x, v, single).wrong_time
    assert not lorentz.judge_answer(scene, x, v, single, precision="binary32").wrong_time
    assert not lorentz.judge_answer(scene, x, v, single, time_tolerance=1e-6).wrong_time
    assert not lorentz.judge_answer(scene, x, v, replace(exact, time=17), time_tolerance=math.inf).wrong_time
    for claim in ({"precision": "float"}, {"time_tolerance": -1}, {"time_tolerance": math.nan}):
        with pytest.raises(lorentz.Error):
            lorentz.judge_answer(scene, x, v, exact, **claim)
    another = lorentz.judge_answer(scene, x, v, lorentz.hit(exact.time + 5, (exact.cell[0] + 5, 1)))
    assert another.verdict == "wrong" and another.departs > 4 and another.cause is not None
    assert lorentz.judge_answer(scene, x, v, lorentz.never()).cause == "never-for-hit"
    assert lorentz.judge_answer(scene, x, v, lorentz.undecided()).verdict == "undecided"
    assert lorentz.judge_answer(scene, x, v, lorentz.unsupported("too hot")).verdict == "unsupported"


def test_starts_inside_by_other_rules():
    scene = lorentz.unit_scene(2, 0.25)
    rules = {"inside": lorentz.inside((0, 0)), "miss": lorentz.hit(0.75, (1, 0)),
             "zero": lorentz.hit(0, (0, 0)), "exit": lorentz.hit(0.25, (0, 0))}
    for rule in rules:
        for other, answer in rules.items():
            verdict = lorentz.judge_answer(scene, [0, 0], [1, 0], answer, starts_inside=rule)
            assert (verdict.verdict == "agree" and not verdict.wrong_time) == (rule == other), (rule, other)
    with pytest.raises(lorentz.Error, match="starts_inside"):
        lorentz.judge_answer(scene, [0, 0], [1, 0], rules["miss"], starts_inside="behind")


def test_a_declared_domain():
    report = lorentz.judge("reduction", questions=2, domain={"speed": (1e-3, 1e3), "shapes": ["ball"]})
    assert report["outside_domain"] > 0 and report["domain"] == "speed=0.001..1000,shape=ball"
    for bad in ({"sped": (0, 1)}, {"speed": (2, 1)}, {"speed": 1}, {"shapes": ["box"]}, {"speed": (0, math.inf)}, 3):
        with pytest.raises(lorentz.Error, match="domain"):
            lorentz.judge("reduction", questions=1, domain=bad)


@pytest.mark.parametrize("name", ["square", "cubic", "ellipsoid", "grating", "impurity"])
def test_certificates_prove_and_refute(name):
    scene = lorentz.Scene(name)
    x, v, _ = lorentz.draw_starts(scene, 20, seed=SEED)
    for i in range(len(x)):
        exact = oracle.first_hit(scene, x[i], v[i], digits=40)
        if exact.outcome == "never":
            assert oracle.check(scene, x[i], v[i], exact, oracle.certificate(scene, x[i], v[i])) is None
            continue
        proof = oracle.certificate(scene, x[i], v[i])
        assert oracle.check(scene, x[i], v[i], exact, proof) is None
        again = lorentz.Certificate.from_dict(proof.to_dict(), scene.dimension)
        assert again.to_dict() == proof.to_dict() and oracle.check(scene, x[i], v[i], exact, again) is None
        later = replace(exact, time=math.nextafter(exact.time, math.inf), time_decimal=None)
        assert oracle.check(scene, x[i], v[i], later, proof)
        other = replace(exact, cell=(exact.cell[0] + 1, *exact.cell[1:])) if exact.cell else lorentz.never()
        assert oracle.check(scene, x[i], v[i], other, proof)
    with pytest.raises(lorentz.Error, match="neither windows nor rows"):
        lorentz.Certificate.from_dict({}, 2)
    with pytest.raises(lorentz.Error, match="basis"):
        lorentz.Certificate.from_dict({"rows": [{"lattice": 0, "atom": 0, "basis": [[1], [0]]}]}, 2)


def test_a_proof_that_is_too_long_is_told():
    """The balls that could contain x first are 400 cells large: more than a checker looks at."""
    scene = lorentz.unit_scene(3, 400)
    assert oracle.first_hit(scene, [0.5, 0.5, 0.5], [1, 0.3, 0.2]).outcome == "inside"
    with pytest.raises(lorentz.Error, match="no checker goes through the proof: .* more than 1000000 steps"):
        oracle.certificate(scene, [0.5, 0.5, 0.5], [1, 0.3, 0.2])


def test_convergents_are_exact():
    random = np.random.default_rng(SEED)
    for rise, run in random.uniform(-3, 3, (50, 2)).tolist() + [[0.1, 1.0], [-7.5, 2.0]]:
        slope, steps = Fraction(rise) / Fraction(run), oracle.convergents(rise, run)
        assert Fraction(steps[-1].p, steps[-1].q) == slope and steps[-1].remainder == 0
        for step in steps:
            assert step.remainder == step.q * slope - step.p
        value = Fraction(steps[-1].a)
        for step in reversed(steps[:-1]):
            value = step.a + 1 / value
        assert value == slope
    assert len(oracle.convergents(0.1, 1.0, 3)) == 3
    with pytest.raises(lorentz.Error, match="run"):
        oracle.convergents(1.0, 0.0)


@pytest.mark.parametrize("query, text", [
    (dict(x=[0, 0], v=[0, 0]), "v"),
    (dict(x=[0, math.inf], v=[1, 0]), "finite"),
    (dict(x=[0, 0, 0], v=[1, 0]), "x: has 3 components|dimension"),
    (dict(x=[0, 0], v=[1, 0], start_from=(0, 5, (0, 0))), "atom"),
    (dict(x=[0, "a half"], v=[1, 0]), "a half"),
])
def test_what_is_no_query(query, text):
    with pytest.raises(lorentz.Error, match=text):
        oracle.first_hit("square", **query)


@pytest.mark.parametrize("x, v, when", [([0.5, 0], [1, 0], Fraction(1, 4)), (["1/3", 0], [1, 0], Fraction(5, 12))])
def test_a_time_limit(x, v, when):
    scene = lorentz.unit_scene(2, 0.25)
    assert oracle.first_hit(scene, x, v).exact_time.fraction() == when
    for limit, outcome in [(when, "later"), (float(when) * 0.999, "later"), (float(when) * 1.001, "hit")]:
        assert oracle.first_hit(scene, x, v, max_time=limit).outcome == outcome, limit
    assert oracle.first_hit(scene, x, v, max_time=np.inf).outcome == "hit"


def test_a_time_limit_between_floats():
    scene = lorentz.unit_scene(2, 0.25)
    x, v, third = [0.5, 0.0], [0.75, 0.0], Fraction(1, 3)  # enters at 1/3, which no float is
    assert oracle.first_hit(scene, x, v).exact_time.fraction() == third
    for limit, outcome in [(third, "later"), (third + Fraction(1, 10**30), "hit"), (float(third), "later"),
                           (math.nextafter(third, 1), "hit"), ("1/3", "later")]:
        assert oracle.first_hit(scene, x, v, max_time=limit).outcome == outcome, limit


def test_a_time_in_decimal_is_checked():
    scene, x, v = lorentz.unit_scene(2, 0.25), [0.5, 0.375], [1, 1]
    answer, proof = oracle.first_hit(scene, x, v, digits=40), oracle.certificate(scene, x, v)
    assert answer.time_decimal and oracle.check(scene, x, v, answer, proof) is None
    nearly = answer.time_decimal[:-1] + str((int(answer.time_decimal[-1]) + 1) % 10)
    for wrong in ("9.9", nearly, "", "x"):
        assert "decimal" in oracle.check(scene, x, v, replace(answer, time_decimal=wrong), proof), wrong


def test_digits_are_as_many_as_asked_for_whatever_the_numbers_are():
    scene = lorentz.unit_scene(2, 0.25)
    for x, v in [([0.5, 0.375], [1, 0.9]), (["1/3", "0.4"], [1, "9/10"]), ([0.5, 0.375], ["sqrt(2)", "golden"]),
                 ([0.5, 0.375], [3e6, 1e6]), (["0.50000000000000000001", "0.4"], ["3e6", "1e6"])]:
        texts = [oracle.first_hit(scene, x, v, digits=digits).time_decimal for digits in (1, 5, 16, 40)]
        assert [len(text.partition("e")[0].replace(".", "").lstrip("0")) for text in texts] == [1, 5, 16, 40]
        assert all(abs(Fraction(text) / Fraction(texts[3]) - 1) < Fraction(1, 2 * 10**(digits - 1))
                   for text, digits in zip(texts, (1, 5, 16)))
    midway = oracle.first_hit(scene, ["0.500000000000000000125", 0], [1, 0], digits=20)  # 0.249999999999999999875
    assert midway.time_decimal == "0.24999999999999999988"  # the even one
    floats, rationals = (oracle.first_hit(scene, x, [2.0**21, 0.5], digits=3) for x in ([0.5, 0], [0.5, "0." + 400 * "0" + "1"]))
    assert floats.time_decimal == rationals.time_decimal == "0.000000119"


def test_a_time_beyond_floats():
    scene = lorentz.unit_scene(2, 0.25)
    assert oracle.first_hit(scene, ["1/2", "1/2"], ["1e-400", "1e-400"]).time == math.inf
    assert float(oracle.first_hit(scene, [0.5, 0.4], [5e-324, 5e-324]).exact_time) == math.inf


def test_numbers_of_every_type_are_what_they_are():
    scene, v = lorentz.unit_scene(2, 0.25), [1, 0.3]
    tenth = oracle.first_hit(scene, [0.5, Fraction(1, 10)], v)
    for same in (Decimal("0.1"), "0.1", "1/10", "1e-1", np.str_("0.1")):
        assert oracle.first_hit(scene, [0.5, same], v) == tenth
    float_tenth = oracle.first_hit(scene, [0.5, 0.1], v)
    assert float_tenth != tenth
    for same in (np.float64(0.1), Decimal(0.1), Fraction(0.1), (0.1).hex(), np.longdouble(0.1)):
        assert oracle.first_hit(scene, [0.5, same], v) == float_tenth
    third = np.longdouble(1) / 3
    assert oracle.first_hit(scene, [0.5, third], v) == oracle.first_hit(scene, [0.5, Fraction(*third.as_integer_ratio())], v)


def with_roots(seed):
    draw = np.random.default_rng(seed)
    return [round(float(c), 6) for c in draw.uniform(0.4, 0.6, 2)], [1, draw.choice(["golden", "sqrt(2)", "-sqrt(3)"])]


def test_times_of_velocities_with_roots_are_rounded_once():
    for seed in range(60):
        x, v = with_roots(seed)
        answer = oracle.first_hit("square", x, v, digits=60)
        assert answer.time == float(Fraction(answer.time_decimal)) == oracle.first_hit("square", x, v).time, (x, v)
    for x in ([0.63557, 0.744592], [0.4, 0.55]):  # a root that is a whole number
        assert oracle.first_hit("square", x, [1, "sqrt(49)"]).time == oracle.first_hit("square", x, [1, 7]).time


def test_limits_of_velocities_with_roots_are_exact():
    for seed in range(60):
        x, v = with_roots(seed)
        exact = Fraction(oracle.first_hit("square", x, v, digits=60).time_decimal)
        nearest = float(exact)
        for limit in (math.nextafter(nearest, 0), nearest, math.nextafter(nearest, 9), exact + Fraction(1, 10**40)):
            outcome = oracle.first_hit("square", x, v, max_time=limit).outcome
            assert outcome == ("hit" if exact < limit else "later"), (x, v, limit)
    at = oracle.first_hit(lorentz.unit_scene(2, 0.25), [0.5, 0], ["sqrt(4)", 0], max_time=0.125)  # its very time
    assert at.outcome == "undecided"  # never "hit"


def test_times_have_as_many_digits_as_wanted():
    scene = lorentz.unit_scene(2, Fraction(1, 4))
    for limit in (None, "1/3"):
        assert oracle.first_hit(scene, ["1/2", 0], [1, 0], digits=10, max_time=limit).time_decimal == "0.2500000000"
    assert str(lorentz.ExactTime(Fraction(1, 4), Fraction(0)).decimal(4)) == "0.2500"
    assert lorentz.ExactTime(Fraction(0), Fraction(0)).decimal(4) == 0


ROW = {"dimension": 2, "lattices": [{"vectors": [[1, 0]], "atoms": [{"position": [0, 0], "radius": 0.25}]}]}
BALL = {"dimension": 2, "lattices": [{"vectors": [], "atoms": [{"position": [0, 0], "radius": 0.25}]}]}


@pytest.mark.parametrize("scene, v, cell", [(ROW, [0.375, -1], (1,)), (BALL, [-0.125, -1], ())])
def test_obstacles_of_rows_and_of_arrays_are_taken_everywhere(scene, v, cell):
    x = [0.25, 2.0]
    exact = oracle.first_hit(scene, x, v)
    assert exact.cell == cell
    limited = oracle.first_hit(scene, x, v, max_time="10/3")  # of numbers that are not all floats
    assert (limited.obstacle, limited.time) == (exact.obstacle, exact.time)
    path = lorentz.itinerary(scene, x, v, collisions=1, states=True)
    assert path.collisions[0].cell == cell and path.cell.shape == (1, 2)
    padded = lorentz.first_hit(scene, [x], [v])[0].obstacle
    assert padded == (0, 0, cell + (0,) * (2 - len(cell)))
    for obstacle in (padded, exact.obstacle):
        assert oracle.entry_time(scene, x, v, obstacle) == exact.exact_time
        assert oracle.first_hit(scene, x, v, start_from=obstacle).outcome == "never"
        assert oracle.margin(scene, x, v, start_from=obstacle).condition is None
        assert oracle.passed(scene, x, v, start_from=obstacle) == oracle.passed(scene, x, v, start_from=padded)
        assert lorentz.itinerary(scene, x, v, start_from=obstacle, collisions=1).end == "never"
        proof = oracle.certificate(scene, x, v, start_from=obstacle)
        assert oracle.check(scene, x, v, lorentz.never(), proof, start_from=obstacle) is None
    with pytest.raises(lorentz.Error, match="cell"):
        oracle.first_hit(scene, x, v, start_from=(0, 0, (1, 1)))


def test_an_entry_time_has_the_scenes_dimension():
    for x, v, name in (([0.5, 0.45, 9], [1, 0.3], "x"), ([0.5, 0.45], [1, 0.3, 5], "v"), ([0.5], [1, 0.3], "x")):
        with pytest.raises(lorentz.Error, match=f"^{name}: has {len(x if name == 'x' else v)} components, needs 2"):
            oracle.entry_time("square", x, v, (0, 0, (2, 1)))
    with pytest.raises(lorentz.Error, match="^x: "):
        oracle.entry_time("square", [math.nan, 0], [1, 0.3], (0, 0, (2, 1)))


def test_texts_may_have_a_plus_sign():
    assert oracle.first_hit("square", ["+0.5", ".45"], [1, "+0x1p-2"]) == oracle.first_hit("square", [0.5, ".45"], [1, 0.25])
    scene = lorentz.Scene(ROW, "+0.25")
    assert scene.is_binary64 and scene == lorentz.Scene(ROW)
