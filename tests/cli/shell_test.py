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
    return re.sub(r"\\f[BIR]|\\[,/&]", "", page).replace("\\-", "-").replace("\\e", "\\")


def page_failures(page):
    """Options and subcommands of --help that the page has not, and what the formatter says of it."""
    words = page.stem.split("-", 1)[1] if "-" in page.stem else ""
    for group in ("scene", "golden", "fuzz"):
        words = words.replace(f"{group}-", f"{group} ")
    text = plain(page.read_text())
    help_text = subprocess.run([PROGRAM, *words.split(), "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    subcommands = help_text.partition("Subcommands:")[2].split("\n\n")[0]
    names = re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_text, re.M) + re.findall(r"^  ([\w-]+)", subcommands, re.M)
    names += [line.strip() for line in help_text.splitlines() if line.startswith("  lorentz ")] + ["LORENTZ_DATA"]
    failures = [f"{page.name} has no {name}" for name in names if name not in text]
    failures += [f"{page.name} has no page {page.stem}-{name}" for name in re.findall(r"^  ([\w-]+)", subcommands, re.M)
                 if not page.with_name(f"{page.stem}-{name}.1").exists()]
    if shutil.which("groff"):
        run = subprocess.run(["groff", "-man", "-ww", "-z", page], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        failures += run.stdout.splitlines()
    return failures


def manual_failures(folder):
    subprocess.run([SOURCE / "cli/manuals.sh", PROGRAM, "1.2.3", folder], check=True, env=dict(os.environ, SOURCE_DATE_EPOCH="0"))
    pages = sorted(folder.glob("*.1"))
    assert len(pages) > 20, pages
    first = (folder / "lorentz.1").read_text()
    assert '.TH LORENTZ "1" "January 1970" "lorentz 1.2.3"' in first, first[:200]
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
