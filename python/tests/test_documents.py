"""What documents show of Python is what Python says."""

import contextlib
import doctest
import io
import re
from pathlib import Path

import lorentz
import matplotlib

matplotlib.use("Agg")
DOCUMENTS = Path(__file__).parents[2] / "docs"


def blocks(name):
    return re.findall(r"^```\n(.*?)^```$", (DOCUMENTS / name).read_text(), re.M | re.S)


def printed_by(program):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(program, {})
    return out.getvalue()


def test_the_tutorial_of_physics():
    programs = [(one, after) for one, after in zip(blocks("tutorial_physics.md"), blocks("tutorial_physics.md")[1:])
                if one.startswith("import lorentz")]
    assert len(programs) == 1
    for program, shown in programs:
        assert printed_by(program) == shown


def test_examples_of_the_package():
    text = "\n".join(block for block in blocks("python.md") if block.startswith(">>> "))
    test = doctest.DocTestParser().get_doctest(text, {"lorentz": lorentz}, "python.md", None, 0)
    assert len(test.examples) >= 4 and doctest.DocTestRunner().run(test).failed == 0
    programs = [block for block in blocks("python.md") if block.startswith("import lorentz\n")]
    assert [printed_by(program).startswith("Answers to 1000000 queries in 2D: ") for program in programs] == [True]


def test_fragments_that_print_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    fragments = [block for block in blocks("python.md") if block.startswith(("runs = ", "try:\n"))]
    found = {"lorentz": lorentz}
    for fragment in fragments:
        exec(fragment, found)
    assert len(found["runs"]) == len(found["rows"]) == 3 and (tmp_path / "density.png").stat().st_size > 10_000
