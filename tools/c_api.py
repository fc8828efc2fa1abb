#!/usr/bin/env python3
"""Reads the C headers as one table, and writes from it the reference page and the declarations for Python.

Usage: tools/c_api.py                      writes docs/reference/c-api.md and python/petzval/_declared.py
       tools/c_api.py --check LIBPETZVAL [LIBPETZVAL_FILES]
                                           fails if these, or the exported names, differ from the headers
       tools/c_api.py --layout             prints a C program that prints sizes and offsets of all structs

docs/explain/c-api.md says which form the headers keep.
"""
import pathlib
import subprocess
import sys

import c_api_table
import c_api_written

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEADERS = ROOT / "include/petzval"
NAMES = ["petzval_c.h", "petzval_lens_c.h", "petzval_frame_c.h", "petzval_files_c.h", "petzval_run_c.h"]
OPTIONAL = "vulkan.h"  # exported all or not at all
PAGE = ROOT / "docs/reference/c-api.md"
DECLARED = ROOT / "python/petzval/_declared.py"


def table():
    return c_api_table.read([HEADERS / name for name in NAMES])


def exported(library):
    """Names that the shared library shows, without that of its version."""
    listing = subprocess.run(["nm", "-D", "--defined-only", library], stdout=subprocess.PIPE, text=True, check=True)
    names = {line.split()[-1].split("@")[0] for line in listing.stdout.splitlines()}
    return {name for name in names if not name.startswith("PETZVAL_")}


def differences(api, library, files=None):
    """One sentence for each thing that differs from the headers."""
    made = {PAGE: c_api_written.page(api), DECLARED: c_api_written.declarations(api)}
    for path, text in made.items():
        if not path.exists() or path.read_text() != text:
            yield f"{path.relative_to(ROOT)} is not what the headers say; run tools/c_api.py"
    wanted = {function.name for function in api.functions if not c_api_written.is_of_files(function)}
    optional = {f.name for f in c_api_table.read([HEADERS / OPTIONAL]).functions}
    found = exported(library)
    yield from unlike(wanted | optional if optional & found else wanted, found)
    if files:
        yield from unlike({f.name for f in api.functions if c_api_written.is_of_files(f)}, exported(files))


def unlike(wanted, found):
    """One sentence for each name that is declared and not exported, or the other way round."""
    yield from (f"{name} is declared and not exported" for name in sorted(wanted - found))
    yield from (f"{name} is exported and not declared" for name in sorted(found - wanted))


def main(*words):
    api = table()
    if words == ("--layout",):
        print(c_api_written.layout_program(api, "petzval_files_c.h"), end="")
    elif words[:1] == ("--check",) and len(words) in (2, 3):
        found = list(differences(api, *words[1:]))
        print("\n".join(found) or f"c api: ok ({len(api.functions)} functions, {len(api.structs)} structs)")
        return bool(found)
    elif not words:
        PAGE.write_text(c_api_written.page(api))
        DECLARED.write_text(c_api_written.declarations(api))
    else:
        sys.exit(__doc__)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
