"""A function of Python as an engine, judged as every other one."""

import json
import signal
import threading
import time
from dataclasses import replace
from pathlib import Path

import lorentz
import numpy as np
import pytest
from lorentz import Outcome, _lorentz

SHORT = 1.5  # seconds


class Certified:
    """The right answers, many at a time."""

    def __init__(self):
        self.engines = {}

    def __call__(self, scene, x, v, start_from):
        if id(scene) not in self.engines:
            self.engines = {id(scene): (scene, lorentz.Engine(scene, "certified-batch"))}
        return self.engines[id(scene)][1].first_hit(x, v, start_from=start_from)


def one_by_one(scene, x, v, start_from):
    return lorentz.oracle.first_hit(scene, x, v, start_from=start_from)


def test_a_right_function_is_right():
    report = lorentz.judge(one_by_one, time=SHORT)
    assert report["verdict"] == "right" and report["findings"] == []
    assert report["engine"] == "one_by_one" and report["queries"] > 200
    assert len(report["difficulties"]) > 20 and "right: no wrong answer" in report["text"]


def test_the_largest_seed():
    report = lorentz.judge(one_by_one, questions=1, seed=2**64 - 1)
    assert int(report["manifest"]["seed"]) == 2**64 - 1


def test_a_vectorized_function_is_the_same():
    report = lorentz.judge(Certified(), vectorized=True, time=SHORT)
    assert report["engine"] == "Certified" and report["queries"] > 200
    assert report["verdict"] == "right" and report["findings"] == []


def test_a_wrong_function_is_found_out():
    def late(scene, x, v, start_from):
        answer = one_by_one(scene, x, v, start_from)
        return replace(answer, time=answer.time + 1) if answer.outcome == "hit" else answer

    assert lorentz.judge(late, time=SHORT)["verdict"] == "right"  # it names the right obstacles
    report = lorentz.judge(late, time=SHORT, name="too late", times=True)
    assert report["verdict"] == "wrong" and report["engine"] == "too late"
    assert report["wrong"] == 0 and report["wrong_time"] >= report["other_quantity"] > 0
    assert {finding["cause"] for finding in report["findings"]} <= {"not-the-time", "wrong-time"}
    assert report["findings"][0]["commands"] == []  # no shell knows the function
    finding = next(one for one in report["findings"] if one["cause"] == "not-the-time")
    given = lorentz.Answer.from_line(json.dumps(finding["given"]))
    verdict = lorentz.judge_answer(finding["scene"], finding["query"]["x"], finding["query"]["v"], given)
    assert (verdict.verdict, verdict.other_quantity, verdict.cause) == ("agree", True, "not-the-time")


def test_wrong_times_count_when_that_is_asked():
    def inexact(scene, x, v, start_from):
        answer = one_by_one(scene, x, v, start_from)
        return replace(answer, time=answer.time * (1 + 1e-9)) if answer.outcome == "hit" else answer

    lenient, strict = (lorentz.judge(inexact, time=SHORT, times=times) for times in (False, True))
    assert (lenient["verdict"], strict["verdict"]) == ("right", "wrong")
    assert strict["wrong_time"] > 100 and {finding["cause"] for finding in strict["findings"]} == {"wrong-time"}


@pytest.mark.parametrize("vectorized", [False, True])
def test_an_exception_is_an_error_of_that_query(vectorized):
    certified = Certified()

    def fragile(scene, x, v, start_from):
        if scene.dimension == 3:
            raise ZeroDivisionError("no third dimension")
        return certified(scene, x, v, start_from) if vectorized else one_by_one(scene, x, v, start_from)

    report = lorentz.judge(fragile, vectorized=vectorized, time=SHORT)
    assert report["verdict"] == "wrong" and report["error"] > 50
    refused = [finding for finding in report["findings"] if finding["cause"] == "refused"]
    assert refused and "ZeroDivisionError: no third dimension" in refused[0]["given"]["message"]
    assert all(row["error"] == 0 for row in report["difficulties"] if row["name"] == "drawn square")
    assert all(row["error"] == row["queries"] for row in report["difficulties"] if row["name"] == "drawn cubic")


def test_reasons_of_answers_reach_the_judge():
    """A query that an engine refuses as unsupported is not an error: neither in Answers nor in a dict of columns."""
    def arrays(scene, x, v, start_from, engine="batch"):
        return lorentz.first_hit(scene, x, v, start_from=start_from, engine=engine)

    def columns(scene, x, v, start_from):
        answers = arrays(scene, x, v, start_from)
        return {name: getattr(answers, name) for name in ("outcome", "lattice", "atom", "cell", "time", "reasons")}

    def published(scene, x, v, start_from):  # which does no ellipses
        return arrays(scene, x, v, start_from, engine="published-float")

    def names(scene, x, v, start_from):
        given = columns(scene, x, v, start_from)
        return given | {"outcome": [Outcome(code).name.lower() for code in given["outcome"]]}

    for function in (arrays, columns, names):
        report = lorentz.judge(function, vectorized=True, time=SHORT)
        assert report["verdict"] == lorentz.judge("batch", time=SHORT)["verdict"] == "right"
        assert report["unsupported"] > 0 and report["error"] == 0 and report["findings"] == []
    report = lorentz.judge(published, vectorized=True, time=SHORT, name="of a paper")
    assert report["unsupported"] > 0 and report["error"] == 0
    states = {row["name"]: row["state"] for row in report["difficulties"]}
    assert states["drawn square"] == "asked" and states["drawn ellipse"] in ("unsupported", "no time")


@pytest.mark.parametrize("vectorized", [False, True])
def test_first_hit_is_judged_as_its_engine_is(vectorized):
    """Its fourth parameter is a radius; start_from goes to it by name."""
    report = lorentz.judge(lorentz.first_hit, vectorized=vectorized, time=SHORT)
    own = lorentz.judge("certified-batch", time=SHORT)
    assert report["engine"] == "first_hit" and report["queries"] > 200
    assert report["verdict"] == own["verdict"] == "right" and report["findings"] == []
    assert report["error"] == report["unsupported"] == own["unsupported"] == 0


def test_of_many_only_the_guilty_queries_fail():
    certified = Certified()

    def fragile(scene, x, v, start_from):
        if (v[:, 0] < 0).any():
            raise ValueError("backwards")
        return certified(scene, x, v, start_from)

    report = lorentz.judge(fragile, vectorized=True, time=SHORT)
    drawn = [row for row in report["difficulties"] if row["name"].startswith("drawn")]
    errors, queries = (sum(row[key] for row in drawn) for key in ("error", "queries"))
    assert queries > 100 and 0.3 < errors / queries < 0.7  # half of all directions


def test_what_is_no_answer():
    report = lorentz.judge(lambda *query: "a hit", time=SHORT, name="text")
    assert report["verdict"] == "wrong" and "str is no Answer" in report["findings"][0]["given"]["message"]
    few = lorentz.judge(lambda scene, x, v, start_from: [], vectorized=True, time=SHORT, name="few")
    assert "0 answers to 1 queries" in few["findings"][0]["given"]["message"]
    two = lorentz.judge(lambda *query: {"outcome": [1, 1]}, time=SHORT, name="two")
    assert "2 answers to 1 query" in two["findings"][0]["given"]["message"]


def test_engines_by_name_and_threads():
    report = lorentz.judge("reduction", time=SHORT)
    assert report["engine"] == "reduction" and report["verdict"] == "right"
    assert lorentz.judge(one_by_one, time=SHORT, jobs=2)["verdict"] == "right"


def test_counted_questions_are_the_same_whatever_they_take():
    def slow(scene, x, v, start_from):
        time.sleep(0.002)
        return one_by_one(scene, x, v, start_from)

    counts = [[(row["name"], row["queries"], row["agree"], row["nonsense"]) for row in report["difficulties"]]
              for report in (lorentz.judge(one, questions=3, name="one") for one in (one_by_one, slow))]
    assert counts[0] == counts[1] and {queries for _, queries, _, _ in counts[0]} == {3}
    with pytest.raises(lorentz.Error, match="questions: not together with time"):
        lorentz.judge("reduction", questions=3, time=SHORT)


def test_an_interrupt_comes_through():
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        lorentz.judge(one_by_one, time=60)
    timer.join()
    assert lorentz.judge(one_by_one, time=SHORT)["verdict"] == "right"  # the name is free again


def test_the_page(tmp_path):
    page = tmp_path / "page.html"
    if _lorentz.HAS_PAGE:
        lorentz.judge(one_by_one, time=SHORT, html=page)
        assert "one_by_one" in page.read_text()
    else:
        with pytest.raises(lorentz.FileError):
            lorentz.judge(one_by_one, time=SHORT, html=page)
        assert not page.exists()


@pytest.mark.parametrize("arguments, text", [
    (dict(engine="clasical"), "did you mean classical"),
    (dict(engine=one_by_one, name="oracle"), "there already"),
    (dict(engine=lambda scene, x, v: None), "is called with scene, x, v, start_from"),
    (dict(engine=lambda scene, x, v, radius, *, start_from: None), "is called with scene, x, v, start_from"),
    (dict(engine=one_by_one, time=-1), "time"),
    (dict(engine=one_by_one, jobs=0), "jobs"),
    (dict(engine=one_by_one, ulps=-1), "ulps"),
])
def test_bad_arguments(arguments, text):
    with pytest.raises(lorentz.Error, match=text):
        lorentz.judge(**arguments)


def test_the_example_is_short_and_runs():
    example = Path(__file__).parents[2] / "docs" / "examples" / "judge_your_engine.py"
    lines = [line for line in example.read_text().splitlines() if line.strip()]
    assert len(lines) <= 20
    space = {"__name__": "example"}
    exec(compile(example.read_text(), str(example), "exec"), space)
    square, cubic = lorentz.unit_scene(2, 0.1), lorentz.unit_scene(3, 0.1)
    x, v = np.array([0.5, 0.42]), np.array([1.0, 0.3])
    answer, exact = space["engine"](square, x, v, None), lorentz.oracle.first_hit(square, x, v)
    assert answer.cell == exact.cell and abs(answer.time - exact.time) < 2e-3
    assert space["engine"](cubic, np.append(x, 0), np.append(v, 0), None).unsupported
    assert lorentz.judge_answer(square, x, v, answer).other_quantity  # its time is a step
