"""defocus --roi: part of a frame, bit for bit as in the whole."""
import json
import unittest

from pictures import read_exr
from program import CommandLineTest


class Region(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.succeed("scene", "make", "night", "-o", "in.exr", "--width", "192", "--height", "108",
                     "--pinhole-samples", "4")

    def check(self, region, *flags):
        self.succeed("defocus", "in.exr", "-o", "whole.exr", *flags)
        self.succeed("defocus", "in.exr", "-o", "part.exr", "--roi", "%d,%d,%d,%d" % region, "--overwrite", *flags)
        (whole, _), (part, _) = read_exr(self.path("whole.exr")), read_exr(self.path("part.exr"))
        x0, y0, x1, y1 = region
        self.assertEqual(sorted(part), sorted(whole))
        for channel, rows in part.items():
            self.assertEqual(rows, [row[x0:x1] for row in whole[channel][y0:y1]], (channel, flags))

    def test_is_that_part_of_the_whole_bit_for_bit(self):
        for flags in ([], ["--engine", "gather"], ["--engine", "gaussian"], ["--lens", "doublet", "--bloom", "0.1"],
                      ["--distortion", "0.1"]):
            self.check((70, 30, 130, 71), *flags)

    def test_display_pictures_are_as_large_as_the_region(self):
        self.succeed("defocus", "in.exr", "-o", "part.png", "--roi", "70,30,130,71")
        with open(self.path("part.png"), "rb") as file:
            head = file.read(24)
        self.assertEqual((int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")), (60, 41))

    def test_a_part_beyond_the_frame_is_cut_with_a_warning(self):
        warning = "--roi 150,90,300,200 extends beyond the frame of 192 x 108 pixels; the part 150,90,192,108 is rendered"
        outcome = self.succeed("defocus", "in.exr", "-o", "cut.exr", "--roi", "150,90,300,200", "--json", "r.json")
        self.assertIn("petzval: warning: " + warning, outcome.lines)
        self.assertIn(warning, json.loads(self.content("r.json"))["warnings"])
        inside = self.succeed("defocus", "in.exr", "-o", "inside.exr", "--roi", "150,90,192,108")
        self.assertNotIn("warning", inside.err)
        self.assertEqual(read_exr(self.path("cut.exr"))[0], read_exr(self.path("inside.exr"))[0])

    def test_what_has_no_pixels_is_refused(self):
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--roi", "300,0,400,50", says=["--roi", "192 x 108"])
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--roi=-50,-50,-10,-10", says=["--roi", "192 x 108"])
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--roi", "30,0,20,50", says=["--roi"])
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--roi", "0,0,9,9", "--view", "coc", says=["--roi"])


if __name__ == "__main__":
    unittest.main()
