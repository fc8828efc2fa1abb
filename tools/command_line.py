#!/usr/bin/env python3
"""Writes what the program says of its verbs into docs/reference/command-line.md, below the mark; --check only compares.

Usage: tools/command_line.py [--check] PROGRAM
"""
import pathlib
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs/reference/command-line.md"
MARK = "<!-- From here on: petzval help --format md;"


def page_of(program):
    said = subprocess.run([program, "help", "--format", "md"], check=True, capture_output=True, text=True).stdout
    text = PAGE.read_text()
    mark_end = text.index("-->", text.index(MARK)) + len("-->")
    return text[:mark_end] + "\n\n" + said.rstrip() + "\n"


def main():
    if sys.argv[1:] in ([], ["--help"]):
        sys.exit(__doc__)
    *options, program = sys.argv[1:]
    made = page_of(program)
    if options != ["--check"]:
        PAGE.write_text(made)
    elif made != PAGE.read_text():
        sys.exit(f"{PAGE.name} is not what the program says; run tools/command_line.py {program}")


if __name__ == "__main__":
    main()
