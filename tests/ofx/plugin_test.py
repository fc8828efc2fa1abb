"""The OpenFX plug-in makes the command line's pictures, and breaks no rule of the specification."""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "cli"))
import pictures  # noqa: E402

PETZVAL, OFX_CHECK = os.environ["PETZVAL"], os.environ["OFX_CHECK"]
BUNDLE = pathlib.Path(os.environ["PETZVAL_OFX"]).parents[2]
CAMERA = ["--focal-length", "105", "--sensor-width", "36", "--fstop", "1.4"]
PARAMS = {"focalLength": 105, "sensorWidth": 36, "fStop": 1.4}


def words(params):
    return [word for name, value in params.items() for word in ("--param", f"{name}={value}")]


class Plugin(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="petzval-ofx-")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.command(PETZVAL, "scene", "make", "night", "-o", "night.exr", "--layers", "plate.exr", "--width", "160",
                    "--height", "90", "--pinhole-samples", "8")
        # The scene has half floats; an effect without blur writes them as floats.
        cls.render("sharp.exr", {"fStop": 1e9}, "--clip", "Source=night.exr", "--clip", "Depth=night.exr:Z")

    @classmethod
    def command(cls, *args, code=0):
        done = subprocess.run(list(map(str, args)), cwd=cls.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, timeout=250, env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"})
        assert done.returncode == code, f"{args}: exit {done.returncode}\n{done.stdout}\n{done.stderr}"
        return done

    @classmethod
    def render(cls, out, params, *clips, code=0):
        return cls.command(OFX_CHECK, "render", BUNDLE, "-o", out, *words(params), *clips, code=code)

    CLIPS = ("--clip", "Source=sharp.exr", "--clip", "Depth=night.exr:Z")

    def same(self, params, flags, clips=CLIPS):
        self.render("host.exr", {**PARAMS, **params}, *clips)
        self.command(PETZVAL, "defocus", "sharp.exr", "--depth", "night.exr", "-o", "line.exr", *CAMERA, *flags, "--overwrite")
        report = json.loads(self.command(PETZVAL, "compare", "line.exr", "host.exr", "--json", "-").stdout)
        self.assertEqual(report["max_error"], 0, (params, report))
        blurred = json.loads(self.command(PETZVAL, "compare", "sharp.exr", "host.exr", "--json", "-").stdout)
        self.assertGreater(blurred["max_error"], 0.1, "the pictures differ from the sharp one")

    def test_a_frame_has_the_bits_of_the_command_line(self):
        self.same({"focusDistance": 4.8}, ["--focus", "4.8m"])

    def test_so_it_has_by_every_engine_and_quality(self):
        self.same({"focusDistance": 3, "engine": "gaussian"}, ["--focus", "3m", "--engine", "gaussian"])
        self.same({"focusDistance": 3, "engine": "gather", "quality": "draft"},
                  ["--focus", "3m", "--engine", "gather", "--quality", "draft"])

    def test_so_it_has_through_a_lens_by_name_and_from_a_file(self):
        own = pathlib.Path(__file__).parents[2] / "lenses/petzval-laikin.json"
        for lens in ("doublet", own):
            self.same({"focusDistance": 4.8, "lens": lens}, ["--focus", "4.8m", "--lens", lens])

    def test_so_it_has_by_a_look_as_text_and_as_file(self):
        self.command(PETZVAL, "defocus", "sharp.exr", "--depth", "night.exr", "-o", "x.exr", *CAMERA, "--focus", "4.8m",
                     "--blades", "5", "--cats-eye", "0.7", "--save-look", "own.look", "--overwrite")
        text = (pathlib.Path(self.folder) / "own.look").read_text()
        for look in ("own.look", text):
            self.same({"focusDistance": 4.8, "look": look}, ["--focus", "4.8m", "--look", "own.look"])

    def test_depth_may_come_from_a_file_of_the_frame_where_there_is_one_clip(self):
        shutil.copy(f"{self.folder}/night.exr", f"{self.folder}/depth.0007.exr")
        self.same({"focusDistance": 4.8, "depthFile": "depth.####.exr"}, ["--focus", "4.8m"],
                  ("--context", "filter", "--time", "7", "--clip", "Source=sharp.exr"))

    def test_frames_of_a_depth_file_may_begin_elsewhere(self):
        shutil.copy(f"{self.folder}/night.exr", f"{self.folder}/numbered.1008.exr")
        self.same({"focusDistance": 4.8, "depthFile": "numbered.####.exr", "depthFrameOffset": 1001}, ["--focus", "4.8m"],
                  ("--context", "filter", "--time", "7", "--clip", "Source=sharp.exr"))

    def test_display_codes_are_blurred_as_light(self):
        def codes_of(name):  # light of NAME.exr as sRGB codes in NAME-codes.exr
            self.command(PETZVAL, "develop", f"{name}.exr", "-o", f"{name}.png", "--bits", "16", "--tone", "none", "--overwrite")
            self.command(PETZVAL, "defocus", f"{name}.png", "--depth", "night.exr", "--transfer", "linear", "--fstop", "1e9",
                         *CAMERA[:4], "--focus", "4.8m", "-o", f"{name}-codes.exr", "--overwrite")
            return f"{name}-codes.exr"
        source = codes_of("sharp")
        self.command(PETZVAL, "defocus", "sharp.png", "--depth", "night.exr", *CAMERA, "--focus", "4.8m", "--fill", "off", "-o", "line.exr",
                     "--save-look", "no-fill.look", "--overwrite")
        # Nothing is estimated: half floats of codes may tip the choice between two edges behind a pixel.
        params = {**PARAMS, "focusDistance": 4.8, "look": "no-fill.look"}
        self.render("host.exr", {**params, "transfer": "srgb"}, "--clip", f"Source={source}", *self.CLIPS[2:])
        report = json.loads(self.command(PETZVAL, "compare", codes_of("line"), "host.exr", "--json", "-").stdout)
        self.assertLess(report["max_error"], 3e-3, report)  # the files of codes are of half floats
        self.render("taken.exr", params, "--clip", f"Source={source}", *self.CLIPS[2:])
        report = json.loads(self.command(PETZVAL, "compare", "taken.exr", "host.exr", "--json", "-").stdout)
        self.assertGreater(report["max_error"], 0.05, "codes taken for light look different")
        # MLT passes on codes, so they are the default there.
        self.render("mlt.exr", params, "--host", "MLT", "--clip", f"Source={source}", *self.CLIPS[2:])
        report = json.loads(self.command(PETZVAL, "compare", "host.exr", "mlt.exr", "--json", "-").stdout)
        self.assertEqual(report["max_error"], 0, report)

    def test_a_host_may_keep_colour_unpremultiplied(self):
        # Bars of alpha 0 to 1 in front of nothing.
        alpha = pictures.plane(160, 90, lambda x, y: (x // 20 % 5) / 4)
        colour = [[0.8 * a * (1 + y % 3) / 3 for a in row] for y, row in enumerate(alpha)]
        depth = pictures.plane(160, 90, lambda x, y: 2 + x / 80)
        with open(f"{self.folder}/bars.exr", "wb") as file:
            file.write(pictures.exr_bytes({"R": colour, "G": colour, "B": colour, "A": alpha, "Z": depth}))
        clips = ("--clip", "Source=bars.exr", "--clip", "Depth=bars.exr:Z")
        self.render("kept.exr", {**PARAMS, "focusDistance": 2}, *clips)
        self.render("divided.exr", {**PARAMS, "focusDistance": 2}, *clips, "--alpha", "unpremultiplied")
        report = json.loads(self.command(PETZVAL, "compare", "kept.exr", "divided.exr", "--json", "-").stdout)
        self.assertLess(report["max_error"], 1e-4, report)

    def test_a_preset_glows_without_blur_too(self):
        self.render("host.exr", {**PARAMS, "fStop": 1e9, "preset": "soft-focus"}, *self.CLIPS)
        self.command(PETZVAL, "defocus", "sharp.exr", "--depth", "night.exr", "-o", "line.exr", *CAMERA[:4], "--fstop", "1e9",
                     "--focus", "3m", "--preset", "soft-focus", "--overwrite")
        report = json.loads(self.command(PETZVAL, "compare", "line.exr", "host.exr", "--json", "-").stdout)
        self.assertEqual(report["max_error"], 0, report)

    def test_the_focus_point_counts_from_the_bottom(self):
        self.same({"focusFrom": "point", "focusPoint": "40.5,30.5"}, ["--focus-at", "40,59"])

    def test_the_default_focus_point_is_the_middle_in_mlt_too(self):
        # MLT 7.41.0 gives the normalised default without the frame's size; other hosts give what a user set.
        point = {"focusFrom": "point", "transfer": "linear"}
        self.same({**point, "focusPoint": "0.5,0.5"}, ["--focus-at", "80,44"], (*self.CLIPS, "--host", "MLT"))
        self.same(point, ["--focus-at", "80,44"])
        self.same({**point, "focusPoint": "0.5,0.5"}, ["--focus-at", "0,89"])

    def depth_of(self, change):
        """The scene's depth, each value changed, as rows."""
        found, _ = pictures.read_exr(f"{self.folder}/night.exr")
        return [[change(float(z), y) for z in row] for y, row in enumerate(found["Z"])]

    def write_depth(self, name, depth):
        colour, _ = pictures.read_exr(f"{self.folder}/sharp.exr")
        pictures.write_exr(f"{self.folder}/{name}", {**{c: [list(map(float, row)) for row in colour[c]] for c in "RGBA"}, "Z": depth})

    def same_depth(self, name, params, flags, *clips):
        """The plug-in and the command line read the same depth of a file."""
        self.render("host.exr", {**PARAMS, "focusDistance": 4.8, **params}, "--clip", "Source=sharp.exr", *clips)
        camera = [] if "coc-px" in flags else [*CAMERA, "--focus", "4.8m"]
        self.command(PETZVAL, "defocus", "sharp.exr", "--depth", name, "-o", "line.exr", *camera, *flags, "--overwrite")
        report = json.loads(self.command(PETZVAL, "compare", "line.exr", "host.exr", "--json", "-").stdout)
        self.assertEqual(report["max_error"], 0, (name, params, report))

    def test_depth_of_few_codes_is_joined_as_on_the_command_line(self):
        self.write_depth("steps.exr", self.depth_of(lambda z, y: round(min(z, 25.5) * 10) / 10))
        self.same_depth("steps.exr", {}, [], "--clip", "Depth=steps.exr:Z")
        self.same_depth("steps.exr", {"depthFile": "steps.exr"}, [])

    def test_depth_of_other_signs_and_misses_is_that_of_the_command_line(self):
        for name, change in (("negative.exr", lambda z, y: -z), ("half.exr", lambda z, y: 65504 if y < 20 else z),
                             ("mixed.exr", lambda z, y: -z if y < 20 else z), ("zero.exr", lambda z, y: 0 if y < 20 else z)):
            self.write_depth(name, self.depth_of(change))
            self.same_depth(name, {}, [], "--clip", f"Depth={name}:Z")

    def test_a_range_may_begin_at_the_camera(self):
        self.write_depth("shares.exr", self.depth_of(lambda z, y: min(z, 25.5) / 25.5))
        for kind in ("normalized", "mist-linear"):
            self.same_depth("shares.exr", {"depthFile": "shares.exr", "depthKind": kind, "depthFar": 25.5},
                            ["--depth-kind", kind, "--depth-range", "0,25.5"])

    def write_shares(self):
        """The scene's depth as shares of 25.5 m: floats in shares.exr, whole numbers in shares.png and half.png, of half the size."""
        shares = self.depth_of(lambda z, y: min(z, 25.5) / 25.5)
        self.write_depth("shares.exr", shares)
        for name, rows in (("shares", shares), ("half", [row[1::2] for row in shares[1::2]])):
            codes = [[round(share * 65535) for share in row] for row in rows]
            pictures.write_png(f"{self.folder}/{name}.png", codes, channels=1, bits=16)

    def test_a_depth_file_may_be_any_picture_that_the_command_line_takes(self):
        self.write_shares()
        for kind, end in (("normalized", 25.5), ("mist-linear", 20)):
            self.same_depth("shares.png", {"depthFile": "shares.png", "depthKind": kind, "depthFar": end},
                            ["--depth-kind", kind, "--depth-range", f"0,{end}"])
        self.same_depth("shares.png", {"depthFile": "shares.png", "depthUnit": 25.5}, ["--depth-kind", "planar", "--unit-scale", "25.5"])

    def test_a_depth_file_without_depth_says_what_it_looked_for(self):
        depth = self.depth_of(lambda z, y: z)
        pictures.write_exr(f"{self.folder}/grey.exr", {c: depth for c in "RGB"})
        self.same_depth("grey.exr", {"depthFile": "grey.exr"}, [])
        grey, named = (self.render("host.exr", {**PARAMS, "focusDistance": 4.8, "depthFile": name}, "--clip", "Source=sharp.exr").stderr
                       for name in ("grey.exr", "night.exr"))
        self.assertEqual(named, "")
        self.assertRegex(grey, r"says: depth: R: the depth file has no depth channel \(looked for Z, .*\), .* in grey.exr$")
        line = grey.strip().removeprefix("the plug-in says: ")
        self.assertIn(line, self.command(PETZVAL, "defocus", "sharp.exr", "--depth", "grey.exr", "-o", "line.exr", *CAMERA,
                                         "--focus", "4.8m", "--overwrite").stderr)

    def test_a_depth_file_of_another_size_is_stretched_as_on_the_command_line(self):
        self.write_shares()
        self.same_depth("half.png", {"depthFile": "half.png", "depthKind": "normalized", "depthFar": 25.5},
                        ["--depth-kind", "normalized", "--depth-range", "0,25.5"])
        depth = self.depth_of(lambda z, y: z)
        pictures.write_exr(f"{self.folder}/half.exr", {"Z": [row[::2] for row in depth[::2]]})
        self.same_depth("half.exr", {"depthFile": "half.exr"}, [])

    def test_radii_of_a_range_are_those_of_the_command_line(self):
        self.write_shares()
        flags = ["--depth-kind", "coc-px", "--depth-range=-6,12"]
        radii = {"depthKind": "coc-px", "depthNear": -6, "depthFar": 12}
        self.same_depth("shares.exr", radii, flags, "--clip", "Depth=shares.exr:Z")
        for name in ("shares.exr", "shares.png"):
            self.same_depth(name, {**radii, "depthFile": name}, flags)
        self.same_depth("shares.exr", {**radii, "depthNear": 0, "depthFile": "shares.exr"}, ["--depth-kind", "coc-px", "--depth-range", "0,12"])

    def test_radii_that_are_missing_are_sharp(self):
        self.write_depth("holes.exr", self.depth_of(lambda z, y: float("inf") if y < 20 else 6))
        self.same_depth("holes.exr", {"depthKind": "coc-px"}, ["--depth-kind", "coc-px"], "--clip", "Depth=holes.exr:Z")

    def test_depth_may_lie_in_the_alpha_of_its_clip(self):
        depth, black = self.depth_of(lambda z, y: z), pictures.plane(160, 90, lambda x, y: 0)
        pictures.write_exr(f"{self.folder}/in-alpha.exr", {"R": black, "G": black, "B": black, "A": depth})
        self.same({"focusDistance": 4.8}, ["--focus", "4.8m"], (*self.CLIPS[:2], "--clip", "Depth=in-alpha.exr"))

    def test_a_mask_and_units_are_those_of_the_command_line(self):
        self.same({"focusDistance": 2.4, "depthUnit": 0.5, "depthKind": "ray"},
                  ["--focus", "2.4m", "--unit-scale", "0.5", "--depth-kind", "ray"])
        self.same({"focusDistance": 4.8}, ["--focus", "4.8m", "--mask", "night.exr:G"],
                  (*self.CLIPS, "--clip", "Mask=night.exr:G"))

    def test_a_clean_plate_is_that_of_the_command_line(self):
        self.same({"focusDistance": 4.8, "lens": "doublet"}, ["--focus", "4.8m", "--lens", "doublet", "--behind", "night.exr"],
                  (*self.CLIPS, "--clip", "Plate=night.exr", "--clip", "PlateDepth=night.exr:Z"))

    def test_a_link_of_the_lens_lab_brings_its_lens(self):
        state = {"lens": {"name": "doublet", "text": None, "look": {"blades": 6, "coma": 0.5}}, "camera": {"f_number": 9}}
        link = base64.urlsafe_b64encode(json.dumps(state).encode()).decode().rstrip("=")
        self.same({"focusDistance": 4.8, "look": f"https://example.org/lab/#lens=1.{link}"},
                  ["--focus", "4.8m", "--lens", "doublet", "--blades", "6", "--coma", "0.5"])
        self.same({"focusDistance": 4.8, "look": f"lens=1.{link}"},
                  ["--focus", "4.8m", "--lens", "doublet", "--blades", "6", "--coma", "0.5"])

    def test_a_link_brings_a_pasted_lens(self):
        own = pathlib.Path(__file__).parents[2] / "lenses/petzval-laikin.json"
        state = {"lens": {"name": "mine", "text": own.read_text(), "look": {"blades": 6}}}
        link = base64.urlsafe_b64encode(json.dumps(state).encode()).decode().rstrip("=")
        self.same({"focusDistance": 4.8, "look": f"lens=1.{link}"}, ["--focus", "4.8m", "--lens", own, "--blades", "6"])

    def test_each_error_is_one_sentence_in_the_hosts_message(self):
        self.write_shares()
        pictures.write_exr(f"{self.folder}/no-depth.exr", {c: pictures.plane(4, 4, 1) for c in "AB"})
        pictures.write_exr(f"{self.folder}/half.exr", {c: pictures.plane(80, 45, 1) for c in "RGBZ"})
        for params, clips, says in (
                ({}, self.CLIPS[:2], "no depth"),
                ({"depthFrom": "file", "depthFile": "none.exr"}, self.CLIPS, "none.exr"),
                ({"depthFrom": "file", "depthFile": "shares.png"}, self.CLIPS,
                 "shares.png: integer pixels are not distances in metres; set their meaning, such as Depth kind"),
                ({"depthFrom": "file", "depthFile": "shares.png", "depthKind": "coc-px"}, self.CLIPS, "set Depth range to the radii"),
                ({"depthFrom": "file", "depthFile": "shares.exr", "depthChannel": "Q"}, self.CLIPS, "'Q'"),
                ({"depthFrom": "file", "depthFile": "no-depth.exr"}, self.CLIPS, "name one in Depth channel"),
                ({"depthKind": "coc-px", "depthNear": 3, "depthFar": 3}, self.CLIPS, "Depth range of Depth kind coc-px needs two"),
                ({"lens": "no-lens"}, self.CLIPS, "no-lens"),
                ({"look": "{"}, self.CLIPS, "Look: is not JSON"),
                ({"look": "https://x.org/#lens=1.!!"}, self.CLIPS, "link"),
                ({"depthKind": "device"}, self.CLIPS, "range"),
                ({"focusFrom": "point", "focusPoint": "999,0"}, self.CLIPS, "focus point"),
                ({}, (*self.CLIPS[:2], "--clip", "Depth=half.exr:Z"), "the clip Depth is 80 x 45 pixels, and Source is 160 x 90"),
                ({}, (*self.CLIPS, "--clip", "Dept=night.exr:Z"), "the plug-in has no clip Dept; it has Source, "),
                ({}, (*self.CLIPS, "--clip", "Plate=sharp.exr"), "PlateDepth")):
            done = self.render("none.exr", params, *clips, code=2)
            self.assertIn(says, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_presets_are_those_of_the_command_line(self):
        self.same({"focusDistance": 4.8, "preset": "achromat"}, ["--focus", "4.8m", "--preset", "achromat"])
        own = pathlib.Path(self.folder) / "presets"
        own.mkdir()
        (own / "mine.json").write_text('{"petzval_look": 1, "lens": {"blades": 5, "cats_eye": 0.7}}')
        with unittest.mock.patch.dict(os.environ, PETZVAL_PRESETS=str(own)):
            self.same({"focusDistance": 4.8, "preset": "mine"}, ["--focus", "4.8m", "--preset", "mine"])
            for params, says in (({"preset": "acromat"}, "Preset: there is no preset \"acromat\" (did you mean achromat?); there are mine, portrait"),
                                 ({"preset": "mine", "look": "own.look"}, "both given")):
                self.assertIn(says, self.render("none.exr", params, *self.CLIPS, code=2).stderr)

    def test_menus_write_the_names_of_presets_and_lenses(self):
        for menu, word, flag in (("presetMenu", "achromat", "--preset"), ("lensMenu", "doublet", "--lens")):
            self.same({"focusDistance": 4.8}, ["--focus", "4.8m", flag, word], (*self.CLIPS, "--edit", f"{menu}={word}"))
            # A host that reports no changes, such as MLT, leaves the word in the menu.
            self.same({"focusDistance": 4.8, menu: word}, ["--focus", "4.8m", flag, word])
        # A menu that was used shows its first entry again, so an emptied text stays empty.
        self.same({"focusDistance": 4.8}, ["--focus", "4.8m"], (*self.CLIPS, "--edit", "lensMenu=doublet", "--edit", "lens="))
        done = self.render("none.exr", {}, *self.CLIPS, "--edit", "presetMenu=acromat", code=2)
        self.assertIn("no parameter presetMenu that takes 'acromat'", done.stderr)

    def test_three_names_are_exported(self):
        listing = self.command("nm", "-D", "--defined-only", os.environ["PETZVAL_OFX"]).stdout
        self.assertEqual([line.split()[-1] for line in listing.splitlines()],
                         ["OfxGetNumberOfPlugins", "OfxGetPlugin", "OfxSetHost"])

    def test_no_rule_is_broken(self):
        for params in ({"focalLength": 200}, {"focalLength": 100, "engine": "gather", "focusFrom": "point"}):
            lines = self.command(OFX_CHECK, BUNDLE, *words(params)).stdout.splitlines()
            self.assertGreater(sum(line.startswith("ok ") for line in lines), 45)
            self.assertEqual([line for line in lines if line.startswith("BROKEN")], [])


if __name__ == "__main__":
    unittest.main()
