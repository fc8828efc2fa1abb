"""The lighter engines from the command line: gather, gaussian, sprites and what each can show."""
import unittest

from pictures import picture, plane, read_exr, read_png, write_exr
from program import CommandLineTest

CAMERA = ["--focal-length", "200mm", "--sensor-width", "36mm", "--fstop", "1.4", "--focus", "2m"]
STAGES = ["coc", "prefilter", "taps", "disc", "disc-blur", "hard-test", "blur", "combine", "near-far", "cure"]
HEADER = "x,y,coc,r,g,b\n"


def texture(x, y):
    return (x * 37 + y * 91) % 17 / 40


def steps(x, y):
    return 1.2 if x < 15 else 2.0 if x < 33 else 2.6 if y < 12 else 9.0


class LightEngines(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(48, 32, texture, steps))
        write_exr(self.path("black.exr"), {**picture(64, 40, 0.0, 2.0), "Z": plane(64, 40, 2)})

    def defocus(self, *flags, source="in.exr", channel="G"):
        self.succeed("defocus", source, "-o", "out.exr", *CAMERA, "-q", *flags)
        return read_exr(self.path("out.exr"))[0][channel]

    def assert_differ(self, one, other, which=""):
        self.assertTrue(one != other, which)

    def points(self, text):
        with open(self.path("points.csv"), "w", newline="") as file:
            file.write(text)

    def sprites(self, *flags, source="black.exr"):
        return self.defocus("--engine", "sprites", "--points", "points.csv", *flags, source=source)

    def test_every_flag_changes_the_picture(self):
        gather, gaussian, sprites = (self.defocus("--engine", e) for e in ("gather", "gaussian", "sprites"))
        self.assert_differ(gather, gaussian)
        stages = [self.defocus("--engine", "gather", "--gather-stage", s) for s in STAGES]
        for i, stage in enumerate(stages):
            self.assert_differ(stage, gather, STAGES[i])
            for other in stages[:i]:
                self.assert_differ(stage, other, STAGES[i])
        cure = ["--engine", "gather", "--gather-stage", "cure"]
        for flags in (["--gather-taps", "16"], ["--gather-taps", "71"], ["--gather-coc", "extreme"]):
            self.assert_differ(self.defocus(*cure, *flags), stages[-1], flags)
        self.assert_differ(self.defocus("--engine", "gather", "--gather-fill", "off"), gather)
        wgld = ["--engine", "gaussian", "--gaussian-style", "wgld"]
        by_depth = self.defocus(*wgld)
        self.assert_differ(by_depth, gaussian)
        self.assert_differ(self.defocus("--engine", "gaussian", "--gaussian-style", "plain"), gaussian)
        self.assert_differ(self.defocus("--engine", "gaussian", "--focus-band", "2"), gaussian)
        for flags in (["--focus-band", "0.6"], ["--depth-offset", "0.3"], ["--depth-along", "ray"], ["--depth-band-range", "0.1m,30m"]):
            self.assert_differ(self.defocus(*wgld, *flags), by_depth, flags)
        self.assert_differ(self.defocus("--engine", "sprites", "--background", "gaussian"), sprites)

    def test_flags_at_their_default_change_nothing(self):
        for engine, flags in (("gather", ["--gather-fill", "on"]), ("gaussian", ["--gaussian-style", "layered"]),
                              ("gaussian", ["--focus-band", "0"]),
                              ("sprites", ["--background", "gather", "--find-points", "on", "--bright-factor", "3"])):
            self.assertTrue(self.defocus("--engine", engine, *flags) == self.defocus("--engine", engine), flags)

    def test_flags_of_another_engine_are_refused(self):
        for flags, says in ((["--gather-stage", "blur"], "--engine gather"),
                            (["--engine", "gather", "--gather-taps", "16"], "--gather-stage"),
                            (["--engine", "gather", "--gather-stage", "glow"], "near-far"),
                            (["--engine", "gather", "--gather-stage", "disc", "--gather-taps", "17"], "71"),
                            (["--focus-band", "1"], "--engine gaussian"),
                            (["--engine", "gaussian", "--depth-offset", "1"], "--gaussian-style wgld"),
                            (["--engine", "gaussian", "--gaussian-style", "wgld", "--focus-band", "2"], "0 to 1"),
                            (["--engine", "gaussian", "--focus-band", "-1"], "--focus-band"),
                            (["--engine", "gather", "--points", "p.csv"], "--engine sprites"),
                            (["--background", "gather"], "--engine sprites"),
                            (["--engine", "sprites", "--bright-factor", "0"], "--bright-factor"),
                            (["--engine", "gather", "--view", "blur-small"], "--engine gaussian")):
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, *flags, says=[says])

    def test_gaussian_buffers_are_shown_as_exr_and_png(self):
        gaussian = ["--engine", "gaussian", "--gaussian-style", "wgld"]
        sharp = picture(48, 32, texture, steps)["G"]
        for a, b in zip(self.defocus(*gaussian, "--view", "sharp"), sharp):
            for one, other in zip(a, b):
                self.assertAlmostEqual(one, other, delta=1e-3)
        small, large = (self.defocus(*gaussian, "--view", "blur-" + s) for s in ("small", "large"))
        self.assert_differ(small, large)
        index = self.defocus(*gaussian, "--view", "focus-index", channel="focus_index")
        self.assertEqual(index[5][20], 1)
        self.assertLess(index[20][40], 1)
        for view in ("sharp", "blur-small", "blur-large", "blur-rows", "focus-index"):
            self.succeed("defocus", "in.exr", "-o", view + ".png", *CAMERA, *gaussian, "--view", view)
            rows, channels, _ = read_png(self.path(view + ".png"))
            self.assertEqual((len(rows), channels), (32, 1 if view == "focus-index" else 3), view)

    def test_levels_are_shown_side_by_side_as_exr_and_png(self):
        self.succeed("defocus", "in.exr", "-o", "levels.exr", *CAMERA, "--view", "levels")
        channels, header = read_exr(self.path("levels.exr"))
        self.assertEqual((len(channels["G"]), len(channels["G"][0])), (32 + 16, 2 * 48))
        self.assertIn(b"LEVEL 0", open(self.path("levels.exr"), "rb").read())
        self.succeed("defocus", "in.exr", "-o", "levels.png", *CAMERA, "--view", "levels", "--exposure", "1")
        rows, channels, _ = read_png(self.path("levels.png"))
        self.assertEqual((len(rows), channels), (48, 3))
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--view", "levels", "--engine", "gather",
                    says=["--view levels", "scatter"])

    def test_layers_and_highlights_are_layers_of_an_exr_and_panels_of_a_png(self):
        for view, prefix, extra in (("layers", "second.", ["depth_layer", "second.depth_layer"]), ("highlights", "taken.", [])):
            self.succeed("defocus", "in.exr", "-o", view + ".exr", *CAMERA, "--view", view)
            channels, _ = read_exr(self.path(view + ".exr"))
            expected = [p + c for p in ("", prefix) for c in "RGBA"] + extra
            self.assertEqual(set(expected) - set(channels), set())
            self.assertEqual((len(channels["G"]), len(channels["G"][0])), (32, 48))
            self.succeed("defocus", "in.exr", "-o", view + ".png", *CAMERA, "--view", view)
            rows, channels, _ = read_png(self.path(view + ".png"))
            self.assertEqual((len(rows) % 32, len(rows[0]) // channels), (0, 2 * 48), view)
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--view", view, "--engine", "gather",
                        says=["--view " + view, "scatter"])
        both, _ = read_exr(self.path("layers.exr"))
        self.assertTrue(any(v == v and v < 0 for row in both["depth_layer"] for v in row), "nothing in front of focus")

    def test_too_little_memory_is_said(self):
        for engine in ("gather", "gaussian", "sprites"):
            self.refuse(1, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--engine", engine, "--max-memory", "15M",
                        says=["--max-memory", engine])

    def test_given_points_are_drawn_where_they_are(self):
        self.points("# lamps\n\n X , y,coc , R,g,b,size,vx\n20.5, 15.5,-4, 8,16, 4, 0,3 # one\r\n44.5,25.5,0,1,2,3,0,0\r\n")
        green = self.sprites()
        self.assertAlmostEqual(sum(map(sum, green)), 18, delta=0.05)
        self.assertAlmostEqual(green[15][20], 16 / (3.14159 * 16), delta=0.01)
        self.assertEqual(green[15][26], 0)
        self.assertAlmostEqual(green[25][44], 2, delta=0.01)

    def test_points_are_places_of_the_display_window(self):
        write_exr(self.path("crop.exr"), picture(32, 20, 0.0, 2), display=(0, 0, 63, 39), origin=(10, 5))
        self.points(HEADER + "20.5,15.5,0,1,2,3\n")
        self.assertAlmostEqual(self.sprites(source="crop.exr")[10][10], 2, delta=1e-3)

    def test_depth_of_points_goes_through_the_camera(self):
        self.points("x,y,depth,r,g,b\n32.5,20.5,2,1,1,1\n")
        self.assertAlmostEqual(self.sprites()[20][32], 1, delta=1e-3)
        self.points("x,y,depth,r,g,b\n32.5,20.5,1.5,1,1,1\n")
        self.assertLess(self.sprites()[20][32], 0.1)
        write_exr(self.path("coc.exr"), {"Z": plane(64, 40, 1)})
        self.refuse(3, "defocus", "black.exr", "--depth", "coc.exr", "--depth-kind", "coc-px", "-o", "no.exr",
                    "--engine", "sprites", "--points", "points.csv", says=["points.csv", "coc"])

    def test_points_that_cannot_be_drawn_are_counted(self):
        self.points(HEADER + "20.5,15.5,1,nan,1,1\n20.5,15.5,1,1e99,1,1\n20.5,15.5,1,-1,1,1\n-400,15,1,1,1,1\n3,3,0,1,1,1\n")
        warnings = self.report("defocus", "black.exr", "-o", "out.exr", *CAMERA, "--engine", "sprites", "--points",
                               "points.csv")["warnings"]
        for text in ("2 of 5 given points are not finite", "1 of 5 given points have negative", "1 of 5 given points lie"):
            self.assertTrue(any(text in w for w in warnings), (text, warnings))

    def test_points_in_fractions_of_the_frame_are_doubted(self):
        for places, is_doubted in (("0.2,0.7 0.5,0.5", True), ("0.2,0.7 3.5,0.5", False), ("0.5,0.5", False)):
            self.points(HEADER + "".join(place + ",1,1,1,1\n" for place in places.split()))
            warnings = self.report("defocus", "black.exr", "-o", "out.exr", *CAMERA, "--engine", "sprites", "--points",
                                   "points.csv")["warnings"]
            self.assertEqual(any("not fractions" in w for w in warnings), is_doubted, (places, warnings))

    def test_a_malformed_line_is_named(self):
        for text, line, says in (("", None, "empty"), ("x,y,r,g,b\n", 1, "depth or coc"), ("a,b\n1,2\n", 1, "'a'"),
                                 ("x,y,coc,depth,r,g,b\n", 1, "both"), ("x,x,coc,r,g,b\n", 1, "twice"),
                                 ("y,coc,r,g,b\n", 1, "column x is missing"),
                                 (HEADER + "1,2,3,4,5,6\n1,2,3,four,5,6\n", 3, "'four' in column r"),
                                 (HEADER + "\n1,2,3\n", 3, "3 values"), (HEADER + "1,2,3,4,5,6,7\n", 2, "more values"),
                                 (HEADER + "1,2,3,4,5,\n", 2, "''"), (HEADER + "1;2;3;4;5;6\n", 2, "not a number"),
                                 ("\0\1\2\n", 1, "not a column")):
            self.points(text)
            where = "points.csv:%d:" % line if line else "points.csv"
            self.refuse(3, "defocus", "black.exr", "-o", "no.exr", *CAMERA, "--engine", "sprites", "--points",
                        "points.csv", says=[where, says])
        # Without an end.
        self.refuse(3, "defocus", "black.exr", "-o", "no.exr", *CAMERA, "--engine", "sprites", "--points", "/dev/zero",
                    says=["/dev/zero", "not a regular file"])
        self.points("1" * 5000)
        self.refuse(3, "defocus", "black.exr", "-o", "no.exr", *CAMERA, "--engine", "sprites", "--points", "points.csv",
                    says=["points.csv:1", "characters in a line"])
        self.refuse(3, "defocus", "black.exr", "-o", "no.exr", *CAMERA, "--engine", "sprites", "--points", "none.csv",
                    says=["none.csv"])

    def test_points_of_every_kind_can_be_made_and_drawn(self):
        sizes = ["--width", "64", "--height", "40", "--focal-length", "40mm"]
        for kind in ("glints", "city", "drops"):
            self.succeed("scene", "points", kind, "-o", "points.csv", *sizes, "--count", "12")
            first = open(self.path("points.csv")).read()
            self.succeed("scene", "points", kind, "-o", "again.csv", *sizes, "--count", "12", "--seed", "1")
            self.assertEqual(first, open(self.path("again.csv")).read())
            self.assertEqual(sum(line[0] not in "#x" for line in first.splitlines()), 12, kind)
            if kind == "drops":
                self.assertGreater(sum(map(sum, self.sprites())), 0, kind)
        self.succeed("scene", "points", "glints", "-o", "points.csv", "--no-clobber")
        self.assertEqual(first, open(self.path("points.csv")).read())

    def test_points_that_cannot_be_made_are_refused(self):
        for words, says in ((["rain", "-o", "p.csv"], "glints, city"), (["city", "-o", "p.exr"], ".csv"),
                            (["city"], "-o FILE.csv"), (["drops", "-o", "p.csv", "--horizon", "0.3"], "--horizon"),
                            (["city", "-o", "p.csv", "--horizon", "7"], "horizon"),
                            (["city", "-o", "p.csv", "--width", "64", "--count", "9000000"], "were asked for")):
            self.refuse(2, "scene", "points", *words, says=[says])

    def test_the_report_holds_what_was_asked_for(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--engine", "gather", "--gather-stage",
                             "cure", "--gather-taps", "16")
        self.assertEqual(report["engine"], "gather")
        self.assertEqual(report["parameters"]["engine_options"], {"gather_stage": "cure", "gather_taps": 16})


if __name__ == "__main__":
    unittest.main()
