"""What silhouettes hide, taken from the frames around or from the other eye."""
import json
import math
import struct
import unittest

from pictures import attribute, camera_attributes, picture, read_exr, write_exr, write_eyes
from program import CommandLineTest

WIDTH, HEIGHT, FOCAL_PX = 64, 24, 60
CARD_M, WALL_M = 1.0, 6.0
SENSOR_MM = 400  # large, so that few pixels make wide discs


class SeenElsewhere(CommandLineTest):
    def seen_from(self, camera_x, card=True):
        """Channels and attributes of a wall behind a near card, whose camera stands at camera_x (m)."""
        def tangent(x):
            return (x + 0.5 - WIDTH / 2) / FOCAL_PX
        def is_card(x):
            return card and abs(tangent(x) * CARD_M + camera_x) < 0.12
        def light(x):
            return 0.05 if is_card(x) else 0.5 + 0.4 * math.sin(2.2 * (tangent(x) * WALL_M + camera_x))
        matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -camera_x, 0, 0, 1]
        return (picture(WIDTH, HEIGHT, lambda x, y: light(x), lambda x, y: CARD_M if is_card(x) else WALL_M),
                camera_attributes(SENSOR_MM * FOCAL_PX / WIDTH, SENSOR_MM, 2, WALL_M)
                + attribute("worldToCamera", "m44f", struct.pack("<16f", *matrix)))

    def write_frames(self, places):
        for frame, place in enumerate(places, 1):
            channels, attributes = self.seen_from(place)
            write_exr(self.path("in.%04d.exr" % frame), channels, attributes=attributes)

    def result(self, name, channel="R"):
        return read_exr(self.path(name))[0][channel]

    def json(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return json.load(file)

    def test_frames_around_show_what_a_card_hides(self):
        self.write_frames([-0.15, 0, 0.15])
        for name, flags in (("alone", []), ("none", ["--temporal", "0"]), ("together", ["--temporal", "1"])):
            self.succeed("defocus", "in.####.exr", "-o", name + ".####.exr", "--json", name + ".####.json", *flags)
        self.assertTrue(self.result("alone.0002.exr") == self.result("none.0002.exr"))
        self.assertTrue(self.result("alone.0002.exr") != self.result("together.0002.exr"))
        self.assertGreater(self.json("together.0002.json")["seen_elsewhere"]["pixels"], 4 * HEIGHT)
        # A frame is a function of its neighbours alone, not of the run it is made in.
        self.succeed("defocus", "in.####.exr", "-o", "one.####.exr", "--temporal", "1", "--frames", "2")
        self.assertTrue(self.result("one.0002.exr") == self.result("together.0002.exr"))

    def test_frames_that_do_not_move_are_left_as_they_are(self):
        self.write_frames([0, 0, 0])
        self.succeed("defocus", "in.####.exr", "-o", "alone.####.exr")
        self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", "--temporal", "2")
        for frame in (1, 2, 3):
            self.assertTrue(self.result("alone.%04d.exr" % frame) == self.result("out.%04d.exr" % frame))

    def write_passing_cards(self, speed_px, frames, layer=None, scale=1.0):
        """A dark post, blurred; behind it a card that goes past by itself; the camera stands. Vectors as of a shutter of 1 / scale."""
        for frame in frames:
            x0 = 14 + speed_px * frame
            def is_post(x):
                return 24 <= x < 34
            def is_card(x):
                return x0 <= x < x0 + 26 and not is_post(x)
            def light(x, y):
                return 0.05 if is_post(x) else 0.5 + 0.4 * math.sin(0.5 * (x - x0)) if is_card(x) else 0.02
            channels = picture(WIDTH, HEIGHT, light, lambda x, y: 1.0 if is_post(x) else 4.0 if is_card(x) else 6.0)
            for name, step in ((layer, speed_px / scale),) if layer else ():
                channels[name + ".u"] = [[step if is_card(x) else 0 for x in range(WIDTH)] for y in range(HEIGHT)]
                channels[name + ".v"] = [[0] * WIDTH for y in range(HEIGHT)]
            matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
            write_exr(self.path("in.%04d.exr" % frame), channels,
                      attributes=camera_attributes(SENSOR_MM * FOCAL_PX / WIDTH, SENSOR_MM, 2, 4.0)
                      + attribute("worldToCamera", "m44f", struct.pack("<16f", *matrix)))

    def behind_the_post(self, out, *flags):
        self.succeed("defocus", "in.####.exr", "-o", out + ".####.exr", "--frames", "2", "--json", out + ".####.json", *flags)
        return self.json(out + ".0002.json").get("seen_elsewhere", {"pixels": 0, "left_out": []})

    def test_vectors_show_what_moves_by_itself_behind_something(self):
        self.write_passing_cards(4, range(5), "forward")
        by_vectors = self.behind_the_post("vectors", "--temporal", "2")["pixels"]
        by_cameras = self.behind_the_post("cameras", "--temporal", "2", "--motion", "off")["pixels"]
        self.assertGreater(by_vectors, by_cameras + 4 * HEIGHT)
        self.assertEqual(self.behind_the_post("named", "--temporal", "2", "--motion", "forward")["pixels"], by_vectors)
        self.refuse(2, "defocus", "in.####.exr", "-o", "no.####.exr", "--temporal", "1", "--motion-scale", "0", says=["--motion-scale"])
        self.refuse(2, "defocus", "in.####.exr", "-o", "no.####.exr", "--motion", "forward", says=["--motion", "--temporal"])
        # The files' vectors may be of half a frame, or point the other way.
        self.write_passing_cards(4, range(5), "flow", -2)
        self.assertEqual(self.behind_the_post("scaled", "--temporal", "2", "--motion", "flow", "--motion-scale=-2,2")["pixels"], by_vectors)
        self.assertTrue(self.result("scaled.0002.exr") == self.result("vectors.0002.exr"))
        self.refuse(2, "defocus", "in.####.exr", "-o", "no.####.exr", "--temporal", "2", "--motion", "speed",
                    says=["in.0000.exr", "no motion layer 'speed'", "flow"])

    def test_what_moves_by_itself_without_vectors_is_no_worse_than_alone(self):
        self.write_passing_cards(4, range(5))
        channels, attributes = self.card_alone(4 * 2)
        write_exr(self.path("behind.exr"), channels, attributes=attributes)
        self.succeed("defocus", "in.0002.exr", "-o", "known.exr", "--behind", "behind.exr")
        self.behind_the_post("alone")
        self.behind_the_post("together", "--temporal", "2")
        alone, together = (self.report("compare", "known.exr", name + ".0002.exr")["psnr_lin"] for name in ("alone", "together"))
        self.assertGreater(together, alone - 0.1)
        self.write_passing_cards(4, range(5), "forward")
        self.behind_the_post("vectors", "--temporal", "2")
        self.assertGreater(self.report("compare", "known.exr", "vectors.0002.exr")["psnr_lin"], alone + 2)

    def card_alone(self, moved_px):
        x0 = 14 + moved_px
        def is_card(x):
            return x0 <= x < x0 + 26
        return (picture(WIDTH, HEIGHT, lambda x, y: 0.5 + 0.4 * math.sin(0.5 * (x - x0)) if is_card(x) else 0.02,
                        lambda x, y: 4.0 if is_card(x) else 6.0),
                camera_attributes(SENSOR_MM * FOCAL_PX / WIDTH, SENSOR_MM, 2, 4.0))

    def test_frames_around_count_as_memory(self):
        self.write_frames([-0.15, 0, 0.15])
        self.succeed("defocus", "in.####.exr", "-o", "all.####.exr", "--temporal", "1")
        self.succeed("defocus", "in.####.exr", "-o", "most.####.exr", "--temporal", "1", "--max-memory", "200M")
        for frame in (1, 2, 3):
            self.assertTrue(self.result("all.%04d.exr" % frame) == self.result("most.%04d.exr" % frame))
        few = self.run_program("defocus", "in.####.exr", "-o", "few.####.exr", "--temporal", "1", "--max-memory", "150K")
        self.assertEqual(few.code, 1)
        self.assertIn("--max-memory is too little: the frames around", few.err)

    def test_what_is_left_out_of_many_frames_is_said_once(self):
        for frame in range(1, 6):  # each is twice as bright as the last
            channels, attributes = self.seen_from(0.02 * frame)
            lit = {name: rows if name == "Z" else [[value * 2 ** frame for value in row] for row in rows]
                   for name, rows in channels.items()}
            write_exr(self.path("in.%04d.exr" % frame), lit, attributes=attributes)
        said = self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", "--temporal", "2", "--report", "r.jsonl")
        self.assertEqual(said.err.count("look the same"), 1, said)
        with open(self.path("r.jsonl"), encoding="utf-8") as file:
            left_out = [json.loads(line)["seen_elsewhere"]["left_out"] for line in file]
        self.assertEqual([len(lines) for lines in left_out], [2, 3, 4, 3, 2])

    def test_what_does_not_go_together_is_refused(self):
        self.write_frames([0, 0.1])
        self.refuse(2, "defocus", "in.0001.exr", "-o", "out.exr", "--temporal", "1", says=["--temporal"])
        for flags in (["--plate", "in.####.exr"], ["--expand-highlights"]):
            self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--temporal", "1", *flags,
                        says=["--temporal", flags[0]])

    def test_each_eye_shows_the_other_what_it_hides(self):
        """A flat wall stays flat: what shines through the blurred card is the same wall to both eyes."""
        places = {"left": -0.1, "right": 0.1}
        write_eyes(self.path("in.exr"), [(view, *self.seen_from(x)) for view, x in places.items()])
        self.succeed("defocus", "in.exr", "-o", "both.exr", "--view-name", "all", "--json", "both.json")
        self.assertGreater(self.json("both.json")["seen_elsewhere"]["pixels"], 4 * HEIGHT)
        for view, x in places.items():
            channels, attributes = self.seen_from(x)
            write_eyes(self.path("one.exr"), [(view, channels, attributes)])
            write_exr(self.path("wall.exr"), self.seen_from(x, card=False)[0], attributes=attributes)
            self.succeed("defocus", "one.exr", "-o", "guessed.exr")
            self.succeed("defocus", "one.exr", "-o", "known.exr", "--behind", "wall.exr")
            together, guessed = (self.report("compare", "known.exr", name, "--view-name", view)["psnr_lin"]
                                 for name in ("both.exr", "guessed.exr"))
            self.assertLess(guessed, 40)
            self.assertGreater(together, guessed + 3, view)


    def test_both_eyes_look_around_in_time_too(self):
        places = {"left": -0.1, "right": 0.1}
        for frame, moved in enumerate([-0.12, 0, 0.12], 1):
            write_eyes(self.path("in.%04d.exr" % frame), [(view, *self.seen_from(x + moved)) for view, x in places.items()])
        eyes = ["--view-name", "all", "--frames", "2"]
        self.succeed("defocus", "in.####.exr", "-o", "eyes.####.exr", *eyes)
        self.succeed("defocus", "in.####.exr", "-o", "both.####.exr", "--temporal", "1", *eyes)
        for view, x in places.items():
            channels, attributes = self.seen_from(x)
            write_eyes(self.path("one.exr"), [(view, channels, attributes)])
            write_exr(self.path("wall.exr"), self.seen_from(x, card=False)[0], attributes=attributes)
            self.succeed("defocus", "one.exr", "-o", "known.exr", "--behind", "wall.exr")
            together, each = (self.report("compare", "known.exr", name + ".0002.exr", "--view-name", view)["psnr_lin"]
                              for name in ("both", "eyes"))
            self.assertGreater(together, each + 1, view)


if __name__ == "__main__":
    unittest.main()
