"""petzval lens psf and table, and the flags that shape a lens: every one changes the picture, bad ones are refused."""
import struct
import unittest
import zlib

from program import CommandLineTest


def grey_png(path, width, height, value):
    """value(x, y): 0…255."""
    rows = b"".join(b"\0" + bytes(value(x, y) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class LensPsf(CommandLineTest):
    def psf(self, lens, *flags):
        """(size, bytes) of the kernel's file."""
        self.succeed("lens", "psf", lens, "-o", "psf.exr", *flags)
        with open(self.path("psf.exr"), "rb") as file:
            return file.read()

    def test_tells_what_was_used(self):
        report = self.report("lens", "psf", "doublet", "--defocus", "-12", "--field", "0.4,0.1", "-o", "psf.exr")
        self.assertEqual(report["defocus_px"], -12)
        self.assertEqual(report["field"], [0.4, 0.1])
        self.assertEqual(report["size"] % 2, 1)
        self.assertEqual(report["lost_share"], 0)
        self.assertEqual(report["camera"]["focal_length_mm"], 50)
        self.assertEqual(report["lens"]["name"], "doublet")

    def test_a_prescription_brings_its_own_camera_numbers(self):
        report = self.report("lens", "psf", "takumar", "-o", "psf.exr")
        self.assertAlmostEqual(report["camera"]["f_number"], 1.4, places=3)
        # A 3:2 frame that its 22 degrees fill: 2 tan 22 / hypot(1, 2/3).
        self.assertAlmostEqual(report["camera"]["sensor_width_mm"] / report["camera"]["focal_length_mm"], 0.67234, 5)

    def test_every_flag_changes_the_kernel(self):
        plain = self.psf("doublet", "--field", "0.6,0.3")
        for flags in (["--defocus", "21"], ["--raw"], ["--size", "15"],
                      ["--spherical", "0"], ["--axial-colour", "-1"], ["--add-spherical", "20"],
                      ["--add-axial-colour", "-0.5"], ["--add-field-curvature", "-1"],
                      ["--add-lateral-colour", "0.5"], ["--add-spherical", "20", "--add-at-fstop", "4"], ["--light", "neon"], ["--coma", "0.4"], ["--astigmatism", "0.4"],
                      ["--distortion", "0.05"], ["--wavelengths", "3"], ["--wave"], ["--focus-mode", "paraxial"],
                      ["--focus-shift", "0.2"], ["--blades", "6"], ["--cats-eye", "0.5"], ["--squeeze", "1.5"],
                      ["--barrel", "11,15"], ["--barn-doors", "0.4,0,0,0"], ["--dust", "1"], ["--scratches", "1"],
                      ["--onion-rings", "1"], ["--fstop", "2.8"], ["--width", "2400"], ["--sensor-width", "24mm"],
                      ["--focal-length", "85mm"]):
            self.assertFalse(plain == self.psf("doublet", "--field", "0.6,0.3", *flags), flags)
        traced = self.psf("retrofocus", "--field", "0.6,0.3")
        self.assertFalse(traced == self.psf("retrofocus", "--field", "0.6,0.3", "--lateral-colour", "0"))
        self.assertTrue(traced == self.psf("retrofocus", "--field", "0.6,0.3", "--lateral-colour", "1"))

    def test_a_lens_scaled_with_its_sensor_makes_the_same_kernel(self):
        plain = self.psf("doublet")
        self.assertTrue(plain == self.psf("doublet", "--focal-length", "100mm", "--sensor-width", "72mm"))
        self.assertFalse(plain == self.psf("doublet", "--focal-length", "85mm"))
        self.assertFalse(plain == self.psf("doublet", "--fstop", "2.8"))

    def test_a_lens_of_another_format_brings_its_sensor(self):
        report = self.report("lens", "psf", "doublet-ccd", "--focal-length", "16mm", "-o", "psf.exr")
        self.assertEqual(report["camera"]["sensor_width_mm"], 4.8)

    def test_blades_with_an_iris_that_opens(self):
        open_iris = self.psf("ideal", "--blades", "6", "--iris-open", "2", "--fstop", "2")
        closed = self.psf("ideal", "--blades", "6", "--iris-open", "2", "--fstop", "8")
        self.assertFalse(open_iris == closed)

    def test_images_of_apertures_and_discs(self):
        grey_png(self.path("half.png"), 32, 32, lambda x, y: 255 if x < 16 else 0)
        plain = self.psf("ideal")
        self.assertFalse(plain == self.psf("ideal", "--aperture-image", "half.png"))
        far = self.psf("ideal", "--kernel-image", "half.png")
        self.assertFalse(plain == far)
        self.assertFalse(far == self.psf("ideal", "--kernel-image", "half.png", "--defocus", "-20"))

    def test_png_to_look_at(self):
        self.succeed("lens", "psf", "uncorrected", "--defocus", "-30", "-o", "psf.png")
        with open(self.path("psf.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_a_picture_too_small_is_said(self):
        self.assertIn("--size", self.succeed("lens", "psf", "ideal", "--size", "11", "-o", "psf.exr").err)

    def test_bad_numbers_are_refused(self):
        for says, flags in ((["--barrel"], ["--barrel", "14"]), (["--barn-doors"], ["--barn-doors", "1,2"]),
                            (["--dust"], ["--dust", "2"]), (["--kernel-image"], ["--kernel-image", "a,b,c"]),
                            (["--iris-open", "--blades"], ["--iris-open", "2"]),
                            (["--spherical", "--lens"], ["--spherical", "0"]),
                            (["--focus-mode", "--focus-shift"], ["--focus-mode", "best", "--focus-shift", "1"])):
            self.refuse(2, "lens", "psf", "ideal", "-o", "psf.exr", *flags, says=says)
        self.refuse(2, "lens", "psf", "ideal", "-o", "psf.exr", "--field", "2,0", says=["--field"])
        self.refuse(2, "lens", "psf", "ideal", "-o", "psf.exr", "--field", "3", says=["--field 3", "0.5,-0.25"])
        self.refuse(2, "lens", "psf", "ideal", "-o", "psf.exr", "--defocus", "1e9", says=["--defocus"])
        self.refuse(2, "lens", "psf", "tessar", "-o", "psf.exr", "--fstop", "1", says=["--fstop"])
        self.refuse(2, "lens", "psf", "tessar", "-o", "psf.exr", "--distortion", "0.1", says=["--distortion"])
        self.refuse(3, "lens", "psf", "ideal", "-o", "psf.exr", "--aperture-image", "no.png", says=["--aperture-image"])


class LensTable(CommandLineTest):
    def test_columns_run_from_in_front_to_behind(self):
        report = self.report("lens", "table", "triplet", "-o", "table.exr", "--columns", "33", "--defocus", "24")
        self.assertEqual(len(report["coc_radius_px"]), 33)
        self.assertEqual(report["coc_radius_px"][0], -24)
        self.assertEqual(report["coc_radius_px"][16], 0)
        self.assertGreater(report["rows"], 24 * report["rows_per_px"])
        self.assertLess(report["coc_radius_px"][17], 0.2)
        even = self.report("lens", "table", "triplet", "-o", "even.exr", "--columns", "33", "--defocus", "24", "--even")
        self.assertEqual(even["coc_radius_px"][17], 1.5)

    def test_channels_hold_energy_and_view(self):
        self.succeed("lens", "table", "doublet", "-o", "table.exr", "--columns", "16")
        listed = self.succeed("inspect", "table.exr").out
        for channels in ("R G B", "view. R G B", "coc. radius"):
            self.assertIn(channels, listed)


if __name__ == "__main__":
    unittest.main()
