"""Writes the mutants of a file into a copy of it, so that one build has them all.

C++: a function with mutants has its body once for each, and then as it is, with notes of the statements at
which mutants stand. Python: the file becomes one that runs the variant asked for. OCaml: a program each.
"""

import collections
import os
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
PYTHON_STUB = """import os as _os
_variants = _os.path.join(_os.path.dirname(_os.path.abspath(__file__)), "{name}.mutants")
_variant = _os.path.join(_variants, _os.environ.get("LORENTZ_MUTANT", "") + ".py")
if not _os.path.exists(_variant):
    _variant = _os.path.join(_variants, "0.py")
exec(compile(open(_variant, encoding="utf-8").read(), __file__, "exec"))
"""
PYTHON_NOTE = """def _reached(n):
    if "LORENTZ_REACHED" in _os.environ:
        _file = _os.open(_os.environ["LORENTZ_REACHED"], _os.O_WRONLY)
        _os.pwrite(_file, b"\\1", n)
        _os.close(_file)
"""


def spliced(source, begin, changes):
    """source[begin:..] with changes of (begin, end, bytes), which do not overlap."""
    for first, last, text in sorted(changes, reverse=True):
        source = source[:first - begin] + text + source[last - begin:]
    return source


def cpp(source, mutants):
    """The file's new text."""
    bodies = collections.defaultdict(list)
    for number, one in mutants:
        bodies[one.body].append((number, one))
    result = source
    for (begin, end, is_void), those in sorted(bodies.items(), reverse=True):
        body, text = source[begin:end], b""
        leave = b"return;" if is_void else b"__builtin_trap();"
        for number, one in those:
            mutated = spliced(body, begin, [(one.begin, one.end, one.text.encode())])
            text += b"\nif (LORENTZ_MUTANT(%d)) {%s\n%s}//mutant %d\n" % (number, mutated, leave, number)
        text += spliced(body, begin, [(one.here, one.here, b"LORENTZ_REACHED(%d); " % number) for number, one in those])
        result = result[:begin] + text + result[end:]
    return b'#include "%s"\n' % os.fsencode(HERE / "switch.hpp") + result


def owners(text):
    """{line: number} of those lines that belong to a mutant. The body as it is belongs to the last mutant before it: where
    all bodies together make no function, such as one that returns a closure, the compiler complains of the last."""
    result, inside, began, last, left = {}, 0, 0, 0, 0
    for n, line in enumerate(text.decode().split("\n"), 1):
        if line.startswith("if (LORENTZ_MUTANT("):
            inside, began = int(line[len("if (LORENTZ_MUTANT("):].split(")")[0]), n
        if inside:
            result[n] = inside
        elif left > 0:
            result[n], left = last, left - 1
        if inside and line.endswith(f"//mutant {inside}"):
            last, left, inside = inside, n - began, 0
    return result


def python(root, path, mutants):
    """Writes, in a copy of the tree at `root`, the file and a folder of its variants beside it."""
    file = root / path
    source = file.read_bytes()
    folder = file.parent / (file.name + ".mutants")
    folder.mkdir()
    for number, one in mutants:
        (folder / f"{number}.py").write_bytes(spliced(source, 0, [(one.begin, one.end, one.text.encode())]))
    notes = collections.defaultdict(list)
    for number, one in mutants:
        notes[one.here].append(number)
    changes = []
    for here, numbers in notes.items():
        if here == 0:
            continue
        line = source[here:source.find(b"\n", here)]
        indent = line[:len(line) - len(line.lstrip())]
        changes.append((here, here, b"".join(indent + b"_reached(%d)\n" % n for n in numbers)))
    noted = spliced(source, 0, changes)
    (folder / "0.py").write_bytes(noted)
    always = "".join(f"_reached({n})\n" for n in notes.get(0, []))
    file.write_text(PYTHON_STUB.format(name=file.name).replace("exec(", PYTHON_NOTE + always + "exec(", 1))
