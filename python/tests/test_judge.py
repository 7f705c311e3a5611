"""A function of Python as an engine, judged as every other one."""

import json
import signal
import threading
from pathlib import Path

import lorentz
import pytest
from lorentz import _lorentz

SHORT = 1.5  # seconds


class Certified:
    """The right answers, many at a time."""

    def __init__(self):
        self.engines = {}

    def __call__(self, scene, x, v, start_from):
        if id(scene) not in self.engines:
            self.engines = {id(scene): (scene, lorentz.Engine(scene, "certified-batch"))}
        none = (-1, 0, (0,) * scene.dimension)
        left = list(zip(*(none if one is None else one for one in start_from)))
        answers = self.engines[id(scene)][1].first_hit(x, v, start_from=left)
        return {name: getattr(answers, name) for name in ("outcome", "lattice", "atom", "cell", "time")}


def one_by_one(scene, x, v, start_from):
    return lorentz.oracle.first_hit(scene, x, v, start_from=start_from)


def test_a_right_function_is_right():
    report = lorentz.judge(one_by_one, time=SHORT)
    assert report["verdict"] == "right" and report["findings"] == []
    assert report["engine"] == "one_by_one" and report["queries"] > 200
    assert len(report["difficulties"]) > 20 and "right: no wrong answer" in report["text"]


def test_a_vectorized_function_is_the_same():
    report = lorentz.judge(Certified(), vectorized=True, time=SHORT)
    assert report["engine"] == "Certified" and report["queries"] > 200
    # Cells beyond 64 bits do not fit its columns: nothing else may be wrong.
    assert all(int(abs(max(map(int, f["exact"]["cell"]), key=abs))) >= 2**63 for f in report["findings"])


def test_a_wrong_function_is_found_out():
    def late(scene, x, v, start_from):
        answer = one_by_one(scene, x, v, start_from)
        return lorentz.hit(answer.time + 1, answer.cell, answer.lattice, answer.atom) if answer.outcome == "hit" else answer

    report = lorentz.judge(late, time=SHORT, name="too late")
    assert report["verdict"] == "wrong" and report["engine"] == "too late"
    assert {finding["cause"] for finding in report["findings"]} == {"other-quantity"}
    assert report["findings"][0]["commands"] == []  # no shell knows the function
    finding = report["findings"][0]
    given = lorentz.Answer.from_line(json.dumps(finding["given"]))
    verdict = lorentz.judge_answer(finding["scene"], finding["query"]["x"], finding["query"]["v"], given)
    assert verdict.cause == "other-quantity"


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


def test_what_is_no_answer():
    report = lorentz.judge(lambda *query: "a hit", time=SHORT, name="text")
    assert report["verdict"] == "wrong" and "str is no Answer" in report["findings"][0]["given"]["message"]
    few = lorentz.judge(lambda scene, x, v, start_from: [], vectorized=True, time=SHORT, name="few")
    assert "0 answers to 1 queries" in few["findings"][0]["given"]["message"]


def test_engines_by_name_and_threads():
    report = lorentz.judge("classical", time=SHORT)
    assert report["engine"] == "classical" and report["verdict"] in ("wrong", "right", "ill-posed")
    assert lorentz.judge(one_by_one, time=SHORT, threads=2)["verdict"] == "right"


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
    (dict(engine=one_by_one, time=-1), "time"),
    (dict(engine=one_by_one, threads=0), "threads"),
    (dict(engine=one_by_one, ulps=-1), "ulps"),
])
def test_bad_arguments(arguments, text):
    with pytest.raises(lorentz.Error, match=text):
        lorentz.judge(**arguments)


def test_the_example_is_short_and_runs():
    example = Path(__file__).parents[2] / "examples" / "judge_your_engine.py"
    lines = [line for line in example.read_text().splitlines() if line.strip()]
    assert len(lines) <= 20
    space = {"__name__": "example"}
    exec(compile(example.read_text(), str(example), "exec"), space)
    report = lorentz.judge(space["engine"], time=SHORT)
    assert report["verdict"] == "wrong" and report["unsupported"] > 0
