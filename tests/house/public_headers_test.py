"""The public headers are clean under many warnings, alone and together in either order; together for
each compiler that is here. The version that they say is the project's.

public_headers_test.py INCLUDE
"""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]


def complaint(include, compiler, headers):
    text = "".join(f"#include <lorentz/{header}>\n" for header in headers)
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", f"-I{include}", *WARNINGS, "-x", "c++", "-"], input=text,
                          capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else f"{compiler}, {', '.join(headers)}:\n{done.stderr}"


def version_complaint(include):
    numbers = re.findall(r"#define LORENTZ_VERSION_\w+ (\d+)", (include / "lorentz" / "version.hpp").read_text())
    project = re.search(r"project\(lorentz VERSION ([0-9.]+)", (include.parent / "CMakeLists.txt").read_text())[1]
    return "" if ".".join(numbers) == project else f"version.hpp says {numbers}, the project is {project}"


def main():
    include = pathlib.Path(sys.argv[1])
    headers = sorted(path.name for path in (include / "lorentz").glob("*.h*"))
    compilers = [name for name in ("g++", "clang++") if shutil.which(name)]
    if len(headers) < 30 or not compilers:
        sys.exit(f"{len(headers)} headers, {compilers}")
    together, alone = [headers, headers[::-1]], [[header] for header in headers]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = [pool.submit(complaint, include, compiler, group)
                for compiler in compilers for group in together + (alone if compiler == compilers[0] else [])]
    complaints = [text for text in [*(job.result() for job in jobs), version_complaint(include)] if text]
    print("\n".join(complaints) or f"{len(headers)} headers, {', '.join(compilers)}")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
