"""./dev bench results: marked tables of pages are replaced by what their commands print, and kept where a command fails."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))
import results  # noqa: E402


class Results(unittest.TestCase):
    def test_every_marked_command_is_there_and_every_mark_is_closed(self):
        for page in results.PAGES.glob("*.md"):
            text = page.read_text()
            blocks = results.BLOCK.findall(text)
            self.assertEqual(len(blocks), text.count("<!-- ./dev") + text.count("<!-- tools/"), page)
            self.assertEqual(len(blocks), text.count("<!-- end -->"), page)
            for command, *_ in blocks:
                self.assertTrue(results.arguments(command)[1].is_file(), f"{page.name}: {command}")

    def test_a_table_is_replaced_and_kept_where_its_command_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "tools").mkdir()
            (root / "tools/good.py").write_text("print('| 1 |\\n\\n' + 30 * 'word ')")
            (root / "tools/bad.py").write_text("print('half a table'); raise SystemExit(1)")
            marked = "# Page\n\n<!-- tools/{0}.py -->\nold\n<!-- end -->\n\nprose\n"
            for name in ("good", "bad"):
                (root / f"{name}.md").write_text(marked.format(name))
            kept, results.PAGES, results.ROOT = (results.PAGES, results.ROOT), root, root
            try:
                with contextlib.redirect_stderr(io.StringIO()), self.assertRaisesRegex(SystemExit, "bad.md: tools/bad.py"):
                    results.main([])
            finally:
                results.PAGES, results.ROOT = kept
            good = (root / "good.md").read_text()
            self.assertIn("<!-- tools/good.py -->\n\n| 1 |\n\n```text\n$ tools/good.py\nword word", good)
            self.assertNotIn("old", good)
            self.assertLessEqual(max(map(len, good.split("\n"))), 100)
            self.assertEqual((root / "bad.md").read_text(), marked.format("bad"))


if __name__ == "__main__":
    unittest.main()
