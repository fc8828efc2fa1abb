"""Fails when a function or a file is too long to be one idea. Exceptions are listed here, with their reason.

Usage: check_sizes.py [repository root]. Needs code formatted by clang-format; generated *_table.inc do not count.
"""
import ast
import pathlib
import re
import sys

FUNCTION_LINES = 60
FILE_LINES = {".h": 300, ".cpp": 500, ".py": 500, "_test.cpp": 600}
# "path" or "path:function" -> why it may be longer. An entry that is no longer needed fails as well.
ALLOWED = {
    "src/scene/built_in/dynamic_range.cpp:add_still_life": "a still life is a list of things",
}

NOT_A_FUNCTION = re.compile(r"^(inline )?(namespace|class|struct|enum|union|extern|if|for|while|switch|do|else|catch)\b")
STRIP = re.compile(r'//[^\n]*|"(\\.|[^"\\])*"|\'(\\.|[^\'\\])\'|/\*.*?\*/', re.DOTALL)


def blank(match):
    """Comments and strings as nothing, with their line ends kept."""
    return "\n" * match[0].count("\n")


def cpp_functions(text):
    """(name, first line, number of lines) of each outermost function, by counting braces."""
    line, head, head_line, open_heads = 1, "", 1, []
    for c in STRIP.sub(blank, text):
        if c == "\n":
            line += 1
        if c == "{":
            open_heads.append((head.strip(), head_line))
        elif c == "}" and open_heads:
            start, first = open_heads.pop()
            inside = any(is_function(h) for h, _ in open_heads)
            if is_function(start) and not inside:
                yield start.split("(")[0].split()[-1].lstrip("*&"), first, line - first + 1
        if c in "{};":
            head = ""
        elif head or not c.isspace():
            head_line = head_line if head else line
            head += c


def is_function(head):
    head = re.sub(r"operator[^\w\s(]+", "operator", head)
    head = re.sub(r"^(#[^\n]*\n|\s|template\s*<[^>]*>|public:|private:|protected:)+", "", head)
    return "(" in head and not NOT_A_FUNCTION.match(head) and "=" not in head.split("(")[0]


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            yield node.name, node.lineno, node.end_lineno - node.lineno + 1


def too_long(root):
    """(key, message) of everything above its limit."""
    for folder in ("include", "src", "apps", "plugins", "tests", "bench", "tools"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in FILE_LINES:
                continue
            name, text = path.relative_to(root).as_posix(), path.read_text()
            limit = FILE_LINES["_test.cpp" if name.endswith("_test.cpp") else path.suffix]
            if text.count("\n") > limit:
                yield name, f"{name}: {text.count(chr(10))} lines, more than {limit}: two ideas?"
            functions = python_functions if path.suffix == ".py" else cpp_functions
            for function, line, lines in functions(text):
                if lines > FUNCTION_LINES:
                    yield (f"{name}:{function}",
                           f"{name}:{line}: {function} has {lines} lines, more than {FUNCTION_LINES}")


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    found = dict(too_long(root))
    wrong = [message for key, message in found.items() if key not in ALLOWED]
    wrong += [f"tools/check_sizes.py: {key} no longer needs its exception" for key in ALLOWED
              if key not in found and (root / key.split(":")[0]).exists()]
    print("\n".join(wrong) or "sizes: ok")
    sys.exit(bool(wrong))
