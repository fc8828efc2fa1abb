"""What is written beside a picture and said of odd ones: camera, history, white, pixel aspect, mattes without colour."""
import struct
import subprocess
import unittest

from pictures import attribute, camera_attributes, picture, plane, read_exr, read_png, write_exr
from program import CommandLineTest

CAMERA = camera_attributes(50, 36, 2, 2)


def chromaticities(*numbers):
    return attribute("chromaticities", "chromaticities", struct.pack("<8f", *numbers))


XYZ = chromaticities(1, 0, 0, 1, 0, 0, 1 / 3, 1 / 3)


class Manners(CommandLineTest):
    def test_camera_and_history_are_written(self):
        write_exr(self.path("in.exr"), picture(depth=3))
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--focal-length", "50mm", "--sensor-width", "36mm", "--fstop",
                     "2.8", "--focus", "2m", "--lens", "doublet")
        attributes = read_exr(self.path("out.exr"))[1]
        for name, value in (("aperture", 2.8), ("focus", 2), ("pinholeFocalLength", 50)):
            self.assertAlmostEqual(struct.unpack("<f", attributes[name])[0], value, places=5)
        history = attributes["petzval:history"].decode()
        for word in ("defocus R: petzval ", "scatter", "doublet", "50 mm", "f/2.8", "focus 2 m"):
            self.assertIn(word, history)

    def test_blurring_twice_is_warned_of_and_both_are_told(self):
        write_exr(self.path("in.exr"), picture(depth=3), attributes=CAMERA)
        self.assertNotIn("second time", self.succeed("defocus", "in.exr", "-o", "once.exr").err)
        self.assertIn("second time", self.succeed("defocus", "once.exr", "-o", "twice.exr", "--fstop", "8").err)
        self.assertEqual(read_exr(self.path("twice.exr"))[1]["petzval:history"].decode().count("defocus R: "), 2)
        self.assertNotIn("second time", self.succeed("defocus", "once.exr", "-o", "coc.exr", "--view", "coc").err)

    def test_the_history_does_not_depend_on_threads_or_names(self):
        write_exr(self.path("in.exr"), picture(depth=3), attributes=CAMERA)
        self.succeed("defocus", "in.exr", "-o", "a.exr", "--threads", "1")
        self.succeed("defocus", "in.exr", "-o", "b.exr", "--threads", "2")
        with open(self.path("a.exr"), "rb") as a, open(self.path("b.exr"), "rb") as b:
            self.assertEqual(a.read(), b.read())

    def develop(self, name, channels, attributes):
        write_exr(self.path("in.exr"), channels, attributes=attributes)
        outcome = self.succeed("develop", "in.exr", "-o", name, "--tone", "none", "--no-dither")
        return read_png(self.path(name))[0][2][:3], outcome.err

    def test_xyz_is_taken_as_it_is(self):
        grey = 0.5
        xyz = {c: plane(8, 6, v * grey) for c, v in zip("RGB", (0.95046, 1, 1.08906))}
        of_xyz, said = self.develop("xyz.png", xyz, XYZ)
        of_rec709, _ = self.develop("rec709.png", {c: plane(8, 6, grey) for c in "RGB"}, b"")
        self.assertEqual(of_xyz, of_rec709)
        self.assertNotIn("adapted", said)
        _, said = self.develop("aces.png", {c: plane(8, 6, grey) for c in "RGB"},
                               chromaticities(0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767))
        self.assertIn("adapted from 0.32168,0.33767", said)
        adopted = attribute("adoptedNeutral", "v2f", struct.pack("<2f", 0.3457, 0.3585))
        warm, said = self.develop("warm.png", {c: plane(8, 6, grey) for c in "RGB"}, adopted)
        self.assertIn("adoptedNeutral", said)
        self.assertGreater(warm[2], warm[0])

    def test_pixels_that_are_not_square_are_so_in_a_png(self):
        write_exr(self.path("in.exr"), picture(depth=2), attributes=CAMERA, aspect=2)
        self.succeed("defocus", "in.exr", "-o", "out.png")
        with open(self.path("out.png"), "rb") as file:
            data = file.read()
        x, y, unit = struct.unpack_from(">IIB", data, data.index(b"pHYs") + 4)
        self.assertEqual((y / x, unit), (2, 0))

    def test_a_matte_of_alpha_and_depth_holds_out(self):
        write_exr(self.path("in.exr"), picture(depth=3, alpha=1), attributes=CAMERA)
        write_exr(self.path("matte.exr"), {"A": plane(24, 16, lambda x, y: float(x < 8)), "Z": plane(24, 16, 1)})
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--holdout", "matte.exr")
        row = read_exr(self.path("out.exr"))[0]["R"][8]
        self.assertEqual((row[3], row[20] > 0.4), (0, True))

    def test_the_focus_view_leaves_emptiness_alone(self):
        write_exr(self.path("in.exr"), picture(200, 120, lambda x, y: float(x < 100), 3, lambda x, y: float(x < 100)),
                  attributes=CAMERA)
        self.succeed("defocus", "in.exr", "-o", "f.png", "--view", "focus")
        row = read_png(self.path("f.png"))[0][5]
        self.assertEqual(row[3 * 150:3 * 150 + 3], [0, 0, 0])
        self.assertGreater(row[3 * 50], 60)

    def test_no_percentile_is_above_the_brightest_value(self):
        write_exr(self.path("in.exr"), picture(colour=0.5), attributes=CAMERA)
        light = self.report("inspect", "in.exr")["dynamic_range"]
        self.assertLessEqual(light["specular"], light["brightest"])

    def test_environment_maps_are_spoken_of(self):
        write_exr(self.path("in.exr"), picture(depth=2), attributes=CAMERA + attribute("envmap", "envmap", b"\0"))
        self.assertIn("environment map", self.succeed("defocus", "in.exr", "-o", "out.exr").err)


if __name__ == "__main__":
    unittest.main()
