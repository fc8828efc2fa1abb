"""petzval defocus --layers: layers of a file are blurred with the colour, so that what sums to it still does."""
import os
import struct
import unittest

from pictures import attribute, camera_attributes, picture, plane, read_exr, write_exr
from program import PETZVAL, CommandLineTest

WIDTH, HEIGHT = 72, 48
SHARED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "shared", "exr")


def is_near(x, y):
    return 24 <= x < 44 and 14 <= y < 36


def depth(x, y):
    return 1 if is_near(x, y) else 4


def light(x, y):
    return 40.0 if (x, y) == (60, 10) else 0.2 + (x * 37 + y * 91) % 17 / 20


def key(x, y):
    return light(x, y) * (0.8 if is_near(x, y) else 0.3 + (x + 2 * y) % 5 / 10)


def add_layer(channels, name, value, alpha=None):
    for c in "RGB":
        channels[name + "." + c] = plane(WIDTH, HEIGHT, value)
    if alpha is not None:
        channels[name + ".A"] = plane(WIDTH, HEIGHT, alpha)


def many_layers(alpha=1):
    channels = picture(WIDTH, HEIGHT, light, depth, alpha)
    add_layer(channels, "key", key, alpha)
    add_layer(channels, "fill", lambda x, y: light(x, y) - key(x, y))
    add_layer(channels, "albedo", lambda x, y: 0.9 if is_near(x, y) else 0.4)
    add_layer(channels, "glow", lambda x, y: 3.0)  # by its values no share of the colour's light
    add_layer(channels, "N", lambda x, y: (x - y) / 50)
    add_layer(channels, "CryptoObject00", lambda x, y: x + y / 7)
    add_layer(channels, "uCryptoed", lambda x, y: x + y / 9)
    channels["matte"] = plane(WIDTH, HEIGHT, lambda x, y: 1.0 if is_near(x, y) else 0.0)
    channels["spill"] = plane(WIDTH, HEIGHT, lambda x, y: x / WIDTH)
    channels["forward.u"] = plane(WIDTH, HEIGHT, lambda x, y: x / 3)
    return channels


CRYPTO = attribute("cryptomatte/1234567/name", "string", b"uCrypto")
CAMERA = camera_attributes(120, 36, 1.4, 2)
BLURRED = {"key": "light", "fill": "light", "albedo": "coverage", "glow": "coverage", "matte": "coverage",
           "spill": "coverage"}


class Layers(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.sharp = many_layers()
        write_exr(self.path("in.exr"), self.sharp, attributes=CAMERA + CRYPTO)

    def assert_sums(self, out, places=1e-4):
        for c in "RGB":
            for y in range(len(out[c])):
                for x, both in enumerate(out[c][y]):
                    total = out["key." + c][y][x] + out["fill." + c][y][x]
                    self.assertLess(abs(total - both), places * max(1, both), "%s at %d,%d" % (c, x, y))

    def test_layers_that_sum_to_the_picture_do_so_when_blurred(self):
        for flags in ([], ["--lens", "doublet"], ["--distortion", "0.2"], ["--overscan", "9"], ["--engine", "gather"],
                      ["--engine", "gaussian"]):
            self.succeed("defocus", "in.exr", "-o", "out.exr", "--layers", "key,fill", *flags)
            out = read_exr(self.path("out.exr"))[0]
            self.assertNotEqual(out["key.R"], self.sharp["key.R"])
            self.assert_sums(out)

    def test_with_what_is_hidden_and_a_matte_that_stays_sharp(self):
        write_exr(self.path("behind.exr"), picture(WIDTH, HEIGHT, light, 4, 1))
        write_exr(self.path("holdout.exr"), picture(WIDTH, HEIGHT, 0, 0.5, lambda x, y: 1.0 if x < 20 else 0.0))
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--layers", "all", "--behind", "behind.exr", "--holdout",
                     "holdout.exr", "--max-memory", "600M")
        out = read_exr(self.path("out.exr"))[0]
        self.assert_sums(out)
        self.assertEqual(out["key.G"][20][4], 0, "held out")

    def test_a_layer_names_a_lamp_in_the_picture_too(self):
        lens = ["--lens", "uncorrected"]
        self.succeed("defocus", "in.exr", "-o", "day.exr", "--layers", "key,fill", *lens)
        said = self.succeed("defocus", "in.exr", "-o", "out.exr", "--layers", "key:sodium,fill", *lens).err
        self.assertIn("key (sodium)", said)
        day, out = read_exr(self.path("day.exr"))[0], read_exr(self.path("out.exr"))[0]
        self.assert_sums(out, 2e-3)  # half floats
        self.assertTrue(out["key.B"] != day["key.B"] and out["B"] != day["B"])
        self.assertTrue(out["fill.B"] == day["fill.B"])
        for flags, says in ((["--layers", "key:sodium"], "ideal lens"),
                            (["--layers", "matte:neon", *lens], "layers of light"),
                            (["--layers", "glow:neon", *lens], "not a share"),
                            (["--layers", "key:neon", "--engine", "gaussian"], "gaussian")):
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *flags, says=["--layers", says])

    def test_the_picture_knows_nothing_of_its_layers(self):
        self.succeed("defocus", "in.exr", "-o", "alone.exr")
        self.succeed("defocus", "in.exr", "-o", "all.exr", "--layers", "all")
        alone, all_ = (read_exr(self.path(n))[0] for n in ("alone.exr", "all.exr"))
        for c in "RGBZ":
            self.assertEqual(alone[c], all_[c])

    def test_all_takes_light_and_mattes_and_leaves_data_alone_and_says_so(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr", "--layers", "all")
        self.assertEqual({b["name"]: b["guide"] for b in report["layers"]["blurred"]}, BLURRED)
        carried = {c["name"]: c["why"] for c in report["layers"]["carried"]}
        self.assertEqual(set(carried), {"N", "CryptoObject00", "uCryptoed", "forward.u"})
        self.assertIn("Cryptomatte", carried["uCryptoed"])
        self.assertTrue(any("forward.u" in line for line in report["detected"]))
        out = read_exr(self.path("out.exr"))[0]
        for name in carried:
            for channel in self.sharp:
                if channel.startswith(name):
                    self.assertEqual(out[channel], self.sharp_as_stored()[channel], channel)
        self.assertEqual(out["key.A"], self.sharp_as_stored()["key.A"], "opaque stays opaque")

    def sharp_as_stored(self):
        return read_exr(self.path("in.exr"))[0]

    def test_a_matte_is_blurred_as_what_it_covers(self):
        write_exr(self.path("near.exr"), {**picture(WIDTH, HEIGHT, lambda x, y: float(is_near(x, y)), depth,
                                                    lambda x, y: float(is_near(x, y))),
                                          "matte": plane(WIDTH, HEIGHT, lambda x, y: float(is_near(x, y)))},
                  attributes=CAMERA)
        self.succeed("defocus", "near.exr", "-o", "out.exr", "--layers", "matte")
        out = read_exr(self.path("out.exr"))[0]
        for y in range(HEIGHT):
            for x in range(WIDTH):
                self.assertAlmostEqual(out["matte"][y][x], out["A"][y][x], delta=1e-4)
        self.assertTrue(0.1 < out["matte"][24][24] < 0.9)

    def test_an_alpha_of_its_own_is_blurred_as_a_matte(self):
        layer = {**self.sharp, "key.A": plane(WIDTH, HEIGHT, lambda x, y: float(is_near(x, y)))}
        write_exr(self.path("own.exr"), layer, attributes=CAMERA)
        report = self.report("defocus", "own.exr", "-o", "out.exr", "--layers", "key,matte")
        self.assertEqual([b["name"] for b in report["layers"]["blurred"]], ["matte", "key", "key.A"])
        out = read_exr(self.path("out.exr"))[0]
        self.assertEqual(out["key.A"], out["matte"])

    def test_names_leave_out_and_are_obeyed(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr", "--layers", "all,-glow,-spill")
        self.assertEqual({b["name"] for b in report["layers"]["blurred"]}, set(BLURRED) - {"glow", "spill"})
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--layers", "N")
        self.assertNotEqual(read_exr(self.path("out.exr"))[0]["N.R"], self.sharp_as_stored()["N.R"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--layers", "CryptoObject00",
                    says=["--layers", "cryptoobject00", "Cryptomatte"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--layers", "keyy", says=["did you mean key?"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--layers", "key:lamp", says=["key:lamp", "no such layer"])

    def test_without_the_flag_the_log_says_what_stays_sharp(self):
        self.assertIn("--layers all", self.succeed("defocus", "in.exr", "-o", "out.exr").err)
        write_exr(self.path("bare.exr"), picture(8, 8), attributes=CAMERA)
        self.assertNotIn("--layers", self.succeed("defocus", "bare.exr", "-o", "out.exr").err)

    def test_luminance_stays_luminance_while_it_is_grey(self):
        write_exr(self.path("y.exr"), {"Y": plane(24, 16, lambda x, y: (x * y) % 5), "Z": plane(24, 16, 4),
                                       "fog.Y": plane(24, 16, lambda x, y: (x * y) % 5 / 2)}, attributes=CAMERA)
        self.succeed("defocus", "y.exr", "-o", "out.exr", "--layers", "all")
        out = read_exr(self.path("out.exr"))[0]
        self.assertEqual(set(out), {"Y", "Z", "fog.Y"})
        for row, half in zip(out["Y"], out["fog.Y"]):
            for value, share in zip(row, half):
                self.assertAlmostEqual(value, 2 * share, delta=1e-4)
        self.assertIn("R, G and B", self.succeed("defocus", "y.exr", "-o", "rgb.exr", "--lens", "doublet").err)
        self.assertEqual(set(read_exr(self.path("rgb.exr"))[0]), {"R", "G", "B", "Z", "fog.Y"})

    def test_is_refused_where_it_has_no_effect(self):
        self.refuse(2, "defocus", "in.exr", "-o", "out.png", "--layers", "all", says=["--layers", "EXR"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--layers", "all", "--view", "coc", says=["--layers"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--layers", "all", "--merge", "in.exr",
                    says=["--layers", "--merge"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--layers", "all", "--engine", "reference",
                    says=["--layers", "--engine", "reference"])

    def test_values_where_there_is_no_coverage_are_spoken_of(self):
        channels = picture(16, 16, lambda x, y: float(x < 8), 2, lambda x, y: float(x < 8))
        channels["sky"] = plane(16, 16, 1)
        write_exr(self.path("sky.exr"), channels, attributes=CAMERA)
        self.assertIn("'sky' have values in 128 pixels",
                      self.succeed("defocus", "sky.exr", "-o", "out.exr", "--layers", "all").err)


class BothEyes(CommandLineTest):
    def setUp(self):
        super().setUp()
        views = b"".join(struct.pack("<i", len(v)) + v for v in (b"right", b"left"))
        channels = picture(20, 12, light, 4, 1)
        for c in "RGBAZ":
            channels["left." + c] = plane(20, 12, lambda x, y, c=c: 1 if c == "A" else 6 if c == "Z" else light(y, x))
        channels["key.left.matte"] = plane(20, 12, lambda x, y: x / 20)
        write_exr(self.path("in.exr"), channels, display=(0, 0, 39, 29), origin=(10, 9),
                  attributes=CAMERA + attribute("multiView", "stringvector", views))

    def test_are_blurred_in_one_run_as_each_alone(self):
        report = self.report("defocus", "in.exr", "-o", "both.exr", "--view-name", "all", "--layers", "all")
        self.assertEqual([v["view"] for v in report["views"]], ["left"])
        both, attributes = read_exr(self.path("both.exr"))
        history = attributes["petzval:history"].decode().splitlines()
        self.assertEqual([line[:line.index(":")] for line in history], ["defocus R", "defocus left.R"])
        x0, y0, _, _ = struct.unpack("<4i", attributes["dataWindow"])
        for view, prefix, more in (("right", "", []), ("left", "left.", ["key.left.matte"])):
            self.succeed("defocus", "in.exr", "-o", "one.exr", "--view-name", view, "--layers", "all")
            one, found = read_exr(self.path("one.exr"))
            window = struct.unpack("<4i", found["dataWindow"])
            for channel in [prefix + c for c in "RGBA"] + more:
                for y in range(window[1], window[3] + 1):
                    for x in range(window[0], window[2] + 1):
                        self.assertAlmostEqual(both[channel][y - y0][x - x0],
                                               one[channel][y - window[1]][x - window[0]], delta=1e-5)

    def test_the_other_eye_is_spoken_of_and_mattes_of_one_view_refused(self):
        self.assertIn("--view-name all", self.succeed("defocus", "in.exr", "-o", "out.exr").err)
        self.refuse(2, "defocus", "in.exr", "-o", "no.png", "--view-name", "all", says=["--view-name all", "EXR"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--view-name", "all", "--holdout", "in.exr",
                    says=["--view-name all", "--holdout"])


@unittest.skipUnless(os.path.isdir(SHARED), "needs ../shared/exr")
class PartsOfOthers(CommandLineTest):
    CAMERA = ["--focal-length", "50", "--sensor-width", "36", "--fstop", "2", "--focus", "10"]

    def test_a_matte_in_a_part_of_its_own_grows_with_the_picture(self):
        report = self.report("defocus", os.path.join(SHARED, "multipart.0001.exr"), "-o", "out.exr", "--layers", "all",
                             "--overscan", "16", *self.CAMERA)
        self.assertEqual([b["name"] for b in report["layers"]["blurred"]], ["whitebarmask.mask"])
        carried = {c["name"]: c["why"] for c in report["layers"]["carried"]}
        self.assertEqual(carried["rgba_left"], "of another view")
        self.assertIn("by its name", carried["disparityL.x"])
        parts = {p["name"]: p["data_window"] for p in self.report("inspect", "out.exr")["parts"]}
        self.assertEqual(parts["whitebarmask_right"], parts["rgba_right"])
        self.assertEqual(parts["whitebarmask_left"]["width"], 385)


if __name__ == "__main__":
    unittest.main()
