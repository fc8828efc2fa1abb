"""Writes every ```c and ```cpp block of a page as a file of its own: block0.cpp, block1.c and so on.

Usage: library_blocks.py PAGE.md FOLDER CPP C. Fails if the page has fewer than CPP and C blocks of the two kinds.
"""
import pathlib
import re
import sys

page, folder, least_cpp, least_c = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
folder.mkdir(parents=True, exist_ok=True)
blocks = re.findall(r"^```(c|cpp)\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
for number, (kind, text) in enumerate(blocks):
    (folder / f"block{number}.{kind}").write_text(text)
kinds = [kind for kind, _ in blocks]
sys.exit(kinds.count("cpp") < least_cpp or kinds.count("c") < least_c)
