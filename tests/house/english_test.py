"""The habits that CONTRIBUTING.md drops, counted: english_test.py SOURCE. Each that is meant stands in MEANT."""

import json
import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
START = r"(?:^|(?<=[.;:!?|/*#-]\s)|(?<=[\"'`]))"
COMPARED = "longer|more|less|larger|smaller|wider|worse|exception"
HABITS = {
    "a sentence that begins with a genitive": START + r"Of\s(?!course|these|all|the\s\d)",
    "is none, is no ..": r"(?<![Tt]here\s)\b(?:(?:is|are|was|were)\snone\b|(?:is|are)\sno\s(?!" + COMPARED + ")[A-Za-z])",
    "a clause as a noun": r"\b[Ww]hat\sis\snot\b|\b[Ww]ho\s"
                          r"(?:is|has|asks|uses|calls|reads|wants|knows|draws|does|needs|writes|leaves|takes|sees|says)\b",
    "a vague number": r"\b[Ss]o\smany\b(?!(?:\s\w+)?\sthat\b)|\bsome\s\d|(?:^|(?<=[.!?]\s))Some\s\d|\b[Mm]ostly\b",
    "a person for a component": r"\b(?:[Ss]ome|[Nn]o|[Aa]ny)body\b|\b[Ww]hoever\b",
}
MEANT = 10
NOT_READ = re.compile(r"docs/(?:league|gallery)/|data/.*(?<!\.md)$")
# There a string is data. In the last three it is also copied into golden sets, which are committed.
DATA = ("tests/", "python/tests/", "fuzz/families/", "question/cases/bad_queries.cpp", "judge/golden/sets.cpp")


def language(comment, string="(?!)", title="(?!)"):
    return re.compile(f"(?P<comment>{comment})|(?P<title>{title})|(?P<string>{string})", re.DOTALL)


DOUBLE, SINGLE, BACK = r'(?<!\w)"(?:\\.|[^"\\\n])*"', r"(?<!\w)'(?:\\.|[^'\\\n])*'", r"`(?:\\.|[^`\\])*`"
STRING = f"{DOUBLE}|{SINGLE}|{BACK}"
# By the end of a file's name, or of the first line of a script whose name has none.
LANGUAGES = {
    ".cpp .hpp .h .c .rs .js .mjs .css":
        language(r"//[^\n]*(?:\n\s*//[^\n]*)*|/\*.*?\*/", r'R"\w*\(.*?\)\w*"|' + STRING, rf"\b(?:TEST_CASE|test)\(\s*(?:{STRING})"),
    ".py .pyi python3": language(r'#[^\n]*(?:\n\s*#[^\n]*)*|""".*?"""', f"{DOUBLE}|{SINGLE}"),
    ".v .ml": language(r"\(\*.*?\*\)", '"[^"]*"'),
    ".md .ipynb .sh .bash .cmake CMakeLists.txt /bin/sh": language(".+"),  # all of it: code of a shell does not look like English
}
CODE = re.compile(r"^```.*?^```|^\| instead of \|[^\n]*(?:\n\|[^\n]*)*|`[^`\n]*`|\"[^\"\n]*\"", re.DOTALL | re.MULTILINE)


def text_of(name):
    """A file's text. A notebook's is that of its cells of Markdown."""
    text = (SOURCE / name).read_text(errors="replace")
    return notebook_text(text) if name.endswith(".ipynb") else text


def notebook_text(text):
    return "\n".join("".join(cell["source"]) for cell in json.loads(text)["cells"] if cell["cell_type"] == "markdown")


def prose(name, text):
    """What people read in a file: pieces of its text, each with the number of its first line."""
    if name.endswith((".md", ".ipynb")):
        text = CODE.sub(lambda code: "x" + "\n" * code[0].count("\n"), text)
    end = name if "." in Path(name).name else text.partition("\n")[0]
    for pattern in [pattern for ends, pattern in LANGUAGES.items() if end.endswith(tuple(ends.split()))]:
        for piece in pattern.finditer(text):
            if piece["comment"] or piece["title"] or not name.startswith(DATA):
                yield text.count("\n", 0, piece.start()) + 1, re.sub(r"\n *(?://+|#+) ?", "\n", piece[0])


def habits(name, text):
    """(line, habit) of each that a file has."""
    return [(first + piece.count("\n", 0, match.start()), habit) for first, piece in prose(name, text)
            for habit, pattern in HABITS.items() for match in re.finditer(pattern, piece, re.MULTILINE)]


class English(unittest.TestCase):
    def test_habits(self):
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, text=True, check=True)
        names, found = [name for name in listed.stdout.split("\0")[:-1] if not NOT_READ.match(name)], []
        self.assertGreater(len(names), 1000)
        for name in names:
            text = text_of(name)
            found += [f"{name}:{line}: {habit}: {text.splitlines()[line - 1].strip()}" for line, habit in habits(name, text)]
        self.assertLessEqual(len(found), MEANT, "\n" + "\n".join(found))

    def test_the_patterns_see_them(self):
        for habit, line in zip(HABITS, ["- Of a miss there is no time.", "A query that is none.", "Who asks is told.",
                                        "It takes some 85 ns.", "Whoever wants it"]):
            self.assertRegex(line, HABITS[habit])
        self.assertFalse(habits("a.md", "If there is none, there is no time, or it is no larger.\n| Some 0 => so many that"))

    def test_what_is_read(self):
        for name, text, lines in [
                ("a.cpp", 'f("A", 1\'000);  // a thing that is\n  // no number\nf("Of it");', [1, 3]),
                ("tests/a.cpp", 'f("Of it");\n/// Of it\nTEST_CASE("Of it"', [2, 3]),
                ("a.js", "`\nOf ${it}`;\n/** Of it */ f('Of it');", [2, 3, 3]),
                ("tests/a.py", 'f("Of it")  # Of it\n"""Doc\n\nOf it."""\n', [1, 4]),
                ("a/run", "#!/usr/bin/env python3\nf('Of it', Of it)", [2]),
                ("b/run", "#!/bin/sh\n# Of it\necho x # Of it\n", [2, 3]),
                ("a.v", "Of x. (* Of\nit *)\n", [1]), ("a.md", "```\nOf it\n```\n`Of` Of it\nOf it", [5]), ("a.ipynb", "It\nOf it", [2]), ("a.json", '"Of it"', [])]:
            self.assertEqual([line for line, _ in habits(name, text)], lines, name)
        cells = [{"cell_type": "markdown", "source": ["Of it\n", "and"]}, {"cell_type": "code", "source": ["# Of it"]},
                 {"cell_type": "markdown", "source": ["Of her"]}]
        self.assertEqual(notebook_text(json.dumps({"cells": cells})), "Of it\nand\nOf her")


if __name__ == "__main__":
    unittest.main()
