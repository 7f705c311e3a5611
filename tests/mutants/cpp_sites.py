"""The mutants of a C++ file, by its syntax tree (libclang)."""

import re

import clang.cindex
from clang.cindex import CursorKind as Kind

from site_of import numbered, site

clang.cindex.Config.set_library_file("/usr/lib/llvm-14/lib/libclang.so.1")

FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.DESTRUCTOR, Kind.FUNCTION_TEMPLATE,
             Kind.CONVERSION_FUNCTION}
LOOPS = {Kind.FOR_STMT, Kind.WHILE_STMT, Kind.DO_STMT, Kind.CXX_FOR_RANGE_STMT}
CALLS = {Kind.CALL_EXPR}
ENDS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
TURNS = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "!=", "!=": "=="}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
UNITS = {"*": "/", "/": "*", "*=": "/=", "/=": "*="}
HALVES = {"&&", "||"}
BINARY = {**ENDS, **TURNS, **SIGNS, **UNITS, **dict.fromkeys(HALVES)}
NEIGHBOURS = {"min": "max", "max": "min", "floor": "ceil", "ceil": "floor", "front": "back", "back": "front",
              "sin": "cos", "cos": "sin", "all_of": "any_of", "any_of": "all_of", "lower_bound": "upper_bound",
              "upper_bound": "lower_bound"}
SYMMETRIC = {"min", "max", "minmax", "swap", "gcd", "lcm", "hypot", "product", "sum"}  # in their arguments
WITHOUT = {"abs", "fabs", "sqrt"}
KEPT = {"clear", "reset"}
MACRO = re.compile(rb"[A-Z][A-Z0-9]+_[A-Z0-9_]+\b")
NO_EFFECT = ("assert", "reserve", "shrink_to_fit", "static_assert", "(void)")


class File:
    def __init__(self, path, source, unit):
        self.path, self.source, self.unit = path, source, unit
        self.sites = []

    def text(self, cursor):
        return self.source[cursor.extent.start.offset:cursor.extent.end.offset].decode()

    def add(self, operator, begin, end, text):
        self.sites.append(site(self.path, self.source, operator, begin, end, text, self.body, self.here))

    def own(self, cursor):
        """Written in this file, by no macro."""
        start, end = cursor.extent.start, cursor.extent.end
        return (start.file is not None and start.file.name == self.unit.spelling and end.file is not None
                and end.file.name == self.unit.spelling and start.offset < end.offset
                and "\n#define" not in self.source[start.offset:end.offset].decode(errors="replace")
                and not self.is_macro(cursor))

    @staticmethod
    def is_condition(loop, part):
        """In `for (a; b; c)` it is b, in other loops all but the body."""
        return loop.kind != Kind.FOR_STMT or part.kind in (Kind.BINARY_OPERATOR, Kind.CALL_EXPR, Kind.UNEXPOSED_EXPR)

    def is_macro(self, cursor):
        at = cursor.extent.start.offset
        return MACRO.match(self.source, at) is not None


def children(cursor):
    return list(cursor.get_children())


def operator_between(file, left, right):
    """The operator between two operands, and where it is; None unless nothing else but spaces stands there."""
    begin, end = left.extent.end.offset, right.extent.start.offset
    between = file.source[begin:end].decode()
    name = between.strip()
    # An operand in parentheses may begin before its cursor does.
    if name not in BINARY:
        return None, 0
    return name, begin + between.index(name)


def binary(file, cursor):
    parts = children(cursor)
    if cursor.kind in CALLS:  # of an operator: its operands, and between them its name
        parts = [part for part in parts if not part.spelling.startswith("operator")]
    if len(parts) != 2:
        return
    left, right = parts
    if left.extent.start.offset > right.extent.start.offset:
        return
    name, at = operator_between(file, left, right)
    if name is None:
        return
    after = at + len(name)
    if file.in_loop_head:  # what reads beyond an end may do anything, so the mistake here is one too few
        if name in ("<", "<="):
            file.add("last left out", right.extent.start.offset, right.extent.end.offset, f"({file.text(right)}) - 1")
        return
    if name in ENDS:
        file.add("comparison's end", at, after, ENDS[name])
    if name in TURNS:
        file.add("comparison turned", at, after, TURNS[name])
    if name in SIGNS and "string" not in cursor.type.spelling and '"' not in file.text(cursor):
        file.add("sign", at, after, SIGNS[name])
    if name in UNITS:
        file.add("unit", at, after, UNITS[name])
    if name in HALVES:
        file.add("half a condition", left.extent.start.offset, right.extent.end.offset, file.text(left))
        file.add("half a condition", left.extent.start.offset, right.extent.end.offset, file.text(right))


def unary(file, cursor):
    parts = children(cursor)
    text = file.text(cursor)
    if len(parts) != 1 or parts[0].extent.start.offset <= cursor.extent.start.offset:
        return
    at = cursor.extent.start.offset
    if text.startswith("-") and not text.startswith("--"):
        file.add("sign", at, at + 1, "")
    if text.startswith("!"):
        file.add("condition turned", at, at + 1, "")


def literal(file, cursor):
    text, at = file.text(cursor), cursor.extent.start.offset
    end = at + len(text)
    if file.in_subscript and text.isdigit():
        file.add("wrong neighbour", at, end, str(int(text) - 1) if int(text) else "1")
        return
    other = {"0": "1", "1": "2", "2": "1", "3": "2", "0.0": "1.0", "1.0": "0.5", "0.5": "1.0", "2.0": "1.0"}.get(text)
    if other:
        file.add("constant", at, end, other)
    elif text.isdigit() and len(text) < 6:
        file.add("constant", at, end, str(int(text) + 1))


def call(file, cursor):
    name = cursor.spelling
    arguments = [a for a in cursor.get_arguments() if a is not None]
    if any(not file.own(a) for a in arguments):
        return
    pairs = [] if name in SYMMETRIC else zip(arguments, arguments[1:])
    for one, other in pairs:  # wrong neighbour: two arguments of one type
        a, b = file.text(one), file.text(other)
        if a != b and one.type.get_canonical().spelling.replace("const ", "").strip(" &") \
                == other.type.get_canonical().spelling.replace("const ", "").strip(" &") and one.type.spelling:
            begin, end = one.extent.start.offset, other.extent.end.offset
            middle = file.source[one.extent.end.offset:other.extent.start.offset].decode()
            if middle.strip() == ",":
                file.add("wrong neighbour", begin, end, b + middle + a)
    text, at = file.text(cursor), cursor.extent.start.offset
    if name in NEIGHBOURS:
        where = text.find(name + "(")
        if where >= 0:
            file.add("wrong neighbour", at + where, at + where + len(name), NEIGHBOURS[name])
    if name in WITHOUT and len(arguments) == 1:
        file.add("unit", at, cursor.extent.end.offset, "(" + file.text(arguments[0]) + ")")
    if name == "size" and text.endswith(".size()"):
        file.add("last left out", at, cursor.extent.end.offset, "(" + text + " - 1)")


def is_subscript(cursor):
    return cursor.kind == Kind.ARRAY_SUBSCRIPT_EXPR or (cursor.kind in CALLS and cursor.spelling == "operator[]")


def subscript(file, cursor):
    parts = children(cursor)
    if cursor.kind in CALLS:
        parts = [part for part in parts if not part.spelling.startswith("operator")]
    if len(parts) != 2 or not file.own(parts[1]):
        return
    index, begin, end = file.text(parts[1]), parts[1].extent.start.offset, parts[1].extent.end.offset
    if not index.isdigit():
        file.add("first for all", begin, end, "0")


def member(file, cursor):
    """Another field of the same type."""
    field = cursor.referenced
    if field is None or field.kind != Kind.FIELD_DECL or field.semantic_parent is None:
        return
    kin = [f for f in field.semantic_parent.get_children() if f.kind == Kind.FIELD_DECL
           and f.type.get_canonical().spelling == field.type.get_canonical().spelling and f.spelling != field.spelling]
    text = file.text(cursor)
    if kin and text.endswith(field.spelling):
        end = cursor.extent.end.offset
        file.add("wrong neighbour", end - len(field.spelling), end, kin[0].spelling)


def is_expression(cursor):
    return cursor.kind.is_expression() or cursor.kind in (Kind.UNEXPOSED_EXPR,)


def statement(file, cursor):
    """What a block consists of: dropped."""
    text = file.text(cursor)
    begin, end = cursor.extent.start.offset, cursor.extent.end.offset
    if any(word in text for word in NO_EFFECT):
        return
    if is_expression(cursor):
        operator = "state kept" if any("." + word + "(" in text for word in KEPT) else "dropped statement"
        file.add(operator, begin, end, "")
    elif cursor.kind == Kind.IF_STMT:
        parts = children(cursor)
        if len(parts) == 2:
            last = text.rstrip(";} \n").split(";")[-1]
            leaves = any(word in last for word in ("return", "continue", "throw", "break"))
            end += 1 if file.source[end:end + 1] == b";" else 0
            file.add("guard dropped" if leaves else "dropped statement", begin, end, ";")
        if parts and file.own(parts[0]) and file.source[begin:parts[0].extent.start.offset].strip() == b"if (":
            condition = file.text(parts[0])
            file.add("condition turned", parts[0].extent.start.offset, parts[0].extent.end.offset, f"!({condition})")
    elif cursor.kind in LOOPS:
        body = children(cursor)[-1]
        if body.kind == Kind.COMPOUND_STMT and cursor.kind != Kind.DO_STMT:
            file.add("first for all", body.extent.end.offset - 1, body.extent.end.offset, " break; }")


def visit(file, cursor):
    """All of a function's body; `file.here` is the statement of a block that a site is in."""
    for part in cursor.get_children():
        if not file.own(part):
            continue
        in_block = cursor.kind in (Kind.COMPOUND_STMT,) or (cursor.kind in (Kind.CASE_STMT, Kind.DEFAULT_STMT)
                                                            and not part.kind.is_expression())
        kept = file.here, file.in_loop_head, file.in_subscript
        file.in_loop_head = cursor.kind in LOOPS and part.kind != Kind.COMPOUND_STMT and file.is_condition(cursor, part)
        file.in_subscript = is_subscript(cursor) and part.extent.start.offset > cursor.extent.start.offset
        # A label is not a statement that another one can be put before and be reached.
        if in_block and part.kind not in (Kind.CASE_STMT, Kind.DEFAULT_STMT):
            file.here = part.extent.start.offset
        if in_block:
            statement(file, part)
        kind = part.kind
        if kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR) or (
                kind == Kind.CALL_EXPR and part.spelling.startswith("operator")):
            binary(file, part)
        if kind == Kind.UNARY_OPERATOR:
            unary(file, part)
        elif kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            literal(file, part)
        elif kind in CALLS and not part.spelling.startswith("operator"):
            call(file, part)
        elif is_subscript(part):
            subscript(file, part)
        elif kind == Kind.MEMBER_REF_EXPR:
            member(file, part)
        if kind in (Kind.STATIC_ASSERT, Kind.TYPEDEF_DECL, Kind.TYPE_ALIAS_DECL):
            continue
        visit(file, part)
        file.here, file.in_loop_head, file.in_subscript = kept


def functions(file, cursor):
    """The bodies of functions, outermost ones, of this file."""
    for part in cursor.get_children():
        if part.location.file is None or part.location.file.name != file.unit.spelling:
            continue
        if part.kind in FUNCTIONS:
            bodies = [c for c in part.get_children() if c.kind == Kind.COMPOUND_STMT]
            if bodies and file.source[bodies[0].extent.start.offset:][:1] == b"{" and not file.is_macro(bodies[0]) \
                    and part.spelling != "main":
                yield part, bodies[0]
        elif part.kind in (Kind.NAMESPACE, Kind.CLASS_DECL, Kind.STRUCT_DECL, Kind.CLASS_TEMPLATE,
                           Kind.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION, Kind.LINKAGE_SPEC, Kind.UNEXPOSED_DECL):
            yield from functions(file, part)


def parse(root, path, arguments):
    return clang.cindex.Index.create().parse(str(root / path), args=arguments)


def sites(root, path, arguments):
    source = (root / path).read_bytes()
    unit = parse(root, path, arguments)
    file = File(path, source, unit)
    for function, body in functions(file, unit.cursor):
        is_void = function.kind in (Kind.CONSTRUCTOR, Kind.DESTRUCTOR) or function.result_type.spelling == "void"
        file.body = (body.extent.start.offset + 1, body.extent.end.offset - 1, is_void)
        file.here, file.in_loop_head, file.in_subscript = file.body[0], False, False
        visit(file, body)
    return numbered(file.sites)


def errors(root, path, arguments):
    """Lines of the file that clang refuses, or from which what it refuses was made."""
    unit = parse(root, path, arguments)
    lines = set()
    for one in unit.diagnostics:
        if one.severity < clang.cindex.Diagnostic.Error:
            continue
        for place in [one, *one.children]:
            if place.location.file and place.location.file.name == unit.spelling:
                lines.add(place.location.line)
    return lines
