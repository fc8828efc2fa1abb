"""sheet --lenses: one picture through several lenses, each wide open."""
import unittest

from pictures import picture, write_exr
from program import CommandLineTest


def png_size(content):
    return int.from_bytes(content[16:20], "big"), int.from_bytes(content[20:24], "big")


class LensSheet(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.succeed("scene", "make", "night", "-o", "in.exr", "--width", "96", "--height", "54",
                     "--pinhole-samples", "4")

    def sheet(self, *flags):
        self.succeed("sheet", "in.exr", "-o", "s.png", "--overwrite", "--width", "96", *flags)
        return self.content("s.png")

    def test_each_lens_has_a_cell(self):
        size = png_size(self.sheet("--lenses", "ideal,doublet,petzval-portrait", "--columns", "3"))
        self.assertEqual(size, (3 * 98 - 2, 54))

    def test_lenses_are_wide_open_unless_told_otherwise(self):
        open_wide = self.sheet("--lenses", "petzval-portrait,doublet")
        self.assertEqual(open_wide, self.sheet("--lenses", "petzval-portrait,doublet", "--fstop", "open"))
        self.assertNotEqual(open_wide, self.sheet("--lenses", "petzval-portrait,doublet", "--fstop", "8"))
        self.assertNotEqual(open_wide, self.sheet("--lenses", "petzval-portrait,doublet", "--focus", "30m"))
        self.assertNotEqual(open_wide, self.sheet("--lenses", "petzval-portrait,doublet", "--no-labels"))

    def test_a_lens_that_does_not_open_so_far_says_so(self):
        outcome = self.succeed("sheet", "in.exr", "-o", "s.png", "--lenses", "petzval-portrait", "--fstop", "1.4")
        self.assertIn("petzval-portrait: opens to f/3.6, not to f/1.4", outcome.err)

    def test_what_cannot_be_is_refused(self):
        self.refuse(2, "sheet", "in.exr", "-o", "s.png", "--lenses", "doublet,nope", says=["nope"])
        self.refuse(2, "sheet", "in.exr", "-o", "s.png", says=["beauty.####.exr, or one picture with --lenses"])
        self.refuse(2, "sheet", "in.exr", "-o", "s.mp4", "--lenses", "doublet", says=["--lenses"])
        self.refuse(2, "sheet", "in.####.exr", "-o", "s.png", "--lenses", "doublet", says=["--lenses"])
        self.refuse(2, "sheet", "in.####.exr", "-o", "s.png", "--fstop", "4", says=["--fstop", "--lenses"])

    def test_defocus_opens_a_lens_as_far_as_it_goes(self):
        report = self.report("defocus", "in.exr", "-o", "o.exr", "--lens", "petzval-portrait", "--fstop", "open")
        self.assertAlmostEqual(report["camera"]["f_number"], 3.6, places=1)
        report = self.report("defocus", "in.exr", "-o", "o.exr", "--fstop", "open")
        self.assertAlmostEqual(report["camera"]["f_number"], 1.4, places=3)  # the file's: no limit
        words = "--fstop open: the lens ideal has no widest aperture"
        self.assertIn(words, self.succeed("defocus", "in.exr", "-o", "o.exr", "--fstop", "open").err)
        write_exr(self.path("bare.exr"), picture(32, 20, 0.5, 3))
        self.refuse(2, "defocus", "bare.exr", "-o", "o.exr", "--fstop", "open", "--focal-length", "50", says=[words, "2.8"])
        self.refuse(2, "scene", "make", "night", "-o", "n.exr", "--fstop", "open", says=["--fstop"])


if __name__ == "__main__":
    unittest.main()
