"""What depth means: whole numbers are not metres, disparity has ends, maps of any size are taken, the program reports odd depth."""
import struct
import unittest

from pictures import camera_attributes, picture, plane, read_exr, write_exr, write_png
from program import CommandLineTest

WIDTH, HEIGHT = 32, 20
CAMERA = camera_attributes(50, 36, 2, 2)


class DepthMeaning(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(WIDTH, HEIGHT, 0.5, None), attributes=CAMERA)
        # White, near, on the left; black on the right.
        write_png(self.path("z.png"), plane(WIDTH, HEIGHT, lambda x, y: 65535 if x < 16 else 0), channels=1, bits=16)

    def depth(self, *flags, source="in.exr"):
        self.succeed("defocus", source, "-o", "z.exr", "--view", "depth", "-q", *flags)
        return read_exr(self.path("z.exr"))[0]["Z"]

    def test_whole_numbers_are_refused_until_one_says_what_they_mean(self):
        self.refuse(2, "defocus", "in.exr", "--depth", "z.png", "-o", "out.exr",
                    says=["z.png", "--depth-kind inverse", "--depth-range"])
        rows = self.depth("--depth", "z.png", "--depth-kind", "normalized", "--depth-range", "1,5")
        self.assertEqual((rows[5][3], rows[5][20]), (5, 1))
        rows = self.depth("--depth", "z.png", "--depth-kind", "planar", "--unit-scale", "65.535")
        self.assertAlmostEqual(rows[5][3], 65.535, places=3)

    def test_radii_in_whole_numbers_need_those_of_black_and_white(self):
        self.refuse(2, "defocus", "in.exr", "--depth", "z.png", "--depth-kind", "coc-px", "-o", "out.exr",
                    says=["z.png", "--depth-range", "pixels"])
        flags = ["--depth", "z.png", "--depth-kind", "coc-px", "--depth-range=-6,12"]
        self.succeed("defocus", "in.exr", "-o", "coc.exr", "--view", "coc", *flags)
        rows = read_exr(self.path("coc.exr"))[0]["coc_radius_px"]
        self.assertEqual((rows[5][3], rows[5][20]), (12, -6))

    def test_steps_of_one_code_are_no_edges(self):
        """A slope in 8 bits is blurred as the slope itself."""
        width, height = 160, 100

        def disparity(x, y):
            return 0.35 + 0.1 * x / width + 0.06 * y / height
        shade = picture(width, height, lambda x, y: 0.2 + 0.1 * ((x // 9 + y // 7) % 2), None)
        write_exr(self.path("cloth.exr"), shade, attributes=CAMERA)
        write_png(self.path("z8.png"), plane(width, height, lambda x, y: round(255 * disparity(x, y))), channels=1)
        write_exr(self.path("z.exr"), {"Z": plane(width, height, disparity)})
        flags = ["--depth-kind", "inverse", "--depth-range", "1,8", "--focal-length", "300", "--fstop", "1"]
        for name in ("z8.png", "z.exr"):
            self.succeed("defocus", "cloth.exr", "--depth", name, *flags, "-o", name + ".out.exr")
        found = self.report("compare", "z.exr.out.exr", "z8.png.out.exr")["psnr_lin"]
        self.assertGreater(found, 60)

    def test_affine_disparity_has_a_near_and_a_far_end(self):
        rows = self.depth("--depth", "z.png", "--depth-kind", "inverse", "--depth-range", "1,8")
        self.assertEqual((rows[5][3], rows[5][20]), (1, 8))
        rows = self.depth("--depth", "z.png", "--depth-kind", "inverse", "--depth-range", "1,inf")
        self.assertEqual((rows[5][3], rows[5][20]), (1, float("inf")))
        half = write_exr(self.path("half.exr"), picture(WIDTH, HEIGHT, 0.5, 0.5), attributes=CAMERA)
        rows = self.depth("--depth-kind", "inverse", "--depth-range", "1,4", source=half)
        self.assertAlmostEqual(rows[0][0], 1 / (0.5 / 1 + 0.5 / 4), places=5)

    def test_mist_is_a_curve_and_never_taken_unasked(self):
        channels = picture(WIDTH, HEIGHT, 0.5, None)
        channels["ViewLayer.Mist.Z"] = plane(WIDTH, HEIGHT, 0.25)
        write_exr(self.path("mist.exr"), channels, attributes=CAMERA)
        self.refuse(3, "defocus", "mist.exr", "-o", "out.exr",
                    says=["not a distance", "--depth-channel ViewLayer.Mist.Z", "--depth-kind mist"])
        rows = self.depth("--depth-channel", "ViewLayer.Mist.Z", "--depth-kind", "mist", "--depth-range", "5,25",
                          source="mist.exr")
        self.assertAlmostEqual(rows[HEIGHT // 2][WIDTH // 2], 15, delta=0.01)  # 5 + 20 sqrt(0.25), near the axis
        self.assertLess(rows[0][0], 14.9)  # by distance from the pinhole

    def test_maps_of_another_size_are_taken(self):
        write_png(self.path("small.png"), plane(7, 5, lambda x, y: 65535 if x < 4 else 0), channels=1, bits=16)
        report = self.report("defocus", "in.exr", "--depth", "small.png", "--depth-kind", "inverse", "--depth-range",
                             "1,8", "-o", "out.exr")
        self.assertTrue(any("7 x 5 for 32 x 20" in line for line in report["detected"]), report["detected"])
        rows = self.depth("--depth", "small.png", "--depth-kind", "inverse", "--depth-range", "1,8")
        self.assertEqual([rows[0][x] for x in (0, 15, 21, 31)], [1, 1, 8, 8])
        self.assertEqual(sorted(rows[0]), rows[0])
        self.assertTrue(all(1 < rows[0][x] < 8 for x in (17, 18, 19)), "a line from one value to the next")
        write_exr(self.path("small.exr"), {"Z": plane(7, 5, lambda x, y: 1.0 if x < 4 else 8.0)})
        rows = self.depth("--depth", "small.exr")
        self.assertEqual({v for row in rows for v in row}, {1, 8}, "distances are not mixed")
        self.assertEqual([rows[0][x] for x in (0, 17, 18, 19, 31)], [1, 1, 8, 8, 8])
        write_exr(self.path("big.exr"), {"Z": plane(64, 40, lambda x, y: 1.0 if x < 32 else 3.0)})
        rows = self.depth("--depth", "big.exr")
        self.assertEqual((rows[3][15], rows[3][16]), (1, 3))
        write_png(self.path("tall.png"), plane(5, 40, 9), channels=1, bits=16)
        self.assertIn("stretched", self.succeed("defocus", "in.exr", "--depth", "tall.png", "--depth-kind", "inverse",
                                                "-o", "out.exr").err)

    def test_a_map_lies_on_the_frame_not_on_the_cropped_picture(self):
        write_exr(self.path("crop.exr"), picture(8, 6, 0.5, None), display=(0, 0, WIDTH - 1, HEIGHT - 1), origin=(14, 4),
                  attributes=CAMERA)
        write_png(self.path("double.png"), plane(64, 40, lambda x, y: 65535 if x < 32 else 0), channels=1, bits=16)
        rows = self.depth("--depth", "double.png", "--depth-kind", "inverse", "--depth-range", "1,8", source="crop.exr")
        self.assertEqual(rows[2], [1, 1, 8, 8, 8, 8, 8, 8])

    def test_depth_that_can_hardly_be_metres_is_spoken_of(self):
        for value, words in ((lambda x, y: 0.2 + x / 100, "--depth-kind normalized"),
                             (lambda x, y: 1500 + 40 * x, "--unit-scale")):
            write_exr(self.path("odd.exr"), picture(WIDTH, HEIGHT, 0.5, value), attributes=CAMERA)
            self.assertIn(words, self.succeed("defocus", "odd.exr", "-o", "out.exr").err)
            self.assertIn(words, self.succeed("inspect", "odd.exr").out)
            self.assertNotIn(words, self.succeed("defocus", "odd.exr", "-o", "out.exr", "--depth-kind", "planar").err)

    def test_a_radius_larger_than_the_picture_is_spoken_of(self):
        write_exr(self.path("z.exr"), picture(WIDTH, HEIGHT, 0.5, 6), attributes=CAMERA)
        self.assertNotIn("larger than the picture", self.succeed("defocus", "z.exr", "-o", "out.exr").err)
        self.assertIn("larger than the picture",
                      self.succeed("defocus", "z.exr", "-o", "out.exr", "--focal-length", "850").err)

    def test_a_focal_length_in_metres_is_doubted(self):
        write_exr(self.path("z.exr"), picture(WIDTH, HEIGHT, 0.5, 6), attributes=CAMERA)
        for length, is_doubted in (("0.05", True), ("8mm", False)):
            error = self.succeed("defocus", "z.exr", "-o", "out.exr", "--focal-length", length).err
            self.assertEqual("look at their units" in error, is_doubted, error)

    def test_a_focus_where_no_surface_is_is_spoken_of(self):
        write_exr(self.path("z.exr"), picture(WIDTH, HEIGHT, 0.5, lambda x, y: 2 + x / 10), attributes=CAMERA)
        for flags in (["--focus", "200"], ["--focus", "80cm"], ["--focus", "3", "--unit-scale", "10m"]):
            error = self.succeed("defocus", "z.exr", "-o", "out.exr", "--focal-length", "300", *flags).err
            self.assertIn("no surface is in focus", error, flags)
        for flags in (["--focus", "3"], ["--focus", "1.9999"], ["--focus", "200", "--near-scale", "0"]):
            error = self.succeed("defocus", "z.exr", "-o", "out.exr", "--focal-length", "300", *flags).err
            self.assertNotIn("no surface is in focus", error, flags)
        sky = picture(WIDTH, HEIGHT, 0.5, lambda x, y: 2 if x < 9 else 0)
        write_exr(self.path("sky.exr"), sky, attributes=CAMERA)
        self.assertNotIn("no surface is in focus", self.succeed("defocus", "sky.exr", "-o", "out.exr", "--focus", "1km").err)

    def test_feet_and_inches_are_lengths(self):
        for text, metres in (("8ft", 2.4384), ("7ft6in", 2.286), ("7'6\"", 2.286), ("10in", 0.254), ("3'", 0.9144)):
            report = self.report("defocus", "in.exr", "--depth", "z.png", "--depth-kind", "inverse", "-o", "out.exr",
                                 "--focus", text)
            self.assertAlmostEqual(report["camera"]["focus_distance_m"], metres, places=9)
        for wrong in ("7ft6cm", "7ft6", "ft", "6in7ft"):
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--focus", wrong, says=["--focus", "8ft"])

    def test_a_range_that_is_held_sharp_says_the_focus_or_holds_it(self):
        write_exr(self.path("bare.exr"), picture(WIDTH, HEIGHT, 0.5, 3))
        camera = ["--focal-length", "50", "--sensor-width", "36", "--fstop", "2"]
        report = self.report("defocus", "bare.exr", "-o", "out.exr", *camera, "--focus-range", "1,3")
        self.assertAlmostEqual(report["camera"]["focus_distance_m"], 1.5)
        self.refuse(2, "defocus", "bare.exr", "-o", "no.exr", *camera, "--focus", "5", "--focus-range", "1,3",
                    says=["--focus-range 1,3", "5 m"])


if __name__ == "__main__":
    unittest.main()
