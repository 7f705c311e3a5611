"""The golden itineraries: their sums, data/check_itineraries.py, and that the program makes the same records again.
python3 tests/golden/golden_itineraries_test.py PROGRAM"""
import copy, hashlib, importlib.machinery, importlib.util, itertools, json, pathlib, random, subprocess, sys, tempfile, unittest
from fractions import Fraction

sys.dont_write_bytecode = True
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
FOLDER = DATA / "golden" / "itineraries"
FILES = sorted(FOLDER.glob("*.ndjson"))
CHECKER = DATA / "check_itineraries.py"
PROGRAM = ""

def module(path):
    loader = importlib.machinery.SourceFileLoader(path.stem, str(path))
    result = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.stem, loader))
    loader.exec_module(result)
    return result

check, make = module(CHECKER), module(FOLDER / "make")

def cases(size=None):
    """Scene line and record line: of each scene one, not of the longest."""
    for path in FILES:
        fresh = False
        for line in path.read_text().splitlines():
            if line.startswith('{"scene"'):
                scene, fresh = line, True
            elif fresh and line.startswith('{"id"') and len(line) < 10_000:
                fresh = False
                if size in (None, json.loads(scene)["scene"]["dimension"]):
                    yield scene, line

CASES = list(cases())

def short(scene, line, collisions=40):
    """The record of fewer collisions from the same start."""
    record = json.loads(line)
    start = {key: record[key] for key in ("x", "v", "direction", "from") if key in record}
    told, = make.journeys(PROGRAM, scene, [start], collisions)
    return json.loads(make.record(scene, start, told))

def flaw_of(scene, record):
    try:
        check.check_record(record, check.Scene(json.loads(scene)["scene"]), make.DIGITS)
    except check.Refuted as flaw:
        return str(flaw)
    return ""

def status_of(*arguments):
    run = subprocess.run([sys.executable, CHECKER, *arguments], capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr

class Committed(unittest.TestCase):
    def test_the_sums_are_right(self):
        sums = [line.split("  ") for line in (FOLDER / "SHA256SUMS").read_text().splitlines()]
        self.assertEqual(sorted(name for _, name in sums), [path.name for path in FILES])
        for digest, name in sums:
            self.assertEqual(hashlib.sha256((FOLDER / name).read_bytes()).hexdigest(), digest, name)

    def test_there_are_enough(self):
        lines = [line for path in FILES for line in path.read_text().splitlines()]
        self.assertGreaterEqual(sum(line.startswith('{"id"') for line in lines), 200)
        self.assertLess(sum(path.stat().st_size for path in FILES), 1_500_000)

    def test_a_sample_is_flown_again(self):
        status, told = status_of("--quick", *FILES)
        self.assertEqual(status, 0, told)
        self.assertEqual(told.count("all right"), len(FILES), told)

class Statuses(unittest.TestCase):
    def test_what_is_no_set_is_bad_input_and_refutes_nothing(self):
        deep = "[" * 100_000
        header = json.dumps({"golden": dict.fromkeys(check.HEADER, 1)})
        scene = '{"scene":{"dimension":2,"lattices":[{"vectors":[[1,0],[0,1e999]],"atoms":[{"position":[0,0],"radius":1}]}]}}'
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {"empty": b"", "blank": b"\n", "deep": deep.encode(), "bytes": b"\xff\xfe",
                               "infinite": f"{header}\n{scene}\n".encode()}.items():
                path = pathlib.Path(folder) / name
                path.write_bytes(text)
                status, told = status_of(path)
                self.assertEqual(status, 2, f"{name}: {told}")
                self.assertNotIn("Traceback", told)
            self.assertEqual(status_of(folder)[0], 2)
            self.assertEqual(status_of(pathlib.Path(folder) / "none")[0], 2)

class Refused(unittest.TestCase):
    def test_records_tampered_with(self):
        draw = random.Random(20161115)
        for scene, line in CASES:
            right = short(scene, line)
            self.assertEqual(flaw_of(scene, right), "")
            for what, change in CHANGES.items():
                record, box = copy.deepcopy(right), json.loads(scene)
                if change(record, box["scene"], draw):
                    with self.subTest(f"{scene} {record['x']}: {what}"):
                        self.assertNotEqual(flaw_of(json.dumps(box), record), "")

    def test_files_tampered_with(self):
        scene, line = CASES[0]
        header = {"golden": {**dict.fromkeys(check.HEADER, ""), "format": 1, "digits": make.DIGITS, "count": 1}}
        lines = [json.dumps(header), scene, line]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "set.ndjson"
            for status, what, changed in [
                (0, "all right", lines),
                (1, "as many", lines[:2]),
                (1, "is there twice", [*lines, line]),
                (1, "does not belong", [*lines[:2], line.replace('"x":[', '"x":[0,', 1)]),
                (1, "the end's v[1] is not", [*lines[:2], tampered_digit(line)]),
                (2, "JSON", [*lines, "{"]),
                (2, "golden", lines[1:]),
                (2, "comes twice", [*lines[:2], line.replace('"x":', '"x":[],"x":', 1)]),
                (2, "keys", [*lines[:2], line.replace('"times"', '"time"')]),
            ]:
                path.write_text("".join(text + "\n" for text in changed))
                got, told = status_of(path)
                self.assertEqual(got, status, told)
                self.assertIn(what, told)
        self.assertEqual(status_of("no such file")[0], 2)
        self.assertEqual(status_of()[0], 2)

    def test_an_obstacle_that_is_passed_over(self):
        """The line meets both; one is entered before."""
        for size in 2, 3:
            scene = {"dimension": size, "lattices": [{"vectors": [[int(i == k) for k in range(size)] for i in range(size)],
                                                      "atoms": [{"position": [0] * size, "radius": "1/10"}]}]}
            start = {"x": ["1/2", "1/50", "0"][:size], "v": [1, 0, 0][:size], "times": {}, "end": {"bits": 9}}
            behind = {**start, "itinerary": [[0, 0, 2, 0, 0][: 2 + size]]}
            with self.assertRaisesRegex(check.Refuted, r"\(0, 0, \(1, 0.*is entered before"):
                check.fly(behind, check.Scene(scene), 30, 300)
            inside = {**start, "x": ["1/20", "0", "0"][:size], "itinerary": [[0, 0, 1, 0, 0][: 2 + size]]}
            with self.assertRaisesRegex(check.Refuted, r"the flight begins in"):
                check.fly(inside, check.Scene(scene), 30, 300)

def tampered_digit(line):
    at = line.rindex('"],"bits"') - 1
    return line[:at] + str((int(line[at]) + 1) % 10) + line[at + 1 :]

# ---- Changes of a record or its scene; false, where they do not apply.
def other_obstacle(record, scene, draw):
    hit = draw.choice(record["itinerary"])
    hit[draw.randrange(2, len(hit))] += draw.choice((-1, 1))
    return True

def swapped(record, scene, draw):
    hits = record["itinerary"]
    pairs = [i for i in range(len(hits) - 1) if hits[i] != hits[i + 1]]
    i = draw.choice(pairs)
    hits[i], hits[i + 1] = hits[i + 1], hits[i]
    return True

def left_out(record, scene, draw):
    del record["itinerary"][draw.randrange(len(record["itinerary"]) - 1)]
    record["times"] = {str(len(record["itinerary"])): list(record["times"].values())[-1]}
    return True

def in_last_place(text, draw):
    digits = [i for i, c in enumerate(text.partition("e")[0]) if c.isdigit()]
    i = digits[-1]
    return text[:i] + str((int(text[i]) + draw.choice((1, 9))) % 10) + text[i + 1 :]

def time_digit(record, scene, draw):
    key = draw.choice(list(record["times"]))
    record["times"][key] = in_last_place(record["times"][key], draw)
    return True

def end_digit(record, scene, draw):
    numbers = record["end"][draw.choice("xv")]
    i = draw.randrange(len(numbers))
    numbers[i] = in_last_place(numbers[i], draw)
    return True

def digit_less(record, scene, draw):
    record["end"]["x"][0] = record["end"]["x"][0].partition("e")[0][:-1]
    return True

def radius(record, scene, draw):
    atom = draw.choice([atom for lattice in scene["lattices"] for atom in lattice["atoms"]])
    if "radius" in atom:
        off = check.rational(atom["radius"]) + draw.choice((-1, 1)) * Fraction(1, 10**12)
        atom["radius"] = f"{off.numerator}/{off.denominator}"
    return "radius" in atom

def start(record, scene, draw):
    off = check.rational(record["x"][0]) + Fraction(1, 10**15)
    record["x"][0] = f"{off.numerator}/{off.denominator}"
    return True

CHANGES = {"another obstacle": other_obstacle, "two collisions swapped": swapped, "a collision left out": left_out,
           "a digit of a time": time_digit, "a digit of the end": end_digit, "a digit less": digit_less,
           "the radius off by 1e-12": radius, "the start off by 1e-15": start}

ANGLES = (
    ("36", "0.80901699437494742410229341718281905886015458990288", "0.58778525229247312916870595463907276859765243764314"),
    ("300", "0.5", "-0.86602540378443864676372317075293618347140262690519"),
    ("990", "0", "-1"),
)

class CheckerParts(unittest.TestCase):
    def test_no_obstacle_along_a_flight_is_missing(self):
        """cells_along against all cells around: skew lattices, long ellipsoids, all directions."""
        draw = random.Random(20161116)
        def number(most): return Fraction(draw.randint(-99, 99), 100) * most
        met = 0
        for trial in range(100):
            size = draw.choice((2, 3))
            vectors = [[str(number(1) + (i == k) * 2) for k in range(size)] for i in range(size)]
            axes = [[str(number(Fraction(1, 2)) + Fraction(i == k, 7)) for k in range(size)] for i in range(size)]
            scene = check.Scene({"dimension": size, "lattices": [
                {"vectors": vectors, "atoms": [{"position": [str(number(1)) for _ in range(size)], "semiaxes": axes}]}]})
            record = {"x": [str(number(2)) for _ in range(size)], "v": [str(number(3) + Fraction(1, 997)) for _ in range(size)]}
            particle = check.start_of(record, scene, check.COARSE)
            until = check.interval(Fraction(3), check.COARSE)
            listed = {*check.cells_along(particle, particle.shape(scene.atoms, (0, 0)), until)}
            for cell in itertools.product(range(-4, 5), repeat=size):
                approach = check.Approach(particle, scene.atoms, (0, 0, cell))
                if approach.D.mid > 0 and 0 < approach.time().mid < until.mid:
                    met += 1
                    self.assertIn(cell, listed, f"trial {trial}")
        self.assertGreater(met, 80)

    def test_numbers_of_starts(self):
        for text, value in {"golden": "1.61803398874989484820458683436563811772030917980576",
                            "sqrt(2)": "1.41421356237309504880168872420969807856967187537694",
                            "-sqrt(1/3)": "-0.57735026918962576450914878050195745564760175127013",
                            "0.1": "0.1", "-7/4": "-1.75", "2.5e-3": "0.0025"}.items():
            off = check.surd(text, 200) - check.interval(Fraction(value), 200)
            self.assertLess(abs(off.mid), 2**200 // 10**49, text)
            self.assertLess(off.rad, 99, text)
        for degrees, cosine, sine in ANGLES:
            for got, value in zip(check.cosine_and_sine(Fraction(degrees), 200), (cosine, sine)):
                self.assertLess(abs((got - check.interval(Fraction(value), 200)).mid), 2**200 // 10**49)
                self.assertLess(got.rad, 99)
        for bad in "x", "sqrt(x)", "sqrt(-1)", "", "1/0", None, [], "inf":
            with self.assertRaises((ValueError, ZeroDivisionError, check.Refuted)):
                check.surd(bad, 100)

class Program(unittest.TestCase):
    def test_the_generator_makes_the_same_lines(self):
        for path in FILES:
            if path.stem != "square":  # which begins with the longest
                expected = path.read_text().splitlines()[:6]
                self.assertEqual(list(itertools.islice(make.lines_of(PROGRAM, path.stem), 6)), expected)

    def test_the_program_makes_the_same_records(self):
        for scene, line in CASES:
            record = json.loads(line)
            start = {key: record[key] for key in ("x", "v", "direction", "from") if key in record}
            told, = make.journeys(PROGRAM, scene, [start], len(record["itinerary"]))
            self.assertEqual(make.record(scene, start, told), line)

    def test_a_set_is_a_stream_of_starts(self):
        run = subprocess.run([PROGRAM, "trajectory", "--strict", "--collisions", "2", FILES[0]], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(run.stdout.count('"end":"collisions"'), FILES[0].read_text().count('"itinerary"'))

if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
