#!/usr/bin/env python3
"""together_test.py BUILD: sources that are compiled together (packaging/cmake/LorentzLibrary.cmake) mean what each means by itself.

A name of one source's unnamed namespace is seen by those that are compiled behind it. Where it is a name of theirs, too,
the compiler may take the one for the other, and of two functions it does so without a word. So no such name may stand in
another source of the row: neither defined there nor used, but as a member or with its namespace in front.
"""
import pathlib
import re
import sys
import tempfile

DEFINITION = re.compile(
    r"^(?! )(?:template <.*?> )?(?:(?:struct|class|enum class|enum|union) (?:\[\[.*?\]\] )?(?P<type>\w+)"
    r"|using (?P<alias>\w+) ="
    r"|(?!return|using|namespace|template)(?:\[\[.*?\]\] )?[\w:<>,&*\[\]() ]*?[\w>&*\]] [&*]*(?P<value>\w+)(?:\(|\[|\{|;| =))")


def without_words(text):
    """The text without comments and strings, line by line as it was."""
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    return re.sub(r'"(?:\\.|[^"\\\n])*"|//[^\n]*', '""', text)


def unnamed(text):
    """Names that are defined in the unnamed namespaces of a source that clang-format has seen to."""
    names, inside = set(), False
    for line in text.splitlines():
        if line.startswith("namespace {"):
            inside = True
        elif inside and line == '}  ""':  # `}  // namespace`: what is in named ones is not indented either
            inside = False
        elif inside and (match := DEFINITION.match(line)):
            names.add(match["type"] or match["alias"] or match["value"])
    return names


def faults(sources):
    """What is seen by another of these sources, a line each."""
    texts = {source: without_words(source.read_text()) for source in sources}
    found = []
    for source, text in texts.items():
        for name in sorted(unnamed(text)):
            called = r"(?:<[^;(){}]*>)?\(" if name[0].islower() and not re.match("k[A-Z]", name) else ""  # else a variable of that name
            use = re.compile(rf"(?<![\w.:])(?<!->){name}\b{called}")
            for other, its in texts.items():
                if other is not source and (place := use.search(its)):
                    line = its.count("\n", 0, place.start()) + 1
                    found.append(f"{name}: in an unnamed namespace of {source}, and in {other}:{line}")
    return found


def check_itself():
    """A function, a constant and a type that another source uses are seen, members and variables of that name are not."""
    first = "namespace {\n\nvoid add(int n) {\n}\n\nconstexpr int kMost = 3;\n\nstruct Row {\n  int n;\n};\n\n}  // namespace\n"
    for text, count in (("void f() {\n  add(1);\n}\n", 1), ("void f() {\n  add<int>(1);\n}\n", 1), ("int n = kMost;\n", 1),
                        ("Row row;\n", 1), ("void f() {\n  a.add(1), b->add(2), c::add(3);  // add(4)\n}\n", 0),
                        ("int add = 4;\n", 0)):
        with tempfile.TemporaryDirectory() as folder:
            sources = [pathlib.Path(folder, name) for name in ("first.cpp", "second.cpp")]
            for source, its in zip(sources, (first, text)):
                source.write_text(its)
            assert len(faults(sources)) == count, (text, faults(sources))


def main():
    check_itself()
    build = pathlib.Path(sys.argv[1])
    rows = sorted(build.glob("*/**/Unity/unity_*.cxx"))
    if (plan := build / "build.ninja").exists():  # an older configuration may have left some
        text = plan.read_text()
        rows = [row for row in rows if str(row.resolve()) in text]
    if not rows:
        sys.exit(f"{build}: no sources are compiled together there")
    found, many = [], 0
    for row in rows:
        sources = [pathlib.Path(path) for path in re.findall(r'^#include "(.*)"$', row.read_text(), re.M)]
        many += len(sources)
        found += faults(sources)
    print("\n".join(found))
    print(f"{many} sources in {len(rows)} rows: {len(found)} names are seen by another source")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
