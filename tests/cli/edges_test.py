"""The edges of every subcommand: help, mistakes, missing files, closed pipes, full disks, outputs that are inputs,
signals.

usage: edges_test.py PROGRAM SOURCE

Which subcommands there are is asked of the program; each must have a line in EDGES. A full disk is played by
/dev/full, and by a limit on the size of files.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it, and what it starts, too
PROGRAM, SOURCE = (str(Path(argument).resolve()) for argument in sys.argv[1:3])


@dataclass
class Edge:
    """What a subcommand is called with."""

    quick: str = ""  # done at once
    work: str = ""  # takes seconds: a signal comes in between. Empty: there is no such work
    outputs: list = field(default_factory=list)  # options that name files to be written
    missing: str = ""  # names /no/such/file as an input
    status: int = 0  # of quick
    prints: bool = True  # on standard output
    slow: bool = False  # quick is not quick: --help takes its place
    room: int = 20  # bytes on the full disk
    reports: bool = False  # a signal is a wish: what is done is reported, and files are written of it



def old_file(command, option):
    """A file of the kind that the option writes."""
    kinds = {"--csv": "x,old", "--html": "<!doctype html><html>old", "--junit": "<?xml version=\"1.0\"?><testsuites>old",
             "--disagreements": '{"scene":old', "--golden": '{"golden":old'}
    if option in ("-o", "--output"):
        return "<svg old" if command == "scene draw" else '{"golden":old'
    return kinds.get(option, "<svg old")


EDGES = {
    "first-hit": Edge("q.ndjson", "many.ndjson -e published-256", missing="/no/such/file"),
    "compare": Edge("--count 100 -e reduction", "--count 9 --disagreements OUT -e cmd:sleep${IFS}99", ["--disagreements", "--baseline", "--junit"],
                    "--queries /no/such/file"),
    "judge": Edge("-e reduction --questions 1", "-e published",
                  ["--html", "--golden", "--baseline", "--junit"],
                  "-e cmd:/no/such/file --time 2", reports=True),
    "convergents": Edge("0.5"),
    "horizon": Edge("square", missing="/no/such/file"),
    "sample": Edge("--count 5", "--count 1e9", missing="--scene /no/such/file"),
    "demo": Edge("", slow=True),
    "doctor": Edge("", slow=True),
    "bench": Edge("--scene square --radius 0.3 -e reduction --count 100 --difficulty drawn", "--count 1e6 --csv OUT",
                  ["--csv", "--html"], "--scene /no/such/file"),
    "scene show": Edge("square", missing="/no/such/file"),
    "scene draw": Edge("square", "", ["-o"], "/no/such/file"),
    "golden make": Edge("--set ties --count 5", "--set grazing --count 1e8 -o OUT", ["-o"]),
    "golden check": Edge("ties -e reduction --first 10", "-e oracle,walk,published-256", ["--disagreements", "--baseline", "--junit"],
                         missing="/no/such/file -e oracle"),
    "golden verify": Edge("bad-queries", "--walk", missing="/no/such/file"),
    "golden explain": Edge("9cbb135e set.ndjson", "", ["--svg", "--html"], "9cbb /no/such/file"),
    "golden list": Edge(),
    "fuzz": Edge("-e published -t published-faults --count 8 --keep 1 --mutate 0 --reword 0", "--time 600",
                 ["--store"], status=1),
    "fuzz show": Edge("1/published-faults/0 --store published.campaign", "", ["--svg", "--html"], "1 --store /no/such/file",
                      room=1000),
    "flights": Edge("--count 1e4", "--count 1e10 --csv OUT", ["--csv", "--html", "--store"],
                    "--scene /no/such/file", reports=True),
    "trajectory": Edge("--scene square --radius 1/3 --time 10 start",
                       "--scene square --radius 1/3 --collisions 1e7 --csv OUT start", ["--csv", "--svg"],
                       "--scene square --time 1 /no/such/file", reports=True),
    "lyapunov": Edge("--collisions 1e4 --radius 0.3", "--collisions 1e12", ["--csv", "--store"],
                     "--scene /no/such/file", reports=True),
    "diffusion": Edge("--count 1e3 --time 5 --radius 0.3", "--count 1e9 --csv OUT", ["--csv", "--store"],
                      "--scene /no/such/file", reports=True),
}

HAS_PAGE = True  # found out in prepare()
WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated", signal.SIGHUP: "hung up"}


class Folder:
    """A folder of its own for each subcommand, with what their lines name."""

    def __init__(self, made):
        self.path = Path(tempfile.mkdtemp(prefix="lorentz-edges-"))
        self.given = os.listdir(made)
        for name in self.given:
            if name.endswith(".campaign"):  # of which an example makes more
                shutil.copy(made / name, self.path / name)
            else:
                os.symlink(made / name, self.path / name)

    def new(self):
        """What was made here."""
        return sorted(set(os.listdir(self.path)) - set(self.given))

    def clear(self):
        for name in self.new():
            path = self.path / name  # what an example left behind may still go
            if path.is_dir():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)


@dataclass
class Ended:
    status: int
    out: str
    err: str


def start(words, folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, bytes_a_file=None):
    limit = ["prlimit", f"--fsize={bytes_a_file}"] if bytes_a_file else []
    return subprocess.Popen([*limit, PROGRAM, *words], cwd=folder, stdin=stdin, stdout=stdout,
                            stderr=subprocess.PIPE, text=True)


def ended(process):
    out, err = process.communicate(timeout=120)
    return Ended(process.returncode, out or "", err)


def lorentz(words, folder, **how):
    return ended(start(words, folder, **how))


def candidates(*words):
    """The subcommands that help lists."""
    out = subprocess.run([PROGRAM, *words, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return re.findall(r"^  ([\w-]+)", out.partition("Subcommands:\n")[2].split("\n\n")[0], re.M)


def usage(words):
    """What help says may follow a subcommand; empty if the words are not one (a scene, a set)."""
    before = f"Usage: lorentz {' '.join(words)} "
    lines = lorentz([*words, "--help"], "/").out.splitlines()
    return next((line[len(before):] for line in lines if line.startswith(before)), "")


def subcommands():
    """All that do something of their own, nested ones too."""
    found = []
    for name in candidates():
        if not usage([name]).endswith(" SUBCOMMAND"):
            found.append(name)
        found += [f"{name} {word}" for word in candidates(name) if usage([name, word])]
    return found


class Test:
    def __init__(self, name, made):
        self.name, self.words, self.edge = name, name.split(), EDGES[name]
        self.folder, self.failures, self.pairs = Folder(made), [], 0
        self.quick = self.words + (["--help"] if self.edge.slow else self.edge.quick.split())

    def check(self, good, what, run):
        if not good:
            state = f"status {run.status}, {self.folder.new()}, {run.err!r}"
            self.failures.append(f"lorentz {self.name}: {what}\n    {state}")

    def run(self, words, **how):
        self.folder.clear()
        return lorentz(words, self.folder.path, **how)

    def help_and_mistakes(self):
        run = self.run([*self.words, "--help"])
        self.check(run.status == 0 and "Example" in run.out, "help has no example", run)
        self.examples(run.out)
        same = self.run(["help", *self.words])
        self.check((same.status, same.out) == (0, run.out), "`lorentz help ..` says something else", same)
        run = self.run([*self.words, "--no-such-option"])
        named = f"no such option: --no-such-option; lorentz {self.name} --help has all"
        self.check(run.status == 2 and named in run.err, "an unknown option is not named", run)
        mistyped = self.words[-1][:-2] + self.words[-1][-1]
        run = self.run([*self.words[:-1], mistyped])
        if self.words[0] != "fuzz" or len(self.words) == 1:  # fuzz takes what follows for itself
            self.check(run.status == 2 and "did you mean" in run.err, f"{mistyped} gets no nearest name", run)
        if self.edge.missing:
            run = self.run(self.words + self.edge.missing.split())
            self.check(run.status == 3 and "/no/such/file" in run.err, "a missing file is not named", run)

    def examples(self, text):
        """Each begins to work: what is still at it after a moment is ended."""
        lines = text.partition("Example")[2].splitlines()
        lines = [line.strip() for line in lines if line.startswith("  ") and "lorentz" in line]
        environment = dict(os.environ, PATH=f"{Path(PROGRAM).parent}:{os.environ['PATH']}")
        for line in lines:
            self.folder.clear()
            process = subprocess.Popen(["sh", "-c", line], cwd=self.folder.path, stdin=subprocess.DEVNULL,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment,
                                       start_new_session=True)
            try:
                out, err = process.communicate(timeout=0.3)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                continue
            run = Ended(process.returncode, out, err)
            works = run.status in (0, 1) or ("--html" in line and not HAS_PAGE)
            self.check(works, f"the example does not work: {line}", run)

    def standard_output(self):
        run = self.run(self.quick)
        self.check(run.status == (0 if self.edge.slow else self.edge.status), "its short work fails", run)
        if not self.edge.prints:
            return
        with open("/dev/full", "w") as full:
            run = self.run(self.quick, stdout=full)
        self.check(run.status == 3 and "lorentz: standard output: No space left on device; free some" in run.err
                   and run.err.count("standard output") == 1, "a full disk is not said once", run)
        read, write = os.pipe()
        os.close(read)
        run = self.run(self.quick, stdout=write)
        os.close(write)
        quiet = run.status == -signal.SIGPIPE and "standard output" not in run.err
        self.check(quiet, "a closed pipe is not quiet", run)

    def without(self, option):
        """The short work, and no such option."""
        words = self.quick
        if option not in words:
            return words
        at = words.index(option)
        return words[:at] + words[at + 2:]

    def is_small(self, name):
        """OUT as it was, or as a store that holds nothing yet."""
        return name == "OUT" and (self.folder.path / name).stat().st_size <= 20

    def output_files(self):
        for option in self.edge.outputs:
            if option == "--html" and not HAS_PAGE:
                continue
            run = self.run(self.words + [option])
            good = run.status == 2 and ": needs a value, FILE; lorentz" in run.err
            self.check(good, f"{option} without a value", run)
            fresh = option in ("--store", "--baseline")  # must not be there
            self.folder.clear()
            old = old_file(self.name, option)
            if not fresh:
                (self.folder.path / "OUT").write_text(old)
            run = lorentz(self.without(option) + [option, "OUT"], self.folder.path, bytes_a_file=self.edge.room)
            self.check(run.status == 3 and "OUT" in run.err and ";" in run.err,
                       f"{option} on a full disk: what, and what to do?", run)
            if not fresh:
                self.check(self.folder.new() == ["OUT"] and (self.folder.path / "OUT").read_text() == old,
                           f"{option} on a full disk does not leave things as they were", run)
            left = [name for name in self.folder.new() if ".part" not in name and not self.is_small(name)
                    and (fresh or name != "OUT")]
            self.check(not left, f"{option} on a full disk leaves {left}", run)
            run = self.run(self.without(option) + [option, "/no/such/folder/f"])
            self.check(run.status == 3 and "/no/such/folder/f" in run.err and "make its folder first" in run.err
                       and not run.out, f"{option} into a missing folder is said late, or not well", run)

    def named_files(self):
        """The options that help says name files: the value's name says which."""
        options = []
        for line in lorentz([*self.words, "--help"], self.folder.path).out.splitlines():
            found = re.match(r"  (?:-\w,)?(--[\w-]+) (FILE|SCENE|SET|NAME=FILE)\b", line)
            if found and found[1] != "--set":  # the recipe of a set, no file
                options.append((found[1], found[2]))
        return options

    def outputs_that_are_inputs(self):
        """Each file that is read named as each that is written, in several ways: refused, and left as it is."""
        inputs = [(name, kind) for name, kind in self.named_files() if name not in self.outputs_in_full()]
        tried = 0
        for output in self.edge.outputs:
            for name, kind in inputs:
                for way in ("same", "./", "link", "hard link", "standard input"):
                    if way == "standard input" and kind != "FILE":
                        continue
                    tried += self.try_one_file_for(name, kind, output, way)
            self.folder.clear()
            (self.folder.path / "F").write_text("precious\n")
            words = ["F" if word == "square" else word for word in self.without(output)]
            for word in [word for word in words if (self.folder.path / word).is_file()]:  # what the short work reads
                before = (self.folder.path / word).read_bytes()
                run = lorentz([*words, output, f"./{word}"], self.folder.path)
                self.check(run.status == 2 and "name another file" in run.err and not run.out,
                           f"{output} over its input {word} is not refused", run)
                self.check((self.folder.path / word).read_bytes() == before, f"{output} overwrites {word}", run)
                tried += 1
        return tried

    def outputs_in_full(self):
        return ["--output" if name == "-o" else name for name in self.edge.outputs]

    def try_one_file_for(self, name, kind, output, way):
        self.folder.clear()
        file, other = self.folder.path / "F", self.folder.path / "G"
        file.write_text("precious\n")
        if way == "link":
            other.symlink_to("F")
        elif way == "hard link":
            os.link(file, other)
        named = {"same": "F", "./": "./F", "standard input": "F"}.get(way, "G")
        value = "-" if way == "standard input" else "a=F" if kind == "NAME=FILE" else "F"
        words = self.without(output)
        for option in (name, "--count" if name == "--queries" else name):  # which exclude each other
            if option in words:
                words = words[:words.index(option)] + words[words.index(option) + 2:]
        with open(file) as stdin:
            run = lorentz([*words, name, value, output, named], self.folder.path, stdin=stdin)
        full = dict(zip(self.edge.outputs, self.outputs_in_full()))[output]
        good = run.status == 2 and f"{full}: " in run.err and f"what {name} reads" in run.err and not run.out
        self.check(good, f"{name} {value} {output} {named} ({way}) is not refused", run)
        self.check(file.read_text() == "precious\n", f"{name} {value} {output} {named} ({way}) loses the input", run)
        return 1

    def signals(self):
        if not self.edge.work:
            return
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            self.folder.clear()
            if "OUT" in self.edge.work:
                (self.folder.path / "OUT").write_text(old_file(self.name, self.edge.work.split()[self.edge.work.split().index("OUT") - 1]))
            process = start(self.words + self.edge.work.split(), self.folder.path)
            wait_for_handler(process, number)
            time.sleep(0.1)
            process.send_signal(number)
            run = ended(process)
            said = WORDS[number] in run.err
            good = run.status == -number and said
            good |= run.status == 3 and said and self.edge.reports  # what is done is said first
            good |= self.name == "fuzz" and run.status == 0 and said  # as the end of its time
            self.check(good, f"{signal.Signals(number).name} gets no clear end", run)
            left = [name for name in self.folder.new() if name != "OUT" and ".part" not in name]
            self.check(not left, f"{signal.Signals(number).name} leaves {left}", run)
            old = self.folder.path / "OUT"
            self.check(not old.exists() or old.read_text().endswith("old") or (self.edge.reports and run.status == 3),
                       f"{signal.Signals(number).name} changes OUT", run)

    def all(self):
        try:
            self.help_and_mistakes()
            self.standard_output()
            self.output_files()
            self.pairs = self.outputs_that_are_inputs()
            self.signals()
        finally:
            shutil.rmtree(self.folder.path)
        return self.failures


def wait_for_handler(process, number):
    """Until the program is so far that it catches the signal."""
    while process.poll() is None:
        status = Path(f"/proc/{process.pid}/status").read_text()
        caught = next(line for line in status.splitlines() if line.startswith("SigCgt:"))
        if int(caught.split()[1], 16) >> (number - 1) & 1:
            return
        time.sleep(0.005)


def prepare(made):
    """The files that the lines above and the examples of the help name."""
    global HAS_PAGE
    for name in ("data", "docs"):
        os.symlink(Path(SOURCE) / name, made / name)
    shutil.copy(Path(SOURCE) / "data" / "golden" / "near-rational.ndjson", made / "set.ndjson")
    (made / "start").write_text('{"x":["1/2","1/10"],"v":[1,0]}\n')
    for file, words in {
        "q.ndjson": "sample --count 1",
        "many.ndjson": "sample --count 50000",
        "queries.npy": "sample --count 10 --format npy",
        "campaign": f"fuzz {EDGES['fuzz'].quick} --store published.campaign",
    }.items():
        with open(made / file, "w") as out:
            run = subprocess.run([PROGRAM, *words.split()], cwd=made, stdout=out, stderr=subprocess.PIPE, text=True)
        assert run.returncode in (0, 1), (words, run)
    page = lorentz(["golden", "explain", "9cbb135e", "--html", "page"], made)
    HAS_PAGE = "without the page" not in page.err


def main():
    os.environ["LORENTZ_DATA"] = f"{SOURCE}/data"
    found = subcommands()
    missing = sorted(set(found) - set(EDGES))
    if missing or len(found) < 20:
        sys.exit(f"the program has {len(found)} subcommands, and {missing} have no line in EDGES of this test")
    made = Path(tempfile.mkdtemp(prefix="lorentz-edges-"))
    try:
        prepare(made)
        with ThreadPoolExecutor(2) as pool:
            tests = [Test(name, made) for name in found]
            failures = sum(pool.map(Test.all, tests), [])
    finally:
        shutil.rmtree(made)
    pairs = sum(test.pairs for test in tests)
    if pairs < 100:
        failures.append(f"only {pairs} pairs of input and output were tried")
    print("\n".join(failures))
    print(f"{len(found)} subcommands, {pairs} pairs of input and output, {len(failures)} failures"
          f"{'' if HAS_PAGE else ' (--html not tried: no page)'}")
    sys.exit(1 if failures else 0)


main()
