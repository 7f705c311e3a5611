"""The tests: what runs each, and whether it passed. A test is asked with a mutant switched on, or with none."""

import dataclasses
import json
import os
import re
import resource
import signal
import subprocess

MEMORY = 6 << 30  # bytes that a test may take: a mutant may want more
KEPT_OUT = re.compile("planted bug|installed tree|The proof has passed|Campaigns find")  # slow, or about the tree itself


@dataclasses.dataclass(frozen=True)
class Test:
    name: str
    command: tuple
    folder: str
    environment: tuple = ()
    pattern: str = ""  # what the output must match, instead of the status


def of_ctest(build):
    listed = json.loads(subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, check=True).stdout)
    for test in listed["tests"]:
        properties = {p["name"]: p["value"] for p in test.get("properties", [])}
        if KEPT_OUT.search(test["name"]) or "command" not in test:
            continue
        yield Test(test["name"], tuple(test["command"]), properties.get("WORKING_DIRECTORY", str(build)),
                   tuple(properties.get("ENVIRONMENT", [])), "|".join(properties.get("PASS_REGULAR_EXPRESSION", [])))


def of_proof(tree):
    """Without what needs the proofs themselves, compiled."""
    for name in re.findall(r"(?m)^class (\w+)\(", (tree / "oracle" / "proof" / "checker_test.py").read_text()):
        if name != "WrongSpecifications":
            yield Test(f"oracle/proof/checker_test.py {name}", ("python3", "oracle/proof/checker_test.py", name), str(tree))


def of_python(tree, installed):
    for file in sorted((tree / "python" / "tests").glob("test_*.py")):
        yield Test(f"python/tests/{file.name}", ("/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", str(file)),
                   str(tree), (f"PYTHONPATH={installed}",))


class Timed(subprocess.Popen):
    """With the processor time of the process and of those that it has waited for."""

    seconds = 0.0

    def _try_wait(self, flags):
        try:
            pid, status, usage = os.wait4(self.pid, flags)
        except ChildProcessError:
            return self.pid, 0
        if pid == self.pid:
            self.seconds = usage.ru_utime + usage.ru_stime
        return pid, status


def ask(test, mutant=0, reached=None, seconds=600, wall=3600):
    """(passed, processor seconds, how it ended)."""
    environment = {**os.environ, **dict(pair.split("=", 1) for pair in test.environment), "LORENTZ_MUTANT": str(mutant)}
    if reached:
        environment["LORENTZ_REACHED"] = str(reached)

    def limits():  # and the signals as a terminal has them: a job in the background may ignore some
        for one in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
            signal.signal(one, signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    process = Timed(test.command, cwd=test.folder, env=environment, stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True, preexec_fn=limits)
    try:
        output, _ = process.communicate(timeout=wall)
        how = "red"
    except subprocess.TimeoutExpired:
        output, how = b"", "no end"
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()
    passed = how == "red" and (re.search(test.pattern, output.decode(errors="replace"), re.DOTALL) is not None
                               if test.pattern else process.returncode == 0)
    if process.returncode == -signal.SIGXCPU:
        how = "no end"
    return passed, process.seconds, how
