"""Work that a signal ends: what is whole is printed and written, the message says which signal it was,
nothing else stays; the second signal, half a second later, ends the program at once.

usage: signals_test.py PROGRAM SOURCE

No signal is sent after some time: each waits for something that the program shows, a progress bar on its
terminal, a line on its standard output, its second thread, or the time that it has computed.
"""

import json
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path

signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it, and what it starts, too
PROGRAM, SOURCE = (str(Path(argument).resolve()) for argument in sys.argv[1:3])
WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated", signal.SIGHUP: "hung up"}
START = '{"id":"a","x":["1/2","1/10"],"v":[1,0]}\n'


class Run:
    """The program with a terminal as its stderr, on which progress is drawn from the beginning."""

    def __init__(self, folder, words):
        self.err, self.out, self.changed = "", "", threading.Condition()
        self.terminal, its_end = pty.openpty()
        environment = dict(os.environ, LORENTZ_DATA=f"{SOURCE}/data", LORENTZ_PROGRESS_AFTER="0")
        self.process = subprocess.Popen([PROGRAM, *words.split()], cwd=folder, stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=its_end, env=environment)
        os.close(its_end)
        ends = {"err": self.terminal, "out": self.process.stdout.fileno()}
        self.readers = [threading.Thread(target=self.read, args=end) for end in ends.items()]
        for reader in self.readers:
            reader.start()

    def read(self, name, descriptor):
        while True:
            try:
                piece = os.read(descriptor, 1 << 16)
            except OSError:  # a terminal whose other end is closed
                piece = b""
            with self.changed:
                setattr(self, name, getattr(self, name) + piece.decode())
                self.changed.notify_all()
            if not piece:
                return

    def wait_for(self, seen):
        """Until `seen` of this run is true; looked at when something arrives, and now and then."""
        with self.changed:
            while not seen(self):
                if self.process.poll() is not None:
                    raise AssertionError(f"ended before, status {self.process.returncode}: {self.err}")
                self.changed.wait(0.02)

    def computed(self):
        """Seconds of the processor."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def threads(self):
        return len(os.listdir(f"/proc/{self.process.pid}/task"))

    def end(self, *numbers):
        for number in numbers:
            self.process.send_signal(number)
        self.process.wait(timeout=300)
        for reader in self.readers:
            reader.join()
        self.process.stdout.close()
        os.close(self.terminal)
        return self.process.returncode


def part_done(run):
    """The bar says that something is done."""
    return re.search(r"\] [1-9][0-9]* of", run.err)


class Signals(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="lorentz-signals-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def ended(self, words, seen, number, status=3):
        for file in self.folder.iterdir():
            file.unlink()
        (self.folder / "start").write_text(START)
        run = Run(self.folder, words)
        self.addCleanup(run.process.kill)  # of one that did not end
        try:
            run.wait_for(seen)
        finally:
            code = run.end(number)
        told = f"{words}: {signal.Signals(number).name}: {run.err}"
        self.assertEqual(code, status, told)
        self.assertIn(f"lorentz: {WORDS[number]}", run.err, told)
        self.assertEqual([file.name for file in self.folder.iterdir() if file.suffix == ".new"], [], told)
        return run

    def rows(self, name):
        text = (self.folder / name).read_text()
        self.assertTrue(text.endswith("\n"), text[-100:])
        return text.splitlines()

    def test_flights(self):
        for number in WORDS:
            words = "flights --radius 0.3 --count 1e11 --json --csv f.csv"
            run = self.ended(words, part_done, number)
            report = json.loads(run.out)
            self.assertGreater(report["mean"], 0)
            self.assertGreater(len(self.rows("f.csv")), 10)

    def test_flights_of_several_radii(self):
        run = self.ended("flights --radius 0.3,0.2 --count 1e6 --json --csv f.csv --engine oracle",
                         lambda run: "flying" in run.err and run.computed() > 0.05, signal.SIGTERM)
        self.assertEqual((self.folder / "f.csv").exists(), bool(run.out))

    def test_diffusion(self):
        for number in WORDS:
            run = self.ended("diffusion --radius 0.3 --count 1e7 --time 5 --csv d.csv", part_done, number)
            self.assertIn("interrupted: only the parts that were done", run.out)
            self.assertEqual(len({row.count(",") for row in self.rows("d.csv")}), 1)

    def test_diffusion_that_is_never_done(self):
        run = self.ended("diffusion --radius 0.3 --time 1e300 --jobs 2 --csv d.csv",
                         lambda run: run.threads() > 1 and run.computed() > 0.2, signal.SIGINT)
        self.assertIn("nothing to report", run.err)
        self.assertFalse((self.folder / "d.csv").exists())

    def test_lyapunov(self):
        for number in WORDS:
            run = self.ended("lyapunov --radius 0.3 --collisions 2e7 --json", part_done, number)
            self.assertFalse(json.loads(run.out)["whole"])

    def test_trajectory(self):
        for number in WORDS:
            words = "trajectory --scene square --radius 1/3 --collisions 1e7 --csv t.csv --svg t.svg start"
            run = self.ended(words, lambda run: run.out.count("\n") > 10, number)
            rows = self.rows("t.csv")
            self.assertGreaterEqual(len(rows) - 1, 10)
            self.assertEqual(len(rows) - 1, run.out.count("\n"))
            self.assertTrue((self.folder / "t.svg").read_text().endswith("</svg>\n"))

    def test_judge(self):
        for number in WORDS:
            begun = re.compile(r"\] ([5-9]|[0-9]{2,}) of")  # tenths of a second
            run = self.ended("judge -e published --json", lambda run: begun.search(run.err), number)
            self.assertGreater(json.loads(run.out)["queries"], 0)

    def test_the_second_signal_ends_it(self):
        run = Run(self.folder, "flights --radius 1e-9 --engine oracle --from surface --count 1e9")
        run.wait_for(lambda run: run.threads() > 1 and run.computed() > 0.2)
        run.process.send_signal(signal.SIGTERM)
        time.sleep(0.6)
        run.process.send_signal(signal.SIGINT)
        code = run.end()
        self.assertIn(code, (-signal.SIGINT, -signal.SIGTERM, 3))  # 3: all was done before the second came

    def test_what_is_sent_twice_at_once_is_one_wish(self):
        for number in WORDS:
            run = Run(self.folder, "flights --radius 0.3 --count 1e11 --json")
            self.addCleanup(run.process.kill)
            run.wait_for(part_done)
            self.assertEqual(run.end(number, number), 3, run.err)
            self.assertGreater(json.loads(run.out)["count"], 0)

    def test_what_is_ignored_stays_ignored(self):
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)  # as nohup does
        try:
            run = Run(self.folder, "flights --radius 0.3 --count 1e11 --json")
        finally:
            signal.signal(signal.SIGHUP, before)
        run.wait_for(part_done)
        run.process.send_signal(signal.SIGHUP)
        so_far = run.computed()
        run.wait_for(lambda run: run.computed() > so_far + 0.3)
        self.assertEqual(run.end(signal.SIGTERM), 3)
        self.assertIn("lorentz: terminated", run.err)

    def test_what_is_ignored_stays_ignored_with_a_program_as_engine(self):
        """By what the system knows of it: nothing has to be waited for that must not happen."""
        guest = Path(self.folder, "guest.sh")
        guest.write_text("#!/bin/sh\ntouch begun\nexec cat > /dev/null\n")
        guest.chmod(0o755)
        before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
        try:
            run = Run(self.folder, "compare --engine cmd:./guest.sh --count 10")
        finally:
            signal.signal(signal.SIGHUP, before)
        run.wait_for(lambda run: Path(self.folder, "begun").exists())
        status = Path(f"/proc/{run.process.pid}/status").read_text()
        ignored, caught = (int(re.search(f"^{of}:\\s*(.*)$", status, re.M)[1], 16) for of in ("SigIgn", "SigCgt"))
        self.assertTrue(ignored >> (signal.SIGHUP - 1) & 1)
        self.assertTrue(caught >> (signal.SIGTERM - 1) & 1)
        self.assertEqual(run.end(signal.SIGTERM), -signal.SIGTERM)

    def test_a_program_as_engine_ends_with_the_program(self):
        guest = Path(self.folder, "guest.sh")
        guest.write_text("#!/bin/sh\necho $$ > pid.new\nmv pid.new pid\nexec sleep 1000\n")
        guest.chmod(0o755)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            with self.subTest(number.name):
                pid = Path(self.folder, "pid")
                pid.unlink(missing_ok=True)
                run = Run(self.folder, "compare --engine cmd:./guest.sh --count 10")
                run.wait_for(lambda run: pid.exists())
                its = Path("/proc", pid.read_text().strip())
                run.wait_for(lambda run: (its / "comm").read_text() == "sleep\n")
                self.assertEqual(run.end(number), -number)
                while its.exists() and "(zombie)" not in (its / "status").read_text():
                    time.sleep(0.01)  # ends when the guest does, or CTest ends it


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
