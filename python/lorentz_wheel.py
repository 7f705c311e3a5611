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
BUILD = ROOT / "build"
TEXT = (ROOT / "CMakeLists.txt").read_text()
VERSION = re.search(r"project\(lorentz VERSION ([0-9.]+)", TEXT).group(1)
INFO = f"lorentz-{VERSION}.dist-info"
TAG = "-".join([f"cp{sys.version_info[0]}{sys.version_info[1]}"] * 2 +
               [re.sub(r"[-.]", "_", sysconfig.get_platform())])
LINES = (ROOT / "packaging/address").read_text().splitlines()
ADDRESS = "".join(line for line in LINES if not line.startswith("#")).strip()  # packaging/say_address checks it
METADATA = f"""Metadata-Version: 2.1
Name: lorentz
Version: {VERSION}
Summary: The periodic Lorentz gas, exactly: which obstacle is hit first?
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: plot
Requires-Dist: matplotlib; extra == 'plot'
""" + (f"Project-URL: Repository, {ADDRESS}\n" if ADDRESS else "")
# The files in an archive of the sources: those from which the extension module is compiled.
WANTED = re.compile(r"(CMakeLists|CMakePresets|LICENSE|README|pyproject|packages|packaging/cmake/|packaging/address|include/|src/|oracle/|question/|"
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
    """Installs the package together with its scenes and golden sets. What a clone has compiled already is taken as it is."""
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
    targets = ["lorentz_python"] + ["lorentz"] * with_program
    print("lorentz: building the extension module, about a minute of processor time; the libraries, if they are not there yet, "
          "three more", file=sys.stderr, flush=True)
    for command in (["cmake", "--log-level=WARNING", "--preset", "release", "-DLORENTZ_PYTHON=ON",
                     f"-DLORENTZ_PYTHON_PROGRAM={sys.executable}", *settings(with_program)],
                    ["cmake", "--build", BUILD, "--target", *targets, "-j", jobs],
                    ["cmake", "--install", BUILD, "--component", "python", "--prefix", folder, "--strip"]):
        subprocess.run(command, cwd=ROOT, check=True)
    shutil.move(folder / "lib/python3/dist-packages/lorentz", folder)
    shutil.rmtree(folder / "lib")
    shutil.rmtree(folder / "share", ignore_errors=True)  # documents of the Debian package
    if with_program:
        (folder / "lorentz" / "bin").mkdir()
        subprocess.run(["strip", BUILD / "lorentz", "-o", folder / "lorentz" / "bin" / "lorentz"], check=True)
    for data in ("scenes", "golden"):
        shutil.copytree(ROOT / "data" / data, folder / "lorentz" / "data" / data)


def settings(with_program):
    """Options of CMake that do not change how a source is compiled, in a folder where some are compiled."""
    if not (ROOT / "cli").exists():  # an archive of the package's sources, compiled in half the time: batches take a tenth more
        return ["-DBUILD_TESTING=OFF", "-DLORENTZ_CLI=OFF", "-DLORENTZ_AVX512=OFF", "-DLORENTZ_GPU=OFF",
                "-DLORENTZ_HASTY=ON"]
    first = [] if (BUILD / "CMakeCache.txt").exists() else ["-DBUILD_TESTING=OFF"]
    return first + ["-DLORENTZ_MPI=OFF"] * with_program  # a wheel is for machines without MPI, too


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
