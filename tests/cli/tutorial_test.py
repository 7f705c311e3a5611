"""Runs the commands of a document, in order and as they stand, and compares what they print and draw.

usage: tutorial_test.py PROGRAM SOURCE DOCUMENT [--write]     --write: puts what they print into the document

They run in one shell, in a folder that has the project's build/, data/ and docs/examples/. What is printed must be
what the document shows, but for `..`, which stands for any number of lines; each picture that the document shows of
docs/gallery/ and that they draw must be the one that is there.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
DOCUMENT = SOURCE / "docs" / sys.argv[3]
GALLERY = SOURCE / "docs" / "gallery"
DONE_ALREADY = ["./run build"]  # before this test runs
MARK = "\x01"


def steps_of(lines):
    """(command, lines printed, first and last line of these) of each `$` in the fenced blocks."""
    steps, fenced, end, any_here = [], False, None, False
    for number, line in enumerate(lines):
        if line.startswith("```"):
            fenced, end, any_here = not fenced, None, False
        elif fenced and line.startswith("$ ") and end is None:
            steps.append([line[2:], [], number + 1])
            any_here = True
            heredoc = re.search(r"<< '(\w+)'$", line)
            end = heredoc[1] if heredoc else None
        elif fenced and end:
            steps[-1][0] += "\n" + line
            steps[-1][2] = number + 1
            end = None if line == end else end
        elif any_here:
            steps[-1][1].append(line)
    return steps


def run(commands):
    """What each prints, on both outputs, and its exit status; and the pictures that they drew."""
    folder = Path(tempfile.mkdtemp(prefix="lorentz-tutorial-"))
    try:
        for name in ("data", "docs"):
            os.symlink(SOURCE / name, folder / name)
        os.symlink(PROGRAM.parent, folder / "build")
        os.symlink(PROGRAM, folder / "lorentz")
        script = "\n".join(f"{command}\nprintf '{MARK}%s\\n' $?" for command in commands)
        environment = {key: value for key, value in os.environ.items() if not key.startswith("LORENTZ_")}
        environment["PATH"] = f"{folder}:{environment['PATH']}"
        done = subprocess.run(["bash", "--norc", "-c", script], cwd=folder, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment, timeout=3600)
        pictures = {path.name: path.read_bytes() for path in folder.glob("*.svg")}
    finally:
        shutil.rmtree(folder)
    parts = re.split(f"{MARK}(\\d+)\n", done.stdout)
    return [(text.splitlines(), int(status)) for text, status in zip(parts[0::2], parts[1::2])], pictures


def agree(shown, printed):
    """Whether the document's lines are those printed; `..` is any lines."""
    if not shown:
        return not printed
    if shown[0].strip() == "..":
        return any(agree(shown[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and shown[0].rstrip() == printed[0].rstrip() and agree(shown[1:], printed[1:])


def write(lines, steps, printed):
    for (_, shown, first), (text, _) in reversed(list(zip(steps, printed))):
        lines[first:first + len(shown)] = [line.rstrip() for line in text]
    DOCUMENT.write_text("\n".join(lines) + "\n")


def pictures_in(text):
    return re.findall(r"!\[[^\]]*\]\(gallery/(\S+\.svg)\)", text)


def main():
    lines = DOCUMENT.read_text().splitlines()
    steps = [step for step in steps_of(lines) if step[0] not in DONE_ALREADY]
    printed, drawn = run([command for command, _, _ in steps])
    shown_pictures = pictures_in("\n".join(lines))
    if len(printed) != len(steps) or len(steps) < 2:
        sys.exit(f"{len(printed)} of {len(steps)} commands ended; the last printed {printed[-1:]}")
    if "--write" in sys.argv:
        for name in shown_pictures:
            (GALLERY / name).write_bytes(drawn[name])
        return write(lines, steps, printed)
    failures = 0
    for name in shown_pictures:
        if drawn.get(name) != (GALLERY / name).read_bytes():
            failures += 1
            print(f"docs/gallery/{name} is not what the commands of docs/{sys.argv[3]} draw")
    for (command, shown, first), (text, status) in zip(steps, printed):
        good = status in (0, 1) and agree(shown, text)
        if not good:
            failures += 1
            print(f"docs/{sys.argv[3]}:{first}: {command}\nis shown to print\n" + "\n".join(shown))
            print(f"and prints (status {status})\n" + "\n".join(text))
    print(f"{len(steps)} commands, {len(shown_pictures)} pictures, {failures} failures")
    sys.exit(1 if failures else 0)


main()
