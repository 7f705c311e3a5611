"""A round of the billion (run): it is kept and not run again, and engines that are wrong give status 1."""

import json
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
LORENTZ = sys.argv[1]
# A program that says what lorentz says, and adds one to a verdict of the first thing that is judged.
FAULTY = """#!/usr/bin/env python3
import json, subprocess, sys
done = subprocess.run([{lorentz!r}, *sys.argv[1:]], capture_output=True, text=True)
said = json.loads(done.stdout)
if sys.argv[1] == {command!r}:
    said[{places!r}][0][{verdict!r}] += 1
print(json.dumps(said))
sys.exit(done.returncode)
"""


def billion(folder, lorentz, *words):
    return subprocess.run([sys.executable, HERE / "run", "--folder", folder, "--lorentz", lorentz, "--jobs", "1",
                           "--scale", "0.0001", *words], capture_output=True, text=True, check=False)


def check(what, holds, done):
    if not holds:
        sys.exit(f"{what}\nstatus {done.returncode}\n{done.stdout}{done.stderr}")


def round_is_kept(folder):
    done = billion(folder, LORENTZ, "--rounds", "3")
    check("a round of a right engine passes", done.returncode == 0 and "0 wrong" in done.stdout, done)
    said = json.loads((folder / "round-03.json").read_text(encoding="utf-8"))
    for half in ("drawn", "families"):
        flights = said[half].pop("flights")
        check(f"{half}: each flight has one verdict", flights == sum(said[half].values()) > 100, done)
    done = billion(folder, "/bin/false", "--rounds", "3")
    check("a round that is kept is not run again", done.returncode == 0, done)


def faults_are_told(folder):
    for number, (command, places, verdict) in enumerate([
            ("compare", "engines", "wrong"), ("compare", "engines", "wrong_time"), ("fuzz", "targets", "error")]):
        program = folder / f"faulty-{number}"
        program.write_text(FAULTY.format(lorentz=LORENTZ, command=command, places=places, verdict=verdict),
                           encoding="utf-8")
        program.chmod(0o755)
        done = billion(folder / f"of-{number}", program, "--rounds", "3")
        check(f"{verdict} of {command} gives status 1", done.returncode == 1 and " wrong, " in done.stdout, done)


def broken_programs_end_it(folder):
    done = billion(folder / "broken", "/bin/false", "--rounds", "3")
    check("no JSON, no round", "status 1" in done.stderr and not list((folder / "broken").glob("*")), done)
    done = billion(folder / "broken", LORENTZ, "--write")
    check("parts of rounds are not written down", done.returncode == 1 and "no whole round" in done.stderr, done)
    done = billion(folder, LORENTZ, "--rounds", "5-100")
    check("rounds beyond the last are refused", done.returncode == 2 and "--rounds" in done.stderr, done)


with tempfile.TemporaryDirectory() as scratch:
    for part in (round_is_kept, faults_are_told, broken_programs_end_it):
        place = pathlib.Path(scratch) / part.__name__
        place.mkdir()
        part(place)
