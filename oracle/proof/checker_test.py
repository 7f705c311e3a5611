"""oracle/proof/check accepts and refuses, with the status and the words of data/check.py, all that the tests of that
one hold: each way to tamper with a record or a proof, and each form of a text.

python3 oracle/proof/checker_test.py"""
import contextlib, hashlib, importlib.util, io, pathlib, subprocess, sys, tempfile, unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKER = ROOT / "oracle" / "proof" / "check"

def load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "tests" / "golden" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module

kinds, forms = load("check_py_test"), load("golden_forms_test")
sys.path.insert(0, str(ROOT / "oracle" / "proof"))
import wrong_specs

def verdict(text):
    """Exit status and output for a file of this text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "set.ndjson"
        path.write_bytes(text)
        # It needs seconds, also where the machine is busy.
        done = subprocess.run([CHECKER, path], capture_output=True, text=True, timeout=600)
        return done.returncode, done.stdout + done.stderr

kinds.run = lambda lines: verdict("".join(line + "\n" for line in lines).encode())
kinds.COMMAND = [CHECKER]

class Accepts(kinds.Accepts):
    def test_errors_are_counted(self):
        """No theorem is about them."""
        error, exact = kinds.CASES["error"], kinds.CASES["exact"]
        for cases, said in (((error, exact), ": 1 of them of the outcome error"), ((exact, kinds.CASES["never2"]), None)):
            status, output = kinds.run(kinds.golden(*cases))
            self.assertEqual(status, 0, output)
            self.assertTrue(said in output if said else "of the outcome" not in output, output)

class Refuses(kinds.Refuses):
    pass

class Ties(unittest.TestCase):
    """Numbers, and times, half way between two: to the even one."""
    def test_numbers(self):
        case = kinds.CASES["exact"]
        header, scene, line = kinds.golden(case)
        question = line[line.index('"x"'):line.index(',"expect"')]
        # n 2^-56 for 1/4
        for n, status in ((2**54 + 2, 0), (2**54 + 6, 1), (2**54 - 1, 0), (2**54 + 3, 1), (2**54 - 2, 1)):
            tie = scene.replace("0.25", "0." + str(n * 5**56).zfill(56))
            identity = hashlib.sha256(f"{tie}\n{question}".encode()).hexdigest()[:16]
            lines = "\n".join((header, tie, kinds.record(case, identity)))
            self.assertEqual(verdict(lines.encode())[0], status, tie)

    def test_times(self):
        for time, status in ((2.0**53, 0), (2.0**53 + 2, 1)):
            lattice = {"vectors": [[2.0**60, 0], [0, 2.0**60]], "atoms": [{"position": [0, 0], "radius": 1}]}
            window = {"lattice": 0, "atom": 0, "from": -2, "to": 1e16, "basis": [[1, 0], [0, 1]]}
            case = {"scene": {"dimension": 2, "lattices": [lattice]},
                    "query": {"x": [-2.0**53 - 2, 0], "v": [1, 0]},
                    "expect": {"outcome": "hit", "lattice": 0, "atom": 0, "cell": [0, 0], "time": time},
                    "time_decimal": "9007199254740993." + 24 * "0",
                    "certificate": {"windows": [window]}}
            self.assertEqual(kinds.run(kinds.golden(case))[0], status)

class Hostile(unittest.TestCase):
    """What would take for ever ends soon, and is refused."""
    def refused(self, name, why, change):
        case = kinds.copy.deepcopy(kinds.CASES[name])
        change(case["certificate"]["windows"])
        status, said = kinds.run(kinds.golden(case))
        self.assertEqual(status, 1, said)
        self.assertRegex(said, why)

    def test_windows(self):
        for name in "plane", "space":
            self.refused(name, "too many", lambda w: w[-1].update(to="0x1p16384"))
            self.refused(name, "too many", lambda w: w[0].update({"from": "-0x1p16384"}))
        # One budget for all.
        self.refused("exact", "too many", lambda w: w.extend([{**w[0], "to": 3e4}] * 2000))
        self.refused("plane", "exponent", lambda w: w[0].update({"from": "-0x1p16385"}))
        self.refused("exact", "of more than 2500", lambda w: w[0].update({"from": "-0x" + 2498 * "1"}))

    def test_windows_that_see_nothing(self):
        """Each costs ten steps, and one for the plane that it looks at."""
        for pieces, status in ((90000, 0), (91000, 1)):
            case = kinds.copy.deepcopy(kinds.CASES["exact"])
            windows = case["certificate"]["windows"]
            windows.extend([{**windows[0], "from": 0.1, "to": 0.1, "basis": [[0, 1], [1, 0]]}] * pieces)
            self.assertEqual(kinds.run(kinds.golden(case))[0], status, pieces)

    def test_lines(self):
        """A line of 32 MiB is read, a longer one passed over."""
        for length, status in ((2**25, 0), (2**25 + 1, 2), (2**26, 2)):
            header, scene, line = kinds.golden(kinds.CASES["exact"])
            said = verdict("\n".join((header, scene, line + (length - len(line)) * " ", "")).encode())
            self.assertEqual(said[0], status, (length, said[1][-300:]))

    def test_ends_are_exact(self):
        """-1/4, where the window has to begin, and 2^-9000 before and behind it."""
        for numerator, status in ((2**8998, 0), (2**8998 + 1, 0), (2**8998 - 1, 1)):
            case = kinds.copy.deepcopy(kinds.CASES["exact"])
            case["certificate"]["windows"][0]["from"] = f"-{numerator:#x}p-9000"
            self.assertEqual(kinds.run(kinds.golden(case))[0], status, numerator - 2**8998)

    def test_exponents(self):
        for number, why in (("1e99999999999999999999", "no number"), ("1e-99999999999999999999", "gap"),
                            ("1" + "0" * 99999 + "e-100001", "gap")):
            header, scene, line = kinds.golden(kinds.CASES["exact"])
            status, said = kinds.run([header, scene, line.replace('"from":-0.25', '"from":-' + number)])
            self.assertEqual(status, 1, said)
            self.assertRegex(said, why)

    def test_a_scene_of_many_atoms(self):
        """No stack overflows."""
        case = kinds.copy.deepcopy(kinds.CASES["error"])
        case["scene"]["lattices"][0]["atoms"] *= 300000
        status, said = kinds.run(kinds.golden(case))
        self.assertEqual(status, 0, said[-300:])

class WrongSpecifications(unittest.TestCase):
    """What Coq does not end with, or refuses elsewhere than in a proof, is not refused."""
    def test_without_time(self):
        longest, wrong_specs.LONGEST = wrong_specs.LONGEST, 0.001
        try: self.assert_not_tried(wrong_specs.WRONG["closed balls"], "did not end")
        finally: wrong_specs.LONGEST = longest

    def test_what_is_no_specification(self):
        for new, said in ((") < valve r", "no specification at all"), (") <", "no specification at all")):
            old = "norm (along q (-1) centre) < value r"
            self.assert_not_tried((old, "norm (along q (-1) centre" + new), said)
        self.assert_not_tried(("nowhere", ""), "0 places")

    def assert_not_tried(self, change, why):
        with self.assertRaisesRegex(wrong_specs.NotTried, why): wrong_specs.refused_by(change)

class Forms(unittest.TestCase):
    def test_each(self):
        """The status is that of check.py."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "set.ndjson"
            for accepted, texts_of_kinds in ((True, forms.ACCEPTED), (False, forms.REFUSED)):
                for kind, texts in texts_of_kinds.items():
                    for text in texts:
                        with self.subTest(kind, text=text[-700:]), contextlib.redirect_stdout(io.StringIO()) as output:
                            path.write_bytes(text)
                            right = forms.check.check(str(path))
                            self.assertEqual(right == 0, accepted, output.getvalue())
                            status, said = verdict(text)
                            self.assertEqual(status, right, said)

if __name__ == "__main__":
    unittest.main()
