"""workflows_test.py SOURCE PROGRAM: what the workflows and the action call is there, and the action judges an engine."""

import os
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import yaml

SOURCE = Path(sys.argv.pop(1)).resolve()
PROGRAM = Path(sys.argv.pop(1)).resolve()
ACTION = SOURCE / ".github/actions/judge-engine"
WORKFLOWS = sorted((SOURCE / ".github/workflows").glob("*.yml"))
QUICK = {"QUESTIONS": "2", "OPTIONS": "--domain dimension=2,shape=ball"}


def steps(of):
    """All steps of a workflow, or of an action."""
    jobs = of["jobs"].values() if "jobs" in of else [of["runs"]]
    return [step for job in jobs for step in job["steps"]]


def said(*command):
    return subprocess.run(command, cwd=SOURCE, check=True, capture_output=True, text=True).stdout


def commands(script):
    """The words of each command of a shell's script, roughly."""
    for line in script.replace("\\\n", " ").split("\n"):
        for part in re.split("&&", line):
            words = shlex.split(part, comments=True)
            if words:
                yield words


class Workflows(unittest.TestCase):
    def test_they_are_there_and_parse(self):
        self.assertEqual([path.name for path in WORKFLOWS], ["ci.yml", "release.yml"])
        for path in WORKFLOWS:
            flow = yaml.safe_load(path.read_text())
            self.assertIn(True, flow, "`on`, which YAML 1.1 takes for a boolean")
            for name, job in flow["jobs"].items():
                self.assertIn("runs-on", job, name)
                for need in [job.get("needs", [])] if isinstance(job.get("needs", []), str) else job.get("needs", []):
                    self.assertIn(need, flow["jobs"])

    def test_each_step_runs_or_uses_one_thing(self):
        for path in [*WORKFLOWS, ACTION / "action.yml"]:
            for step in steps(yaml.safe_load(path.read_text())):
                self.assertEqual(len({"run", "uses"} & step.keys()), 1, step)
                if "uses" in step:
                    self.assertRegex(step["uses"], r"^actions/[\w-]+@v\d+$")

    def test_what_they_call_exists(self):
        usage, help_of_all = said("./run", "--help"), said(PROGRAM, "--help")
        ours = 0
        for path in [*WORKFLOWS, ACTION / "action.yml"]:
            for step in steps(yaml.safe_load(path.read_text())):
                for words in commands(step.get("run", "")):
                    first = words[0]
                    if first == "./run":
                        self.assertRegex(usage, rf"(?m)^  {words[1]} ")
                    elif first.endswith("lorentz"):
                        self.assertRegex(help_of_all, rf"(?m)^  {words[1]} ")
                    elif "/" in first and not first.startswith(("here/", "$")):
                        self.assertTrue(os.access(SOURCE / first, os.X_OK), first)
                    else:
                        continue
                    ours += 1
        self.assertGreaterEqual(ours, 6)

    def test_ci_is_what_ci_run_does(self):
        flow = yaml.safe_load((SOURCE / ".github/workflows/ci.yml").read_text())
        (job,) = flow["jobs"].values()
        self.assertEqual(job["container"], "debian:12")
        self.assertIn(".ci/run", [step.get("run") for step in job["steps"]])

    def test_a_release_attaches_what_was_tried(self):
        jobs = yaml.safe_load((SOURCE / ".github/workflows/release.yml").read_text())["jobs"]
        self.assertEqual((jobs["try"]["needs"], jobs["attach"]["needs"]), ("build", "try"))
        self.assertEqual([name for name, job in jobs.items() if job.get("permissions") == {"contents": "write"}], ["attach"])
        parts = jobs["try"]["strategy"]["matrix"]["part"]
        self.assertEqual(sorted(step["if"].split("'")[1] for step in jobs["try"]["steps"] if "if" in step), sorted(parts))


class Run(unittest.TestCase):
    def test_nothing_is_built_for_help_or_a_slip(self):
        """What builds or installs is a stand-in that leaves a file."""
        with tempfile.TemporaryDirectory() as folder:
            called = Path(folder) / "called"
            for name in ("cmake", "dpkg-query", "apt-get", "sudo", "npm"):
                (Path(folder) / name).write_text(f"#!/bin/sh\ntouch {called}\nexit 1\n")
                (Path(folder) / name).chmod(0o755)

            def status(*words):
                environment = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
                return subprocess.run(["./run", *words], cwd=SOURCE, env=environment, stdin=subprocess.DEVNULL,
                                      capture_output=True).returncode

            for name in re.findall("(?m)^  ([a-z][a-z0-9-]*) ", said("./run", "--help")):
                self.assertEqual((status(name, "--help"), status(name, "--chek"), called.exists()), (0, 2, False), name)
            for words in (["install"], ["install", "nosuch.txt"], ["determinism", "--two", "x"], ["billion", "--rounds", "200"]):
                self.assertEqual((status(*words), called.exists()), (2, False), words)
            for words in (["paper", "--check"], ["paper", "--long"], ["billion"], ["determinism", "9"], ["league"], ["mutants"]):
                called.unlink(missing_ok=True)
                self.assertEqual((status(*words), called.exists()), (1, True), words)


class Action(unittest.TestCase):
    def test_inputs_go_to_the_script_and_options_exist(self):
        action, script = yaml.safe_load((ACTION / "action.yml").read_text()), (ACTION / "judge").read_text()
        step = next(step for step in steps(action) if "run" in step)
        self.assertEqual({value for value in step["env"].values()}, {f"${{{{ inputs.{name} }}}}" for name in action["inputs"]})
        for name in step["env"]:
            self.assertRegex(script, rf"\${{?{name}\b")
        options = said(PROGRAM, "judge", "--help")
        called = re.search(r"lorentz\" judge .*?>", script, re.DOTALL)[0]
        found = re.findall(r"--[\w-]+", called)
        self.assertIn("--junit", found)
        for option in found:
            self.assertRegex(options, rf"{option}\b")

    def judge(self, folder, **inputs):
        """The script, with a wheel that has nothing but a command, which calls this build's program."""
        wheel = folder / "lorentz-0-py3-none-any.whl"
        with zipfile.ZipFile(wheel, "w") as archive:
            info = "lorentz-0.dist-info"
            archive.writestr("lorentz_stand_in.py", f"import os, sys\ndef main():\n    os.execv({str(PROGRAM)!r}, sys.argv)\n")
            archive.writestr(f"{info}/METADATA", "Metadata-Version: 2.1\nName: lorentz\nVersion: 0\n")
            archive.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
            archive.writestr(f"{info}/entry_points.txt", "[console_scripts]\nlorentz = lorentz_stand_in:main\n")
            archive.writestr(f"{info}/RECORD", "")
        inputs = {"ENGINE": "reduction", "BASELINE": "", "WHEEL": str(wheel), **QUICK, **inputs}
        return subprocess.run([ACTION / "judge", folder / "judged"], env={**os.environ, **inputs}, cwd=folder, capture_output=True,
                              text=True)

    def test_it_judges(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            page = subprocess.run([PROGRAM, "flights", "--count", "100", "--html", folder / "page"], capture_output=True, text=True)
            if "without the page" in page.stderr:
                self.skipTest("this program has no page of reports; that of a wheel has it")
            done = self.judge(folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in ["judged.xml", "judged.txt", "judged.html"]:
                self.assertGreater((folder / "judged" / name).stat().st_size, 100, name)
            self.assertEqual(self.judge(folder, ENGINE="published").returncode, 1)
            done = self.judge(folder, ENGINE="published", BASELINE="known")
            self.assertEqual((done.returncode, (folder / "known").exists()), (2, False))
            self.assertIn("known is not there", done.stderr)
            subprocess.run([PROGRAM, "judge", "--engine", "published", "--questions", QUICK["QUESTIONS"], *QUICK["OPTIONS"].split(),
                            "--baseline", folder / "known"], capture_output=True)
            self.assertEqual(self.judge(folder, ENGINE="published", BASELINE="known").returncode, 0)

    def test_without_an_address_it_says_so(self):
        address = said("packaging/say_address", "--print").strip()
        with tempfile.TemporaryDirectory() as scratch:
            if not address:
                done = self.judge(Path(scratch), WHEEL="")
                self.assertEqual(done.returncode, 2)
                self.assertIn("packaging/address is empty", done.stderr)


if __name__ == "__main__":
    unittest.main()
