"""The command `lorentz`, if the package contains the program."""

import os
import sys
from pathlib import Path


def main() -> None:
    """Replaces this process by the program."""
    program = Path(__file__).resolve().parent / "bin" / "lorentz"
    os.execv(program, ["lorentz", *sys.argv[1:]])
