"""petzval defocus: every flag does what it says, every view holds what it names."""
import json
import math
import os
import struct
import time
import unittest

from pictures import attribute, camera_attributes, picture, plane, read_exr, read_png, write_exr, write_png
from program import CommandLineTest

FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M = 200, 36, 1.4, 2
CAMERA = ["--focal-length", "200", "--sensor-width", "36", "--fstop", "1.4", "--focus", "2"]
INFINITY = float("inf")
ALWAYS = ["schema", "seconds", "peak_memory_bytes", "engine", "device", "lens", "camera", "detected", "warnings"]


def radius_px(z, width, focus=FOCUS_M):
    """docs/conventions.md, "Circle of confusion", --image-scale rendered."""
    return 0.5 * FOCAL_MM / F_NUMBER * FOCAL_MM / 1000 * (1 / focus - 1 / z) * width / SENSOR_MM


def texture(x, y):
    return (x * 37 + y * 91) % 17 / 40


def slope(x, y):
    return 1 + x / 8


class Defocus(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(32, 20, texture, slope, alpha=lambda x, y: 1 if y < 10 else 0.5),
                  attributes=camera_attributes(FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M))

    def coc(self, *args):
        self.succeed("defocus", *args, "-o", "coc.exr", "--view", "coc", "-q")
        return read_exr(self.path("coc.exr"))[0]["coc_radius_px"]

    def beauty(self, *args):
        self.succeed("defocus", "in.exr", "-o", "out.exr", "-q", *args)
        return read_exr(self.path("out.exr"))[0]

    def assert_planes_near(self, a, b, tolerance):
        for y, (row_a, row_b) in enumerate(zip(a, b)):
            for x, (va, vb) in enumerate(zip(row_a, row_b)):
                self.assertAlmostEqual(va, vb, delta=tolerance, msg="at %d,%d" % (x, y))

    def test_camera_numbers_of_the_file_are_enough(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr")
        self.assertAlmostEqual(report["camera"]["f_number"], F_NUMBER, places=5)
        self.assertIn("aperture", report["camera"]["origins"]["f_number"])

    def test_a_flag_goes_before_the_file_and_says_so(self):
        camera = self.report("defocus", "in.exr", "-o", "out.exr", "--fstop", "f/4")["camera"]
        self.assertEqual(camera["f_number"], 4)
        self.assertEqual(camera["origins"]["f_number"], "--fstop")
        self.assertIn("f/4 (--fstop)", self.succeed("defocus", "in.exr", "-o", "out.exr", "--fstop", "4").err)

    def test_coc_view_is_the_formula_of_the_conventions_and_says_what_it_is(self):
        rows = self.coc("in.exr")
        self.assert_planes_near(rows, plane(32, 20, lambda x, y: radius_px(slope(x, y), 32)), 1e-4)
        self.assertEqual(read_exr(self.path("coc.exr"))[1]["petzval:coc"], b"signed radius, px, + is far")

    def test_coc_view_can_be_read_again_without_a_camera(self):
        expected = self.beauty()
        self.coc("in.exr")
        bare = picture(32, 20, texture, None, alpha=lambda x, y: 1 if y < 10 else 0.5)
        write_exr(self.path("bare.exr"), bare)
        self.succeed("defocus", "bare.exr", "--depth", "coc.exr", "--depth-kind", "coc-px", "-o", "again.exr")
        self.assertEqual(read_exr(self.path("again.exr"))[0]["R"], expected["R"])

    def test_every_kind_of_depth_means_the_same_distances(self):
        expected = plane(32, 20, lambda x, y: radius_px(slope(x, y), 32))
        pixel = SENSOR_MM / 32 / FOCAL_MM

        def ray(x, y):
            return slope(x, y) * math.sqrt(1 + (pixel * (x - 15.5)) ** 2 + (pixel * (y - 9.5)) ** 2)
        kinds = {
            "ray": (ray, []), "inverse": (lambda x, y: 1 / slope(x, y), []),
            "planar": (lambda x, y: 100 * slope(x, y), ["--unit-scale", "0.01"]),
            "normalized": (lambda x, y: (slope(x, y) - 0.5) / 9.5, ["--depth-range", "0.5,10"]),
            "device": (lambda x, y: (1 / 0.5 - 1 / slope(x, y)) / (1 / 0.5 - 1 / 10), ["--depth-range", "0.5,10"]),
        }
        for kind, (value, flags) in kinds.items():
            write_exr(self.path("kind.exr"), picture(32, 20, texture, value))
            rows = self.coc("kind.exr", "--depth-kind", kind, *flags, *CAMERA)
            self.assert_planes_near(rows, expected, 2e-3)

    def test_depth_may_come_from_another_file_and_channel(self):
        write_exr(self.path("flat.exr"), picture(32, 20, texture, None))
        write_exr(self.path("depth.exr"), {"distance.V": plane(32, 20, slope), "Z": plane(32, 20, 7)})
        rows = self.coc("flat.exr", "--depth", "depth.exr", "--depth-channel", "distance.V", *CAMERA)
        self.assert_planes_near(rows, plane(32, 20, lambda x, y: radius_px(slope(x, y), 32)), 1e-4)

    def test_focus_at_takes_the_depth_of_a_pixel_of_the_display_window(self):
        write_exr(self.path("crop.exr"), picture(32, 20, texture, slope), display=(0, 0, 63, 39), origin=(10, 5))
        report = self.report("defocus", "crop.exr", "-o", "out.exr", *CAMERA[:-2], "--focus-at", "26,7")
        self.assertEqual(report["camera"]["focus_distance_m"], slope(16, 2))
        self.assertEqual(report["camera"]["origins"]["focus_distance_m"], "--focus-at 26,7")
        self.refuse(2, "defocus", "crop.exr", "-o", "o.exr", *CAMERA[:-2], "--focus-at", "3,7", says=["10 to 41"])

    def test_the_permissible_radius_sets_the_limits_and_what_the_focus_view_shows_white(self):
        def shown(*flags):
            self.succeed("defocus", "in.exr", "-o", "focus.png", *CAMERA, "--view", "focus", *flags)
            return read_png(self.path("focus.png"))[0]
        self.assertEqual(shown(), shown("--permissible-radius", "1"))
        self.assertNotEqual(shown(), shown("--permissible-radius", "3"))
        for radius in (0.5, 1):
            flags = ["--permissible-radius", str(radius)]
            limits = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, *flags)["focus_limits"]
            self.assertEqual(limits, self.report("inspect", "in.exr", *CAMERA, *flags)["focus_limits"])
            self.assertAlmostEqual(radius_px(limits["near_m"], 32), -radius, places=4)

    def test_focus_point_goes_through_the_camera_matrix_of_the_file(self):
        # The camera stands at (1, 2, 3) and looks along +x of the world: its z is x - 1.
        def matrix(sign):
            rows = [0, 0, sign, 0, 0, 1, 0, 0, -sign, 0, 0, 0, 3 * sign, -2, -sign, 1]
            return attribute("worldToCamera", "m44f", struct.pack("<16f", *rows))
        for sign in (1, -1):
            write_exr(self.path("world.exr"), picture(32, 20, texture, slope), attributes=matrix(sign))
            report = self.report("defocus", "world.exr", "-o", "out.exr", *CAMERA[:-2], "--focus-point", "3.5,9,-2")
            self.assertAlmostEqual(report["camera"]["focus_distance_m"], 2.5)
            self.assertEqual(report["camera"]["origins"]["focus_distance_m"], "--focus-point 3.5,9,-2")
            self.assertEqual(any("-z" in w for w in report["warnings"]), sign < 0)
            report = self.report("defocus", "world.exr", "-o", "out.exr", *CAMERA[:-2], "--focus-point", "351,9,-2",
                                 "--unit-scale", "0.01")
            self.assertAlmostEqual(report["camera"]["focus_distance_m"], 3.5, places=6)
        self.refuse(2, "defocus", "world.exr", "-o", "no.exr", *CAMERA[:-2], "--focus-point", "1,5,5", says=["plane"])
        write_exr(self.path("none.exr"), picture(32, 20, texture, slope))
        self.refuse(2, "defocus", "none.exr", "-o", "no.exr", *CAMERA[:-2], "--focus-point", "1,2,3",
                    says=["worldToCamera", "--focus-at"])

    def test_every_flag_that_shapes_the_blur_changes_the_result(self):
        plain = self.beauty()["G"]
        flags = ["--fstop 8", "--focus 3", "--focal-length 150mm", "--sensor-width 30mm", "--image-scale thin-lens",
                 "--max-radius 2", "--near-scale 0.2", "--far-scale 0.2", "--focus-range 1.5,3", "--blades 3",
                 "--squeeze 2", "--cats-eye 1", "--lens doublet", "--unit-scale 2", "--depth-kind inverse", "--engine reference"]
        for flag in flags:
            self.assertTrue(self.beauty(*flag.split())["G"] != plain, flag)
        for one, other in (("--focus-range 1.5,3", "--focus-range 1.5,3 --focus-falloff 0.9"),
                           ("--blades 3", "--blades 3 --blade-rotation 45"),
                           ("--blades 3", "--blades 3 --blade-curvature 1"),
                           ("--lens doublet", "--lens doublet --focus-mode paraxial"),
                           ("--engine reference --pupil-points 16", "--engine reference --pupil-points 64"),
                           ("--engine reference --pupil-points 16", "--engine reference --pupil-points 16 --seed 2")):
            self.assertTrue(self.beauty(*one.split())["G"] != self.beauty(*other.split())["G"], other)

    def test_flags_at_their_neutral_value_change_nothing(self):
        plain = self.beauty()
        for flag in ("--near-scale 1", "--far-scale 1", "--max-radius 1000", "--squeeze 1", "--cats-eye 0",
                     "--blades 0", "--unit-scale 1", "--depth-kind planar", "--image-scale rendered",
                     "--lens ideal", "--engine scatter", "--quality standard", "--threads 1", "--threads 2"):
            self.assertTrue(self.beauty(*flag.split()) == plain, flag)

    def test_a_pinhole_gives_the_picture_back(self):
        sharp = read_exr(self.path("in.exr"))[0]
        out = self.beauty("--fstop", "inf")
        for channel in "RGBAZ":
            self.assert_planes_near(out[channel], sharp[channel], 1e-6)

    def test_hidden_layers_deep_or_flat_show_through(self):
        near = picture(32, 20, lambda x, y: 0 if 12 <= x < 18 else 1, lambda x, y: 1 if 12 <= x < 18 else 4, alpha=1)
        write_exr(self.path("near.exr"), near)
        write_exr(self.path("hidden.exr"), picture(32, 20, 1, 4, alpha=1))
        self.succeed("defocus", "near.exr", "-o", "without.exr", *CAMERA)
        report = self.report("defocus", "near.exr", "-o", "with.exr", *CAMERA, "--behind", "hidden.exr")
        self.assertTrue(any(l.startswith("plate: ") for l in report["detected"]))
        self.assertTrue(read_exr(self.path("with.exr"))[0]["R"] != read_exr(self.path("without.exr"))[0]["R"])

    def test_a_clean_plate_may_cover_more_than_the_picture_or_less(self):
        display = (0, 0, 31, 19)

        def post(x, y):
            return 12 <= x < 18
        near = picture(32, 20, lambda x, y: 0 if post(x, y) else 1, lambda x, y: 1 if post(x, y) else 4, alpha=1)
        write_exr(self.path("near.exr"), near)
        write_exr(self.path("plate.exr"), picture(32, 20, 1, 4, alpha=1))
        self.succeed("defocus", "near.exr", "-o", "same.exr", *CAMERA, "--behind", "plate.exr")
        write_exr(self.path("wide.exr"), picture(48, 36, 1, 4, alpha=1), display=display, origin=(-8, -8))
        said = self.report("defocus", "near.exr", "-o", "wider.exr", *CAMERA, "--behind", "wide.exr")["detected"]
        self.assertTrue(any("48 x 36 pixels at -8,-8" in line for line in said), said)
        self.assertEqual(read_exr(self.path("wider.exr"))[0], read_exr(self.path("same.exr"))[0])
        write_exr(self.path("part.exr"), picture(20, 20, 1, 4, alpha=1), display=display, origin=(8, 0))
        self.succeed("defocus", "near.exr", "-o", "narrower.exr", *CAMERA, "--behind", "part.exr")
        write_exr(self.path("beside.exr"), picture(8, 8, 1, 4, alpha=1), display=display, origin=(40, 0))
        self.refuse(3, "defocus", "near.exr", "-o", "o.exr", *CAMERA, "--behind", "beside.exr",
                    says=["beside.exr", "overlap"])

    def test_report_always_holds_its_keys(self):
        for view in ("beauty", "coc", "depth"):
            report = self.report("defocus", "in.exr", "-o", "out.exr", "--view", view)
            for key in ALWAYS:
                self.assertIn(key, report)
            for key in ("read", "kernels", "compute", "write", "total"):
                self.assertGreaterEqual(report["seconds"][key], 0)
            self.assertGreaterEqual(report["seconds"]["total"], report["seconds"]["compute"])
            self.assertGreater(report["peak_memory_bytes"], 1 << 20)
        self.assertEqual(self.report("defocus", "in.exr", "-o", "out.exr")["engine"], "scatter")

    def test_report_goes_to_a_file_whole(self):
        self.assertEqual(self.succeed("defocus", "in.exr", "-o", "out.exr", "--json", "r.json").out, "")
        with open(self.path("r.json")) as file:
            report = json.load(file)
        self.assertEqual(report["output"], "out.exr")
        for stage in report["stages"]:
            self.assertEqual(set(stage), {"stage", "seconds", "bytes", "multiply_adds"})
        spread = next(stage for stage in report["stages"] if stage["stage"] == "spread")
        self.assertGreater(spread["bytes"], spread["multiply_adds"])
        self.assertIsNone(report["stages"][0]["bytes"], "kernels are not counted")
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.exr", "out.exr", "r.json"])

    def test_what_was_detected_is_said_on_standard_error(self):
        outcome = self.succeed("defocus", "in.exr", "-o", "out.exr")
        self.assertEqual(outcome.out, "")
        for word in ("colour:", "depth:", "camera:", "wrote out.exr"):
            self.assertIn(word, outcome.err)
        self.assertGreater(len(self.succeed("defocus", "in.exr", "-o", "out.exr", "-v").lines), len(outcome.lines))

    def test_update_and_no_clobber_leave_finished_files_alone(self):
        def stamp():
            return os.stat(self.path("out.exr")).st_mtime_ns
        now = time.time()
        self.succeed("defocus", "in.exr", "-o", "out.exr")
        os.utime(self.path("in.exr"), (now - 100, now - 100))
        first = stamp()
        self.assertIn("nothing to do", self.succeed("defocus", "in.exr", "-o", "out.exr", "-u").err)
        self.assertIn("exists and is kept", self.succeed("defocus", "in.exr", "-o", "out.exr", "--no-clobber").err)
        self.assertIn("skipped", self.report("defocus", "in.exr", "-o", "out.exr", "-u"))
        self.assertEqual(stamp(), first)
        os.utime(self.path("in.exr"), (now + 100, now + 100))
        self.succeed("defocus", "in.exr", "-o", "out.exr", "-u")
        self.assertNotEqual(stamp(), first)
        self.succeed("defocus", "in.exr", "-o", "new.exr", "--no-clobber")
        os.truncate(self.path("new.exr"), os.path.getsize(self.path("new.exr")) // 2)
        self.assertIn("kept, although it is damaged or cut off",
                      self.succeed("defocus", "in.exr", "-o", "new.exr", "--no-clobber").err)
        self.succeed("defocus", "in.exr", "-o", "new.exr", "--overwrite")

    def test_other_channels_and_attributes_are_carried_over(self):
        extra = picture(32, 20, texture, slope)
        extra["crypto00.R"] = plane(32, 20, lambda x, y: x + 1e-3 * y)
        mine = b"mine\0string\0" + struct.pack("<I", 5) + b"kept!"
        write_exr(self.path("rich.exr"), extra, attributes=mine)
        self.succeed("defocus", "rich.exr", "-o", "out.exr", *CAMERA)
        rows, attributes = read_exr(self.path("out.exr"))
        self.assertEqual(rows["crypto00.R"], read_exr(self.path("rich.exr"))[0]["crypto00.R"])
        self.assertEqual(attributes["mine"], b"kept!")


class Views(CommandLineTest):
    WIDTH, HEIGHT = 400, 300

    def setUp(self):
        super().setUp()
        # Left near, middle in focus, right far.
        write_exr(self.path("in.exr"),
                  picture(self.WIDTH, self.HEIGHT, 0.5, lambda x, y: (1, 2, 9)[3 * x // self.WIDTH], alpha=0.75),
                  half="RGBA", attributes=camera_attributes(FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M))

    def view(self, name, *flags):
        self.succeed("defocus", "in.exr", "-o", name + ".png", "--view", name, *flags)
        return read_png(self.path(name + ".png"))

    def pixel(self, rows, x, y):
        return rows[y][3 * x:3 * x + 3]

    def test_focus_view_is_blue_near_orange_far_and_white_in_focus(self):
        rows, channels, bits = self.view("focus")
        self.assertEqual((channels, bits), (3, 8))
        near, sharp, far = (self.pixel(rows, x, 20) for x in (50, 200, 350))
        self.assertGreater(near[2], near[0] + 60)
        self.assertGreater(far[0], far[2] + 60)
        self.assertLess(max(sharp) - min(sharp), 6)
        self.assertGreater(min(sharp), max(near[0], far[2]))

    def test_focus_view_carries_a_legend_in_words(self):
        rows, _, _ = self.view("focus")
        box = [self.pixel(rows, x, y) for y in range(self.HEIGHT - 60, self.HEIGHT) for x in range(0, 200)]
        self.assertGreater(sum(max(p) < 40 for p in box), 2000, "a dark box")
        self.assertGreater(sum(min(p) > 200 for p in box), 300, "white letters on it")
        for swatch in ((2, 0), (0, 2)):  # blue and orange
            self.assertTrue(any(p[swatch[0]] > p[swatch[1]] + 120 for p in box))

    def test_coc_map_is_black_where_sharp(self):
        rows, _, _ = self.view("coc")
        self.assertLess(max(self.pixel(rows, 200, 20)), 8)
        self.assertGreater(self.pixel(rows, 50, 20)[2], 120)

    def test_depth_png_can_be_read_again(self):
        rows, channels, bits = self.view("depth")
        self.assertEqual((channels, bits), (1, 16))
        self.assertEqual([rows[5][x] for x in (50, 200, 350)], [65535, 32768, 7282])  # 1/1, 1/2, 1/9
        self.succeed("defocus", "in.exr", "-o", "a.exr", "--view", "coc")
        self.succeed("defocus", "in.exr", "-o", "b.exr", "--view", "coc", "--depth", "depth.png", "--depth-kind",
                     "inverse")
        a, b = (read_exr(self.path(n))[0]["coc_radius_px"] for n in ("a.exr", "b.exr"))
        for x in (50, 200, 350):
            self.assertAlmostEqual(a[5][x], b[5][x], delta=0.01)

    def test_depth_exr_is_planar_metres(self):
        self.succeed("defocus", "in.exr", "-o", "z.exr", "--view", "depth", "--unit-scale", "0.5")
        rows, _ = read_exr(self.path("z.exr"))
        self.assertEqual([rows["Z"][5][x] for x in (50, 200, 350)], [0.5, 1, 4.5])

    def test_alpha_view(self):
        rows, channels, _ = self.view("alpha", "--fstop", "inf")
        self.assertEqual(channels, 1)
        self.assertAlmostEqual(rows[150][200] / 65535, 0.75, delta=0.01)

    def test_views_as_exr(self):
        for name, channels in (("focus", "BGR"), ("alpha", "A")):
            self.succeed("defocus", "in.exr", "-o", "v.exr", "--view", name)
            self.assertEqual(sorted(read_exr(self.path("v.exr"))[0]), sorted(channels))

    def test_a_png_covers_the_display_window_and_an_exr_the_data_window(self):
        write_exr(self.path("crop.exr"), picture(20, 10, 0.5, 2, alpha=1), display=(0, 0, 39, 29), origin=(30, 5),
                  attributes=camera_attributes(FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M))
        for view in ("beauty", "coc", "focus", "depth", "alpha"):
            self.succeed("defocus", "crop.exr", "-o", view + ".png", "--view", view)
            rows, channels, _ = read_png(self.path(view + ".png"))
            self.assertEqual((len(rows), len(rows[0]) // channels), (30, 40), view)
            if view != "coc":  # sharp is black there
                self.assertGreater(rows[6][35 * channels], 60, view)
            self.assertEqual(rows[2][2 * channels], 0, view)
            self.succeed("defocus", "crop.exr", "-o", view + ".exr", "--view", view)
            self.assertEqual(struct.unpack("<4i", read_exr(self.path(view + ".exr"))[1]["dataWindow"]), (30, 5, 49, 14))

    def test_png_in_and_out_keeps_the_look(self):
        rows = [[(x * 3 + c * 5 + y) % 256 for x in range(32) for c in range(3)] for y in range(20)]
        write_png(self.path("in.png"), rows)
        write_exr(self.path("z.exr"), {"Z": plane(32, 20, 2)})
        outcome = self.succeed("defocus", "in.png", "--depth", "z.exr", "-o", "out.png", *CAMERA)
        self.assertIn("clip", outcome.err, "1.0 in a PNG is clipped, and the log says so")
        again = read_png(self.path("out.png"))[0]
        self.assertLessEqual(max(abs(a - b) for ra, rb in zip(rows, again) for a, b in zip(ra, rb)), 1)


if __name__ == "__main__":
    unittest.main()
