"""One guard knows every file that a run reads and writes: no output of any verb replaces an input, a neighbour or
another output, and --no-clobber replaces nothing at all."""
import os
import unittest

from pictures import camera_attributes, picture, write_exr
from program import CAMERA, CommandLineTest


class Guard(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2, 3):
            write_exr(self.path("s.%04d.exr" % frame), picture(24, 16, lambda x, y: frame / 10, lambda x, y: 1 + x / 10),
                      attributes=camera_attributes(50, 36, 1.4, 2))
        self.before = {name: self.content(name) for name in os.listdir(self.folder)}

    def refused(self, *command):
        self.refuse(2, *command, says=["would replace"])
        self.assertEqual({name: self.content(name) for name in os.listdir(self.folder)}, self.before)

    def test_a_plot_or_a_track_never_replaces_a_frame(self):
        track = ["focus-track", "s.####.exr", "--at", "10,8"]
        self.refused(*track, "-o", "t.csv", "--plot", "s.0002.exr")
        self.refused(*track, "-o", "s.0002.exr", "--frames", "1")
        self.refused(*track, "-o", "t.csv", "--report", "t.csv")
        self.refused(*track, "-o", "t.csv", "--plot", "t.svg", "--report", "t.svg")

    def test_no_output_replaces_a_neighbour_or_another_frame(self):
        shot = ["defocus", "s.####.exr", "--frames", "1", "--temporal", "1"]
        self.refused(*shot, "-o", "s.0002.exr")
        for flag in ("--report", "--save-look"):
            self.refused(*shot, "-o", "f.####.exr", flag, "s.0002.exr")
        self.refused("defocus", "s.####.exr", "-o", "s.####.exr", *CAMERA)
        self.refused("defocus", "s.####.exr", "-o", "f.####.exr", *CAMERA, "--json", "f.####.exr")

    def test_a_sheet_and_a_comparison_replace_nothing_they_read_or_write(self):
        self.refused("sheet", "s.####.exr", "-o", "o.png", "--report", "o.png")
        self.refused("sheet", "s.####.exr", "-o", "o.png", "--report", "s.0003.exr")
        self.refused("compare", "s.####.exr", "s.0001.exr", "--report", "s.0002.exr")
        self.refused("inspect", "s.####.exr", "--report", "s.0002.exr")
        self.refused("develop", "s.####.exr", "-o", "d.####.png", "--report", "d.0002.png")

    def test_links_are_the_files_they_lead_to(self):
        os.symlink("s.0002.exr", self.path("link.svg"))
        os.link(self.path("s.0003.exr"), self.path("twin.svg"))
        self.before = {name: self.content(name) for name in os.listdir(self.folder)}
        for name in ("link.svg", "twin.svg", "./s.0002.exr"):
            self.refused("focus-track", "s.####.exr", "-o", "t.csv", "--at", "10,8", "--plot", name)

    def test_every_file_that_a_flag_reads_is_guarded(self):
        for flag in ("--depth", "--behind", "--holdout", "--merge", "--mask", "--look", "--aperture-image"):
            if flag == "--look":
                self.succeed("defocus", "s.0001.exr", "-o", "o.exr", "--save-look", "plate")
            else:
                os.link(self.path("s.0003.exr"), self.path("plate"))
            self.refuse(2, "defocus", "s.0001.exr", "-o", "p.exr", flag, "plate", "--json", "plate", says=["would replace"])
            os.remove(self.path("plate"))
        with open(self.path("t.csv"), "w") as file:
            file.write("frame,focus\n1,2\n")
        self.refuse(2, "defocus", "s.####.exr", "-o", "f.####.exr", "--track", "t.csv", "--report", "t.csv",
                    says=["would replace"])

    def test_no_clobber_never_replaces_a_report(self):
        with open(self.path("j.json"), "w") as file:
            file.write("mine")
        for verb in (["defocus", "s.0001.exr", "-o", "new.exr"], ["develop", "s.0001.exr", "-o", "new.png"],
                     ["scene", "points", "city", "-o", "new.csv"],
                     ["scene", "make", "slant", "-o", "made.exr", "--width", "20", "--height", "10"],
                     ["lens", "psf", "doublet", "-o", "psf.exr"]):
            outcome = self.succeed(*verb, "--json", "j.json", "--no-clobber")
            self.assertIn("j.json: exists and is kept", outcome.err)
            self.assertTrue(os.path.exists(self.path(verb[verb.index("-o") + 1])))
            self.assertEqual(self.content("j.json"), b"mine")
        self.succeed("defocus", "s.0001.exr", "-o", "new.exr", "--json", "j.json")
        self.assertIn(b'"verb"', self.content("j.json"))

    def test_a_scene_makes_what_is_missing_and_leaves_what_is_there(self):
        size = ["--width", "20", "--height", "10", "--samples", "4", "--pinhole-samples", "1"]
        outputs = {"-o": "o.exr", "--truth": "t.exr", "--layers": "l.exr"}
        words = [word for pair in outputs.items() for word in pair]
        for there in outputs.values():
            with open(self.path(there), "w") as file:
                file.write("mine")
            outcome = self.succeed("scene", "make", "slant", *words, *size, "--no-clobber")
            self.assertIn(there + ": exists and is kept", outcome.err)
            for name in outputs.values():
                self.assertEqual(self.content(name)[:4], b"mine" if name == there else b"v/1\x01", name)
                os.remove(self.path(name))


if __name__ == "__main__":
    unittest.main()
