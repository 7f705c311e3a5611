"""Holds three checkers of certificates against each other on records that were tampered with: proof/check,
data/check.py, and `lorentz golden verify`. Each tampered record has the id of its question, so all of them
get as far as its proof.

python3 proof/differential.py PROGRAM COUNT [SEED]
exit status: 0 they agree, 1 they don't (the records are printed)"""
import collections, contextlib, hashlib, importlib.util, io, json, math, pathlib, random, re, signal
import subprocess, sys, tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SPEC = importlib.util.spec_from_file_location("check", ROOT / "data" / "check.py")
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)
BATCH, FILE = 2000, 20  # records of a batch; of a file, for `golden verify` says no more of one
# What takes more steps, or check.py longer, is left out: hostile proofs are for other tests.
BUDGET, SECONDS = 2000, 0.2

def compact(value):
    return json.dumps(value, separators=(",", ":"), allow_nan=False)  # ValueError: no way to tamper

def committed():
    """(scene line, record) of all golden sets, but for errors."""
    for path in sorted((ROOT / "data" / "golden").glob("*.ndjson")):
        for line in path.read_text().splitlines()[1:]:
            if line.startswith('{"scene"'):
                scene = line
            elif '"outcome":"error"' not in line:
                yield scene, line

# ---- Ways to tamper. Each changes the record in place, or raises where it can't.
def nudge(x, rng):
    if rng.random() < .3: return math.nextafter(x, rng.choice((math.inf, -math.inf)))
    return x * (1 + rng.choice((-1, 1)) * 2.0**-rng.randrange(1, 50))
def nudge_end(end, rng):
    if type(end) is not str: return nudge(float(end), rng)
    mantissa, power = end.split("p")
    return hex(int(mantissa, 16) + rng.choice((-1, 1)) * 2**rng.randrange(40)) + "p" + power
def pieces(record): return next(iter(record["certificate"].values()))
def shift(values, rng, steps=(-1, 1)):
    i = rng.randrange(len(values))
    values[i] = int(values[i]) + rng.choice(steps)
def claimed_cell(record, rng): shift(record["expect"]["cell"], rng)
def atom_beside(box, rng, scene):  # one that exists: of others `golden verify` reads no further
    lattices = json.loads(scene)["scene"]["lattices"]
    l = box["lattice"]
    a = (box["atom"] + 1) % len(lattices[l]["atoms"])
    if a == box["atom"]: l = (l + 1) % len(lattices)
    if (l, a) == (box["lattice"], box["atom"]) or a >= len(lattices[l]["atoms"]): raise KeyError
    box.update(lattice=l, atom=a)
def claimed_atom(record, rng, scene): atom_beside(record["expect"], rng, scene)
def start(record, rng):
    record["x"][rng.randrange(len(record["x"]))] += rng.choice((-1, 1)) * 2.0**rng.randrange(-50, 1)
def start_ulp(record, rng):
    i = rng.randrange(len(record["x"]))
    record["x"][i] = math.nextafter(record["x"][i], rng.choice((9e99, -9e99)))
def velocity(record, rng): i = rng.randrange(len(record["v"])); record["v"][i] = nudge(record["v"][i], rng)
def other_way(record, rng): record["v"] = [-c for c in record["v"]]
def scaled(record, rng): f = 2.0**rng.randrange(-40, 40); record["v"] = [c * f for c in record["v"]]
def basis_number(record, rng): shift(rng.choice(rng.choice(pieces(record))["basis"]), rng)
def basis_rows(record, rng): rng.shuffle(rng.choice(pieces(record))["basis"])
def basis_sheared(record, rng):
    rows = rng.choice(pieces(record))["basis"]
    (i, j), k = rng.sample(range(len(rows)), 2), rng.choice((-3, -1, 1, 2))
    rows[i] = [int(a) + k * int(b) for a, b in zip(rows[i], rows[j])]
def window_end(record, rng):
    window, key = rng.choice(pieces(record)), rng.choice(("from", "to"))
    window[key] = nudge_end(window[key], rng)
def window_gone(record, rng): l = pieces(record); l.pop(rng.randrange(len(l)))
def window_twice(record, rng): l = pieces(record); l.insert(rng.randrange(len(l) + 1), dict(rng.choice(l)))
def window_order(record, rng): rng.shuffle(pieces(record))
def window_atom(record, rng, scene): atom_beside(rng.choice(pieces(record)), rng, scene)
def toggled_from(record, rng):
    if record.pop("from", None) is None: raise KeyError
def from_claimed(record, rng):
    record["from"] = {key: record["expect"][key] for key in ("lattice", "atom", "cell")}
def from_beside(record, rng):
    from_claimed(record, rng)
    record["from"]["cell"] = list(record["from"]["cell"])
    shift(record["from"]["cell"], rng)
def time_ulp(record, rng):
    t = record["expect"]["time"]
    t = 1.7976931348623157e308 if t == "inf" else math.nextafter(t, rng.choice((math.inf, -math.inf)))
    record["expect"]["time"] = "inf" if t == math.inf else abs(t)
def digit(record, rng):
    text = record["time_decimal"]
    i = rng.choice([i for i, c in enumerate(text) if c.isdigit()])
    record["time_decimal"] = text[:i] + str((int(text[i]) + rng.choice((1, 9))) % 10) + text[i + 1:]
def to_inside(record, rng):
    record["expect"].pop("time"), record.pop("time_decimal")
    record["expect"].update(outcome="inside")
def to_hit(record, rng):
    if record["expect"]["outcome"] != "inside": raise KeyError
    record["expect"].update(outcome="hit", time=0.0); record["time_decimal"] = "0"
WAYS = [claimed_cell, claimed_atom, start, start_ulp, velocity, other_way, scaled, basis_number, basis_rows,
        basis_sheared, window_end, window_gone, window_twice, window_order, window_atom, toggled_from,
        from_claimed, from_beside, time_ulp, digit, to_inside, to_hit]

def line_of(scene, record):
    question = compact({key: record[key] for key in ("x", "v", "from") if key in record})[1:-1]
    identity = hashlib.sha256(f"{scene}\n{question}".encode()).hexdigest()[:16]
    rest = compact({key: record[key] for key in record if key not in ("id", "tags", "x", "v", "from")})[1:]
    return f'{{"id":"{identity}","tags":["t"],{question},{rest}'

def tampered(cases, rng):
    while True:
        (scene, line), way = rng.choice(cases), rng.choice(WAYS)
        record = json.loads(line)
        with contextlib.suppress(KeyError, IndexError, ValueError, TypeError, AttributeError):
            way(record, rng, *[scene] * (way in (claimed_atom, window_atom)))
            return scene, way.__name__, line_of(scene, record)

# ---- Verdicts: of each line of a file, whether it is refused.
def refused_lines(said):
    return {(m[1], int(m[2])): m[3] for m in re.finditer(r"^(?:lorentz: )?(\S+?):(\d+): (.*)$", said, re.M)}
class Overtime(Exception): pass
def interrupt(*_): raise Overtime
def by_python(paths):
    """A record that is being checked when time is up is refused for that."""
    signal.signal(signal.SIGPROF, interrupt)
    with contextlib.redirect_stdout(io.StringIO()) as said:
        for path in paths:
            try:
                signal.setitimer(signal.ITIMER_PROF, SECONDS, SECONDS)
                check.check(path)
            except Overtime:  # between two records: nothing is said of the file
                print(f"{path}:0: Overtime")
            signal.setitimer(signal.ITIMER_PROF, 0)
    return refused_lines(said.getvalue())
def by_proof(paths, *options):
    done = subprocess.run([ROOT / "proof" / "check", *options, *paths], capture_output=True, text=True)
    assert done.returncode in (0, 1), (done.returncode, done.stdout[-300:], done.stderr[-300:])
    return refused_lines(done.stdout)
def by_program(program, paths):
    """`margin` and `condition` of a record that was changed are others now: its proof has passed by then."""
    done = subprocess.run([program, "golden", "verify", *paths], capture_output=True, text=True)
    assert done.returncode in (0, 1), (done.returncode, done.stdout[-300:], done.stderr[-300:])
    refused = refused_lines(done.stderr)
    other = re.compile("its (margin|condition) is another one")
    return {at: why for at, why in refused.items() if not other.search(why)}

# docs/certificates.md lets a checker refuse a basis whose first two vectors are at right angles to v.
ALLOWED = "b_1 and b_2 are both at right angles to v"

def header(count):
    return compact({"golden": {"format": 1, "name": "n", "description": "d", "generator": "g", "version": "v",
                               "count": count, "tags": {"t": ""}}})

def write(folder, records):
    """Files of few records; the place of each."""
    places = []
    for first in range(0, len(records), FILE):
        part = records[first:first + FILE]
        path = str(folder / f"{first}.ndjson")
        lines = [header(len(part))]
        for scene, _, line in part:
            lines += [scene, line]
            places.append((path, len(lines)))
        pathlib.Path(path).write_text("\n".join(lines) + "\n")
    return places

def batch(program, records):
    """How often each way had which verdicts (True: accepted), and where they differ."""
    tally, differ = collections.Counter(), []
    with tempfile.TemporaryDirectory() as name:
        places = write(pathlib.Path(name), records)
        refused = by_proof(list(dict.fromkeys(path for path, _ in places)), "--budget", str(BUDGET))
        records = [record for record, at in zip(records, places) if "too many" not in refused.get(at, "")]
    with tempfile.TemporaryDirectory() as name:
        places = write(pathlib.Path(name), records)
        paths = list(dict.fromkeys(path for path, _ in places))
        says = by_python(paths), by_proof(paths), by_program(program, paths)
        for place, (scene, way, line) in zip(places, records):
            if any("Overtime" in says[0].get(at, "") for at in (place, (place[0], 0))): continue
            if ALLOWED in says[2].get(place, ""):
                tally["(a basis that may be refused)", ()] += 1
                continue
            verdicts = tuple(place not in refused for refused in says)
            tally[way, verdicts] += 1
            if len({*verdicts}) == 1: continue
            why = [refused.get(place, "accepted")[:200] for refused in says]
            differ.append((way, verdicts, why, scene, line))
    return tally, differ

def unique(records):
    """One record for each id, for a file may not have one twice."""
    return list({line[7:23]: (scene, way, line) for scene, way, line in records}.values())

def main(program, count, seed=1):
    rng, cases = random.Random(int(seed)), list(committed())
    tally, differ, done = collections.Counter(), [], 0
    while done < int(count):
        records = unique(tampered(cases, rng) for _ in range(min(BATCH, int(count) - done)))
        of_batch, more = batch(program, records)
        tally.update(of_batch)
        differ += more
        for way, verdicts, why, scene, line in more:
            print(f"{way}: check.py, proof, program: {verdicts} {why}\n{scene}\n{line}")
        done += sum(of_batch.values())
        print(f"{done} records, {len(differ)} verdicts differ", flush=True)
    for way in WAYS:
        accepted, refused = tally[way.__name__, (True,) * 3], tally[way.__name__, (False,) * 3]
        print(f"{way.__name__:16} {accepted:8} accepted {refused:8} refused")
    print(f"{tally['(a basis that may be refused)', ()]} with a basis that only the program refuses, and may")
    return 1 if differ else 0

if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
