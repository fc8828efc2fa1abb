"""What is written from the table of the C API: the reference page, declarations for ctypes, a program of layouts."""
import re
import textwrap

from c_api_table import Enum, Function, Handle, Struct

UNITS = {"mm": "mm", "m": "m", "px": "pixels", "deg": "degrees", "um": "µm", "bytes": "bytes"}
ALWAYS = "invalid_argument, out_of_memory, internal"

# --- The page


def _unit(name):
    ending = name.rsplit("_", 1)[-1]
    return "" if ending == name or "_per_" in name else UNITS.get(ending, "")


def _cell(text):
    return text.replace("|", "\\|")


def _without_errors(doc):
    """The description, and the statuses behind "Errors:"."""
    found = re.search(r"\s*Errors: ([\w, ]+)\.", doc)
    return (doc.replace(found[0], "").strip(), found[1]) if found else (doc, "")


def _declared(function):
    def one(member):
        if member.calls:
            return f"{member.calls.returns} (*{member.name})({', '.join(map(one, member.calls.arguments))})"
        return f"{member.type} {member.name}"
    return f"{function.returns} {function.name}({', '.join(map(one, function.arguments)) or 'void'});"


def _of_function(function):
    doc, errors = _without_errors(function.doc)
    yield f"### {function.name}\n\n```text\n{_declared(function)}\n```\n"
    if doc:
        yield f"\n{_paragraph(doc)}\n"
    units = [f"`{a.name}` in {_unit(a.name)}" for a in function.arguments if _unit(a.name)]
    if units:
        yield f"\nUnits: {', '.join(units)}.\n"
    if function.returns == "petzval_status":
        yield f"\nErrors: {ALWAYS}{', ' + errors if errors else ''}.\n"
    yield "\n"


def _of_struct(struct):
    yield f"### {struct.name}\n\n"
    if struct.doc:
        yield f"{_paragraph(struct.doc)}\n\n"
    yield "| member | type | unit | |\n|---|---|---|---|\n"
    for field in struct.fields:
        kind = "function" if field.calls else field.type
        doc = f"`{_declared(field.calls)}` {field.doc}" if field.calls else field.doc
        yield f"| `{field.name}` | `{kind}` | {_unit(field.name)} | {_cell(doc)} |\n"
    yield "\n"


def _of_enum(enum):
    yield f"### {enum.name}\n\n"
    yield "| name | number | |\n|---|---|---|\n"
    for name, number, doc in enum.values:
        yield f"| `{name}` | {number} | {_cell(doc)} |\n"
    yield "\n"


def page(api):
    """docs/reference/c-api.md."""
    parts = ["# C API\n\nThis page is written by `tools/c_api.py` from the headers under `include/petzval`.\n"
             "[library.md](library.md) shows the functions in use.\n\n"]
    for section in api.sections:
        if section.title:
            parts.append(f"## {section.title}\n\n")
        elif section.preface:
            title, text = section.preface.split(": ", 1)
            parts.append(f"## {title}\n\n{_preface(text)}\n\n")
        for item in section.items:
            if isinstance(item, Handle):
                parts.append(f"### {item.name}\n\n{_paragraph('A handle. ' + item.doc)}\n\n")
            else:
                writer = {Enum: _of_enum, Struct: _of_struct, Function: _of_function}[type(item)]
                parts += writer(item)
    return "".join(parts).rstrip() + "\n"


def _paragraph(text):
    return textwrap.fill(text, 100, break_long_words=False, break_on_hyphens=False)


def _preface(text):
    """A sentence, and a list where its parts begin with a dash."""
    first, *others = text.split(" - ")
    items = [textwrap.fill(item, 100, initial_indent="- ", subsequent_indent="  ") for item in others]
    return "\n".join([_paragraph(first[:1].upper() + first[1:]), *([""] if items else []), *items])


# --- Declarations for ctypes

BASE = {"int": "c_int", "double": "c_double", "float": "c_float", "size_t": "c_size_t", "ptrdiff_t": "c_ssize_t",
        "uint64_t": "c_uint64", "uint32_t": "c_uint32", "char": "c_char"}


def _ctype(kind, api):
    kind = re.sub(r"\b(const|volatile)\b", "", kind).strip()
    if kind == "void":
        return "None"
    if kind in ("char*",):
        return "c_char_p"
    if kind == "void*":
        return "c_void_p"
    if kind.endswith("*"):
        return f"POINTER({_ctype(kind[:-1].strip(), api)})"
    if kind in {enum.name for enum in api.enums}:
        return "c_int"
    return BASE.get(kind, kind)


def _callback(function, api):
    arguments = ["c_void_p" if a.calls else _ctype(a.type, api) for a in function.arguments]
    return f"CFUNCTYPE({', '.join([_ctype(function.returns, api), *arguments])})"


def _wrapped(head, words, tail):
    """A list in lines of at most 110 columns."""
    lines, line = [], head
    for i, word in enumerate(words):
        word += tail if i == len(words) - 1 else ", "
        if len(line) + len(word.rstrip()) > 110:
            lines.append(line.rstrip())
            line = " " * 8
        line += word
    return "\n".join([*lines, line if words else head + tail])


def declarations(api):
    """python/petzval/_declared.py."""
    lines = ['"""Structs and prototypes of libpetzval.so. Written by tools/c_api.py from the headers; not edited."""',
             "from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int, c_size_t,",
             "                    c_ssize_t, c_uint64, c_void_p)", ""]
    for enum in api.enums:
        lines += [""] + [f"{name} = {number}" for name, number, _ in enum.values]
    for handle in api.handles:
        lines += ["", "", f"class {handle.name}(Structure):", '    """A handle."""']
    for struct in api.structs:
        lines += ["", "", f"class {struct.name}(Structure):", "    _fields_ = ["]
        lines += [f'        ("{f.name}", {_callback(f.calls, api) if f.calls else _ctype(f.type, api)}),'
                  for f in struct.fields]
        lines += ["    ]"]
    lines += ["", "", "# Name: type of the result, types of the arguments.", "PROTOTYPES = {"]
    lines += [_prototype(function, api) for function in api.functions if not is_of_files(function)]
    lines += ["}", "# The same of libpetzval-files.so.", "FILES_PROTOTYPES = {"]
    lines += [_prototype(function, api) for function in api.functions if is_of_files(function)]
    return "\n".join([*lines, "}"]) + "\n"


def is_of_files(function):
    """True for functions of libpetzval-files.so."""
    return function.name.startswith("petzval_files_")


def _prototype(function, api):
    head = f'    "{function.name}": ({_ctype(function.returns, api)}, ['
    return _wrapped(head, [_ctype(a.type, api) for a in function.arguments], "]),")


# --- Layouts


def layout_program(api, header):
    """C that prints "struct size", and "struct.member offset", one a line."""
    rows = []
    for struct in api.structs:
        rows.append(f'    printf("{struct.name} %zu\\n", sizeof({struct.name}));')
        rows += [f'    printf("{struct.name}.{f.name} %zu\\n", offsetof({struct.name}, {f.name}));'
                 for f in struct.fields]
    return "\n".join([f"#include <petzval/{header}>", "#include <stdio.h>", "int main(void) {", *rows,
                      "    return 0;", "}"]) + "\n"
