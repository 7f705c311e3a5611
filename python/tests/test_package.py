"""The package as such: what it costs to import, what it says of itself."""

import ast
import inspect
import os
import resource
import subprocess
import sys
from pathlib import Path

import lorentz
import pytest
from lorentz import _lorentz

FOLDER = Path(lorentz.__file__).parent


def seconds_of(code):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, "-c", code], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def test_import_takes_less_than_twice_as_long_as_that_of_numpy():
    pairs = [(seconds_of("import lorentz"), seconds_of("import numpy")) for _ in range(5)]
    assert min(ours for ours, _ in pairs) < 2 * min(numpys for _, numpys in pairs)


def test_import_does_not_import_matplotlib():
    code = ("import sys, lorentz; seen = lambda: 'matplotlib' in sys.modules; assert not seen(); "
            "lorentz.plot.scene('square'); assert seen()")
    subprocess.run([sys.executable, "-c", code], check=True)


def test_everything_public_is_there_and_says_what_it_is():
    for name in lorentz.__all__:
        thing = getattr(lorentz, name)
        if inspect.isclass(thing) or inspect.isfunction(thing) or inspect.ismodule(thing):
            assert inspect.getdoc(thing), name
    for name in lorentz.oracle.__all__ + lorentz.plot.__all__:
        module = lorentz.oracle if name in lorentz.oracle.__all__ else lorentz.plot
        assert inspect.getdoc(getattr(module, name)), name


def members(body):
    return {node.name for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))} | {
        node.target.id for node in body if isinstance(node, ast.AnnAssign)}


def test_the_stub_has_what_the_module_has():
    tree = ast.parse((FOLDER / "_lorentz.pyi").read_text())
    module = {name for name in vars(_lorentz) if not name.startswith("__")}
    assert members(tree.body) == module
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and node.body and node.name not in ("Error", "FileError"):
            own = {name for name in vars(getattr(_lorentz, node.name)) if not name.startswith("__")
                   and name != "_pybind11_conduit_v1_"}
            assert {name for name in members(node.body) if not name.startswith("__")} == own, node.name


def test_types(tmp_path):
    pytest.importorskip("mypy")
    assert (FOLDER / "py.typed").exists()
    config = Path(__file__).parents[2] / "pyproject.toml"
    mypy = [sys.executable, "-m", "mypy", "--config-file", config, "--cache-dir", tmp_path]
    examples = [config.parent / "docs" / "examples" / name for name in ("judge_your_engine.py", "paper_figures.py")]
    for checked in (["-p", "lorentz"], examples):
        result = subprocess.run([*mypy, *checked], cwd=FOLDER.parent, env=os.environ | {"MYPYPATH": str(FOLDER.parent)},
                                capture_output=True, text=True)
        assert result.returncode == 0, result.stdout + result.stderr
