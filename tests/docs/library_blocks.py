"""Writes every ```c and ```cpp block of a page as a file of its own.

Usage: library_blocks.py PAGE.md FOLDER. Fails if there are fewer blocks than the page is known to have of each kind.
"""
import pathlib
import re
import sys

page, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
blocks = re.findall(r"^```(c|cpp)\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
for number, (kind, text) in enumerate(blocks):
    (folder / f"block{number}.{kind}").write_text(text)
kinds = [kind for kind, _ in blocks]
sys.exit(kinds.count("cpp") < 2 or kinds.count("c") < 1)
