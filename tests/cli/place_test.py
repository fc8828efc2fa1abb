"""Where pixels lie in the frame, windows and pixel aspect, is the same in everything that is written of a picture."""
import struct
import unittest

from pictures import camera_attributes, picture, read_exr, write_exr
from program import CommandLineTest

ASPECT, DISPLAY, ORIGIN = 2, (0, 0, 39, 29), (4, 5)
SENSOR_MM = 36
VIEWS = {"beauty": [], "coc": [], "focus": [], "depth": [], "alpha": [], "layers": [], "highlights": [], "guessed": [],
         "sharp": ["--engine", "gaussian"], "blur-small": ["--engine", "gaussian"],
         "blur-large": ["--engine", "gaussian"], "focus-index": ["--engine", "gaussian"]}


class PlaceOfPixels(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(20, 10, lambda x, y: 40 if (x, y) == (7, 3) else 0.5, 2, alpha=1),
                  display=DISPLAY, origin=ORIGIN, aspect=ASPECT,
                  attributes=camera_attributes(200, SENSOR_MM, 1.4, 3))

    def attributes(self, name):
        found = read_exr(self.path(name))[1]
        return (struct.unpack("<f", found["pixelAspectRatio"])[0], struct.unpack("<4i", found["displayWindow"]),
                struct.unpack("<4i", found["dataWindow"]), found)

    def test_of_every_view(self):
        for view, flags in VIEWS.items():
            room = ["--overscan", "off"] if view in ("beauty", "alpha") else []
            self.succeed("defocus", "in.exr", "-o", view + ".exr", "--view", view, *room, *flags)
            aspect, display, data, _ = self.attributes(view + ".exr")
            self.assertEqual((view, aspect, display, data), (view, ASPECT, DISPLAY, (4, 5, 23, 14)))

    def test_of_pictures_side_by_side_the_shape_of_pixels(self):
        self.succeed("defocus", "in.exr", "-o", "levels.exr", "--view", "levels")
        self.assertEqual(self.attributes("levels.exr")[0], ASPECT)

    def test_the_sensor_is_as_high_as_its_pixels_are(self):
        self.succeed("defocus", "in.exr", "-o", "coc.exr", "--view", "coc")
        width, height = struct.unpack("<2f", self.attributes("coc.exr")[3]["sensorOverallDimensions"])
        self.assertAlmostEqual(width, SENSOR_MM, places=4)
        self.assertAlmostEqual(height, SENSOR_MM * 30 / 40 / ASPECT, places=4)

    def test_inspect_says_it(self):
        self.assertIn("pixel aspect 2", self.succeed("inspect", "in.exr").out)


if __name__ == "__main__":
    unittest.main()
