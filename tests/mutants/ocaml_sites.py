"""The mutants of an OCaml file, by its words: no syntax tree is at hand, and the compiler refuses mutants that are not OCaml."""

import re

from site_of import numbered, site

WORDS = [
    ("comparison's end", r" < ", " <= "), ("comparison's end", r" <= ", " < "), ("comparison's end", r" > ", " >= "),
    ("comparison's end", r" >= ", " > "),
    ("comparison turned", r" < ", " > "), ("comparison turned", r" > ", " < "), ("comparison turned", r" <> ", " = "),
    ("sign", r" \+ ", " - "), ("sign", r" - ", " + "), ("unit", r" \* ", " / "),
    ("half a condition", r" && ", " || "), ("half a condition", r" \|\| ", " && "),
    ("condition turned", r"\bnot \(", "("),
    ("condition turned", r"\btrue\b", "false"), ("condition turned", r"\bfalse\b", "true"),
    ("wrong neighbour", r"\bfst ", "snd "), ("wrong neighbour", r"\bsnd ", "fst "),
    ("wrong neighbour", r"List\.for_all\b", "List.exists"), ("wrong neighbour", r"List\.exists\b", "List.for_all"),
    ("wrong neighbour", r"\bZ\.add\b", "Z.sub"), ("wrong neighbour", r"\bZ\.sub\b", "Z.add"),
    ("last left out", r"String\.length (\w+)", r"(String.length \1 - 1)"),
    ("constant", r"(?<![\w.'\"])0(?![\w.'])", "1"), ("constant", r"(?<![\w.'\"])1(?![\w.'])", "2"),
    ("constant", r"(?<![\w.'\"])([2-9]|\d\d+)(?![\w.'])", lambda m: str(int(m[0]) + 1)),
    ("dropped statement", r"(?<=; )(?!let|if|match)[a-z_.A-Z]+ [\w.!()]+( [\w.!()]+)*(?=;)", "()"),
]


def without_texts(source):
    """A text of the same length, with strings and comments blank."""
    blank = lambda m: re.sub(r"[^\n]", "~", m[0])
    return re.sub(r'"(\\.|[^"\\])*"|\(\*.*?\*\)', blank, source, flags=re.DOTALL)


def conditions(text):
    """`if c then` and `when c ->`: where c begins and ends, `if`s within it left alone."""
    for match in re.finditer(r"\bif (?P<c>(?:(?!\bif\b|\bthen\b).)*?) then\b|\bwhen (?P<w>(?:(?!->).)*?) ->", text, re.DOTALL):
        group = "c" if match["c"] is not None else "w"
        yield match.start(group), match.end(group)


def sites(root, path):
    source = (root / path).read_text()
    text, found = without_texts(source), []
    assert source.isascii()
    whole = (0, len(source))
    add = lambda *change: found.append(site(path, source.encode(), *change, whole, 0))
    for operator, pattern, replacement in WORDS:
        for match in re.finditer(pattern, text):
            if match.start() > 0:
                add(operator, match.start(), match.end(), match.expand(replacement) if isinstance(replacement, str)
                    else replacement(match))
    for begin, end in conditions(text):
        add("condition turned", begin, end, f"not ({source[begin:end]})")
        add("guard dropped", begin, end, "false")
    return numbered(found)
