"""One word, one thing; one home for JSON: words_test.py SOURCE"""

import re
import sys
import unittest
from collections import defaultdict
from pathlib import Path

SOURCE = Path(sys.argv.pop(1))
NOT_OURS = ("tests", "docs", "build")
# Names that two files may define: each is another thing in another room.
MOST_SHARED_NAMES = 19
TYPE = re.compile(r"^\s*(?:struct|class|enum class|enum|union)\s+(?:\[\[\w+\]\]\s+)?(\w+)(?:\s+final)?\s*(?::[^:;{]*)?\{", re.MULTILINE)
# A key of JSON with a value put behind it: `"{\"id\":" + id`, `",\"x\":{}"`.
GLUED = re.compile(r'\\"\w+\\":(?:"|\{\}|\[\{\}|\\"\{)')
TEXTS_OF_THEIR_OWN = {"question/cases/bad_queries.cpp",  # bad on purpose
                      "judge/golden/production.cpp"}  # reads what begins so


def sources():
    for path in sorted(SOURCE.rglob("*")):
        if path.suffix in (".cpp", ".hpp") and not path.relative_to(SOURCE).parts[0].startswith(NOT_OURS):
            yield path.relative_to(SOURCE).as_posix(), re.sub(r"//[^\n]*", "", path.read_text())


class Words(unittest.TestCase):
    def test_type_names(self):
        files = defaultdict(set)
        for name, text in sources():
            for word in TYPE.findall(text):
                files[word].add(name)
        shared = {word: sorted(where) for word, where in files.items() if len(where) > 1}
        self.assertGreater(len(files), 300)
        listed = "\n".join(f"{word}: {', '.join(where)}" for word, where in sorted(shared.items()))
        self.assertLessEqual(len(shared), MOST_SHARED_NAMES, listed)

    def test_the_glossary_s_types_are_there(self):
        table = (SOURCE / "CONTRIBUTING.md").read_text().partition("## Words")[2].partition("\n## ")[0]
        rows = re.findall(r"^\| ([a-z' ]+) \| [^|]+ \| `([\w:]+)` \|$", table, re.MULTILINE)
        self.assertGreater(len(rows), 35)
        self.assertEqual(len(rows), table.count("\n| ") - 1, "a row is not as the others are")
        for column in zip(*rows):
            self.assertEqual(len(set(column)), len(rows))
        code = "\n".join(text for _, text in sources())
        for _, name in rows:
            room, _, word = name.rpartition("::")
            self.assertRegex(code, rf"\b(?:struct|class|enum class) {word}\b|\busing {word} = ", name)
            self.assertTrue(not room or f"namespace lorentz::{room} {{" in code, name)

    def test_json_is_written_in_one_place(self):
        self.assertTrue(GLUED.search(r'out += "{\"id\":" + id'))
        glued = [f"{name}: {found}" for name, text in sources() if name not in TEXTS_OF_THEIR_OWN for found in GLUED.findall(text)]
        self.assertEqual(glued, [])


if __name__ == "__main__":
    unittest.main()
