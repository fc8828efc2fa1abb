"""petzval develop, compare, inspect and scene; and the commands of the README one after another."""
import math
import os
import struct
import unittest

from pictures import attribute, camera_attributes, picture, plane, read_exr, read_png, write_exr, write_png
from program import CAMERA, CommandLineTest

KEYS = ["psnr_lin", "ssim_lin", "psnr_srgb", "ssim_srgb", "psnr_log", "max_error", "energy_ratio"]


def srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


class Develop(CommandLineTest):
    def develop(self, colour, *flags):
        write_exr(self.path("in.exr"), picture(64, 32, colour, None))
        self.succeed("develop", "in.exr", "-o", "out.png", *flags)
        return read_png(self.path("out.png"))

    def test_without_a_tone_curve_it_is_srgb(self):
        rows, _, bits = self.develop(lambda x, y: x / 64, "--tone", "none", "--no-dither", "--bits", "16")
        self.assertEqual(bits, 16)
        for x in range(64):
            self.assertAlmostEqual(rows[0][3 * x], 65535 * srgb(x / 64), delta=0.51)

    def test_sixteen_bits_stay_sixteen(self):
        codes = [[1000 * x + y for x in range(64) for _ in range(3)] for y in range(32)]
        write_png(self.path("in.png"), codes, bits=16)
        write_exr(self.path("z.exr"), picture(64, 32))
        self.succeed("defocus", "in.png", "--depth", "z.exr", "-o", "out.png", *CAMERA)  # all of it is in focus
        rows, _, bits = read_png(self.path("out.png"))
        self.assertEqual(bits, 16)
        self.assertLess(max(abs(a - b) for own, given in zip(rows, codes) for a, b in zip(own, given)), 4)
        self.succeed("develop", "in.png", "-o", "eight.png", "--bits", "8")
        self.assertEqual(read_png(self.path("eight.png"))[2], 8)

    def test_mid_grey_is_kept_in_the_mean_and_dithered(self):
        rows, _, _ = self.develop(0.18)
        codes = [code for row in rows for code in row]
        self.assertAlmostEqual(sum(codes) / len(codes), 255 * srgb(0.18), delta=0.02)
        self.assertGreater(len(set(codes)), 1)

    def test_exposure_is_in_stops(self):
        brighter = self.develop(0.1, "--exposure", "2", "--no-dither")
        self.assertEqual(brighter, self.develop(0.4, "--no-dither"))

    def test_highlights_roll_off_instead_of_clipping(self):
        rows, _, _ = self.develop(lambda x, y: 0.5 + x / 8, "--no-dither")
        codes = rows[0][0::3]
        self.assertEqual(codes, sorted(codes))
        self.assertLess(codes[-1], 255)
        self.assertGreater(len(set(codes)), 25)


class Compare(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("a.exr"), picture(32, 24, 0.5, None))
        write_exr(self.path("b.exr"), picture(32, 24, lambda x, y: 0.75 if (x, y) == (20, 7) else 0.6, None))

    def test_values_by_hand(self):
        report = self.report("compare", "a.exr", "b.exr")
        mean = (767 * 0.1 ** 2 + 0.25 ** 2) / 768
        self.assertAlmostEqual(report["psnr_lin"], -10 * math.log10(mean), places=3)
        self.assertAlmostEqual(report["max_error"], 0.25, places=6)
        self.assertEqual(report["max_error_at"], [20, 7])
        self.assertAlmostEqual(report["energy_ratio"], (767 * 0.6 + 0.75) / (768 * 0.5), places=5)
        for key in KEYS:
            self.assertIsInstance(report[key], (int, float), key)

    def test_a_heat_map_for_each_frame_needs_frames(self):
        self.refuse(2, "compare", "a.exr", "b.exr", "-o", "d.####.png", says=["the input must be the frames of a shot"])

    def test_identical_pictures_are_infinitely_alike(self):
        report = self.report("compare", "a.exr", "a.exr")
        self.assertEqual(report["psnr_lin"], math.inf)
        self.assertEqual(report["ssim_lin"], 1)
        self.assertEqual(report["max_error"], 0)
        self.assertIn("inf", self.succeed("compare", "a.exr", "a.exr").out)

    def test_a_table_for_people_by_default(self):
        out = self.succeed("compare", "a.exr", "b.exr").out
        for word in ("PSNR", "SSIM", "largest error", "20,7", "energy ratio"):
            self.assertIn(word, out)

    def test_exposure_multiplies_before_clipping(self):
        self.assertEqual(self.report("compare", "a.exr", "b.exr", "--exposure", "4")["psnr_lin"], math.inf)

    def test_only_pixels_under_the_mask_count(self):
        write_png(self.path("mask.png"), [[255 if x < 16 else 0 for x in range(32)] for y in range(24)], channels=1)
        report = self.report("compare", "a.exr", "b.exr", "--mask", "mask.png")
        self.assertAlmostEqual(report["max_error"], 0.1, places=6)
        write_exr(self.path("mask.exr"), picture(32, 24, lambda x, y: x < 16, None))
        self.assertEqual(self.report("compare", "a.exr", "b.exr", "--mask", "mask.exr")["psnr_lin"], report["psnr_lin"])
        write_png(self.path("small.png"), [[255] * 8] * 8, channels=1)
        self.refuse(2, "compare", "a.exr", "b.exr", "--mask", "small.png", says=["small.png", "8 x 8"])

    def test_a_heat_map_is_as_large_as_the_pictures_and_the_worst_places_are_named(self):
        outcome = self.succeed("compare", "a.exr", "b.exr", "-o", "map.png")
        self.assertIn("worst place 1", outcome.out)
        self.assertIn("codes RMS", outcome.out)
        head = self.content("map.png")[16:24]
        self.assertEqual(struct.unpack(">II", head), (32, 24))
        report = self.report("compare", "a.exr", "b.exr")
        self.assertGreater(report["worst_places"][0]["rms_codes"], 0)
        self.assertEqual(self.report("compare", "a.exr", "a.exr")["worst_places"], [])
        self.refuse(2, "compare", "a.exr", "b.exr", "-o", "map.exr", says=[".png"])

    def test_frames_of_a_scene_and_their_heat_maps(self):
        small = ["--width", "32", "--height", "18", "--pinhole-samples", "1"]
        self.succeed("scene", "make", "post", "-o", "p.##.exr", "--frames", "20-21", *small)
        self.succeed("scene", "make", "post", "-o", "one.exr", "--frame", "21", *small)
        self.assertEqual(self.report("compare", "one.exr", "p.21.exr")["psnr_lin"], math.inf)
        outcome = self.succeed("compare", "p.##.exr", "one.exr", "-o", "d.##.png")
        self.assertIn("worst is frame 20", outcome.out)
        self.assertIn("worst place 1", outcome.out)
        self.assertTrue(self.content("d.20.png") and self.content("d.21.png"))
        self.refuse(2, "scene", "make", "post", "-o", "q.exr", "--frames", "20-21", *small, says=["####"])
        self.refuse(2, "scene", "make", "post", "-o", "q.##.exr", *small, says=["--frames"])

    def test_alpha_that_differs_is_warned_of(self):
        for name, alpha in (("one.exr", 1), ("half.exr", 0.5), ("near.exr", 0.999)):
            write_exr(self.path(name), picture(32, 24, 0.5, None, alpha))
        outcome = self.succeed("compare", "one.exr", "half.exr")
        self.assertIn("warning: alpha differs by up to 0.5; the numbers compare red, green and blue", outcome.err)
        for same in ("near.exr", "a.exr"):
            self.assertNotIn("alpha", self.succeed("compare", "one.exr", same).err)

    def test_png_and_exr_compare_in_linear_light(self):
        code = round(255 * srgb(0.5))
        write_png(self.path("a.png"), [[code] * 96] * 24)
        self.assertGreater(self.report("compare", "a.exr", "a.png")["psnr_lin"], 45)

    def test_windows_are_lined_up(self):
        write_exr(self.path("crop.exr"), picture(8, 6, 0.5, None), display=(0, 0, 31, 23), origin=(4, 5))
        whole = picture(32, 24, lambda x, y: 0.5 if 4 <= x < 12 and 5 <= y < 11 else 0, None)
        write_exr(self.path("whole.exr"), whole)
        self.assertEqual(self.report("compare", "whole.exr", "crop.exr")["psnr_lin"], math.inf)


class Inspect(CommandLineTest):
    def test_parts_layers_depth_and_camera_with_origins(self):
        channels = picture(8, 6, 0.5, lambda x, y: 1e10 if y == 0 else 2 + x)
        channels["diffuse.R"] = plane(8, 6, 0)
        write_exr(self.path("in.exr"), channels, half="RGB", attributes=attribute("aperture", "float", b"\0\0\0\x40"))
        text = self.succeed("inspect", "in.exr").out
        for words in ("8 x 6", "R G B  (half)", "diffuse. R  (float)", "Z  (float)", "2 m to 9 m", "8 of 48 pixels without depth",
                      "OpenEXR aperture", "give --focus"):
            self.assertIn(words, text)
        report = self.report("inspect", "in.exr")
        self.assertEqual(report["camera"]["f_number"], 2)
        self.assertIsNone(report["camera"]["focus_distance_m"])
        self.assertEqual(report["depth"]["misses"], 8)
        self.assertEqual(report["parts"][0]["compression"], "none")
        self.assertNotIn("field of view", text)

    def test_the_field_of_view_follows_from_the_camera(self):
        write_exr(self.path("in.exr"), picture(8, 6, 0.5, 2.0), attributes=camera_attributes(18, 36, 2, 3))  # 2 atan(36 / 36)
        self.assertIn("field of view   90 deg  (of the sensor's width at infinity)", self.succeed("inspect", "in.exr").out)
        self.assertIn("focus distance  4 m  (--focus)", self.succeed("inspect", "in.exr", "--focus", "4").out)


class Scene(CommandLineTest):
    SMALL = ["--width", "48", "--height", "27", "--pinhole-samples", "4"]

    def test_list_names_what_make_makes(self):
        scenes = self.report("scene", "list")["scenes"]
        text = self.succeed("scene", "list").out
        self.assertGreaterEqual(len(scenes), 5)
        for scene in scenes:
            self.assertIn(scene["name"], text)
            self.succeed("scene", "make", scene["name"], "-o", scene["name"] + ".exr", *self.SMALL)

    def test_one_side_alone_keeps_the_shape(self):
        for given, size in ((["--width", "48"], (48, 27)), (["--height", "27"], (48, 27)), (["--width", "50"], (50, 28)),
                            (["--width", "20", "--height", "20"], (20, 20))):
            self.succeed("scene", "make", "slant", "-o", "s.exr", "--pinhole-samples", "1", *given)
            window = self.report("inspect", "s.exr")["display_window"]
            self.assertEqual((window["width"], window["height"]), size)

    def test_from_a_scene_to_a_picture_without_one_camera_flag(self):
        self.succeed("scene", "make", "night", "-o", "night.exr", *self.SMALL)
        report = self.report("defocus", "night.exr", "-o", "out.exr")
        self.assertEqual(report["warnings"], [])
        self.succeed("develop", "out.exr", "-o", "out.png")
        self.succeed("defocus", "night.exr", "-o", "focus.png", "--view", "focus")
        self.assertLess(self.report("compare", "night.exr", "out.exr")["psnr_lin"], 60)

    def test_truth_and_hidden_layers_fit_the_picture(self):
        self.succeed("scene", "make", "bars", "-o", "bars.exr", "--truth", "truth.exr", "--layers", "layers.exr",
                     "--samples", "64", *self.SMALL)
        self.succeed("defocus", "bars.exr", "-o", "with.exr", "--behind", "layers.exr", "--engine", "reference",
                     "--pupil-points", "256")
        sharp = self.report("compare", "truth.exr", "bars.exr")["psnr_lin"]
        self.assertGreater(self.report("compare", "truth.exr", "with.exr")["psnr_lin"], sharp)

    def test_overscan_grows_the_data_window_but_not_the_truth(self):
        self.succeed("scene", "make", "bars", "-o", "bars.exr", "--truth", "truth.exr", "--layers", "layers.exr",
                     "--overscan", "6", "--samples", "16", *self.SMALL)
        windows = {name: struct.unpack("<4i", read_exr(self.path(name))[1]["dataWindow"])
                   for name in ("bars.exr", "truth.exr")}
        self.assertEqual(windows, {"bars.exr": (-6, -6, 53, 32), "truth.exr": (0, 0, 47, 26)})
        self.succeed("defocus", "bars.exr", "-o", "with.exr", "--behind", "layers.exr")
        self.report("compare", "truth.exr", "with.exr")

    def test_camera_flags_hold_for_the_scene_and_are_written(self):
        self.succeed("scene", "make", "slant", "-o", "s.exr", "--fstop", "5.6", "--focus", "150cm", *self.SMALL)
        camera = self.report("inspect", "s.exr")["camera"]
        self.assertAlmostEqual(camera["f_number"], 5.6, places=5)
        self.assertAlmostEqual(camera["focus_distance_m"], 1.5, places=5)

    def test_a_scene_may_be_lit_in_codes(self):
        self.succeed("scene", "make", "bars", "-o", "light.exr", *self.SMALL)
        report = self.report("scene", "make", "bars", "-o", "codes.exr", "--lit-in", "codes", *self.SMALL)
        self.assertEqual(report["parameters"]["lit_in"], "codes")
        light, codes = (read_exr(self.path(name))[0] for name in ("light.exr", "codes.exr"))
        self.assertEqual(light["Z"], codes["Z"])
        self.assertLess(max(map(max, codes["G"])), 0.5 * max(map(max, light["G"])))
        self.refuse(2, "scene", "make", "wgld", "-o", "out.exr", "--lit-in", "codes", says=["--lit-in", "wgld"])

    def test_before_the_blur_nobody_sees_that_a_scene_was_lit_in_codes(self):
        for lit in ("light", "codes"):
            self.succeed("scene", "make", "dynamic-range", "-o", f"{lit}.exr", "--lit-in", lit,
                         "--width", "480", "--height", "270", "--pinhole-samples", "16")
            curve = ["--tone", "none"] + (["--transfer", "linear"] if lit == "codes" else [])
            self.succeed("develop", f"{lit}.exr", "-o", f"{lit}_sharp.png", *curve)
            self.succeed("defocus", f"{lit}.exr", "-o", f"{lit}_blurred.png", *curve)
        sharp, blurred = (self.report("compare", f"light_{state}.png", f"codes_{state}.png")["psnr_srgb"]
                          for state in ("sharp", "blurred"))
        self.assertGreater(sharp, 28)
        self.assertLess(blurred, sharp - 5)

    def test_a_scene_can_be_focused_on_a_point_of_its_world(self):
        self.succeed("scene", "make", "table", "-o", "table.exr", *self.SMALL)
        # The chequered ball's middle, from 0,0.26,0 looking at 0,0.06,1.2.
        report = self.report("defocus", "table.exr", "-o", "out.exr", "--focus-point", "0.03,0.052,1.2")
        self.assertAlmostEqual(report["camera"]["focus_distance_m"], (0.208 * 0.2 + 1.2 * 1.2) / math.hypot(0.2, 1.2), 4)
        self.assertEqual(report["warnings"], [])
        self.succeed("scene", "make", "table", "-o", "moved.exr", "--camera-at", "0.3,0.3,0.2", "--look-at",
                     "0.03,0.052,1.2", *self.SMALL)
        report = self.report("defocus", "moved.exr", "-o", "out.exr", "--focus-point", "0.03,0.052,1.2")
        self.assertAlmostEqual(report["camera"]["focus_distance_m"], math.hypot(0.27, 0.248, 1), 4)
        self.refuse(2, "scene", "make", "table", "-o", "no.exr", "--look-at", "0,9,0", *self.SMALL, says=["--look-at"])

    def test_depth_can_be_soft_and_coarse(self):
        self.succeed("scene", "make", "bars", "-o", "bars.exr", "--depth-blur", "2", "--depth-bits", "8", *self.SMALL)
        depth = read_exr(self.path("bars.exr"))[0]["Z"]
        self.assertLessEqual(len({value for row in depth for value in row}), 256)
        self.refuse(2, "scene", "make", "bars", "-o", "no.exr", "--depth-bits", "9", *self.SMALL, says=["--depth-bits"])

    def test_a_camera_that_sees_nothing_or_everything_is_refused(self):
        for flags in (["--focal-length", "1e-30"], ["--sensor-width", "1e30"], ["--sensor-width", "1e-9"]):
            self.refuse(2, "scene", "make", "slant", "-o", "no.exr", "--width", "8", "--height", "8", *flags,
                        says=["--sensor-width", "--focal-length"])

    def test_same_bits_for_any_number_of_threads(self):
        for threads in ("1", "2"):
            self.succeed("scene", "make", "slant", "-o", threads + ".exr", "--threads", threads, *self.SMALL)
        self.assertEqual(read_exr(self.path("1.exr"))[0], read_exr(self.path("2.exr"))[0])

    def test_no_clobber_leaves_a_finished_scene_alone(self):
        self.succeed("scene", "make", "slant", "-o", "s.exr", *self.SMALL)
        self.assertIn("exists and is kept", self.succeed("scene", "make", "slant", "-o", "s.exr", "--no-clobber").err)

    def test_no_clobber_names_a_damaged_file(self):
        self.succeed("scene", "make", "slant", "-o", "s.exr", *self.SMALL)
        for line in (["scene", "make", "slant", "-o", "made.exr"], ["develop", "s.exr", "-o", "shown.png"],
                     ["compare", "s.exr", "s.exr", "-o", "map.png"], ["lens", "psf", "doublet", "-o", "disc.exr"]):
            output = line[-1]
            self.succeed(*line, *(self.SMALL if line[0] == "scene" else []))
            self.assertNotIn("damaged", self.succeed(*line, "--no-clobber").err)
            os.truncate(self.path(output), os.path.getsize(self.path(output)) // 2)
            self.assertIn(output + ": kept, although it is damaged or cut off", self.succeed(*line, "--no-clobber").err)


if __name__ == "__main__":
    unittest.main()
