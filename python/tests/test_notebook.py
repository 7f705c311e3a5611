"""The notebook of the first hour prints what it shows. Run as a program, this writes what it shows anew."""

import copy
import json
import os
import sys
import tempfile
from pathlib import Path
from unittest import mock

import lorentz
import pytest

for module in ("nbclient", "nbformat", "ipykernel", "matplotlib_inline"):
    pytest.importorskip(module, reason=f"{module} is missing: python/tests/packages.txt")

import nbclient
import nbformat

NOTEBOOK = Path(__file__).parents[2] / "docs" / "notebooks" / "first_hour.ipynb"
PACKAGE = Path(lorentz.__file__)


def run(notebook, folder):
    """Runs all cells in this folder, by this Python, with the package that this Python imports."""
    kernel = folder / "kernels" / "python3" / "kernel.json"
    kernel.parent.mkdir(parents=True)
    kernel.write_text(json.dumps({"argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
                                  "display_name": "Python 3", "language": "python"}))
    own = {"JUPYTER_PATH": folder, "JUPYTER_RUNTIME_DIR": folder, "JUPYTER_CONFIG_DIR": folder, "IPYTHONDIR": folder,
           "PYTHONPATH": os.pathsep.join([str(PACKAGE.parents[1]), os.environ.get("PYTHONPATH", "")]),
           "MPLBACKEND": "module://matplotlib_inline.backend_inline", "PYDEVD_DISABLE_FILE_VALIDATION": 1}
    with mock.patch.dict(os.environ, {name: str(value) for name, value in own.items()}):
        nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", record_timing=False,
                                resources={"metadata": {"path": str(folder)}}).execute()


def shown(cell):
    """What a cell prints, on stdout and stderr, and the number of its pictures."""
    texts = [(out.name, out.text) for out in cell.outputs if out.output_type == "stream"]
    return texts, sum("image/png" in out.get("data", {}) for out in cell.outputs)


def test_cells_print_what_they_show(tmp_path):
    stored = nbformat.read(NOTEBOOK, as_version=4)
    fresh = copy.deepcopy(stored)
    fresh.cells.append(nbformat.v4.new_code_cell("print(lorentz.__file__)"))
    run(fresh, tmp_path)
    assert shown(fresh.cells.pop()) == ([("stdout", f"{PACKAGE}\n")], 0)
    code = [(old, new) for old, new in zip(stored.cells, fresh.cells) if old.cell_type == "code"]
    for old, new in code:
        assert shown(new) == shown(old), old.source
        assert all(name == "stdout" for name, _ in shown(new)[0]), old.source
    assert sum(len(shown(old)[0]) for old, _ in code) >= 7 and sum(shown(old)[1] for old, _ in code) == 4


def test_the_file_is_small_and_valid():
    assert NOTEBOOK.stat().st_size < 300_000
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    assert [cell.execution_count for cell in notebook.cells if cell.cell_type == "code"] == list(
        range(1, 1 + sum(cell.cell_type == "code" for cell in notebook.cells)))


def main():
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        run(notebook, Path(folder))
    notebook.metadata.pop("language_info", None)  # of the Python that ran it
    nbformat.write(notebook, NOTEBOOK)


if __name__ == "__main__":
    main()
