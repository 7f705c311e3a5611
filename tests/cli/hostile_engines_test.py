"""`fuzz` and `judge` keep their time, and say what is true, whatever an engine does.

usage: hostile_engines_test.py PROGRAM SOURCE [--table]

--table: all engines, and a table of how long each run took, instead of a test with a few of them.

An engine that hangs does so for days, so the limits of the test are generous: it fails if the time is not kept at all,
not if the machine is busy.
"""
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM, SOURCE = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
ENGINE = shlex.join([sys.executable, str(Path(__file__).with_name("hostile_engine.py")), SOURCE])
SECONDS = 4  # of each run
FAR_TOO_LONG = 120

ENGINES = {
    "starts never": "sleep 1000000",
    "hangs at the first question": f"{ENGINE} hangs",
    "hangs at the hundredth": f"{ENGINE} hangs 100",
    "deaf to SIGTERM, and hangs": f"{ENGINE} deaf-hangs 5",
    "floods its output": f"{ENGINE} floods 5",
    "writes a line without end": f"{ENGINE} floods-without-end 5",
    "floods its errors": f"{ENGINE} complains 5",
    "prints lines that are no answers": f"{ENGINE} prints",
    "dies at the fifth": f"{ENGINE} dies 5",
    "leaves a child with its pipes": f"{ENGINE} forks 5",
    "slow: 0.3 s each": f"{ENGINE} slow",
    "naive_engine.py": shlex.join([sys.executable, f"{SOURCE}/docs/examples/naive_engine.py"]),
}
FEW = ["starts never", "hangs at the hundredth", "floods its output", "slow: 0.3 s each"]


def run(words, engine, signal_after=None, seconds=SECONDS):
    """Seconds, status, output, errors. It is killed when it takes far too long."""
    environment = dict(os.environ, LORENTZ_DATA=f"{SOURCE}/data")
    begun = time.monotonic()
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        process = subprocess.Popen([PROGRAM, *words.split(), "-e", engine], stdout=out, stderr=err,
                                   env=environment, start_new_session=True)
        try:
            if signal_after is not None:
                time.sleep(signal_after)
                begun = time.monotonic()
                process.send_signal(signal.SIGTERM)
            process.wait(FAR_TOO_LONG)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        took = time.monotonic() - begun
        out.seek(0), err.seek(0)
        return took, process.returncode, out.read(), err.read()


def fuzz(engine, **more):
    return run(f"fuzz --scenes unit --time {SECONDS}", f"cmd:{engine}", **more)


def judge(engine, **more):
    return run(f"judge --quick --time {SECONDS}", f"cmd:{engine}", **more)


class Hostile(unittest.TestCase):
    def test_a_campaign_ends_in_its_time(self):
        for name in FEW:
            with self.subTest(name):
                took, status, out, err = fuzz(ENGINES[name])
                self.assertGreaterEqual(status, 0, f"killed after {took:.0f} s: {out}{err}")
                self.assertIn("smallest margin", out)
                self.assertNotIn("none of the first", err)
                asked = sum(int(row.split()[1]) for row in re.findall(r"^all .*", out, re.M))
                if asked == 0:
                    self.assertRegex(err, "no case was judged: |gave no answer in ")
                    self.assertEqual(status, 3)

    def test_a_campaign_without_an_answer_says_so(self):
        took, status, out, err = fuzz(ENGINES["starts never"])
        self.assertIn("no case was judged: the first were still being made or answered", err)
        self.assertIn("no findings", out)
        self.assertEqual(status, 3)

    def test_a_signal_ends_a_campaign(self):
        words = "fuzz --scenes unit --time 100000"
        took, status, out, err = run(words, f"cmd:{ENGINES['hangs at the hundredth']}", signal_after=15)
        self.assertGreaterEqual(status, 0, f"killed after {took:.0f} s: {out}{err}")
        self.assertIn("lorentz: terminated", err)
        self.assertIn("smallest margin", out)

    def test_a_verdict_comes_in_its_time(self):
        for name in FEW:
            with self.subTest(name):
                took, status, out, err = judge(ENGINES[name])
                self.assertGreaterEqual(status, 0, f"killed after {took:.0f} s: {out}{err}")
                self.assertIn("how bad: ", out)

    def test_a_slow_engine_is_not_broken(self):
        # Long enough for its start on a busy machine: without any answer in all of the time it would be broken.
        took, status, out, err = run("judge --quick --time 20", f"cmd:{ENGINES['slow: 0.3 s each']}")
        self.assertNotIn("\nbroken: ", out)


def table():
    for name, engine in ENGINES.items():
        for what in (fuzz, judge):
            took, status, out, err = what(engine)
            told = [line for line in err.splitlines() if line.startswith("lorentz: no ")]
            last = "; ".join(told) if what is fuzz else out.strip().splitlines()[-1] if out else err.strip()
            print(f"| {name} | {what.__name__} | {took:.1f} | {status} | {last[:150]} |", flush=True)


if __name__ == "__main__":
    if "--table" in sys.argv:
        table()
    else:
        unittest.main(argv=sys.argv[:1])
