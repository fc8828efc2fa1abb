"""Focus pulls: by pixels, by a rack, followed or not; what each frame is focused on is told."""
import json
import unittest

from pictures import camera_attributes, picture, write_exr
from program import CommandLineTest

NEAR_M, WALL_M, FAR_M = 2.0, 3.0, 8.0


class Pulls(CommandLineTest):
    """From a near thing on the left to a far one on the right; between them a wall."""

    def setUp(self):
        super().setUp()
        self.write(range(1, 6))

    def write(self, frames, **options):
        for frame in frames:
            write_exr(self.path("in.%04d.exr" % frame),
                      picture(50, 20, lambda x, y: (x + y) % 7 / 10,
                              lambda x, y: NEAR_M if x < 15 else FAR_M if x >= 35 else WALL_M),
                      attributes=camera_attributes(200, 36, 1.4, 5), **options)

    def pull(self, *flags, track=None):
        """Focus by frame, from the records, and what was said."""
        if track:
            with open(self.path("t.csv"), "w") as file:
                file.write(track)
            flags = ["--track", "t.csv", *flags]
        outcome = self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", "--report", "r.jsonl", *flags)
        with open(self.path("r.jsonl")) as file:
            records = [json.loads(line) for line in file]
        return [r["camera"]["focus_distance_m"] for r in records], outcome.err, records

    def even(self, distances):
        """Evenly in dioptres from near to far."""
        for i, metres in enumerate(distances):
            self.assertAlmostEqual(1 / metres, 1 / NEAR_M + i / 4 * (1 / FAR_M - 1 / NEAR_M), places=6)

    def test_pixels_are_measured_at_their_keys_and_focus_moves_evenly_between(self):
        distances, said, records = self.pull(track="frame,focus_x,focus_y\n1,5,10\n5,45,10\n")
        self.even(distances)
        self.assertIn("frame 1: out.0001.exr, focus 2 m, f/1.4, ", said)
        self.assertIn("focus 8 m, f/1.4", said)
        self.assertNotIn("jumps", said)
        self.assertEqual(records[2]["camera"]["origins"]["focus_distance_m"], "--track")

    def test_a_pixel_is_followed_where_that_is_asked_for_and_a_jump_is_told(self):
        distances, said, records = self.pull(track="frame,focus_x,focus_y,follow\n1,5,10,on\n5,45,10,\n")
        self.assertEqual(distances, [NEAR_M, WALL_M, WALL_M, FAR_M, FAR_M])
        self.assertIn("frame 2: the focus jumps from 2 to 3 m", said)
        self.assertIn("frame 4: the focus jumps from 3 to 8 m, beyond the depth of field", records[3]["warnings"][0])
        self.assertEqual(records[2]["warnings"], [])

    def test_a_track_of_other_frames_is_told(self):
        distances, said, _ = self.pull("--frames", "1-5", track="frame,focus\n1001,2\n1005,8\n")
        self.assertEqual(distances, [2] * 5)
        self.assertIn("the keys of the track are frames 1001 to 1005; all frames of this run have the values of frame "
                      "1001", said)
        for keys in ("5,2\n1005,8", "1001,2"):  # a key in the run; one value for all frames
            self.assertNotIn("keys of the track", self.pull("--frames", "1-5", track="frame,focus\n%s\n" % keys)[1])

    def test_a_rack_takes_pixels_and_distances(self):
        self.even(self.pull("--rack", "1:5,10", "5:45,10")[0])
        self.even(self.pull("--rack", "1:200cm", "5:45,10")[0])
        self.assertEqual(self.pull("--rack", "1:2", "5:inf")[0][4], float("inf"))
        # The keys' frames are read, whichever frames are made.
        self.assertEqual(len(self.pull("--rack", "1:5,10", "5:45,10", "--frames", "2,3")[0]), 2)
        # Through a single picture; beside a track of something else.
        self.succeed("defocus", "in.0001.exr", "-o", "still.####.exr", "--rack", "1:5,10", "5:45,10")
        distances, said, _ = self.pull("--rack", "1:5,10", "5:45,10", track="frame,fstop\n1,1.4\n5,2.8\n")
        self.even(distances)
        self.assertIn("f/2.8", said)

    def test_what_no_rack_can_be_is_refused(self):
        for keys, says in ((["1:5,10,3"], "--rack 1:5,10,3"), (["a:5,10"], "a:5,10"), (["1:far"], "--rack 1:far"),
                           (["1:2", "1:3"], "twice"), (["5,10"], "FRAME:X,Y")):
            self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--rack", *keys, says=[says])
        with open(self.path("t.csv"), "w") as file:
            file.write("frame,focus\n1,2\n")
        self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--rack", "1:2", "--track", "t.csv", says=["focus"])
        self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--rack", "1:500,10", says=["frame 1", "500,10"])
        self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--rack", "1:5,10", "--focus", "2m", says=["--focus"])
        self.refuse(3, "defocus", "in.####.exr", "-o", "out.####.exr", "--rack", "1:5,10", "9:45,10", says=["frame 9", "in.0009"])

    def test_a_shot_that_cannot_know_how_things_move_is_refused_before_the_work(self):
        self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", "--temporal", "1",
                    says=["worldToCamera", "--motion", "leave out --temporal"])


if __name__ == "__main__":
    unittest.main()
