"""The library for C as others see it: what it exports, how its structs lie in memory, and the examples that ask it.

interface_test.py LIBRARY SOURCE CC: what is expected lies beside this file, in symbols.txt and layout.txt.
"""
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LIBRARY, SOURCE, CC = Path(sys.argv.pop(1)).resolve(), Path(sys.argv.pop(1)).resolve(), sys.argv.pop(1)
HERE = Path(__file__).resolve().parent
INCLUDE, EXAMPLES = SOURCE / "include", SOURCE / "docs" / "examples"
STRICT = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", f"-I{INCLUDE}"]
STRUCT = re.compile(r"typedef struct (\w+) \{(.*?)\n\} \1;", re.DOTALL)
CONSTANT = re.compile(r"^ +(LORENTZ_\w+) = |^#define (LORENTZ_\w*INTERFACE) ", re.MULTILINE)
PRINTED = """hit, cell (27, 1), time 26.950854326278535
never, cell (0, 0), time nan
far, cell (0, 0), time 4.55e+19
inside, cell (0, 0), time nan
"""


def output(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def members(body):
    """The names of a struct's members."""
    plain = re.sub(r"/\*.*?\*/", "", body, flags=re.DOTALL)
    return re.findall(r"(\w+)(?:\[\d\])?(?=[,;])", plain)


def layout_program(headers):
    """A program in C that prints the constants, and the place and the size of each struct and member."""
    lines = ["#include <lorentz/lorentz.h>", "#include <stddef.h>", "#include <stdio.h>", "int main(void) {"]
    for header in headers:
        for names in CONSTANT.findall(header):
            name = "".join(names)
            lines.append(f'  printf("{name} %d\\n", (int){name});')
        for struct, body in STRUCT.findall(header):
            lines.append(f'  printf("{struct} %d\\n", (int)sizeof({struct}));')
            for member in members(body):
                lines.append(f'  printf("{struct}.{member} %d %d\\n", (int)offsetof({struct}, {member}), '
                             f'(int)sizeof((({struct}*)0)->{member}));')
    return "\n".join(lines + ["  return 0;", "}", ""])


class Interface(unittest.TestCase):
    def setUp(self):
        self.work = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def compiled(self, name, text, *arguments):
        (self.work / f"{name}.c").write_text(text)
        output(CC, *STRICT, "-o", self.work / name, self.work / f"{name}.c", *arguments)
        return self.work / name

    def linked(self):
        return [LIBRARY, f"-Wl,-rpath,{LIBRARY.parent}"]

    def test_it_exports_these_functions_and_no_other(self):
        defined = output("nm", "-D", "--defined-only", LIBRARY)
        names = sorted(line.split(" ", 1)[1] for line in defined.splitlines())
        self.assertEqual("".join(name + "\n" for name in names), (HERE / "symbols.txt").read_text())

    def test_its_name_has_the_number_of_the_interface(self):
        dynamic = output("readelf", "-d", LIBRARY)
        number = re.search(r"#define LORENTZ_INTERFACE (\d+)", (INCLUDE / "lorentz" / "lorentz.h").read_text())[1]
        self.assertIn(f"[liblorentz.so.{number}]", dynamic)
        self.assertNotIn("TEXTREL", dynamic)

    def test_structs_and_constants_are_where_they_were(self):
        headers = [(INCLUDE / "lorentz" / name).read_text() for name in ("engine.h", "lorentz.h")]
        text = layout_program(headers)
        self.assertEqual(text.count("sizeof(lorentz_"), 3)
        self.assertEqual(output(self.compiled("layout", text)), (HERE / "layout.txt").read_text())

    def test_the_example_in_c(self):
        program = self.compiled("ask", (EXAMPLES / "ask.c").read_text(), *self.linked())
        self.assertEqual(output(program), PRINTED)

    def test_the_header_is_cpp_too(self):
        text = "#include <lorentz/lorentz.h>\nint main() { return lorentz_interface() - LORENTZ_INTERFACE; }\n"
        (self.work / "one.cpp").write_text(text)
        output("c++", "-std=c++98", "-Wall", "-Wextra", "-Werror", f"-I{INCLUDE}", "-o", self.work / "one", self.work / "one.cpp",
               *self.linked())
        output(self.work / "one")

    @unittest.skipUnless(shutil.which("node") and (EXAMPLES / "javascript" / "node_modules" / "koffi").exists(),
                         "koffi is not installed: npm ci --ignore-scripts in docs/examples/javascript")
    def test_the_example_in_javascript(self):
        self.assertEqual(output("node", EXAMPLES / "javascript" / "ask.mjs", LIBRARY).replace("NaN", "nan"),
                         PRINTED.replace("4.55e+19", "45500000000000000000"))


if __name__ == "__main__":
    unittest.main()
