"""Each argument of a call draws in an order that the compiler chooses, so no call has two arguments that draw:
cases, and so campaigns and golden sets, would depend on the compiler. Braces are read from left to right.

usage: draws_test.py ROOT"""

import pathlib, re, sys, unittest

ROOT = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["question", "fuzz", "judge/golden", "statistics", "tests/digests"]
SOURCES = r"(?:random_?|drawn_?|source\.random|source\.scene)"
DRAWS = re.compile(rf"\b{SOURCES}\.(?!scene\b)[a-z_]+\(|\b[a-z_]+\((?:[^()]*,\s*)?(?:{SOURCES}|source)\s*[,)]")
NO_CALLS = {"if", "for", "while", "switch", "return", "sizeof"}


def arguments(text, start):
    """The arguments of the call whose parenthesis opens before `start`; none if it has no end."""
    result, depth, begun = [], 1, start
    for place in range(start, len(text)):
        depth += (text[place] in "([{") - (text[place] in ")]}")
        if depth == 0:
            return result + [text[begun:place]]
        if text[place] == "," and depth == 1:
            result.append(text[begun:place])
            begun = place + 1
    return []


def doubled(text):
    text = re.sub(r"//[^\n]*", "", text)
    return [call[1] for call in re.finditer(r"([A-Za-z_][\w:<>]*)\(", text)
            if call[1] not in NO_CALLS and sum(bool(DRAWS.search(a)) for a in arguments(text, call.end())) > 1]


class Draws(unittest.TestCase):
    def test_what_is_found(self):
        self.assertEqual(doubled("sum(scaled(a, random.uniform()), scaled(b, random.uniform()))"), ["sum"])
        self.assertEqual(doubled("turned(drawn.one_in(2), drawn_primitive(random, 3))"), ["turned"])
        self.assertEqual(doubled("f(random.uniform(), b); Vec{random.uniform(), random.uniform()}"), [])

    def test_no_call_draws_twice(self):
        for folder in FOLDERS:
            for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
                self.assertEqual(doubled(path.read_text()), [], f"{path}: name the draws, one after the other")


if __name__ == "__main__":
    unittest.main()
