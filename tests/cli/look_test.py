"""Looks: what a run chose, written and taken again; flags beside it; what has no effect."""
import base64
import json
import os
import pathlib
import unittest

from pictures import picture, read_exr, write_exr, write_png
from program import CAMERA, CommandLineTest


def texture(x, y):
    return (x * 37 + y * 91) % 17 / 40


class Looks(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(40, 28, texture, lambda x, y: 1.2 if x < 15 else 5.0))

    def defocus(self, *flags):
        self.succeed("defocus", "in.exr", "-o", "out.exr", *CAMERA, "-q", *flags)
        with open(self.path("out.exr"), "rb") as file:
            return file.read()

    def text(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def write(self, name, **sections):
        with open(self.path(name), "w") as file:
            json.dump({"petzval_look": 1} | sections, file)

    def test_a_saved_look_gives_the_same_bytes(self):
        for flags in (["--lens", "doublet", "--blades", "5", "--bloom", "0.1", "--focus-shift", "0.2"],
                      ["--engine", "gather", "--gather-stage", "cure", "--gather-taps", "16", "--gather-coc", "extreme"],
                      ["--engine", "sprites", "--background", "gaussian", "--find-points", "off"],
                      ["--barrel", "14mm,20mm;1.5cm,-30", "--barn-doors", "0.2,0,0,0.1", "--max-radius", "6"],
                      ["--focus-range", "1.8m,inf", "--near-scale", "0.3333333333333333", "--vignetting"],
                      ["--engine", "reference", "--pupil-points", "16", "--seed", "18446744073709551615"]):
            first = self.defocus(*flags, "--save-look", "look.json")
            self.assertEqual(first, self.defocus("--look", "look.json", "--save-look", "again.json"), flags)
            self.assertEqual(self.text("look.json"), self.text("again.json"))

    def test_reports_hold_the_same_object(self):
        report = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--blades", "5", "--save-look", "look.json")
        with open(self.path("look.json")) as file:
            self.assertEqual(json.load(file), report["look"])
        self.assertEqual(report["look"]["lens"]["blades"], 5)

    def test_every_preset_has_an_effect(self):
        names = self.presets()
        self.assertGreaterEqual(len(names), 8)
        # A lamp off the axis, behind focus, so that corners, colours and glare have something to show.
        write_exr(self.path("in.exr"), picture(96, 64, lambda x, y: 60.0 if (x, y) in ((70, 14), (24, 30)) else 0.1,
                                               lambda x, y: 8.0))
        made = {name: self.defocus("--preset", name) for name in names}
        made["none"] = self.defocus()
        made["night, five blades"] = self.defocus("--preset", "night", "--blades", "5")
        self.assertEqual(len(set(made.values())), len(made))

    def presets(self):
        outcome = self.run_program("defocus", "in.exr", "-o", "o.exr", "--preset", "nope")
        self.assertEqual(outcome.code, 2)
        return outcome.err.strip().split("there are ")[1].split(", ")

    def test_own_presets_come_from_a_folder(self):
        os.mkdir(self.path("mine"))
        self.write("mine/five.json", lens={"blades": 5})
        self.succeed("defocus", "in.exr", "-o", "five.exr", *CAMERA, "--preset", "five",
                     env={"PETZVAL_PRESETS": self.path("mine")})
        self.assertEqual(read_exr(self.path("five.exr"))[0], self.pixels("--blades", "5"))
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", *CAMERA, "--preset", "five", says=["--preset", "portrait"])
        self.write("look.json", lens={"blades": 5})
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", *CAMERA, "--preset", "night", "--look", "look.json",
                    says=["--preset", "--look"])

    def pixels(self, *flags):
        self.defocus(*flags)
        return read_exr(self.path("out.exr"))[0]

    def test_a_link_of_the_lens_lab_is_a_look(self):
        told = {"lens": {"name": "doublet", "text": None, "look": {"blades": 5, "cats_eye": 0.4}}, "camera": {}, "light": {}}
        link = "lens=1." + base64.urlsafe_b64encode(json.dumps(told).encode()).decode().rstrip("=")
        by_flags = self.pixels("--lens", "doublet", "--blades", "5", "--cats-eye", "0.4")
        for look in (link, "https://example.org/lab/#" + link):
            self.assertEqual(self.pixels("--look", look), by_flags)
        self.refuse(3, "defocus", "in.exr", "-o", "o.exr", *CAMERA, "--look", link[:-7], says=["--look", "link of the lens lab"])

    def test_a_link_holds_a_pasted_lens_and_so_does_a_saved_look(self):
        own = pathlib.Path(__file__).parents[2] / "lenses/double-gauss-fast.json"
        told = {"lens": {"name": "mine", "text": own.read_text(), "look": {"blades": 5}}}
        link = "lens=1." + base64.urlsafe_b64encode(json.dumps(told).encode()).decode().rstrip("=")
        by_file = self.pixels("--lens", str(own), "--blades", "5")
        self.assertEqual(self.pixels("--look", link, "--save-look", "saved.json"), by_file)
        self.assertEqual(self.pixels("--look", "saved.json"), by_file)
        self.assertEqual(self.pixels("--lens", own.read_text(), "--blades", "5"), by_file)
        self.assertNotEqual(self.pixels("--blades", "5"), by_file)
        self.refuse(3, "defocus", "in.exr", "-o", "o.exr", *CAMERA, "--lens", "50 4\n", says=["pasted: line 1"])

    def test_numbers_out_of_range_are_refused_as_those_of_flags(self):
        self.write("look.json", glare={"bloom": -1e30})
        self.refuse(3, "defocus", "in.exr", "-o", "o.exr", *CAMERA, "--look", "look.json",
                    says=["look.json", "glare.bloom", "0 to 1"])

    def test_flags_beside_a_look_win(self):
        self.write("look.json", lens={"name": "doublet", "blades": 5, "wave": True}, glare={"bloom": 0.1})
        five = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--look", "look.json", "--blades", "6",
                           "--wave=off", "--bloom", "0")
        self.assertEqual((five["look"]["lens"]["blades"], five["look"]["lens"]["wave"]), (6, False))
        self.assertIsNone(five["glare"])
        self.assertEqual(self.defocus("--look", "look.json", "--wave=off", "--bloom", "0", "--blades", "7"),
                         self.defocus("--lens", "doublet", "--blades", "7"))

    def test_files_are_relative_to_the_look(self):
        os.mkdir(self.path("looks"))
        write_png(self.path("looks/half.png"), [[255 if x < 8 else 40 for x in range(16)] for _ in range(16)], 1)
        self.write("looks/a.json", lens={"aperture_image": "half.png"})
        first = self.defocus("--look", "looks/a.json", "--save-look", "b.json")
        with open(self.path("b.json")) as file:
            self.assertEqual(json.load(file)["lens"]["aperture_image"], "./looks/half.png".removeprefix("./"))
        self.assertEqual(first, self.defocus("--look", "b.json"))
        self.assertEqual(first, self.defocus("--aperture-image", "looks/half.png"))

    def test_what_is_typed_in_vain_is_refused(self):
        gaussian, cure = ["--engine", "gaussian"], ["--engine", "gather", "--gather-stage", "cure"]
        for flags, says in ((gaussian + ["--blades", "6"], "--blades"), (gaussian + ["--lens", "doublet"], "--lens"),
                            (gaussian + ["--barrel", "24,40"], "--barrel"), (gaussian + ["--cats-eye", "0.8"], "--cats-eye"),
                            (gaussian + ["--quality", "standard"], "--quality"), (cure + ["--blades", "6"], "--gather-stage cure"),
                            (cure + ["--quality", "draft"], "--quality"), (["--seed", "1"], "--engine reference")):
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, *flags, says=[says, "no effect"])
        self.defocus(*gaussian, "--blades", "6", "--star", "0.1")

    def test_what_a_look_holds_to_no_effect_is_told(self):
        self.write("look.json", engine="gaussian", lens={"blades": 5, "cats_eye": 0.4}, quality="draft")
        warnings = self.report("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--look", "look.json")["warnings"]
        self.assertEqual(len(warnings), 2, warnings)
        self.assertIn("look.json: --blades and --cats-eye have no effect", warnings[1])

    def test_glare_of_a_look_is_part_of_beauty_alone(self):
        self.write("look.json", glare={"bloom": 0.5, "vignetting": True}, plate={"expand_highlights": True})
        self.succeed("defocus", "in.exr", "-o", "coc.exr", *CAMERA, "--look", "look.json", "--view", "coc")
        self.assertEqual(set(read_exr(self.path("coc.exr"))[0]), {"coc_radius_px"})

    def test_what_is_no_look_is_refused_and_nothing_written(self):
        self.write("typo.json", lens={"blade": 5})
        self.write("star.json", glare={"star": 0.5})
        self.write("later.json", petzval_look=9)
        open(self.path("empty.json"), "w").close()
        for file, code, says in (("typo.json", 3, "did you mean lens.blades?"), ("star.json", 2, "--star"),
                                 ("later.json", 3, "later version"), ("empty.json", 3, "not JSON"),
                                 ("none.json", 3, "none.json"), (".", 3, "regular file")):
            self.refuse(code, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--look", file, says=[says])
        self.refuse(1, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--save-look", "nowhere/look.json", says=["nowhere"])
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, "--save-look", "in.exr", says=["replace the input"])

    def test_a_look_that_is_there_is_left_alone_with_no_clobber(self):
        with open(self.path("look.json"), "w") as file:
            file.write("mine")
        self.defocus("--save-look", "look.json", "--no-clobber")
        self.assertEqual(self.text("look.json"), "mine")

    def test_failures_are_told_as_json_too(self):
        for flags, code, exit_code, field, says in (
                (["--engine", "gaussian", "--blades", "5"], "invalid-argument", 2, "lens.blades", "--blades has no effect"),
                (["--fokus", "3"], "invalid-argument", 2, None, "did you mean --focus?"),
                (["--lens", "dublet"], "invalid-argument", 2, "lens.name", "did you mean doublet?"),
                (["--depth", "none.exr"], "invalid-file", 3, None, "none.exr")):
            outcome = self.run_program("defocus", "in.exr", "-o", "no.exr", *CAMERA, *flags, "--json", "-")
            self.assertEqual(outcome.code, exit_code, outcome)
            report = json.loads(outcome.out)
            self.assertEqual(report["verb"], "defocus")
            error = report["failure"]
            self.assertEqual((error["code"], error["field"], error["exit_code"]), (code, field, exit_code), outcome)
            self.assertIn(says, error["message"])
            self.assertIn(says, outcome.lines[-1])
        for verb, words in (("lens psf", ["lens", "psf", "dublet", "-o", "no.exr"]), ("inspect", ["inspect", "none.exr"]),
                            (None, ["blur"])):
            self.assertEqual(json.loads(self.run_program(*words, "--json", "-").out)["verb"], verb)
        self.refuse(2, "defocus", "in.exr", "-o", "no.exr", "--fokus", "3", "--json", "r.json", says=["--focus"])

    def test_a_switch_takes_no_value_but_on_and_off(self):
        for flag in ("--wave=x", "--quiet=2", "--overwrite=maybe"):
            self.refuse(2, "defocus", "in.exr", "-o", "no.exr", *CAMERA, flag, says=[flag.split("=")[0], "on or off"])


if __name__ == "__main__":
    unittest.main()
