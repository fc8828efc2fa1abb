"""Light as it is: transfer curves, plates whose highlights are given back, what inspect says about range and focus."""
import unittest

from pictures import attribute, picture, read_exr, read_png, write_exr, write_png
from program import CAMERA, CommandLineTest


class Light(CommandLineTest):
    def plate(self):
        """White dots on grey, sharp on the left, far behind focus on the right."""
        rows = [[code for x in range(96) for code in [255 if x % 24 == 12 and y == 12 else 90] * 3] for y in range(24)]
        write_png(self.path("plate.png"), rows)
        write_exr(self.path("depth.exr"), picture(96, 24, 0.5, lambda x, y: 2.0 if x < 48 else 40.0))
        return ["defocus", "plate.png", "--depth", "depth.exr", *CAMERA]

    def test_transfer_holds_for_what_is_read_and_written(self):
        write_png(self.path("in.png"), [[0, 64, 128, 255] * 6] * 8, channels=1)
        for name in ("srgb", "gamma2.2", "gamma2.0", "linear"):
            self.succeed("develop", "in.png", "-o", "out.png", "--transfer", name, "--no-dither")
            self.assertEqual(read_png(self.path("out.png"))[0][3][0:12:3], [0, 64, 128, 255], name)
        write_exr(self.path("in.exr"), picture(8, 8, 0.5, None))
        codes = set()
        for name in ("srgb", "gamma2.2", "gamma2.0", "linear"):
            self.succeed("develop", "in.exr", "-o", "out.png", "--transfer", name, "--tone", "none", "--no-dither")
            codes.add(read_png(self.path("out.png"))[0][0][0])
        self.assertEqual(codes, {188, 186, 180, 128})

    def test_expanded_highlights_glow_in_the_blur_and_leave_what_is_sharp(self):
        run = self.plate()
        self.succeed(*run, "-o", "plain.exr")
        self.succeed(*run, "-o", "expanded.exr", "--expand-highlights")
        plain, expanded = read_exr(self.path("plain.exr"))[0]["G"], read_exr(self.path("expanded.exr"))
        glow = max(row[x] for row in expanded[0]["G"] for x in range(70, 96)) - plain[0][95]
        dull = max(row[x] for row in plain for x in range(70, 96)) - plain[0][95]
        self.assertGreater(glow, 3 * dull)
        for y in range(24):
            self.assertEqual(expanded[0]["G"][y][0:20], plain[y][0:20])
        self.assertIn(b"assumed", expanded[1]["petzval:expandHighlights"])
        self.succeed(*run, "-o", "brighter.exr", "--expand-highlights", "--highlight-peak", "60")
        self.assertNotEqual(read_exr(self.path("brighter.exr"))[0]["G"], expanded[0]["G"])

    def test_expansion_is_refused_where_it_means_nothing(self):
        write_exr(self.path("hdr.exr"), picture(24, 16, 7.0, 2.0))
        self.refuse(2, "defocus", "hdr.exr", "-o", "out.exr", *CAMERA, "--expand-highlights", says=["7", "end at 1"])
        self.refuse(2, "defocus", "hdr.exr", "-o", "out.exr", *CAMERA, "--highlight-peak", "4", says=["--expand-highlights"])
        self.refuse(2, "defocus", "hdr.exr", "-o", "out.exr", *CAMERA, "--transfer", "linear", says=["PNG"])

    def test_contrast_and_tone_change_the_picture(self):
        write_exr(self.path("in.exr"), picture(32, 16, lambda x, y: 0.02 * x, None))
        pictures = []
        for flags in ([], ["--contrast", "1.4"], ["--tone", "reinhard"], ["--tone", "none"]):
            self.succeed("develop", "in.exr", "-o", "out.png", "--no-dither", *flags)
            pictures.append(read_png(self.path("out.png"))[0])
        for i, p in enumerate(pictures):
            self.assertNotIn(p, pictures[:i])

    def test_inspect_tells_the_range_and_warns_of_codes_taken_for_light(self):
        write_exr(self.path("light.exr"), picture(64, 32, lambda x, y: 9.0 if x == 5 else 0.02 if x < 32 else 0.64))
        report = self.report("inspect", "light.exr")
        self.assertAlmostEqual(report["dynamic_range"]["diffuse_over_shadow_stops"], 5, delta=0.1)
        self.assertFalse(report["dynamic_range"]["looks_encoded"])
        write_exr(self.path("codes.exr"), picture(64, 32, lambda x, y: (90 + x + y) / 255))
        report = self.report("inspect", "codes.exr")
        self.assertTrue(report["dynamic_range"]["looks_encoded"])
        self.assertIn("dull", " ".join(report["warnings"]))
        self.assertIn("stops", self.succeed("inspect", "light.exr").out)

    def test_inspect_tells_near_and_far_limit_and_hyperfocal_distance(self):
        write_exr(self.path("in.exr"), picture(1920, 1, 0.5))
        self.assertIsNone(self.report("inspect", "in.exr")["focus_limits"])
        camera = ["--focal-length", "50mm", "--sensor-width", "36mm", "--fstop", "2.8", "--focus", "4m"]
        limits = self.report("inspect", "in.exr", *camera)["focus_limits"]
        self.assertAlmostEqual(limits["hyperfocal_m"], 23.810, places=2)
        self.assertAlmostEqual(limits["near_m"], 1 / (1 / 4 + 1 / 23.810), places=3)
        self.assertAlmostEqual(limits["far_m"], 1 / (1 / 4 - 1 / 23.810), places=3)
        wider = self.report("inspect", "in.exr", *camera, "--permissible-radius", "2")["focus_limits"]
        self.assertAlmostEqual(wider["hyperfocal_m"], 23.810 / 2, places=2)


if __name__ == "__main__":
    unittest.main()
