"""The habits that CONTRIBUTING.md drops, counted: english_test.py SOURCE. Each that is meant stands in MEANT."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
START = r"(?:^|(?<=[.;:!?|] )|(?<=/// )|(?<=// )|(?<=- ))"
HABITS = {
    "a sentence that begins with a genitive": START + r"Of (?!course|these|all|the \d)",
    "is none, is no ..": r"\b(?:is|are|was|were) none\b|\b(?:is|are) no (?!longer|more|less|exception)[a-z]",
    "a clause as a noun": r"\b[Ww]hat is not\b|\b[Ww]ho (?:is|has|asks|uses|calls|reads|wants|knows|draws|does|needs|writes|leaves|takes|sees|says)\b",
    "a vague number": r"\b[Ss]o many\b|\b[Ss]ome \d|\b[Mm]ostly\b",
    "a person for a component": r"\b(?:[Ss]ome|[Nn]o|[Aa]ny)body\b|\b[Ww]hoever\b",
}
MEANT = 10
GENERATED = ("docs/league/", "docs/report/", "docs/gallery/")


def files():
    listed = subprocess.run(["git", "ls-files", "*.md", "include"], cwd=SOURCE, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split() if not name.startswith(GENERATED)]


def prose(name):
    """Numbered lines that people read: no blocks of code, no table of what not to write."""
    text = (SOURCE / name).read_text()
    if name.startswith("include/"):
        return [(number, line.split("//", 1)[1]) for number, line in enumerate(text.split("\n"), 1) if "//" in line]
    is_code, is_table_of_habits, lines = False, False, []
    for number, line in enumerate(text.split("\n"), 1):
        is_code ^= line.startswith("```")
        is_table_of_habits = line.startswith("| instead of |") or (is_table_of_habits and line.startswith("|"))
        if not is_code and not is_table_of_habits:
            lines.append((number, re.sub(r"`[^`]*`|\"[^\"]*\"", "x", line)))
    return lines


class English(unittest.TestCase):
    def test_habits(self):
        names, found = files(), []
        self.assertGreater(len(names), 60)
        for name in names:
            for number, line in prose(name):
                found += [f"{name}:{number}: {habit}: {line.strip()}" for habit, pattern in HABITS.items() if re.search(pattern, line)]
        self.assertLessEqual(len(found), MEANT, "\n" + "\n".join(found))

    def test_the_patterns_see_them(self):
        for habit, line in zip(HABITS, ["- Of a miss there is no time.", "A query that is none.", "Who asks is told.",
                                        "It takes some 85 ns.", "Whoever wants it"]):
            self.assertRegex(line, HABITS[habit])


if __name__ == "__main__":
    unittest.main()
