"""address_test.py SOURCE: the address of the project stands in packaging/address alone; whatever names it has it from there."""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
EXAMPLE = "https://host.example/owner/lorentz"
# Hosts of code, of packages and of images; an address of ours would have the project's name in it.
OURS = re.compile(r"\b(?:github|gitlab|codeberg|ghcr|quay|pypi|bitbucket|sr\.ht|docker|zenodo)\b[\w.]*[/:][\w./~-]*lorentz\b", re.IGNORECASE)
OWNER = re.compile(r"^ *(?:- )?uses: (?!actions/)(\S+)", re.MULTILINE)


def tracked():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=SOURCE, check=False,
                            stdout=subprocess.PIPE, text=True).stdout.split("\n")
    for name in listed:
        path = SOURCE / name
        if name and path.is_file() and not path.is_symlink() and path.suffix not in (".png", ".svg", ".npy") \
                and not name.startswith(("data/golden/", "tests/harness/corpus/")):
            yield name, path.read_text(errors="replace")


def printed_address():
    say = [SOURCE / "packaging/say_address", "--print"]
    return subprocess.run(say, check=True, capture_output=True, text=True).stdout.strip()


def with_address(folder, address):
    """What the address goes into, in a copy."""
    for name in ("packaging", "python", "README.md", "CITATION.cff", "CMakeLists.txt", "LICENSE"):
        copy = shutil.copytree if (SOURCE / name).is_dir() else shutil.copy
        copy(SOURCE / name, folder / name)
    file = folder / "packaging/address"
    comments = [line for line in file.read_text().splitlines() if line.startswith("#")]
    file.write_text("\n".join(comments + [address] * bool(address)) + "\n")
    return subprocess.run([folder / "packaging/say_address"], capture_output=True, text=True)


def metadata(folder):
    return subprocess.run([sys.executable, "-c", "import lorentz_wheel; print(lorentz_wheel.METADATA)"], cwd=folder / "python",
                          check=True, capture_output=True, text=True).stdout


def homepage(folder):
    """What CMake puts into the Debian packages."""
    file = folder / "packaging/cmake/LorentzPackages.cmake"
    lines = re.search(r"^file\(STRINGS [^\n]*packaging/address.*?^endif\(\)", file.read_text(), re.MULTILINE | re.DOTALL)
    script = folder / "homepage.cmake"
    script.write_text(f"set(PROJECT_SOURCE_DIR {folder})\n{lines[0]}\nmessage(STATUS \"<${{CPACK_DEBIAN_PACKAGE_HOMEPAGE}}>\")\n")
    return re.search("<(.*)>", subprocess.run(["cmake", "-P", script], check=True, capture_output=True, text=True).stdout)[1]


class Address(unittest.TestCase):
    def test_no_file_names_another(self):
        count, address = 0, printed_address()
        for name, text in tracked():
            count += 1
            with self.subTest(name):
                text = text.replace(address, "") if address else text
                said = OURS.findall(text) if name != "tests/packaging/address_test.py" else []
                self.assertEqual(said, [], "the address belongs into packaging/address")
                if name.startswith(".github/"):
                    self.assertEqual(OWNER.findall(text), [])
        self.assertGreater(count, 100, "is this a clone?")

    def test_the_pattern_sees_one(self):
        for text in ("https://github.com/someone/lorentz", "ghcr.io/someone/lorentz:1", "git@gitlab.com:someone/lorentz.git"):
            self.assertTrue(OURS.search(text), text)
        self.assertFalse(OURS.search("https://github.com/google/highway"))

    def test_files_agree_with_it(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            self.assertEqual(with_address(folder, printed_address()).returncode, 0)
            for name in ("README.md", "CITATION.cff"):
                self.assertEqual((folder / name).read_text(), (SOURCE / name).read_text(), "call packaging/say_address")

    def test_all_say_it_once_it_is_filled_in(self):
        for address in (EXAMPLE, ""):
            with self.subTest(address), tempfile.TemporaryDirectory() as scratch:
                folder = Path(scratch)
                self.assertEqual(with_address(folder, address).returncode, 0)
                say = folder / "packaging/say_address"
                texts = [(folder / "README.md").read_text(), (folder / "CITATION.cff").read_text(), metadata(folder), homepage(folder)]
                for text in texts:
                    self.assertEqual(EXAMPLE in text, bool(address), text)
                self.assertEqual(f"\nProject-URL: Repository, {EXAMPLE}\n" in texts[2], bool(address))
                self.assertEqual(f'\nrepository-code: "{EXAMPLE}"\n' in texts[1], bool(address))
                self.assertEqual(texts[3], address)
                self.assertEqual(subprocess.run([say, "--check", EXAMPLE + "/"], capture_output=True).returncode == 0, bool(address))
                self.assertNotEqual(subprocess.run([say, "--check", "https://host.example/other/lorentz"],
                                                   capture_output=True).returncode, 0)
                # And taken out again, nothing is left of it.
                if address:
                    shutil.copy(SOURCE / "packaging/address", folder / "packaging/address")
                    subprocess.run([say], check=True)
                    self.assertEqual((folder / "README.md").read_text(), (SOURCE / "README.md").read_text())

    def test_what_is_no_address_is_refused(self):
        for wrong in ("host.example/owner/lorentz", "https://host.example", EXAMPLE + "\n" + EXAMPLE, "https://a.b/c d"):
            with self.subTest(wrong), tempfile.TemporaryDirectory() as scratch:
                done = with_address(Path(scratch), wrong)
                self.assertEqual(done.returncode, 1)
                self.assertIn("packaging/address: one line", done.stderr)

    def test_image_and_workflow_read_it(self):
        self.assertIn("packaging/say_address --print", (SOURCE / "packaging/Containerfile").read_text())
        self.assertIn("packaging/say_address --check", (SOURCE / ".github/workflows/release.yml").read_text())
        self.assertIn("packaging/say_address\" --print", (SOURCE / ".github/actions/judge-engine/judge").read_text())


if __name__ == "__main__":
    unittest.main()
