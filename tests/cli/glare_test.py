"""Glare and falloff from the command line, in develop and in defocus."""
import unittest

from pictures import picture, read_exr, read_png, write_exr
from program import CAMERA, CommandLineTest


def lamp(x, y):
    return 500.0 if (x, y) in ((48, 24), (49, 24)) else 0.05


class Glare(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(96, 48, lamp, 2.0))

    def defocus(self, *flags):
        self.succeed("defocus", "in.exr", "-o", "out.exr", *CAMERA, *flags)
        return read_exr(self.path("out.exr"))[0]["G"]

    def test_every_part_changes_the_picture_and_keeps_its_light(self):
        plain = self.defocus()
        total = sum(map(sum, plain))
        for flags in (["--bloom", "0.2", "--bloom-radius", "0.05"], ["--veil", "0.2"],
                      ["--star", "0.2", "--blades", "6", "--star-radius", "0.2"],
                      ["--star", "0.2", "--blades", "5", "--star-radius", "0.2", "--star-quality", "draft"]):
            glared = self.defocus(*flags)
            self.assertNotEqual(glared, plain, flags)
            self.assertAlmostEqual(sum(map(sum, glared)) / total, 1, delta=2e-3, msg=flags)

    def test_amount_zero_is_identical(self):
        self.assertEqual(self.defocus("--bloom", "0", "--veil", "0"), self.defocus())

    def test_vignetting_darkens_the_corners_only(self):
        plain, dimmed = self.defocus(), self.defocus("--vignetting")
        self.assertAlmostEqual(dimmed[24][42] / plain[24][42], 1, delta=0.03)
        self.assertLess(dimmed[0][0], 0.85 * plain[0][0])

    def test_develop_does_the_same_before_the_tone_curve(self):
        self.succeed("develop", "in.exr", "-o", "plain.png")
        for flags in (["--bloom", "0.3"], ["--ghosts", "0.1"], ["--star", "0.3", "--blades", "6"],
                      ["--vignetting", "--focal-length", "20mm", "--sensor-width", "36mm"]):
            self.succeed("develop", "in.exr", "-o", "glared.png", *flags)
            self.assertNotEqual(read_png(self.path("glared.png")), read_png(self.path("plain.png")), flags)

    def test_the_report_holds_what_was_done(self):
        report = self.report("develop", "in.exr", "-o", "out.png", "--bloom", "0.25")
        self.assertEqual(report["glare"]["bloom"], 0.25)
        self.assertIsNone(self.report("develop", "in.exr", "-o", "out.png")["glare"])

    def test_the_time_of_glare_is_that_of_its_stages(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--bloom", "0.2", "--star", "0.2", "--blades", "6")
        seconds, stages = report["seconds"], {stage["stage"]: stage["seconds"] for stage in report["stages"]}
        glare = [stages[name] for name in ("star's pattern", "highlights of glare", "bloom", "star", "light")]
        self.assertAlmostEqual(seconds["glare"], sum(glare), delta=1e-6)
        self.assertAlmostEqual(seconds["kernels"] + seconds["compute"] + seconds["glare"], sum(stages.values()), delta=0.02)

    def test_flags_without_effect_and_wrong_ones_are_refused(self):
        out = ["develop", "in.exr", "-o", "out.png"]
        for flags, says in ((["--star", "0.1"], "--blades"), (["--bloom-radius", "0.1"], "--bloom"),
                            (["--bloom", "1.5"], "--bloom"), (["--bloom", "0.6", "--veil", "0.6"], "all light"),
                            (["--star-quality", "best", "--star", "0.1", "--blades", "6"], "draft"),
                            (["--coating", "none"], "--ghosts"), (["--vignetting"], "--focal-length"),
                            (["--blades", "6"], "glare")):
            self.refuse(2, *out, *flags, says=[says])
        self.refuse(2, "defocus", "in.exr", "-o", "coc.exr", *CAMERA, "--view", "coc", "--bloom", "0.1",
                    says=["--bloom"])


if __name__ == "__main__":
    unittest.main()
