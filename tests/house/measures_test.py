"""The house does not grow: measures_test.py SOURCE PROGRAM counts what a reader has to know, and holds it below a limit.

A limit is lowered when less is reached, and never raised: a change that adds a concept names the one that it removes.
"""

import re
import subprocess
import sys
import unittest
from collections import Counter
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
PROGRAM = sys.argv.pop(1)
NO_PRODUCTION = ("tests", "docs", "oracle/proof", "build", "fuzz/planted")
TYPE = re.compile(r"^ *(?:template <.*> *)?(?:struct|class|enum(?: class)?) +\w+(?: final)?(?: *:[^;{]*)? *\{", re.MULTILINE)

LIMITS = {"lines of production C++": 68_400, "type definitions": 815, "names of types in two files": 19, "libraries": 38,
          "subcommands": 24, "options": 190}


NAMED = re.compile(r"^ *(?:template <.*> *)?(?:struct|class|enum(?: class)?) +(\w+)(?: final)?(?: *:(?!:)[^;{]*)? *\{", re.MULTILINE)


def sources():
    for path in SOURCE.rglob("*"):
        if path.suffix in (".cpp", ".hpp", ".h") and not path.relative_to(SOURCE).as_posix().startswith(NO_PRODUCTION):
            yield path.read_text()


def helps(*command):
    """What --help says of the program, and of each of its subcommands."""
    asked = subprocess.run([PROGRAM, *command, "--help"], capture_output=True, check=True, text=True).stdout
    commands = asked.partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    names = re.findall(r"^  (\w[\w-]*)", commands, re.MULTILINE)
    return [asked] + [text for name in names for text in helps(*command, name)]


def counted():
    texts, pages = list(sources()), helps()
    homonyms = Counter(name for text in texts for name in set(NAMED.findall(text)))
    names = r"^  (?:-\w,)?--"
    return {"lines of production C++": sum(text.count("\n") for text in texts),
            "type definitions": sum(len(TYPE.findall(text)) for text in texts),
            "names of types in two files": sum(files > 1 for files in homonyms.values()),
            "libraries": sum(len(re.findall(r"^lorentz_library\(", path.read_text(), re.MULTILINE))
                             for path in SOURCE.rglob("CMakeLists.txt")
                             if not path.relative_to(SOURCE).as_posix().startswith("build")),
            "subcommands": len(pages) - 1,
            "options": sum(len(re.findall(names, page, re.MULTILINE)) - 1 for page in pages)}  # --help has no page of its own


class Measures(unittest.TestCase):
    def test_nothing_is_above_its_limit(self):
        now = counted()
        for name, limit in LIMITS.items():
            with self.subTest(name):
                self.assertGreater(now[name], limit // 2, "is it still counted?")
                self.assertLessEqual(now[name], limit)


if __name__ == "__main__":
    unittest.main()
