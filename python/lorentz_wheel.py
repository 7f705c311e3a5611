"""Builds the package's wheel and source archive for pip (PEP 517). CMake builds and installs the package; the
wheel is a zip archive of the installed files. No other build tool is needed, so `pip install .` works without
access to an index.

With `--config-settings program=yes` the wheel also contains the command `lorentz` (`./run wheel`).
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build-python"
TEXT = (ROOT / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(lorentz VERSION ([0-9.]+)", TEXT).group(1)
INFO = f"lorentz-{VERSION}.dist-info"
TAG = "-".join([f"cp{sys.version_info[0]}{sys.version_info[1]}"] * 2 +
               [re.sub(r"[-.]", "_", sysconfig.get_platform())])
METADATA = f"""Metadata-Version: 2.1
Name: lorentz
Version: {VERSION}
Summary: The periodic Lorentz gas, exactly: which obstacle is hit first?
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: plot
Requires-Dist: matplotlib; extra == 'plot'
"""
# The files in an archive of the sources: those from which the extension module is compiled.
WANTED = re.compile(r"(CMakeLists|CMakePresets|LICENSE|README|pyproject|packages|packaging/cmake/|include/|src/|oracle/|question/|"
                    r"report/|statistics/|fuzz/|judge/|python/|"
                    r"data/scenes/|data/golden/)")
UNWANTED = re.compile(r"^python/tests/|^oracle/proof/|^fuzz/planted/|^report/web/")


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    write_info(Path(metadata_directory))
    return INFO


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"lorentz-{VERSION}-{TAG}.whl"
    with_program = (config_settings or {}).get("program") == "yes"
    with tempfile.TemporaryDirectory() as folder:
        install(Path(folder), with_program)
        write_info(Path(folder))
        if with_program:
            (Path(folder) / INFO / "entry_points.txt").write_text("[console_scripts]\nlorentz = lorentz._program:main\n")
        pack(Path(folder), Path(wheel_directory) / name)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Archives only the package's sources: no tests, no command line, no documents except the package's
    own."""
    name = f"lorentz-{VERSION}"
    archive = Path(sdist_directory) / f"{name}.tar.gz"
    with tarfile.open(archive, "w:gz", format=tarfile.PAX_FORMAT) as tar:
        for path in sources():
            tar.add(ROOT / path, f"{name}/{path}", recursive=False)
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as info:
            info.write(METADATA)
            info.flush()
            tar.add(info.name, f"{name}/PKG-INFO")
    return archive.name


def sources():
    git = subprocess.run(["git", "ls-files"], cwd=ROOT, check=False, stdout=subprocess.PIPE, text=True)  # it says why not
    if git.returncode != 0:
        sys.exit("lorentz: the archive of sources has what git lists: make it in a clone")
    return [path for path in git.stdout.split("\n") if WANTED.match(path) and not UNWANTED.search(path)]


def install(folder, with_program):
    """Installs the package together with its scenes and golden sets."""
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    targets = ["lorentz_python"] + ["lorentz"] * with_program
    is_archive = not (ROOT / "cli").exists()  # of the package's sources: built in less than five minutes of processor time
    print("lorentz: building the extension module: some minutes of processor time", file=sys.stderr, flush=True)
    for command in (["cmake", "--log-level=WARNING", "--preset", "python", "-DBUILD_TESTING=OFF", "-DLORENTZ_PYTHON_DIR=.",
                     f"-DLORENTZ_CLI={'ON' if with_program else 'OFF'}", f"-DPython3_EXECUTABLE={sys.executable}",
                     f"-DLORENTZ_AVX512={'OFF' if is_archive else 'ON'}"],
                    ["cmake", "--build", BUILD, "--target", *targets, "-j", jobs],
                    ["cmake", "--install", BUILD, "--component", "python", "--prefix", folder, "--strip"]):
        subprocess.run(command, cwd=ROOT, check=True)
    if with_program:
        (folder / "lorentz" / "bin").mkdir()
        subprocess.run(["strip", BUILD / "lorentz", "-o", folder / "lorentz" / "bin" / "lorentz"], check=True)
    for data in ("scenes", "golden"):
        shutil.copytree(ROOT / "data" / data, folder / "lorentz" / "data" / data)


def write_info(folder):
    info = folder / INFO
    info.mkdir()
    (info / "METADATA").write_text(METADATA)
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: lorentz\nRoot-Is-Purelib: false\nTag: {TAG}\n")
    shutil.copy(ROOT / "LICENSE", info)


def pack(folder, wheel):
    """Packs all files below the folder, and RECORD, which lists the checksum and size of each."""
    record = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file in sorted(path for path in folder.rglob("*") if path.is_file()):
            name = file.relative_to(folder).as_posix()
            archive.write(file, name)
            digest = base64.urlsafe_b64encode(hashlib.sha256(file.read_bytes()).digest()).rstrip(b"=").decode()
            record.append(f"{name},sha256={digest},{file.stat().st_size}\n")
        archive.writestr(f"{INFO}/RECORD", "".join(record) + f"{INFO}/RECORD,,\n")
