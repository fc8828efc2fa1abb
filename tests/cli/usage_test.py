"""Flags: what is understood, and what is refused in one line with exit code 2 before any file is touched."""
import unittest

from pictures import picture, read_exr, write_exr
from program import CAMERA, CommandLineTest

VERBS = ["defocus", "lens", "lens list", "lens show", "lens psf", "lens table", "inspect", "scene", "scene list", "scene make", "scene points", "compare", "develop"]

# Every flag of defocus that takes a value, with a value it accepts.
DEFOCUS_VALUES = {
    "--layer": "x", "--view-name": "left", "--depth": "in.exr", "--depth-channel": "Z", "--depth-kind": "planar",
    "--unit-scale": "0.01", "--plate": "in.exr", "--holdout": "in.exr", "--mask": "in.exr", "--overscan": "8", "--focal-length": "50mm", "--sensor-width": "36mm", "--fstop": "2",
    "--focus": "2m", "--focus-at": "1,1", "--focus-point": "1,2,3", "--breathing": "off", "--focus-range": "1,3",
    "--permissible-radius": "2", "--near-scale": "1", "--far-scale": "1", "--max-radius": "9", "--lens": "ideal", "--blades": "5",
    "--squeeze": "2", "--cats-eye": "0.5", "--engine": "reference", "--quality": "draft", "--seed": "3", "--ocio": "sRGB", "--ocio-space": "scene",
    "--bloom": "0.1", "--star": "0", "--ghosts": "0.1", "--veil": "0.1", "--bloom-radius": "0.1", "--bloom-threshold": "1", "--transfer": "srgb",
    "--star-radius": "0.3", "--star-quality": "draft", "--coating": "none", "--glare-threshold": "2", "--highlight-peak": "8",
    "--focus-mode": "best", "--max-memory": "2G", "-o": "out.exr", "--view": "coc", "--json": "r.json", "--threads": "1", "--progress": "off",
    "--gather-stage": "cure", "--gather-taps": "16", "--gather-coc": "mean", "--gather-fill": "off", "--fill": "dim", "--points": "p.csv",
    "--gaussian-style": "wgld", "--focus-band": "0.3", "--depth-offset": "-0.1", "--depth-along": "ray", "--depth-band-range": "0.1m,30m",
    "--background": "gather", "--find-points": "off", "--bright-factor": "2",
    "--spherical": "0.5", "--axial-colour": "-1", "--lateral-colour": "0.5", "--coma": "0.3",
    "--add-spherical": "20", "--add-at-fstop": "2", "--add-axial-colour": "-0.5", "--add-field-curvature": "-1",
    "--add-lateral-colour": "0.5", "--light": "neon", "--astigmatism": "0.2", "--distortion": "0.01",
    "--focus-shift": "-0.1", "--wavelengths": "31", "--barrel": "14,20;14,-20", "--barn-doors": "0.2,0,0,0",
    "--iris-open": "2", "--aperture-image": "half.png", "--kernel-image": "far.exr,near.exr", "--dust": "0.5",
    "--scratches": "0.5", "--onion-rings": "0.5", "--texture-seed": "3",
    "--device": "cpu", "--frames": "1-3", "--missing": "skip", "--track": "t.csv", "--focus-speed": "0.1", "--report": "shot.jsonl",
}
DEFOCUS_SWITCHES = ["--overwrite", "--no-clobber", "-u", "-v", "-q", "--vignetting", "--expand-highlights", "--wave"]

CONTRADICTIONS = [
    (["--overwrite", "--no-clobber"], ["--overwrite", "--no-clobber"]),
    (["-u", "--no-clobber"], ["-u", "--no-clobber"]),
    (["-v", "-q"], ["-v", "-q"]),
    (["--focus", "2", "--focus-at", "1,1"], ["--focus", "--focus-at"]),
    (["--focus", "2", "--focus-point", "1,1,1"], ["--focus", "--focus-point"]),
    (["--focus-at", "2,2", "--focus-point", "1,1,1"], ["--focus-at", "--focus-point"]),
    (["--depth-kind", "coc-px", "--focus-point", "1,1,1"], ["--focus-point", "coc-px"]),
    (["--permissible-radius", "2"], ["--permissible-radius", "--view focus"]),
    (["--focus-falloff", "0.2"], ["--focus-falloff", "--focus-range"]),
    (["--blade-rotation", "10"], ["--blade-rotation", "--blades"]),
    (["--blades", "0", "--blade-curvature", "1"], ["--blade-curvature", "--blades"]),
    (["--focus-mode", "best"], ["--focus-mode", "--lens"]),
    (["--spherical", "0"], ["--spherical", "--lens", "--add-spherical"]),
    (["--light", "neon"], ["--light", "--lens"]),
    (["--lens", "doublet", "--light", "neon", "--wavelengths", "9"], ["--wavelengths", "--light neon"]),
    (["--add-at-fstop", "2"], ["--add-at-fstop", "--add-spherical"]),
    (["--add-spherical", "9", "--engine", "gaussian"], ["--add-spherical", "gaussian"]),
    (["--iris-open", "2"], ["--iris-open", "--blades"]),
    (["--texture-seed", "2"], ["--texture-seed", "--dust"]),
    (["--wave", "--kernel-image", "far.exr"], ["--wave", "--kernel-image"]),
    (["--engine", "scatter", "--pupil-points", "64"], ["--pupil-points", "reference"]),
    (["--depth-range", "0,1"], ["--depth-range", "normalized"]),
    (["--depth-kind", "normalized"], ["--depth-range"]),
    (["--depth-kind", "coc-px", "--unit-scale", "2"], ["--unit-scale", "coc-px"]),
    (["--depth-kind", "coc-px", "--fstop", "2"], ["--fstop", "coc-px"]),
    (["--depth-kind", "coc-px", "--near-scale", "2"], ["--near-scale", "coc-px"]),
    (["--exposure", "1"], ["--exposure", ".png"]),
    (["--overscan", "9", "--view", "coc"], ["--overscan", "coc"]),
    (["--holdout", "in.exr", "--view", "depth"], ["--holdout", "depth"]),
    (["--tone", "none"], ["--tone", ".png"]),
]

WRONG_VALUES = {
    "--focal-length": ["0", "-85mm", "85 mm", "85yd", "mm", "", "nan"], "--focus": ["0m", "3,2", "three"],
    "--sensor-width": ["0"], "--fstop": ["0", "-2", "f2.8"], "--focus-at": ["1", "1,2,3", "a,b", "1.5,2"], "--focus-point": ["1,2", "1,2,3,4", "a,b,c", "1,2,inf"],
    "--breathing": ["thick"], "--focus-range": ["3m,1m", "2", "0,1"], "--near-scale": ["-1", "inf"],
    "--far-scale": ["x"], "--max-radius": ["0"], "--permissible-radius": ["0", "x"], "--blades": ["2", "-5", "5.5", "65"], "--blade-curvature": ["1.1"],
    "--squeeze": ["0"], "--cats-eye": ["2"], "--dust": ["2"], "--barrel": ["14", "0,3", "a,b"], "--wavelengths": ["0"],
    "--barn-doors": ["1,1", "2,0,0,0", "a,0,0,0"], "--kernel-image": ["a,b,c", ","], "--engine": ["warp"], "--quality": ["best"], "--seed": ["-1", "x"],
    "--max-memory": ["0", "2Q", "G", "-1G"], "--threads": ["-1", "1e3", "1000000"], "--depth-kind": ["z"],
    "--unit-scale": ["0"], "--depth-range": ["1"], "--progress": ["loud"], "--pupil-points": ["0"],
    "--view": ["lairs", ""], "--focus-shift": ["x", ""], "--gather-stage": ["glow", ""], "--gather-taps": ["17", "x"],
    "--gather-coc": ["max"], "--gather-fill": ["1"], "--fill": ["half", ""], "--gaussian-style": ["box"], "--focus-band": ["-1", "x"],
    "--depth-offset": ["nan"], "--depth-band-range": ["2", "3m,1m"], "--background": ["scatter"],
    "--find-points": ["maybe"], "--bright-factor": ["0"], "--overscan": ["0", "-3", "wide"],
}


class Usage(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(8, 6))

    def test_help_of_every_verb_shows_an_example_first(self):
        for verb in [""] + VERBS:
            outcome = self.succeed(*verb.split(), "--help")
            self.assertTrue(outcome.out.startswith("Example\n  petzval " + verb), verb)
            self.assertEqual(outcome.err, "")
            self.assertLessEqual(max(map(len, outcome.out.splitlines())), 120, verb)

    def test_help_names_every_flag(self):
        text = self.succeed("defocus", "--help-all").out
        for flag in list(DEFOCUS_VALUES) + DEFOCUS_SWITCHES:
            self.assertIn(flag, text)

    def test_version(self):
        self.assertRegex(self.succeed("--version").out, r"^petzval \d+\.\d+\.\d+( \(git [0-9a-f]{8}\+?\))?\n$")

    def test_a_verb_mistyped_is_what_is_wrong_and_not_the_flags_after_it(self):
        self.refuse(2, "defokus", "in.exr", "-o", "out.exr", says=["unknown verb defokus (did you mean defocus?)"])
        self.refuse(2, "lens", "shwo", "doublet", "--json", "x.json", says=["unknown verb shwo"])

    def test_no_verb_or_an_unknown_one(self):
        self.refuse(2, says=["--help"])
        self.refuse(2, "defcus", says=["defcus", "did you mean defocus"])
        self.refuse(2, "scene", says=["list", "make"])
        self.refuse(2, "scene", "mke", says=["did you mean make"])
        self.refuse(2, "scene", "make", "tables", "-o", "t.exr", says=["no scene tables (did you mean table?); there are night, "])

    def test_what_must_be_given(self):
        self.refuse(2, "defocus", says=["needs", "for example: petzval defocus"])
        self.refuse(2, "defocus", "in.exr", says=["-o OUT"])
        self.refuse(2, "compare", "in.exr", says=["TEST"])
        self.refuse(2, "scene", "make", "slant", says=["-o FILE.exr"])
        self.refuse(2, "scene", "make", "-o", "out.exr", says=["NAME"])

    def test_unknown_flags_are_named_and_a_near_one_is_offered(self):
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--fokus", "3", says=["--fokus", "did you mean --focus?"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--fokus=3", says=["--fokus "])
        self.refuse(2, "defocus", "in.exr", "more.exr", "-o", "out.exr", says=["more.exr"])
        self.refuse(2, "inspect", "in.exr", "--bloom", "3", says=["--bloom"])

    def test_a_flag_of_another_program_leads_to_ours(self):
        for theirs, ours in (("--aperture", "--fstop"), ("--f-number", "--fstop"), ("--focus-distance", "--focus")):
            self.refuse(2, "defocus", "in.exr", "-o", "out.exr", theirs, "3", says=[theirs, f"did you mean {ours}?"])
        self.assertNotIn("--fstop", self.refuse(2, "scene", "list", "--aperture", "3", says=["--aperture"]).err)

    def test_a_flag_does_not_take_the_next_one_for_its_value(self):
        for following in ("-o", "--width"):
            self.refuse(2, "scene", "make", "slant", "--layers", following, "out.exr",
                        says=[f"--layers needs a value, but is followed by {following}"])
        self.refuse(2, "lens", "psf", "doublet", "-o", "d.png", "--defocus", "-o", says=["--defocus", "followed by -o"])
        self.succeed("lens", "psf", "doublet", "-o", "d.png", "--defocus", "-9")

    def test_an_output_without_its_flag_is_explained(self):
        self.refuse(2, "defocus", "in.exr", "out.exr", says=["out.exr", "-o out.exr"])
        given = self.refuse(2, "defocus", "in.exr", "more.exr", "-o", "out.exr", says=["more.exr"])
        self.assertNotIn("-o more.exr", given.err)

    def test_help_of_a_verb_is_what_its_flag_shows(self):
        for verb in ("defocus", "lens psf", "scene"):
            self.assertEqual(self.succeed("help", *verb.split()).out, self.succeed(*verb.split(), "--help").out)
        self.refuse(2, "help", "defokus", says=["no verb defokus (did you mean defocus?)"])
        self.refuse(2, "help", "lens", "psv", says=["no verb psv (did you mean psf?)"])
        self.refuse(2, "help", "defocus", "--format", "man", says=["--format", "leave out the verb"])

    def test_a_missing_lens_file_is_not_taken_for_a_misspelt_lens(self):
        for name in ("missing.zmx", "folder/missing", "missing.json"):
            outcome = self.refuse(2, "lens", "show", name, says=[f'lens file "{name}" does not exist'])
            self.assertNotIn("petzval lens list", outcome.err)
        outcome = self.refuse(2, "lens", "show", "dublet", says=["did you mean doublet?", "petzval lens list shows all"])
        self.assertLess(len(outcome.err), 150)

    def test_pictures_beside_the_input_need_their_own_depth(self):
        write_exr(self.path("flat.exr"), picture(8, 6, depth=None))
        for flag in ("--plate", "--holdout", "--merge"):
            self.refuse(3, "defocus", "in.exr", "-o", "out.exr", *CAMERA, flag, "flat.exr",
                        says=[flag + " flat.exr has no depth", "deep EXR"])

    def test_no_flag_may_be_given_twice(self):
        for flag, value in DEFOCUS_VALUES.items():
            others = [] if flag == "-o" else ["-o", "out.exr"]
            self.refuse(2, "defocus", "in.exr", *others, flag, value, flag, value, says=[flag + " is given more than once"])
        for flag in DEFOCUS_SWITCHES:
            self.refuse(2, "defocus", "in.exr", "-o", "out.exr", flag, flag, says=[flag + " is given more than once"])

    def test_a_flag_without_its_value(self):
        for flag in DEFOCUS_VALUES:
            self.refuse(2, "defocus", "in.exr", flag, says=[flag, "needs a value"])
        self.refuse(2, "defocus", "in.exr", "--focus", "--fstop", "2", says=["--focus needs a value", "--fstop"])

    def test_flags_that_contradict_each_other(self):
        for flags, words in CONTRADICTIONS:
            self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *flags, says=words)

    def test_values_out_of_range_say_what_is_accepted(self):
        for flag, values in WRONG_VALUES.items():
            for value in values:
                self.refuse(2, "defocus", "in.exr", "-o", "out.exr", flag, value, says=[flag + " " + value])

    def test_output_names(self):
        self.refuse(2, "defocus", "in.exr", "-o", "out.jpg", *CAMERA, says=["out.jpg", ".exr or .png"])
        self.refuse(2, "develop", "in.exr", "-o", "out.exr", says=["out.exr", ".png"])
        self.refuse(2, "scene", "make", "slant", "-o", "out.png", says=["out.png", ".exr"])
        self.refuse(2, "scene", "make", "slant", "-o", "a.exr", "--truth", "a.exr", says=["different files"])
        self.refuse(2, "defocus", "in.exr", "-o", "in.exr", *CAMERA, says=["in.exr", "would replace the input"])
        self.refuse(2, "defocus", "in.exr", "-o", "../%s/in.exr" % self.folder.split("/")[-1], *CAMERA)

    def test_an_unknown_scene_lists_those_there_are(self):
        self.refuse(2, "scene", "make", "nite", "-o", "out.exr", says=["nite", "slant", "bars"])

    def test_missing_camera_numbers_are_named_and_the_example_given_works(self):
        outcome = self.refuse(2, "defocus", "in.exr", "-o", "out.exr", "--fstop", "2", "--focus", "2m",
                              says=["no focal length and no sensor width", "--focal-length and --sensor-width"])
        outcome = self.refuse(2, "defocus", "in.exr", "-o", "out.exr", says=["for example: petzval defocus in.exr"])
        example = outcome.lines[-1].split("for example: petzval ")[1]
        self.succeed(*example.split())

    def test_lengths_take_units(self):
        cameras = [self.report("defocus", "in.exr", "-o", "out.exr", "--fstop", "2", *lengths.split())["camera"]
                   for lengths in ("--focal-length 85 --sensor-width 36 --focus 2.5",
                                   "--focal-length=85mm --sensor-width=3.6cm --focus=2500mm",
                                   "--focal-length 0.085m --sensor-width 36mm --focus 250cm")]
        self.assertEqual(cameras[0]["focal_length_mm"], 85)
        self.assertEqual(cameras[0]["focus_distance_m"], 2.5)
        self.assertEqual(cameras[0], cameras[1])
        self.assertEqual(cameras[0], cameras[2])
        self.assertEqual(cameras[0]["origins"]["focus_distance_m"], "--focus")

    def test_an_aperture_has_an_f_number_or_a_diameter(self):
        lengths = ["--focal-length", "50", "--sensor-width", "36", "--focus", "3"]
        camera = self.report("defocus", "in.exr", "-o", "out.exr", *lengths, "--aperture-diameter", "2.5cm")["camera"]
        self.assertEqual(camera["f_number"], 2)
        self.assertIn("--aperture-diameter", camera["origins"]["f_number"])
        self.succeed("defocus", "in.exr", "-o", "by_number.exr", *lengths, "--fstop", "2")
        self.assertEqual(read_exr(self.path("out.exr"))[0], read_exr(self.path("by_number.exr"))[0])
        self.assertEqual(self.report("lens", "psf", "ideal", "--defocus", "9", "-o", "psf.exr", "--focal-length", "50",
                                     "--aperture-diameter", "25")["camera"]["f_number"], 2)
        for verb in (["defocus", "in.exr", "-o", "out.exr"], ["inspect", "in.exr"], ["scene", "make", "bars", "-o", "s.exr"],
                     ["lens", "psf", "ideal", "--defocus", "9", "-o", "psf.exr"]):
            self.refuse(2, *verb, "--fstop", "2", "--aperture-diameter", "25", says=["--fstop", "--aperture-diameter"])

    def test_focus_inside_the_focal_length_is_refused_only_where_it_means_nothing(self):
        near = ["--focal-length", "85", "--sensor-width", "36", "--fstop", "8", "--focus", "80mm"]
        outcome = self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *near, "--breathing", "on", says=["--breathing"])
        self.assertNotIn("thin-lens:", outcome.lines[-1])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *near, "--image-scale", "thin-lens", says=["--focus"])
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--max-radius", "3", *near)

    def test_file_names_with_odd_letters_stay_on_one_line(self):
        self.refuse(3, "inspect", "a\nb\x1b[31m.exr", says=["a"])
        write_exr(self.path("ein Bild ä.exr"), picture(8, 6))
        self.succeed("develop", "ein Bild ä.exr", "-o", "ä.png")

    def test_colour_of_errors_needs_a_terminal(self):
        self.assertNotIn("\x1b", self.run_program("defcus").err)


if __name__ == "__main__":
    unittest.main()
