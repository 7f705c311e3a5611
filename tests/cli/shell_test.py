"""The manual pages say what --help says.

usage: shell_test.py PROGRAM SOURCE
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])


def plain(page):
    """A page without roff's escapes."""
    return re.sub(r"\\f[BIR]|\\&", "", page).replace("\\-", "-").replace("\\e", "\\")


def page_failures(page):
    """Options and subcommands of --help that the page has not, and what the formatters say of it."""
    words = page.stem.split("-", 1)[1] if "-" in page.stem else ""
    for group in ("scene", "golden", "fuzz"):
        words = words.replace(f"{group}-", f"{group} ")
    text = plain(page.read_text())
    asked = subprocess.run([PROGRAM, *words.split(), "--help"], stdout=subprocess.PIPE, text=True, check=True)
    help_text = asked.stdout
    subcommands = help_text.partition("Subcommands:")[2].split("\n\n")[0]
    names = re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_text, re.M)
    names += [f"{page.stem}-{name}" for name in re.findall(r"^  ([\w-]+)", subcommands, re.M)]
    names += [line.strip() for line in help_text.splitlines() if line.startswith("  lorentz ")]
    failures = [f"{page.name} has no {name}" for name in names if name not in text]
    prose = [plain(line) for line in page.read_text().splitlines() if not re.match(r"\.|\\fB|lorentz.* \\- ", line)]
    failures += [f"{page.name} has a long line: {line}" for line in prose if len(line) > 80 and not line.startswith("  ")]
    for formatter in (["groff", "-man", "-ww", "-z"], ["mandoc", "-T", "lint", "-W", "warning"]):
        if shutil.which(formatter[0]):
            run = subprocess.run([*formatter, page], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            failures += run.stdout.splitlines()
    return failures


def manual_failures(folder):
    subprocess.run([PROGRAM, "--manuals", folder / "man1"], check=True, env=dict(os.environ, SOURCE_DATE_EPOCH="0"))
    pages = sorted((folder / "man1").iterdir())
    assert len(pages) > 25 and all(page.suffix == ".1" for page in pages), pages
    first = (folder / "man1" / "lorentz.1").read_text()
    assert first.startswith('.TH LORENTZ 1 1970-01-01 "lorentz '), first[:60]
    return sum((page_failures(page) for page in pages), [])


def main():
    folder = Path(tempfile.mkdtemp(prefix="lorentz-shell-"))
    try:
        failures = manual_failures(folder)
    finally:
        shutil.rmtree(folder)
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
