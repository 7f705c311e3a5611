"""Golden sets as iterables: every record's answer is the oracle's, and its certificate proves it."""

import pickle

import lorentz
import pytest


def test_the_sets():
    names = lorentz.golden_sets()
    assert {"near-rational", "grazing", "bad-queries", "ties"} <= set(names)
    assert len(lorentz.golden("near-rational")) == sum(1 for _ in lorentz.golden("near-rational"))


@pytest.mark.parametrize("name", ["grazing", "crystals", "never"])
def test_records(name):
    outcomes = set()
    for number, record in enumerate(lorentz.golden(name)):
        if number % 10:
            continue
        exact = lorentz.oracle.first_hit(record.scene, record.x, record.v, start_from=record.start_from, digits=40)
        assert (exact.outcome, exact.obstacle, exact.time) == (
            record.answer.outcome, record.answer.obstacle, record.answer.time)
        assert exact.time_decimal == record.answer.time_decimal
        assert lorentz.oracle.check(record.scene, record.x, record.v, record.answer, record.certificate,
                                    start_from=record.start_from) is None
        hardness = lorentz.oracle.margin(record.scene, record.x, record.v, start_from=record.start_from)
        assert (hardness.margin, hardness.condition) == (record.margin, record.condition)
        outcomes.add(record.answer.outcome)
    assert number > 100 and outcomes <= {"hit", "never", "inside"}


def test_what_errors_of_the_inputs_excuse():
    listed = [record for record in lorentz.golden("grazing") if record.acceptable]
    assert len(listed) > 20 and lorentz.golden("grazing").precision == "binary64"
    assert lorentz.golden("grazing-binary32").precision == "binary32"
    for record in listed[:20]:
        assert record.comment and record.source_id == "" and "needs-judge" not in record.tags
        for obstacle, ulps in record.acceptable:
            other = lorentz.Answer("never") if obstacle is None else lorentz.Answer("hit", *obstacle, record.answer.time)
            verdict = lorentz.oracle.judge_answer(record.scene, record.x, record.v, other, start_from=record.start_from,
                                                  ulps=16)
            assert verdict.verdict == "ill-posed" and verdict.departs == ulps, (record.id, obstacle, verdict)


def test_records_are_pickled_and_equal_themselves():
    for record in list(lorentz.golden("grazing"))[:5] + list(lorentz.golden("bad-queries"))[:3]:
        again = pickle.loads(pickle.dumps(record))
        assert again == record and again is not record
    first, second = list(lorentz.golden("grazing"))[:2]
    assert first != second and first.certificate != second.certificate


def test_questions_that_are_none():
    records = list(lorentz.golden("bad-queries"))
    assert records and all(r.answer.outcome == "error" for r in records)
    assert all((r.x is None) == (r.flaw is not None) for r in records) and any(r.flaw for r in records)
    assert all(r.question.startswith('"') for r in records)


def test_two_readers_at_once():
    records = lorentz.golden("ties")
    assert [(a.id, b.id) for a, b in zip(records, records)] == [(r.id, r.id) for r in records]


def test_no_such_set(tmp_path):
    with pytest.raises(lorentz.Error, match="did you mean grazing"):
        lorentz.golden("grasing")
    broken = tmp_path / "broken.ndjson"
    broken.write_text('{"golden":{"format":1,"count":1,"tags":{}}}\n{"id":"a"}\n')
    with pytest.raises(lorentz.Error, match="broken.ndjson:2"):
        list(lorentz.golden(broken))
