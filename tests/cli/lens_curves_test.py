"""Lenses drawn as aberration curves in a file: every verb takes them, damage is named with its line."""
import json
import pathlib
import re
import unittest

from program import CAMERA, CommandLineTest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs/reference/lens-files.md"


def documented():
    """The example of the page about lens files."""
    return re.search(r"^```json\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE).group(1)


class CurveFiles(CommandLineTest):
    def lens(self, text=None):
        pathlib.Path(self.path("drawn.json")).write_text(text or documented())
        return "drawn.json"

    def disc(self, lens, *flags):
        self.succeed("lens", "psf", lens, "-o", "disc.exr", "--defocus", "16", *flags)
        return pathlib.Path(self.path("disc.exr")).read_bytes()

    def test_the_documented_example_is_a_lens(self):
        facts = self.report("lens", "show", self.lens())
        self.assertEqual(facts["lens"]["name"], "soft-rgb")
        self.assertEqual(facts["efl_mm"], 85)
        self.assertEqual(len(facts["longitudinal_aberration_mm"]["axis_crossing_minus_primary_paraxial_focus"]), 3)

    def test_options_of_curve_lenses_shape_it(self):
        plain = self.disc(self.lens())
        self.assertEqual(plain, self.disc("drawn.json", "--spherical", "1"))
        for flags in (["--spherical", "-1"], ["--axial-colour", "0"], ["--coma", "1", "--field", "0.5,0"],
                      ["--wavelengths", "3"], ["--fstop", "4"], ["--blades", "5"]):
            self.assertNotEqual(plain, self.disc("drawn.json", *flags), flags)

    def test_it_photographs(self):
        self.lens()
        self.succeed("scene", "make", "table", "-o", "table.exr", "--width", "96", "--height", "54")
        pictures = []
        for lens in ("drawn.json", "ideal"):
            self.succeed("defocus", "table.exr", "-o", "out.exr", "--overwrite", "--lens", lens, *CAMERA)
            pictures.append(pathlib.Path(self.path("out.exr")).read_bytes())
        self.assertNotEqual(*pictures)
        # What needs surfaces falls back on what every lens has.
        self.succeed("defocus", "table.exr", "-o", "glare.exr", "--lens", "drawn.json", "--ghosts", "0.1",
                     "--vignetting", *CAMERA)
        self.succeed("lens", "table", "drawn.json", "-o", "texture.exr", "--columns", "9")

    def test_damage_is_named_with_its_line(self):
        whole = documented()
        for damaged, says in ((whole.replace("0.05]", "0.05, 1]"), "line 7"),
                              (whole.replace('"R"', '"red"'), "line 6"),
                              (whole.replace("10, 15", "15, 10"), "line 4"),
                              (whole.replace("-0.35, -0.55", "-35, -0.55"), "line 6"),
                              (whole[:len(whole) // 2], "line"),
                              (whole.replace('"f_number": 2,', ""), "f_number")):
            for verb in (["lens", "show"], ["lens", "psf", "-o", "disc.exr"]):
                self.refuse(3, *verb, self.lens(damaged), says=["drawn.json", says])

    def test_a_preset_written_out_is_the_preset(self):
        facts = self.report("lens", "show", "doublet")
        curves = facts["longitudinal_aberration_mm"]
        focal_length, f_number = facts["efl_mm"], facts["f_number"]
        shifts = curves["axis_crossing_minus_primary_paraxial_focus"]
        text = json.dumps({
            "focal_length_mm": focal_length, "f_number": f_number, "units": "mm",
            "pupil_height": [z * focal_length / (2 * f_number) for z in curves["pupil_zone"]],
            "curves": [{"wavelength_nm": float(um) * 1000, "shift": s} for um, s in shifts.items()]})
        camera = ["--focal-length", "50", "--sensor-width", "36", "--fstop", "2"]
        ours, theirs = (self.report("lens", "psf", lens, "-o", "disc.exr", "--overwrite", "--defocus", "20", *camera)
                        for lens in (self.lens(text), "doublet"))
        self.assertEqual(ours["size"], theirs["size"])
        self.succeed("lens", "psf", "drawn.json", "-o", "ours.exr", "--defocus", "20", *camera)
        self.succeed("lens", "psf", "doublet", "-o", "theirs.exr", "--defocus", "20", *camera)
        self.assertGreater(self.report("compare", "ours.exr", "theirs.exr")["psnr_lin"], 120)


if __name__ == "__main__":
    unittest.main()
