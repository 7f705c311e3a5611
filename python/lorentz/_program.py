"""The command `lorentz`, where the package has the program in it."""

import os
import sys
from pathlib import Path


def main() -> None:
    """Becomes the program."""
    program = Path(__file__).resolve().parent / "bin" / "lorentz"
    os.execv(program, ["lorentz", *sys.argv[1:]])
