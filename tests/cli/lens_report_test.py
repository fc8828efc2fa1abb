"""petzval lens report: one page that any XML reader takes, with every figure, the same bytes each time; clear errors."""
import json
import os
import pathlib
import re
import unittest
import xml.etree.ElementTree as ElementTree

from program import CommandLineTest

SECTIONS = ["section", "discs", "aberrations", "rays", "texture", "field", "spots", "waves", "formation", "numbers"]
PICTURE = re.compile(r"data:image/png;base64,[A-Za-z0-9+/=]+")
BAD_NUMBER = re.compile(r'="[^"]*\b(nan|inf)\b[^"]*"', re.IGNORECASE)
LENSES = pathlib.Path(__file__).resolve().parents[2] / "lenses"


class LensReport(CommandLineTest):
    def page(self, path):
        text = pathlib.Path(self.path(path)).read_text(encoding="utf-8")
        root = ElementTree.fromstring(text)  # well-formed, or it raises
        return PICTURE.sub("", text), root

    def check_page(self, path, drawings):
        text, root = self.page(path)
        found = [section.get("id") for section in root.iter("section")]
        for section in SECTIONS:
            self.assertIn(section, found)
        figures = list(root.iter("figure"))
        self.assertGreaterEqual(len(figures), drawings)
        self.assertIsNone(BAD_NUMBER.search(text))
        for word in ("<script", "http://www.w3.org/1999", "src=\"http", "@import", "url("):
            self.assertNotIn(word, text)
        return text

    def test_a_lens_of_curves_has_every_figure(self):
        self.succeed("lens", "report", "doublet", "-o", "sheet.html")
        text = self.check_page("sheet.html", 20)
        for words in ("3 wavelengths", "31 wavelengths", "squared", "--cats-eye", "--coma", "b′/f = 0.5",
                      "b′/f = 2", "pinhole", "a line", "Contrast at f/2", "wavefront"):
            self.assertIn(words, text)
        self.assertLess(os.path.getsize(self.path("sheet.html")), 5e6)

    def test_a_prescription_has_its_numbers_and_history(self):
        self.succeed("lens", "report", "petzval-portrait", "-o", ".")
        text = self.check_page("petzval-portrait.html", 22)
        for words in ("Voigtländer", "1840", "S III", "Lagrange invariant", "Exit pupil", "Vignetting", "sagittal"):
            self.assertIn(words, text)

    def test_a_lens_file_is_named_after_its_file(self):
        file = self.path("my lens.json")
        pathlib.Path(file).write_text((LENSES / "singlet.json").read_text())
        self.succeed("lens", "report", file, "-o", "new/folder")
        self.check_page("new/folder/my-lens.html", 20)

    def test_curves_in_a_file_have_a_page_too(self):
        curves = {"id": "drawn", "name": "Drawn", "source": "this test", "focal_length_mm": 85, "f_number": 2, "units": "mm",
                  "pupil_height": [0, 15, 21.25], "curves": [{"wavelength_nm": "G", "shift": [0, -0.4, 0.3]}]}
        pathlib.Path(self.path("drawn.json")).write_text(json.dumps(curves))
        self.succeed("lens", "report", "drawn.json", "-o", "sheet.html")
        self.assertIn("85 mm", self.check_page("sheet.html", 20))

    def test_several_lenses_have_their_pages_and_stand_side_by_side(self):
        # --all is the same with every lens that ships; report_test.cpp draws the figures of all of them.
        file = self.path("my lens.json")
        pathlib.Path(file).write_text((LENSES / "singlet.json").read_text())
        report = self.report("lens", "report", "ideal", "doublet", file, "-o", "sheets")
        pages = ["ideal.html", "doublet.html", "my-lens.html"]
        self.assertEqual([pathlib.Path(p).name for p in report["outputs"]],
                         [*pages, "comparison.html", "contact-sheet.svg", "index.html"])
        for page in pages:
            self.check_page("sheets/" + page, 20)
        for sheet in ("index.html", "comparison.html"):
            text, root = self.page("sheets/" + sheet)
            self.assertEqual([a.get("href") for a in root.iter("a") if a.get("href") in pages], pages)
            self.assertIsNone(BAD_NUMBER.search(text))
        self.assertIn("doublet", self.page("sheets/contact-sheet.svg")[0])

    def test_lenses_that_would_share_a_page_are_refused(self):
        self.refuse(2, "lens", "report", "tessar", "tessar", "-o", "x", says=["two lenses", "tessar.html"])
        self.refuse(2, "lens", "report", "tessar", "nonesuch", "-o", "x", says=["nonesuch"])
        self.refuse(2, "lens", "report", "tessar", "ideal", says=["-o DIR"])
        self.refuse(2, "lens", "report", "tessar", "ideal", "-o", "x.html", says=["folder"])
        self.assertFalse(pathlib.Path(self.path("x")).exists())

    def test_the_same_lens_makes_the_same_bytes(self):
        for name in ("a.html", "b.html"):
            self.succeed("lens", "report", "ideal", "-o", name)
        self.assertEqual(pathlib.Path(self.path("a.html")).read_bytes(), pathlib.Path(self.path("b.html")).read_bytes())

    def test_wrong_use_is_refused_in_one_line(self):
        self.refuse(2, "lens", "report", "doublett", "-o", "x", says=["doublett", "doublet,"])
        self.refuse(2, "lens", "report", says=["a lens"])
        self.refuse(2, "lens", "report", "doublet", "--all", "-o", "x", says=["--all"])
        self.refuse(2, "lens", "report", "--all", says=["-o DIR"])
        self.refuse(2, "lens", "report", "--all", "-o", "all.html", says=["folder"])
        self.refuse(1, "lens", "report", "doublet", "-o", "missing/sheet.html", says=["missing"])
        pathlib.Path(self.path("taken")).write_text("a file")
        self.refuse(1, "lens", "report", "doublet", "-o", "taken", says=["taken"])
        self.refuse(1, "lens", "report", "doublet", "-o", "/proc/sheets", says=["/proc/sheets"])

    def test_a_page_that_is_there_can_be_left_alone(self):
        pathlib.Path(self.path("ideal.html")).write_text("mine")
        self.succeed("lens", "report", "ideal", "--no-clobber")
        self.assertEqual(pathlib.Path(self.path("ideal.html")).read_text(), "mine")


if __name__ == "__main__":
    unittest.main()
