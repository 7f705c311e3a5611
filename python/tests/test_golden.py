"""Golden sets as iterables: every record's answer is the oracle's, and its certificate proves it."""

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


def test_questions_that_are_none():
    records = list(lorentz.golden("bad-queries"))
    assert records and all(r.answer.outcome == "error" for r in records)
    assert all((r.x is None) == (r.flaw is not None) for r in records) and any(r.flaw for r in records)
    assert all(r.question.startswith('"') for r in records)


def test_two_readers_at_once():
    records = lorentz.golden("ties")
    assert [(a.id, b.id) for a, b in zip(records, records)] == [(r.id, r.id) for r in records]


def test_no_such_set(tmp_path):
    with pytest.raises(lorentz.FileError, match="did you mean grazing"):
        lorentz.golden("grasing")
    broken = tmp_path / "broken.ndjson"
    broken.write_text('{"golden":{"format":1,"count":1,"tags":{}}}\n{"id":"a"}\n')
    with pytest.raises(lorentz.Error, match="broken.ndjson:2"):
        list(lorentz.golden(broken))
