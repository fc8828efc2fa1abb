"""Several files in one frame: --merge, --holdout and --overscan; real deep files where they are at hand."""
import math
import os
import unittest

from pictures import picture, plane, read_exr, write_exr
from program import CommandLineTest

REAL = os.path.join(os.path.dirname(__file__), "..", "..", "..", "shared", "exr")
REAL_CAMERA = ["--unit-scale", "0.01", "--focal-length", "85mm", "--sensor-width", "36mm", "--fstop", "2.8",
               "--focus", "2.4m"]
# 3 px of radius at 6 m, -5 px at 1 m in a frame 40 px wide.
CAMERA = ["--focal-length", "150mm", "--sensor-width", "36mm", "--focus", "2m"]
DISPLAY = (0, 0, 39, 29)


def card(x0, x1, grey, depth, alpha=1):
    """A card between two columns of a frame of 40 x 30, nothing beside it."""
    def inside(x):
        return x0 <= x < x1
    channels = picture(40, 30, lambda x, y: grey if inside(x) else 0, lambda x, y: depth if inside(x) else 1e10)
    channels["A"] = plane(40, 30, lambda x, y: alpha if inside(x) else 0)
    return channels


class Deep(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("near.exr"), card(0, 16, 0.25, 1))
        write_exr(self.path("middle.exr"), card(10, 24, 0.5, 2))
        write_exr(self.path("far.exr"), card(0, 40, 1, 6))

    def rows(self, name, channel="R"):
        return read_exr(self.path(name))[0][channel]

    def defocus(self, *args, fstop="1.4"):
        return self.succeed("defocus", *args, *CAMERA, "--fstop", fstop)

    def test_files_in_any_order_give_the_same_bits(self):
        self.defocus("near.exr", "-o", "a.exr", "--merge", "middle.exr", "far.exr")
        self.defocus("far.exr", "-o", "b.exr", "--merge", "near.exr", "middle.exr")
        for channel in "RGBA":
            self.assertEqual(self.rows("a.exr", channel), self.rows("b.exr", channel))

    def test_a_merged_picture_shows_each_file_where_it_is_nearest(self):
        self.defocus("far.exr", "-o", "sharp.exr", "--merge", "near.exr", "middle.exr", fstop="inf")
        row = self.rows("sharp.exr")[15]
        for x in range(40):
            self.assertAlmostEqual(row[x], 0.25 if x < 16 else 0.5 if x < 24 else 1, places=3)

    def test_what_one_file_hides_of_another_is_seen_past_its_edge(self):
        self.defocus("far.exr", "-o", "out.exr", "--merge", "near.exr")
        self.defocus("near.exr", "-o", "alone.exr")
        both, near, alpha = (self.rows("out.exr")[15], self.rows("alone.exr")[15], self.rows("alone.exr", "A")[15])
        for x in range(3, 37):  # the near card over a background that is the same everywhere
            self.assertAlmostEqual(both[x], near[x] + 1 - alpha[x], delta=0.02)

    def test_what_was_found_behind_is_a_deep_file_that_behind_takes(self):
        write_exr(self.path("in.exr"), picture(40, 30, lambda x, y: 0.2 if x < 16 else 1.0, lambda x, y: 1.0 if x < 16 else 6.0))
        said = self.succeed("defocus", "in.exr", "-o", "hidden.exr", "--view", "hidden", *CAMERA, "--fstop", "1.4").err
        self.assertIn("--plate hidden.exr", said)
        self.defocus("in.exr", "-o", "plain.exr")
        self.defocus("in.exr", "-o", "given.exr", "--behind", "hidden.exr")
        for plain, given in zip(self.rows("plain.exr")[15], self.rows("given.exr")[15]):
            self.assertAlmostEqual(plain, given, delta=0.05)
        view = ["--view", "hidden", *CAMERA, "--fstop", "2"]
        self.refuse(2, "defocus", "in.exr", "-o", "no.png", *view, says=["--view hidden", "deep EXR"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *view, "--near-scale", "2", says=["--near-scale"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *view, "--engine", "gather", says=["--view hidden", "scatter"])

    def test_guesses_are_marked_by_a_matte(self):
        write_exr(self.path("in.exr"), picture(40, 30, lambda x, y: 0.2 if x < 16 else 1.0, lambda x, y: 1.0 if x < 16 else 6.0))
        view = ["--view", "guessed", *CAMERA, "--fstop", "1.4"]
        self.succeed("defocus", "in.exr", "-o", "matte.exr", *view)
        row = self.rows("matte.exr", "guessed")[15]
        self.assertGreater(max(row[8:18]), 0.1)
        self.assertEqual(max(row[34:]), 0)
        self.assertTrue(all(0 <= share <= 1 for share in row))
        self.succeed("defocus", "in.exr", "-o", "matte.png", *view)
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *view, "--engine", "gather", says=["--view guessed", "scatter"])

    def test_windows_are_joined(self):
        write_exr(self.path("left.exr"), picture(6, 5, 1, 2, alpha=1), display=DISPLAY, origin=(2, 3))
        write_exr(self.path("right.exr"), picture(4, 9, 1, 3, alpha=1), display=DISPLAY, origin=(20, 1))
        self.defocus("left.exr", "-o", "out.exr", "--merge", "right.exr", fstop="inf")
        channels, attributes = read_exr(self.path("out.exr"))
        self.assertEqual(len(channels["A"]), 9)
        self.assertEqual(len(channels["A"][0]), 22)
        self.assertEqual(channels["A"][2][:8], [1] * 6 + [0] * 2)
        self.assertEqual(sum(map(sum, channels["A"])), 6 * 5 + 4 * 9)

    def test_another_frame_is_refused(self):
        write_exr(self.path("other.exr"), picture(8, 6))
        for flag in ("--merge", "--holdout"):
            self.refuse(3, "defocus", "far.exr", "-o", "out.exr", *CAMERA, "--fstop", "2", flag, "other.exr",
                        says=[flag + " other.exr", "display window"])
        self.refuse(3, "defocus", "far.exr", "-o", "out.exr", *CAMERA, "--fstop", "2", "--merge", "no.exr", says=["no.exr"])
        self.refuse(2, "defocus", "far.exr", "-o", "near.exr", *CAMERA, "--fstop", "2", "--merge", "near.exr", says=["near.exr"])

    def test_hidden_layers_of_a_deep_picture_are_in_it(self):
        self.refuse(2, "defocus", "far.exr", "-o", "out.exr", *CAMERA, "--fstop", "2", "--merge", "near.exr", "--behind", "middle.exr",
                    says=["--plate", "deep"])

    def test_a_holdout_hides_what_is_behind_it_and_stays_sharp(self):
        self.defocus("far.exr", "-o", "free.exr")
        self.defocus("far.exr", "-o", "held.exr", "--holdout", "near.exr")
        for channel in "RA":
            free, held = self.rows("free.exr", channel)[15], self.rows("held.exr", channel)[15]
            self.assertEqual(held[:16], [0] * 16)
            for x in range(16, 40):
                self.assertAlmostEqual(held[x], free[x], places=3)

    def test_a_holdout_behind_everything_changes_nothing(self):
        self.defocus("near.exr", "-o", "free.exr")
        self.defocus("near.exr", "-o", "held.exr", "--holdout", "far.exr")
        for free, held in zip(self.rows("free.exr"), self.rows("held.exr")):
            for a, b in zip(free, held):
                self.assertAlmostEqual(a, b, places=3)
        self.refuse(2, "defocus", "near.exr", "-o", "out.exr", *CAMERA, "--fstop", "2", "--holdout", "far.exr", "--engine", "gather",
                    says=["gather", "holdout"])

    def test_overscan_keeps_the_light_that_leaves_the_window(self):
        write_exr(self.path("piece.exr"), picture(12, 10, 1, 6, alpha=1), display=DISPLAY, origin=(14, 10))
        self.defocus("piece.exr", "-o", "cut.exr", "--overscan", "off")
        self.defocus("piece.exr", "-o", "whole.exr", "--overscan", "auto")
        self.defocus("piece.exr", "-o", "wide.exr", "--overscan", "9")
        def light(name):
            return sum(map(sum, self.rows(name)))
        self.assertLess(light("cut.exr"), 115)
        self.assertAlmostEqual(light("whole.exr"), 120, delta=0.6)
        self.assertEqual(len(self.rows("wide.exr")[0]), 12 + 18)
        at = 9
        for y in range(10):  # inside the old window nothing changes
            for a, b in zip(self.rows("cut.exr")[y], self.rows("wide.exr")[y + at][at:at + 12]):
                self.assertAlmostEqual(a, b, delta=2e-3)

    def test_overscan_of_a_full_frame_is_nothing(self):
        outcome = self.defocus("far.exr", "-o", "out.exr", "--overscan", "auto")
        self.assertIn("overscan has no effect", outcome.err)
        self.assertEqual(len(self.rows("out.exr")[0]), 40)

    @unittest.skipUnless(os.path.isdir(REAL), "the OpenEXR project's pictures are not at hand")
    def test_real_deep_files_merge_and_hold_out(self):
        balls, trunks = os.path.join(REAL, "deep_balls.exr"), os.path.join(REAL, "deep_trunks.exr")
        runs = {"balls": [balls], "trunks": [trunks], "both": [balls, "--merge", trunks],
                "other": [trunks, "--merge", balls], "held": [balls, "--holdout", trunks]}
        light = {}
        for name, args in runs.items():
            self.succeed("defocus", *args, "-o", name + ".exr", *REAL_CAMERA)
        same = self.report("compare", "both.exr", "other.exr")
        self.assertEqual(same["max_error"], 0)
        for name in ("balls", "trunks", "both", "held"):
            rows = self.rows(name + ".exr")
            light[name] = sum(map(sum, rows))
            self.assertTrue(all(math.isfinite(v) and -1e-4 < v < 10 for row in rows for v in row), name)
            for row in self.rows(name + ".exr", "A"):
                self.assertTrue(all(0 <= v <= 1.001 for v in row), name)
        self.assertGreater(light["both"], max(light["balls"], light["trunks"]))
        self.assertLess(light["both"], light["balls"] + light["trunks"])
        self.assertLess(light["held"], light["balls"])


if __name__ == "__main__":
    unittest.main()
