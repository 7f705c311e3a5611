"""The mutants of a Python file, by its syntax tree."""

import ast

from site_of import numbered, site

ENDS = {ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">"}
TURNS = {ast.Lt: ">", ast.LtE: ">=", ast.Gt: "<", ast.GtE: "<=", ast.Eq: "!=", ast.NotEq: "==", ast.In: "not in",
         ast.NotIn: "in", ast.Is: "is not", ast.IsNot: "is"}
SIGNS = {ast.Add: "-", ast.Sub: "+"}
UNITS = {ast.Mult: "//", ast.Div: "*", ast.FloorDiv: "*"}
NEIGHBOURS = {"min": "max", "max": "min", "any": "all", "all": "any", "floor": "ceil", "ceil": "floor"}


class File:
    def __init__(self, path, source):
        self.path, self.source, self.sites = path, source, []
        self.starts = [0]
        for line in source.split(b"\n"):
            self.starts.append(self.starts[-1] + len(line) + 1)

    def begin(self, node):
        return self.starts[node.lineno - 1] + node.col_offset

    def end(self, node):
        return self.starts[node.end_lineno - 1] + node.end_col_offset

    def text(self, node):
        return self.source[self.begin(node):self.end(node)].decode()

    def add(self, operator, begin, end, text, here):
        self.sites.append(site(self.path, self.source, operator, begin, end, text, (0, len(self.source)), here))

    def replace(self, operator, node, text, here):
        self.add(operator, self.begin(node), self.end(node), text, here)


def begins_a_line(file, node):
    at = file.begin(node)
    return not file.source[file.starts[node.lineno - 1]:at].strip() and not file.source[at:].startswith(b"elif")


def comparison(file, node, here):
    operands = [node.left, *node.comparators]
    for left, kind, right in zip(operands, node.ops, operands[1:]):
        begin, end = file.end(left), file.begin(right)
        between = file.source[begin:end].decode()
        if "(" in between or ")" in between:
            continue
        for operator, table in (("comparison's end", ENDS), ("comparison turned", TURNS)):
            if type(kind) in table:
                file.add(operator, begin, end, f" {table[type(kind)]} ", here)


def arithmetic(file, node, here):
    begin, end = file.end(node.left), file.begin(node.right)
    between = file.source[begin:end].decode()
    is_text = any(isinstance(part, (ast.JoinedStr, ast.List, ast.Tuple)) or isinstance(getattr(part, "value", 0), str)
                  for part in (node.left, node.right))
    if "(" in between or ")" in between or is_text:
        return
    for operator, table in (("sign", SIGNS), ("unit", UNITS)):
        if type(node.op) in table:
            file.add(operator, begin, end, f" {table[type(node.op)]} ", here)


def statement(file, node, here):
    leaves = isinstance(node, ast.If) and not node.orelse and isinstance(node.body[-1], (ast.Raise, ast.Return, ast.Continue))
    if leaves and begins_a_line(file, node):
        file.replace("guard dropped", node.test, "False", here)
    if isinstance(node, (ast.AugAssign, ast.Expr)) and not isinstance(getattr(node, "value", None), ast.Constant):
        file.replace("dropped statement", node, "pass", here)
    if isinstance(node, (ast.If, ast.While)) and not isinstance(node.test, ast.Constant):
        file.replace("condition turned", node.test, f"not ({file.text(node.test)})", here)
    if isinstance(node, ast.For):
        last = node.body[-1]
        if not isinstance(last, (ast.Return, ast.Raise)) and begins_a_line(file, last):
            file.add("first for all", file.end(last), file.end(last),
                     "\n" + " " * node.body[0].col_offset + "break", here)


def expression(file, node, here):
    if isinstance(node, ast.Compare):
        comparison(file, node, here)
    elif isinstance(node, ast.BinOp):
        arithmetic(file, node, here)
    elif isinstance(node, ast.BoolOp):
        for k in range(len(node.values)):
            rest = [file.text(value) for i, value in enumerate(node.values) if i != k]
            joint = " and " if isinstance(node.op, ast.And) else " or "
            file.replace("half a condition", node, "(" + joint.join(f"({part})" for part in rest) + ")", here)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.Not)):
        operator = "sign" if isinstance(node.op, ast.USub) else "condition turned"
        file.replace(operator, node, f"({file.text(node.operand)})", here)
    elif isinstance(node, ast.Constant) and type(node.value) is int:
        file.replace("constant", node, {0: "1", 1: "2", 2: "1"}.get(node.value, str(node.value + 1)), here)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        if node.func.id in NEIGHBOURS:
            file.replace("wrong neighbour", node.func, NEIGHBOURS[node.func.id], here)
        if node.func.id in ("abs", "sorted"):
            file.replace("unit", node.func, "", here)
    if isinstance(node, ast.Call) and not (isinstance(node.func, ast.Name) and node.func.id in NEIGHBOURS):
        for one, other in zip(node.args, node.args[1:]):
            a, b = file.text(one), file.text(other)
            simple = all(isinstance(part, (ast.Name, ast.Attribute, ast.Subscript)) for part in (one, other))
            if simple and a != b:
                file.add("wrong neighbour", file.begin(one), file.end(other), f"{b}, {a}", here)
    if isinstance(node, ast.Subscript) and not isinstance(node.slice, (ast.Slice, ast.Constant)) \
            and isinstance(node.slice, ast.Name) and len(node.slice.id) == 1:
        file.replace("first for all", node.slice, "0", here)


def visit(file, node, here):
    for child in ast.iter_child_nodes(node):
        if isinstance(child, (ast.JoinedStr, ast.arguments, ast.Import, ast.ImportFrom)):
            continue
        if child in getattr(node, "decorator_list", []) or child is getattr(node, "returns", None):
            continue
        inner = here
        if isinstance(child, ast.stmt):
            if begins_a_line(file, child):
                inner = file.starts[child.lineno - 1]
            statement(file, child, inner)
        else:
            expression(file, child, inner)
        visit(file, child, inner)


def sites(root, path):
    source = (root / path).read_bytes()
    file = File(path, source)
    visit(file, ast.parse(source), 0)
    return numbered(file.sites)


def compiles(text):
    try:
        compile(text, "mutant", "exec")
        return True
    except SyntaxError:
        return False
