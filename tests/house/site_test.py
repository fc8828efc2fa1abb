"""The site: the start page lists every page; links that lead nowhere and pages that load from other hosts are found."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
import site_pages  # noqa: E402


class Site(unittest.TestCase):
    def faults(self, html):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder)
            (site / "there.png").touch()
            (site / "a.html").write_text(html)
            return list(site_pages.faults(site))

    def test_a_dead_link_and_a_foreign_script_are_found(self):
        self.assertEqual(self.faults('<a href="a.html#x">b</a> <img src="there.png"> <a href="https://c.org">d</a>'), [])
        self.assertIn("leads nowhere", self.faults('<a href="b.html">b</a>')[0])
        self.assertIn("leads nowhere", self.faults('<img alt="x" src="gallery/b.png">')[0])
        self.assertIn("loads https://fonts", self.faults('<link rel="stylesheet" href="https://fonts.org/a.css">')[0])
        self.assertIn("loads //cdn", self.faults('<script src="//cdn.org/a.js"></script>')[0])

    def test_a_section_of_the_start_page_links_to_every_page(self):
        site_pages.nav()  # exits with the names of the pages that are missing


if __name__ == "__main__":
    unittest.main()
