#!/usr/bin/env python3
"""Writes python/petzval/*.pyi from the annotated sources: every public name with its types and its docstring.

Usage: tools/python_stubs.py [--check]    --check fails where a stub differs from its source

Stubs spare type checkers the bodies, which ctypes leaves untyped. stubtest compares them with the running package.
"""
import ast
import pathlib
import sys

PACKAGE = pathlib.Path(__file__).resolve().parent.parent / "python/petzval"
MODULES = ["__init__", "arrays", "camera", "comparison", "errors", "files", "lens", "look", "run", "session", "shot"]


class Bare(ast.NodeTransformer):
    """Functions without bodies, classes without private members."""

    def visit_FunctionDef(self, node):  # noqa: N802: ast's name
        text = ast.get_docstring(node, clean=False)
        node.body = [ast.Expr(ast.Constant(text)) if text else ast.Expr(ast.Constant(...))]
        node.args.defaults = [shown(d) for d in node.args.defaults]
        node.args.kw_defaults = [shown(d) for d in node.args.kw_defaults]
        return node

    def visit_ClassDef(self, node):  # noqa: N802
        node.body = [self.visit(part) for part in node.body if is_public(part)]
        node.body = node.body or [ast.Expr(ast.Constant(...))]
        return node


def shown(default):
    return default if default is None or isinstance(default, (ast.Constant, ast.UnaryOp, ast.Tuple)) else ast.Constant(...)


def is_public(part):
    name = getattr(part, "name", "")
    if isinstance(part, ast.Expr):
        return isinstance(part.value, ast.Constant)
    return not name.startswith("_") or (name.startswith("__") and name != "__del__")


def top(part):
    """True for what a stub shows of a module: imports, public definitions, docstrings, public annotated names."""
    if isinstance(part, ast.Assign):
        target = part.targets[0]
        return isinstance(target, (ast.Name, ast.Tuple)) and not getattr(target, "id", "").startswith("_") \
            or getattr(target, "id", "") == "__all__"
    return is_public(part)


def literal(part):
    """A module's constants by their types, where their values mean nothing to a type checker."""
    if not isinstance(part, ast.Assign) or getattr(part.targets[0], "id", "") == "__all__":
        return [part]
    target, value = part.targets[0], part.value
    if isinstance(target, ast.Tuple):
        return [ast.AnnAssign(name, ast.Name("int"), None, 1) for name in target.elts]
    if isinstance(value, ast.Dict):
        return [ast.AnnAssign(target, ast.Name("dict"), None, 1)]
    if isinstance(value, ast.Call):
        return [ast.AnnAssign(target, value.func, None, 1)]
    return [part]


def stub(module):
    """The text of a stub."""
    tree = ast.parse((PACKAGE / f"{module}.py").read_text())
    parts = [shown_part for part in tree.body if top(part) for shown_part in literal(part)]
    tree.body = [Bare().visit(part) for part in parts]
    head = "# Written by tools/python_stubs.py; not edited.\n"
    return head + ast.unparse(ast.fix_missing_locations(tree)) + "\n"


def main(*words):
    wrong = []
    for module in MODULES:
        path = PACKAGE / f"{module}.pyi"
        if words != ("--check",):
            path.write_text(stub(module))
        elif not path.exists() or path.read_text() != stub(module):
            wrong.append(f"{path.name} is not what {module}.py says; run tools/python_stubs.py")
    print("\n".join(wrong) or "stubs: ok")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
