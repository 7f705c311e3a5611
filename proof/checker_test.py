"""proof/check accepts and refuses, with the status and the words of data/check.py, all that the tests of that one hold: each
way to tamper with a record or a proof, and each form of a text. python3 proof/checker_test.py"""
import importlib.util, pathlib, subprocess, sys, tempfile, unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
CHECKER = ROOT / "proof" / "check"

def load(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / "tests" / "golden" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module

kinds, forms = load("check_py_test"), load("golden_forms_test")

def verdict(text):
    """Exit status and output for a file of this text."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "set.ndjson"
        path.write_bytes(text)
        done = subprocess.run([CHECKER, path], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

kinds.run = lambda lines: verdict("".join(line + "\n" for line in lines).encode())
kinds.CHECK = CHECKER  # in test_the_program

class Accepts(kinds.Accepts):
    def test_the_program(self):
        lines = "\n".join(kinds.golden(*kinds.CASES.values()))
        for arguments, text, status in ((["-"], lines, 0), (["-"], lines.rsplit("\n", 1)[0], 1), (["-"], lines + "\n{", 2),
                                        (["no such file"], "", 2), ([], "", 2)):
            done = subprocess.run([CHECKER, *arguments], input=text, text=True, capture_output=True)
            self.assertEqual(done.returncode, status, done)

class Refuses(kinds.Refuses):
    pass

class Forms(unittest.TestCase):
    def hold(self, texts_of_kinds, accepted):
        for kind, texts in texts_of_kinds.items():
            for text in texts:
                with self.subTest(kind, text=text[-700:]):
                    status, said = verdict(text)
                    self.assertIn(status, (0, 1, 2), said)
                    self.assertEqual(status == 0, accepted, said)

    def test_accepted(self):
        self.hold(forms.ACCEPTED, True)

    def test_refused(self):
        self.hold(forms.REFUSED, False)

if __name__ == "__main__":
    unittest.main()
