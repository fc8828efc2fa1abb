"""--ocio of develop and defocus: displays and views of a small config written here; and what is said without one."""
import json
import os
import unittest

from pictures import picture, plane, read_png, write_exr
from program import CAMERA, CommandLineTest

# Scene reference: ACES2065-1 where `aces` names it, else scene-linear Rec.709.
CONFIG = """ocio_profile_version: 2
roles:
  default: reference
  scene_linear: %(linear)s
%(aces)s
displays:
  sRGB:
    - !<View> {name: Gamma, colorspace: gamma}
    - !<View> {name: Half, colorspace: half}
  Other:
    - !<View> {name: Only, colorspace: half}
active_displays: [sRGB, Other]
colorspaces:
  - !<ColorSpace>
    name: reference
  - !<ColorSpace>
    name: %(linear)s
    from_scene_reference: %(to_linear)s
  - !<ColorSpace>
    name: gamma
    from_scene_reference: !<GroupTransform>
      children: [%(to_linear)s, !<ExponentTransform> {value: 2.2, direction: inverse}]
  - !<ColorSpace>
    name: half
    from_scene_reference: !<GroupTransform>
      children: [%(to_linear)s, !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}]
"""
# CIE XYZ (D65) to Rec.709, SMPTE RP 177.
FROM_ACES = ("!<GroupTransform> {children: [!<BuiltinTransform> {style: \"UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD\"}, "
             "!<MatrixTransform> {matrix: [3.2409699419, -1.5373831776, -0.4986107603, 0, -0.9692436363, "
             "1.8759675015, 0.0415550574, 0, 0.0556300797, -0.2039769589, 1.0569715142, 0, 0, 0, 0, 1]}]}")
NOTHING = "!<MatrixTransform> {offset: [0, 0, 0, 0]}"


def config(linear="scene", aces=False):
    return CONFIG % {"linear": linear, "aces": "  aces_interchange: reference\n" if aces else "",
                     "to_linear": FROM_ACES if aces else NOTHING}


class Ocio(CommandLineTest):
    def setUp(self):
        super().setUp()
        light = picture(12, 8, lambda x, y: (x + y) / 24, None)
        light["B"] = plane(12, 8, 0.2)
        write_exr(self.path("in.exr"), light)
        outcome = self.run_program("develop", "in.exr", "-o", "out.png", "--ocio", "default", env=self.environment(None))
        self.built = "without OpenColorIO" not in outcome.err
        self.assertEqual(outcome.code, 2)

    def environment(self, text):
        if text is None:
            return {"OCIO": ""}
        with open(self.path("config.ocio"), "w") as file:
            file.write(text)
        return {"OCIO": self.path("config.ocio")}

    def need(self):
        if not self.built:
            self.skipTest("built without OpenColorIO: libopencolorio-dev is not installed")

    def codes(self, text, *flags):
        self.succeed("develop", "in.exr", "-o", "out.png", "--no-dither", "--bits", "16", *flags,
                     env=self.environment(text))
        return read_png(self.path("out.png"))[0]

    def test_the_display_and_view_are_those_of_the_config(self):
        self.need()
        for text in (config("lin_rec709"), config("lin_rec709", aces=True)):
            for flags, expected in ((["default"], lambda v: v ** (1 / 2.2)), (["sRGB"], lambda v: v ** (1 / 2.2)),
                                    (["sRGB,Half"], lambda v: v / 2), (["Other,Only"], lambda v: v / 2),
                                    (["sRGB,Half", "--exposure", "1"], lambda v: v)):
                rows = self.codes(text, "--ocio", *flags)
                for x, y in ((1, 0), (5, 3), (11, 7)):
                    value = 65535 * min(1, expected((x + y) / 24))
                    self.assertAlmostEqual(rows[y][3 * x], value, delta=60, msg=(flags, x, y))
                    self.assertAlmostEqual(rows[y][3 * x + 2], 65535 * expected(0.2), delta=60)

    def test_a_space_that_the_config_does_not_name_is_said(self):
        self.need()
        outcome = self.succeed("develop", "in.exr", "-o", "out.png", "--ocio", "default", env=self.environment(config()))
        self.assertIn("--ocio-space", outcome.err)
        outcome = self.succeed("develop", "in.exr", "-o", "out.png", "--ocio", "default", "--ocio-space", "scene",
                               env=self.environment(config()))
        self.assertNotIn("warning", outcome.err)

    def test_without_the_flag_the_variable_changes_nothing(self):
        self.need()
        self.assertEqual(self.codes(None), self.codes(config()))

    def test_what_is_not_there_is_named_with_what_is(self):
        self.need()
        for flags, says in ((["--ocio", "Rec2100"], ["Rec2100", "sRGB, Other"]),
                            (["--ocio", "sRGB,Film"], ["Film", "Gamma, Half"]),
                            (["--ocio", "sRGB", "--ocio-space", "acescg"], ["acescg", "reference"])):
            known = self.environment(config())
            self.refuse(2, "develop", "in.exr", "-o", "no.png", *flags, says=says, env=known)
        self.refuse(2, "develop", "in.exr", "-o", "no.png", "--ocio", "default", says=["$OCIO is not set"],
                    env=self.environment(None))
        broken = self.environment("roles: [\nno")
        self.refuse(3, "develop", "in.exr", "-o", "no.png", "--ocio", "default", says=["$OCIO", "config.ocio"], env=broken)

    def test_a_pipe_is_no_config_and_is_not_waited_for(self):
        self.need()
        os.mkfifo(self.path("pipe"))
        self.refuse(3, "develop", "in.exr", "-o", "out.png", "--ocio", "default", env={"OCIO": self.path("pipe")},
                    says=["$OCIO", "not a regular file"])

    def test_defocus_shows_by_it_as_develop_does(self):
        self.need()
        light = picture(12, 8, lambda x, y: (x + y) / 24, 2.0)
        write_exr(self.path("in.exr"), light)
        env = self.environment(config("lin_rec709"))
        self.succeed("defocus", "in.exr", "-o", "out.png", *CAMERA, "--ocio", "sRGB,Half", "--exposure", "1",
                     "--json", "report.json", env=env)
        rows = read_png(self.path("out.png"))[0]
        for x, y in ((1, 0), (5, 3), (11, 7)):
            self.assertAlmostEqual(rows[y][3 * x], 255 * (x + y) / 24, delta=1.01)
        with open(self.path("report.json")) as file:
            report = json.load(file)
        self.assertEqual(report["parameters"]["display"]["ocio"], "sRGB,Half")
        self.assertEqual(report["codes_device"], "cpu")

    def test_defocus_says_what_is_wrong_before_it_works(self):
        self.need()
        env = self.environment(config("lin_rec709"))
        self.refuse(2, "defocus", "no.exr", "-o", "no.png", "--ocio", "sRGB,Film", says=["Gamma, Half"], env=env)
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--ocio", "sRGB", says=["--ocio", ".png"], env=env)
        self.refuse(2, "defocus", "in.exr", "-o", "no.png", "--ocio", "sRGB", "--view", "coc", says=["--ocio"], env=env)

    def test_flags_that_ocio_replaces_are_refused(self):
        for verb in ("develop", "defocus"):
            self.refuse(2, verb, "in.exr", "-o", "no.png", "--ocio", "default", "--tone", "none", says=["--ocio", "--tone"])
        for flags in (["--tone", "none"], ["--contrast", "1.2"], ["--transfer", "srgb"]):
            self.refuse(2, "develop", "in.exr", "-o", "no.png", "--ocio", "default", *flags, says=["--ocio", flags[0]])
        self.refuse(2, "develop", "in.exr", "-o", "no.png", "--ocio-space", "x", says=["--ocio"])


if __name__ == "__main__":
    unittest.main()
