"""release_test.py SOURCE PROGRAM: the parts of a release that are made in a moment: bill of materials, checksums, signature."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile
from importlib.machinery import SourceFileLoader
from pathlib import Path

SOURCE = Path(sys.argv.pop(1)).resolve()
PROGRAM = Path(sys.argv.pop(1)).resolve()
WHEEL = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 and sys.argv[1].endswith(".whl") else None
BUNDLE = SourceFileLoader("bundle", str(SOURCE / "packaging/wheel/bundle")).load_module()


def wheel_in(folder):
    """What packaging/wheel/bundle would put beside this build's program; MPI's libraries are in no wheel."""
    if WHEEL:
        return WHEEL
    direct = [name for name in BUNDLE.needed(PROGRAM) if not BUNDLE.GIVEN.match(name) and not re.search("mpi|boost", name)]
    linked = dict(re.findall(r"(\S+) => (/\S+)", BUNDLE.said("ldd", PROGRAM)))
    found = {name: Path(linked[name]).resolve() for name in direct}
    found.update(BUNDLE.libraries_of(list(found.values())))
    path = folder / "lorentz.whl"
    with zipfile.ZipFile(path, "w") as wheel:
        wheel.write(PROGRAM, "lorentz/bin/lorentz")
        for name, file in found.items():
            digest = hashlib.sha256(file.read_bytes()).hexdigest()[:8]
            stem, _, rest = name.partition(".so")
            wheel.write(file, f"lorentz.libs/{stem}-{digest}.so{rest}")
        wheel.writestr("lorentz.libs/liblorentz_no_ntl.so", "")
    return path


def bill_of(wheel):
    return subprocess.run([SOURCE / "packaging/sbom", wheel], check=True, capture_output=True, text=True).stdout


def has_packages_of_wheels():
    return bool(shutil.which("dpkg-query")) and subprocess.run(["dpkg-query", "-W", "pybind11-dev"], capture_output=True).returncode == 0


@unittest.skipUnless(has_packages_of_wheels(), "python/packages.txt is not installed; ./run release and .ci/run install it")
class Release(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_the_bill_has_all_libraries_of_the_wheel(self):
        wheel = wheel_in(self.folder)
        text = bill_of(wheel)
        self.assertEqual(text, bill_of(wheel), "the same twice")
        bill = json.loads(text)
        with zipfile.ZipFile(wheel) as archive:
            there = {name: hashlib.sha256(archive.read(name)).hexdigest() for name in archive.namelist()
                     if name.startswith("lorentz.libs/") and "/liblorentz_" not in name}
        listed = {each["properties"][0]["value"]: each["hashes"][0]["content"] for each in bill["components"] if "properties" in each}
        self.assertEqual(listed, there)
        self.assertGreaterEqual(len(there), 8)
        self.assertFalse(any(re.search("ntl|gf2x", name) for name in there), "GPL: packaging/wheel/bundle")
        self.assertEqual({each["name"] for each in bill["components"]} & {"libgmp10", "libboost-dev", "pybind11-dev"},
                         {"libgmp10", "libboost-dev", "pybind11-dev"})

    def test_it_has_the_packages_of_the_page_if_there_is_one(self):
        page = self.folder / "page.html"
        subprocess.run([PROGRAM, "flights", "--count", "100", "--html", page], capture_output=True)
        names = {each["name"] for each in json.loads(bill_of(wheel_in(self.folder)))["components"]}
        self.assertEqual("@observablehq/plot" in names, page.exists())
        self.assertNotIn("esbuild", names)

    def test_it_has_what_its_format_requires(self):
        bill = json.loads(bill_of(wheel_in(self.folder)))
        self.assertEqual((bill["bomFormat"], bill["specVersion"], bill["version"]), ("CycloneDX", "1.5", 1))
        self.assertRegex(bill["serialNumber"], r"^urn:uuid:[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}$")
        components = [bill["metadata"]["component"], *bill["components"]]
        for each in components:
            self.assertIn(each["type"], ("application", "library"))
            self.assertTrue(each["name"] and each["version"])
            (licence,) = each["licenses"]
            self.assertTrue(licence.get("expression") or licence["license"]["id"])
            for digest in each.get("hashes", []):
                self.assertRegex(digest["content"], {"SHA-256": r"^[0-9a-f]{64}$", "SHA-512": r"^[0-9a-f]{128}$"}[digest["alg"]])
        references = [each["bom-ref"] for each in components]
        self.assertEqual(len(references), len(set(references)))
        (tree,) = bill["dependencies"]
        self.assertEqual({tree["ref"], *tree["dependsOn"]}, set(references))

    def test_all_headers_that_are_compiled_in_are_listed(self):
        """What packages.txt and python/packages.txt name is in the bill, or is a tool."""
        named = {line.split()[0] for name in ("packages.txt", "python/packages.txt")
                 for line in (SOURCE / name).read_text().splitlines() if line and not line.startswith("#")}
        tools = {"g++", "cmake", "ninja-build", "pkgconf", "python3-dev", "python3-numpy", "python3-pip"}
        bill = {each["name"] for each in json.loads(bill_of(wheel_in(self.folder)))["components"]}
        for name in named - tools - bill:
            stem = name.removesuffix("-dev")
            self.assertTrue(any(re.fullmatch(rf"{stem}[\d-]*", each) for each in bill), f"{name} is in no bill")

    def test_checksums_and_signature(self):
        folder, home = self.folder / "release", self.folder / "gnupg"
        folder.mkdir()
        home.mkdir(mode=0o700)
        (folder / "one").write_text("1")
        (folder / "two").write_text("2")
        environment = {**os.environ, "GNUPGHOME": str(home)}
        environment.pop("LORENTZ_SIGN_KEY", None)

        def run(*command, **more):
            return subprocess.run(command, cwd=folder, capture_output=True, text=True, env={**environment, **more})

        make, check = SOURCE / "packaging/checksums", ("sha256sum", "--check", "--strict", "SHA256SUMS")
        self.assertEqual(run(make, folder).returncode, 0)
        self.assertEqual(sorted(os.listdir(folder)), ["SHA256SUMS", "one", "two"])
        self.assertEqual(run(*check).stdout, "one: OK\ntwo: OK\n")
        if not shutil.which("gpg"):
            return
        self.addCleanup(run, "gpgconf", "--kill", "all")
        generated = run("gpg", "--batch", "--passphrase", "", "--quick-generate-key", "test@localhost", "ed25519", "sign")
        self.assertEqual(generated.returncode, 0, generated.stderr)
        self.assertEqual(run(make, folder, LORENTZ_SIGN_KEY="test@localhost").returncode, 0)
        verify = ("gpg", "--verify", "SHA256SUMS.asc", "SHA256SUMS")
        self.assertEqual((run(*check).returncode, run(*verify).returncode), (0, 0))
        self.assertNotIn("asc", (folder / "SHA256SUMS").read_text())
        (folder / "SHA256SUMS").write_text((folder / "SHA256SUMS").read_text().replace("one", "eno"))
        self.assertNotEqual(run(*verify).returncode, 0)
        self.assertNotEqual(run(make, folder, LORENTZ_SIGN_KEY="nobody@localhost").returncode, 0)

    def test_the_archive_of_the_package_can_be_configured(self):
        """It holds each folder that CMake asks for: nothing is compiled here."""
        python = f"import lorentz_wheel; lorentz_wheel.build_sdist({str(self.folder)!r})"
        subprocess.run([sys.executable, "-c", python], cwd=SOURCE / "python", check=True)
        subprocess.run(["tar", "-xzf", next(self.folder.glob("*.tar.gz")), "--strip-components=1"], cwd=self.folder, check=True)
        settings = subprocess.run([sys.executable, "-c", "import lorentz_wheel; print(*lorentz_wheel.settings(False), sep='\\n')"],
                                  cwd=self.folder / "python", check=True, capture_output=True, text=True).stdout.splitlines()
        done = subprocess.run(["cmake", "--log-level=WARNING", "--preset", "release", "-DLORENTZ_PYTHON=OFF", *settings],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        planned = subprocess.run(["ninja", "-C", self.folder / "build", "-n", "all"], capture_output=True, text=True)
        self.assertEqual(planned.returncode, 0, planned.stdout)


if __name__ == "__main__":
    unittest.main()
