"""Answers as docs/examples/naive_engine.py does, but for one thing, which comes at the Nth question (default: the first).

usage: hostile_engine.py SOURCE WHAT [N]
"""
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

WHAT, AT = sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 1
NAIVE = {}
exec((Path(sys.argv[1]) / "docs/examples/naive_engine.py").read_text().partition("\nlattices = None\n")[0], NAIVE)


def write(text):
    sys.stdout.write(text)
    sys.stdout.flush()


def hangs():
    time.sleep(1e6)


def floods():
    while True:
        write("a line that is no answer\n" * 1000)


def floods_without_end():
    while True:
        write("x" * 100_000)


def complains():
    while True:
        sys.stderr.write("what a question\n" * 1000)


def forks():
    subprocess.Popen(["sleep", "1000"])  # it holds the pipes
    os._exit(0)


ACTS = {"hangs": hangs, "floods": floods, "floods-without-end": floods_without_end, "complains": complains,
        "forks": forks, "dies": lambda: os._exit(3), "prints": lambda: write("a line that is no answer\n"),
        "slow": lambda: time.sleep(0.3)}
if WHAT.startswith("deaf"):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
if WHAT == "deaf-from-the-start":
    hangs()

lattices, questions = None, 0
for line in sys.stdin:
    item = json.loads(line)
    if "scene" in item:
        scene, d = item["scene"]["lattices"], item["scene"]["dimension"]
        mine = all(len(a["vectors"]) == d and all("radius" in b for b in a["atoms"]) for a in scene)
        lattices = [NAIVE["Lattice"](a) for a in scene] if mine else []
        continue
    questions += 1
    if questions == AT or (questions > AT and WHAT in ("prints", "slow")):
        ACTS[WHAT.removeprefix("deaf-")]()
    try:
        result = NAIVE["answer"](item, lattices)
    except Exception as error:
        result = {"outcome": "error", "message": repr(error)}
    write(json.dumps({"id": item.get("id")} | result) + "\n")
