"""The golden itineraries: their sums, data/check_itineraries.py, and that the program makes the same records again.
python3 tests/golden/golden_itineraries_test.py PROGRAM"""
import hashlib, importlib.machinery, importlib.util, itertools, json, pathlib, subprocess, sys, unittest

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

make = module(FOLDER / "make")

def cases():
    """Scene line and record line: of each scene one, not of the longest."""
    for path in FILES:
        fresh = False
        for line in path.read_text().splitlines():
            if line.startswith('{"scene"'):
                scene, fresh = line, True
            elif fresh and line.startswith('{"id"') and len(line) < 10_000:
                fresh = False
                yield scene, line

CASES = list(cases())

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
