"""Runs the commands in the documents, but for the tutorial, which has a test of its own: examples_test.py LORENTZ SOURCE

Each must begin to work: what is still at it after a moment is ended. Lines that it prints as JSON are read back.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import strict_json

LORENTZ, SOURCE = (Path(argument).resolve() for argument in (sys.argv.pop(1), sys.argv.pop(1)))
MOMENT = 0.5  # seconds
SCENE = '{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1]],"atoms":[{"position":[0,0],"radius":0.1}]}]}}\n'
QUERY = '{"id":1,"x":[0,0.445],"v":[1,0.0175]}\n'
ANSWER = '{"id":1,"outcome":"never"}\n'
FILES = {"F": SCENE + QUERY, "FILE": ANSWER, "queries.ndjson": SCENE + QUERY, "published.ndjson": ANSWER,
         "classical.ndjson": ANSWER, "start": '{"x":["1/2","1/10"],"v":[1,0]}\n',
         "mine": f"#!/bin/sh\nexec python3 {SOURCE}/docs/examples/naive_engine.py\n"}

MADE = {"queries.npy": "sample --scene cubic --radius 0.2 --count 9 --format npy",
        "answers.npy": "first-hit --scene cubic --radius 0.2 --format npy queries.npy",
        "before.json": "judge --questions 1 --engine published --json"}


def commands(text):
    """The commands of lorentz in the blocks of code, with the lines that go on."""
    for block in re.findall(r"^```\w*\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        lines = iter(block.split("\n"))
        for line in lines:
            command = line.removeprefix("$ ").strip()
            if not re.match(r"(build/)?lorentz |(echo|printf) .*\| (build/)?lorentz ", command):
                continue
            while command.endswith("\\"):
                command = command[:-1] + next(lines).strip().removeprefix("> ")
            if command.endswith("<< END"):
                for line in lines:
                    command += "\n" + line
                    if line == "END":
                        break
            if not re.search(r"\[-|\.\.\.|lorentz \d", command):  # a synopsis, or what it prints
                yield command


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.path, cls.number = Path(cls.folder.name), 0
        begun = cls.path / "begun"
        begun.mkdir()
        (begun / "build").symlink_to(LORENTZ.parent)
        for name in ("docs", "data"):
            (begun / name).symlink_to(SOURCE / name)
        (begun / "mine.so").symlink_to(LORENTZ.parent / "library_engine.so")
        for name, text in FILES.items():
            (begun / name).write_text(text)
        (begun / "mine").chmod(0o755)
        cls.environment = dict(os.environ, PATH=f"{LORENTZ.parent}:{os.environ['PATH']}")
        stores = ["fuzz", "--engine", "published", "--target", "published-faults,leaving", "--count", "99", "--store", "published.campaign"]
        subprocess.run([LORENTZ, *stores], cwd=begun, stdout=subprocess.DEVNULL, check=False)
        for name, command in MADE.items():
            with open(begun / name, "wb") as out:
                subprocess.run([LORENTZ, *command.split()], cwd=begun, stdout=out, stderr=subprocess.DEVNULL, check=False)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_for_a_moment(self, command):
        """Status and output, or None if it was still running. In a folder of its own: a process told to end may take a while."""
        self.number += 1
        path = self.path / str(self.number)
        shutil.copytree(self.path / "begun", path, symlinks=True)
        with open(path / "out", "wb") as out, open(path / "err", "wb") as err:
            process = subprocess.Popen(["sh", "-c", command], cwd=path, env=self.environment, stdin=subprocess.DEVNULL,
                                       stdout=out, stderr=err, start_new_session=True)
        try:
            status = process.wait(timeout=MOMENT)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGTERM)  # it ends the programs that it has started
            process.wait()
            return None
        return status, (path / "out").read_bytes(), (path / "err").read_bytes()

    def test_documents(self):
        number = 0
        for document in [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md"))]:
            if document.name == "tutorial.md":
                continue
            for command in commands(document.read_text()):
                number += 1
                with self.subTest(f"{document.name}: {command}"):
                    done = self.run_for_a_moment(command)
                    if done is None or b"without the page" in done[2]:
                        continue
                    status, out, err = done
                    self.assertIn(status, (0, 1), err.decode()[-500:])
                    if out.startswith(b"{"):
                        self.assertTrue(strict_json.read_lines(out))
        self.assertGreater(number, 20)


if __name__ == "__main__":
    unittest.main()
