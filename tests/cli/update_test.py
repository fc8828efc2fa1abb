"""-u: what is there is left alone only where it was made with the same settings, and says why it is made again."""
import json
import os
import struct
import unittest

from pictures import attribute, camera_attributes, picture, write_exr
from program import CommandLineTest


class Update(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2, 3):
            write_exr(self.path("in.%04d.exr" % frame),
                      picture(40, 28, lambda x, y: (x * 31 + y * 17 + frame) % 13 / 20, lambda x, y: 1.2 if x < 15 else 5.0),
                      attributes=camera_attributes(50, 36, 1.4, 2))
            os.utime(self.path("in.%04d.exr" % frame), (1, 1))

    def update(self, *flags, output="out.####.exr"):
        outcome = self.succeed("defocus", "in.####.exr", "-o", output, "-u", *flags)
        return [line for line in outcome.lines if line.startswith("frame ")]

    def track(self, text):
        with open(self.path("t.csv"), "w") as file:
            file.write(text)

    def all_left(self, lines):
        self.assertEqual(["kept (" in line for line in lines], [True] * 3, lines)

    def test_a_changed_flag_is_noticed_and_named(self):
        self.update()
        self.all_left(self.update())
        for line in self.update("--lens", "doublet"):
            self.assertIn("made again: --lens was not given and is doublet", line)
        self.all_left(self.update("--lens", "doublet"))
        self.assertIn("--fstop was not given and is 2", self.update("--lens", "doublet", "--fstop", "2")[0])

    def test_a_changed_track_remakes_the_frames_that_it_changes(self):
        self.track("frame,fstop\n1,1.4\n2,2\n3,2\n")
        self.update("--track", "t.csv")
        self.track("frame,fstop\n1,1.4\n2,2\n3,4\n")
        lines = self.update("--track", "t.csv", "--report", "r.jsonl")
        self.assertEqual(["made again: --fstop was 2 and is 4" in line for line in lines], [False, False, True], lines)
        with open(self.path("r.jsonl")) as file:
            records = [json.loads(line) for line in file]
        self.assertEqual([("made_again" in r, "skipped" in r) for r in records], [(False, True), (False, True), (True, False)])
        os.utime(self.path("t.csv"))
        self.all_left(self.update("--track", "t.csv"))

    def test_the_same_choice_by_a_track_a_look_or_flags_is_the_same(self):
        self.update("--blades", "5", "--fstop", "2", "--save-look", "look.json")
        self.track("frame,fstop\n1,2\n")
        self.all_left(self.update("--track", "t.csv", "--look", "look.json"))

    def test_other_files_and_older_outputs_are_noticed(self):
        self.update()
        os.link(self.path("in.0003.exr"), self.path("plate.exr"))
        self.assertIn("made from other files", self.update("--behind", "plate.exr")[0])
        os.utime(self.path("in.0002.exr"))
        self.assertEqual(["kept (" in line for line in self.update("--behind", "plate.exr")], [True, False, True])

    def test_a_newer_neighbour_remakes_a_frame(self):
        matrix = struct.pack("<16f", *[float(i % 5 == 0) for i in range(16)])
        for frame in (1, 2, 3):
            write_exr(self.path("in.%04d.exr" % frame), picture(40, 28, lambda x, y: 0.5, lambda x, y: 3.0),
                      attributes=camera_attributes(50, 36, 1.4, 2) + attribute("worldToCamera", "m44f", matrix))
            os.utime(self.path("in.%04d.exr" % frame), (1, 1))
        self.update("--temporal", "1")
        self.all_left(self.update("--temporal", "1"))
        os.utime(self.path("in.0003.exr"))
        self.assertEqual(["kept (" in line for line in self.update("--temporal", "1")], [True, False, False])

    def test_display_pictures_say_it_too(self):
        self.update(output="out.####.png")
        self.all_left(self.update(output="out.####.png"))
        self.assertIn("--exposure was not given and is 1", self.update("--exposure", "1", output="out.####.png")[0])
        for flags, says in (([], ""), ([], "nothing to do"), (["--tone", "none"], "made again: --tone")):
            self.assertIn(says, self.succeed("develop", "out.0001.png", "-o", "d.png", "-u", *flags).err)

    def test_a_picture_of_an_older_version_is_made_again(self):
        self.update()
        old = self.content("out.0002.exr")
        with open(self.path("out.0002.exr"), "wb") as file:
            file.write(old.replace(b"petzval:madeWith", b"petzval:madeWhen"))
        lines = self.update()
        self.assertIn("made again: it does not say what it was made with", lines[1])
        self.assertIn("kept (", lines[2])


if __name__ == "__main__":
    unittest.main()
