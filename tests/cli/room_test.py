"""Room for light that leaves a data window which ends inside the frame: given by default, and said."""
import struct
import unittest

from pictures import camera_attributes, picture, plane, read_exr, read_png, write_exr
from program import CommandLineTest

DISPLAY = (0, 0, 47, 39)
CAMERA = camera_attributes(280, 36, 2, 2)  # 8.7 px at 6 m and 48 px across


class Room(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("piece.exr"), picture(12, 10, 1, 6, alpha=1), display=DISPLAY, origin=(20, 16),
                  attributes=CAMERA)

    def out(self, *flags, source="piece.exr"):
        outcome = self.succeed("defocus", source, "-o", "out.exr", *flags)
        channels, attributes = read_exr(self.path("out.exr"))
        return outcome, channels, struct.unpack("<4i", attributes["dataWindow"])

    def light(self, channels):
        return sum(map(sum, channels["R"]))

    def test_an_autocropped_element_keeps_its_light_and_the_log_says_so(self):
        outcome, channels, window = self.out()
        self.assertAlmostEqual(self.light(channels), 120, delta=0.6)
        self.assertIn("data window grows by", outcome.err)
        self.assertLess(window[0], 15)
        self.assertGreater(window[2], 36)
        self.assertEqual(max(channels["A"][0]), 0)

    def test_off_cuts_it_and_auto_goes_beyond_the_frame(self):
        _, cut, window = self.out("--overscan", "off")
        self.assertEqual(window, (20, 16, 31, 25))
        self.assertLess(self.light(cut), 115)
        write_exr(self.path("rim.exr"), picture(12, 10, 1, 6, alpha=1), display=DISPLAY, origin=(2, 16),
                  attributes=CAMERA)
        _, _, inside = self.out(source="rim.exr")
        self.assertEqual(inside[0], 0)
        _, _, beyond = self.out("--overscan", "auto", source="rim.exr")
        self.assertLess(beyond[0], -4)
        self.assertEqual(beyond[2:], inside[2:])

    def test_inside_the_old_window_nothing_changes(self):
        _, cut, _ = self.out("--overscan", "off")
        _, grown, window = self.out()
        for y in range(10):
            for x in range(12):
                self.assertAlmostEqual(cut["R"][y][x], grown["R"][y + 16 - window[1]][x + 20 - window[0]], delta=5e-3)

    def test_what_stays_sharp_or_fills_the_frame_keeps_its_window(self):
        for flags in (["--fstop", "inf"], ["--focus", "6"]):
            self.assertEqual(self.out(*flags)[2], (20, 16, 31, 25))
        write_exr(self.path("full.exr"), picture(48, 40, 1, 6, alpha=1), attributes=CAMERA)
        self.assertEqual(self.out(source="full.exr")[2], DISPLAY)
        write_exr(self.path("wide.exr"), picture(60, 50, 1, 6), display=DISPLAY, origin=(-6, -5), attributes=CAMERA)
        self.assertEqual(self.out(source="wide.exr")[2], (-6, -5, 53, 44))

    def test_a_png_shows_it_too(self):
        self.succeed("defocus", "piece.exr", "-o", "out.png")
        self.succeed("defocus", "piece.exr", "-o", "cut.png", "--overscan", "off")
        out, cut = (read_png(self.path(name))[0] for name in ("out.png", "cut.png"))
        self.assertGreater(out[20][3 * 17], 20)
        self.assertEqual(cut[20][3 * 17], 0)

    def test_discs_that_are_wider_than_their_radius_fit(self):
        for flags in (["--squeeze", "2"], ["--lens", "petzval-laikin"], ["--distortion", "0.2"]):
            _, channels, _ = self.out("--overscan", "auto", *flags)
            for row in (channels["R"][0], channels["R"][-1]):
                self.assertLess(max(row), 2e-3, flags)


if __name__ == "__main__":
    unittest.main()
