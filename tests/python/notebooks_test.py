"""Every notebook runs from its first cell to its last; plots are drawn without a display.

Exits 77 (skipped) where numpy or matplotlib is missing.
"""
import json
import pathlib
import re
import sys
import unittest

try:
    import matplotlib
    import numpy  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing.name} is missing")
    sys.exit(77)

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "python/notebooks"
matplotlib.use("Agg")


class Notebooks(unittest.TestCase):
    def test_all_cells_run(self):
        found = sorted(NOTEBOOKS.glob("*.ipynb"))
        self.assertEqual(len(found), 3)
        for path in found:
            names = {}
            cells = json.loads(path.read_text())["cells"]
            for i, cell in enumerate(c for c in cells if c["cell_type"] == "code"):
                with self.subTest(notebook=path.name, cell=i):
                    exec(compile("".join(cell["source"]), f"{path.name} cell {i}", "exec"), names)
            matplotlib.pyplot.close("all")

    def test_the_blocks_of_the_readme_run(self):
        blocks = re.findall(r"^```python\n(.*?)^```", (NOTEBOOKS.parent / "README.md").read_text(), re.M | re.S)
        self.assertTrue(blocks)
        for block in blocks:
            exec(compile(block, "README.md", "exec"), {})

    def test_no_notebook_keeps_outputs(self):
        for path in NOTEBOOKS.glob("*.ipynb"):
            for cell in json.loads(path.read_text())["cells"]:
                self.assertFalse(cell.get("outputs"), path.name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
