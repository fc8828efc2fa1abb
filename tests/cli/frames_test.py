"""Shots: many frames by one command, what changes over them, missing frames, failures, frames made before."""
import json
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

from pictures import picture, read_exr, read_png, write_exr
from program import CAMERA, PETZVAL, CommandLineTest, address_space


class Shots(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2, 3, 5):
            self.make(frame)

    def make(self, frame):
        write_exr(self.path("in.%04d.exr" % frame),
                  picture(40, 28, lambda x, y: (x * 31 + y * 17 + frame) % 13 / 20, lambda x, y: 1.2 if x < 15 else 5.0))

    def defocus(self, *flags):
        return self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, *flags)

    def outputs(self):
        return sorted(name for name in os.listdir(self.folder) if name.startswith("out."))

    def test_frames_are_what_single_commands_make(self):
        outcome = self.defocus("--lens", "doublet")
        self.assertIn("4 frames, 1-3,5", outcome.err)
        self.assertIn("no --frames", outcome.err)
        self.assertEqual(self.outputs(), ["out.%04d.exr" % n for n in (1, 2, 3, 5)])
        self.succeed("defocus", "in.0002.exr", "-o", "one.exr", *CAMERA, "--lens", "doublet")
        self.assertEqual(self.content("one.exr"), self.content("out.0002.exr"))

    def test_a_hash_in_the_name_of_an_existing_file_or_folder_is_no_frame_number(self):
        os.mkdir(self.path("job #3"))
        shutil.copy(self.path("in.0001.exr"), self.path("job #3/take #2.exr"))
        self.succeed("defocus", "job #3/take #2.exr", "-o", "job #3/out.exr", *CAMERA)
        self.succeed("defocus", "in.0001.exr", "-o", "one.exr", *CAMERA)
        # (The files also hold the hash of the whole command.)
        self.assertEqual(read_exr(self.path("job #3/out.exr"))[0], read_exr(self.path("one.exr"))[0])
        self.succeed("inspect", "job #3/take #2.exr")

    def test_warnings_that_differ_in_numbers_alone_are_printed_once(self):
        for frame, least in ((1, -1e-7), (2, -0.25), (3, -3.0), (5, -2.5e-3)):
            write_exr(self.path("in.%04d.exr" % frame),
                      picture(40, 28, 0.5, 2.0, lambda x, y: 1.5 + frame if x < 20 else least))
        outcome = self.defocus("--report", "r.jsonl")
        self.assertEqual(outcome.err.count("the picture has alpha from"), 1, outcome.err)
        with open(self.path("r.jsonl")) as file:
            self.assertEqual(file.read().count("the picture has alpha from"), 4)

    def test_frames_of_other_digits_are_named(self):
        shutil.copy(self.path("in.0001.exr"), self.path("in.-0001.exr"))
        self.assertIn("files left out: 1; in.-0001.exr has another number of digits", self.defocus().err)
        self.assertNotIn("left out", self.defocus("--frames", "1-3").err)
        self.refuse(3, "defocus", "in.##.exr", "-o", "out.##.exr", *CAMERA,
                    says=["no frame exists; in.-0001.exr has another number of digits"])

    def test_a_list_chooses_and_printf_names_work(self):
        self.succeed("defocus", "in.%04d.exr", "-o", "out.##.exr", *CAMERA, "--frames", "1-5x2")
        self.assertEqual(self.outputs(), ["out.01.exr", "out.03.exr", "out.05.exr"])

    def test_a_track_changes_focus_and_look(self):
        with open(self.path("t.csv"), "w") as file:
            file.write("frame,focus,lens.blades\n1,1,5\n3,inf,7\n")
        without_focus = [word for word in CAMERA if word not in ("--focus", "2m")]
        self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", *without_focus, "--frames", "1-3", "--track", "t.csv")
        self.succeed("defocus", "in.0002.exr", "-o", "one.exr", *without_focus, "--focus", "2m", "--blades", "5")
        self.assertEqual(self.content("one.exr"), self.content("out.0002.exr"))
        # One picture, focus pulled through it: the track says which frames.
        self.succeed("defocus", "in.0001.exr", "-o", "still.####.exr", *without_focus, "--track", "t.csv")
        self.assertNotEqual(self.content("still.0001.exr"), self.content("still.0003.exr"))

    def test_missing_frames_are_named_before_the_work_begins(self):
        self.refuse(3, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--frames", "1-5",
                    says=["1 of 5 frames", ": 4 ", "--missing skip"])
        self.defocus("--frames", "1-5", "--missing", "skip")
        self.assertEqual(len(self.outputs()), 4)
        self.defocus("--frames", "4,5", "--missing", "black")
        channels, _ = read_exr(self.path("out.0004.exr"))
        self.assertEqual(max(max(row) for row in channels["R"]), 0)

    def test_a_gap_among_existing_frames_is_named(self):
        missing = "in.####.exr: between existing frames, these are missing: 4"
        self.assertIn(missing, str(self.defocus().lines))
        os.remove(self.path("in.0002.exr"))
        self.assertNotIn("missing", str(self.defocus().lines), "every second frame exists")

    def test_frames_of_another_size_are_named(self):
        write_exr(self.path("in.0003.exr"), picture(20, 14, lambda x, y: 0.5, lambda x, y: 2))
        self.assertIn("frame 3 has 20 x 14 pixels, unlike frame 2 with 40 x 28 pixels", str(self.defocus().lines))
        os.remove(self.path("in.0003.exr"))
        self.assertNotIn("unlike", str(self.defocus().lines))

    def test_one_failing_frame_does_not_stop_the_rest(self):
        with open(self.path("in.0002.exr"), "wb") as file:
            file.write(b"junk")
        outcome = self.run_program("defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--report", "r.jsonl")
        self.assertEqual(outcome.code, 4, outcome)
        self.assertIn("1 of 4 frames failed: 2", outcome.lines[-1])
        self.assertEqual(self.outputs(), ["out.%04d.exr" % n for n in (1, 3, 5)])
        with open(self.path("r.jsonl")) as file:
            records = [json.loads(line) for line in file]
        self.assertEqual([r["frame"] for r in records], [1, 2, 3, 5])
        self.assertIn("error", records[1])
        self.assertEqual(records[3]["engine"], "scatter")

    def test_what_is_whole_is_left_and_what_is_cut_off_made_again(self):
        self.defocus()
        before = {name: self.content(name) for name in self.outputs()}
        with open(self.path("out.0003.exr"), "wb") as file:
            file.write(before["out.0003.exr"][:700])
        os.remove(self.path("out.0001.exr"))
        times = {name: os.stat(self.path(name)).st_mtime_ns for name in ("out.0002.exr", "out.0005.exr")}
        outcome = self.defocus("--no-clobber")
        self.assertIn("cut off", outcome.err)
        self.assertEqual({name: self.content(name) for name in self.outputs()}, before)
        self.assertEqual({name: os.stat(self.path(name)).st_mtime_ns for name in times}, times)

    def test_a_signal_leaves_whole_frames_alone(self):
        for frame in range(6, 40):
            self.make(frame)
        run = subprocess.Popen([PETZVAL, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--engine", "reference",
                                "--pupil-points", "2048"], cwd=self.folder, stderr=subprocess.PIPE)
        while not self.outputs():
            time.sleep(0.01)
        run.send_signal(signal.SIGTERM)
        run.communicate(timeout=20)
        self.assertEqual(run.returncode, 143)
        made = self.outputs()
        self.assertLess(len(made), 38)
        for name in made:
            self.assertFalse("unfinished" in name, made)
            read_exr(self.path(name))

    def no_leftovers(self):
        self.assertFalse([name for name in os.listdir(self.folder) if "unfinished" in name])

    def test_frames_of_another_size_or_without_depth_do_not_stop_the_rest(self):
        write_exr(self.path("in.0002.exr"), picture(30, 50, lambda x, y: 0.3, lambda x, y: 3.0))
        without = picture(40, 28, lambda x, y: 0.3, lambda x, y: 3.0)
        del without["Z"]
        write_exr(self.path("in.0003.exr"), without)
        outcome = self.run_program("defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA)
        self.assertEqual(outcome.code, 4, outcome)
        self.assertIn("1 of 4 frames failed: 3", outcome.lines[-1])
        self.assertIn("frame 3: ", outcome.err)
        channels, _ = read_exr(self.path("out.0002.exr"))
        self.assertEqual((len(channels["R"][0]), len(channels["R"])), (30, 50))
        self.no_leftovers()

    def test_a_track_with_a_hole_is_bridged_and_one_that_is_damaged_refused(self):
        with open(self.path("t.json"), "w") as file:
            json.dump({"frames": [{"frame": 1, "focus": 1}, {"frame": 2}, {"frame": 5, "focus": 4}]}, file)
        self.defocus("--track", "t.json")
        self.assertEqual(len(self.outputs()), 4)
        for text in ("frame,focus\n1,2\n1,3\n", "frame,focus\n1,near\n", "frame\n", ""):
            with open(self.path("t.csv"), "w") as file:
                file.write(text)
            self.refuse(3, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--track", "t.csv", says=["t.csv"])

    def test_a_track_with_keys_far_apart_lists_only_the_frames_that_are_asked_for(self):
        limits = address_space(1024)
        far_apart = [[2147483647], [-2147483648, 2147483647], [1, 2000000000]]
        for keys in far_apart:
            with open(self.path("t.json"), "w") as file:
                json.dump({"frames": [{"frame": frame, "focus": 2} for frame in keys]}, file)
            self.succeed("defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--track", "t.json",
                         "--frames", "1-3", limits=limits)
        self.refuse(2, "defocus", "in.0001.exr", "-o", "far.####.exr", *CAMERA, "--track", "t.json",
                    says=["t.json", "more than a million frames"], limits=limits)
        self.succeed("defocus", "in.0001.exr", "-o", "far.####.exr", *CAMERA, "--track", "t.json",
                     "--frames", "2000000000", limits=limits)

    def test_a_frame_that_cannot_be_written_fails_alone(self):
        write_exr(self.path("in.0003.exr"), picture(200, 150, lambda x, y: (x * 31 + y * 17) % 101 / 50, lambda x, y: 2.0))
        limits = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (40000, 40000))  # noqa: E731
        outcome = self.run_program("defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, limits=limits)
        self.assertEqual(outcome.code, 6, outcome)
        self.assertIn("frames failed: 3", outcome.lines[-1])
        self.assertEqual(self.outputs(), ["out.%04d.exr" % n for n in (1, 2, 5)])
        self.no_leftovers()

    def test_a_full_disk_leaves_whole_frames(self):
        disk = self.path("disk")
        os.mkdir(disk)
        mount = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk]
        if os.geteuid() != 0 or not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode:
            self.skipTest("a small disk of its own needs root and mount")
        self.addCleanup(subprocess.run, ["umount", disk])
        for frame in range(6, 40):
            self.make(frame)
        outcome = self.run_program("defocus", "in.####.exr", "-o", "disk/out.####.exr", *CAMERA)
        self.assertEqual(outcome.code, 6, outcome)
        self.assertIn("No space left", outcome.err)
        made = sorted(os.listdir(disk))
        self.assertTrue(0 < len(made) < 38, made)
        for name in made:
            self.assertTrue(name.startswith("out."), made)
            read_exr(os.path.join(disk, name))

    def test_two_runs_on_one_folder_make_one_shot(self):
        for frame in range(6, 20):
            self.make(frame)
        self.defocus("--lens", "doublet")
        truth = {name: self.content(name) for name in self.outputs()}
        for name in truth:
            os.remove(self.path(name))
        line = [PETZVAL, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--lens", "doublet", "--no-clobber", "-q",
                "--kernel-cache", "off"]
        runs = [subprocess.Popen(line, cwd=self.folder, stderr=subprocess.PIPE) for _ in range(2)]
        said = [run.communicate(timeout=60)[1].decode() for run in runs]
        self.assertEqual([run.returncode for run in runs], [0, 0], said)
        self.assertEqual({name: self.content(name) for name in self.outputs()}, truth)
        self.no_leftovers()

    def test_records_replace_neither_what_frames_read_nor_what_they_write(self):
        before = self.content("in.0003.exr")
        for name in ("in.0003.exr", "./in.0001.exr", "out.0002.exr"):
            self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--frames", "1-3", "--report", name,
                        says=["would replace"])
        self.assertEqual(self.content("in.0003.exr"), before)

    def test_wrong_words_are_refused(self):
        for flags, said in ((["--frames", "1-4:2"], "1-4x2"), (["--frames", "a"], "frame number"),
                            (["--json", "r.json"], "--report"), (["--focus-speed", "1"], "--track"),
                            (["--missing", "black", "--view", "coc"], "beauty")):
            self.refuse(2, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, *flags, says=[said])
        self.refuse(2, "defocus", "in.####.exr", "-o", "out.exr", *CAMERA, says=["####"])
        self.refuse(2, "defocus", "in.0001.exr", "-o", "out.####.exr", *CAMERA, says=["--frames, --track or --rack"])
        self.refuse(2, "defocus", "in.0001.exr", "-o", "out.exr", *CAMERA, "--frames", "1", says=["--frames", "neither"])
        self.refuse(3, "defocus", "no.####.exr", "-o", "out.####.exr", *CAMERA, says=["no frame exists"])
        self.refuse(3, "defocus", "in.####.exr", "-o", "out.####.exr", *CAMERA, "--track", "none.csv", says=["none.csv"])

    def test_inspect_tells_what_changes(self):
        write_exr(self.path("in.0004.exr"), picture(40, 28, lambda x, y: 0.5, lambda x, y: 1.0 + x / 10))
        outcome = self.succeed("inspect", "in.####.exr", "--frames", "3-5")
        same, changed = outcome.out.split("what changes")
        self.assertIn("display window: 40 x 28", same)
        self.assertNotIn("display window", changed)
        rows = [line.split() for line in changed.strip().splitlines()]
        self.assertEqual([row[0] for row in rows], ["frame", "3", "4", "5"])
        heads = changed.strip().splitlines()[0]
        self.assertIn("farthest m", heads)
        self.assertIn("4.9", rows[2])
        self.succeed("inspect", "in.####.exr", "--report", "r.jsonl")
        with open(self.path("r.jsonl")) as file:
            self.assertEqual([json.loads(line)["verb"] for line in file], ["inspect"] * 5)

    def test_compare_and_develop_take_frames(self):
        self.defocus()
        outcome = self.succeed("compare", "in.####.exr", "out.####.exr", "--frames", "1-3")
        lines = outcome.out.splitlines()
        self.assertEqual([line.split()[0] for line in lines[:6]], ["frame", "1", "2", "3", "mean", "worst"])
        self.assertTrue(all(line.startswith("worst place") for line in lines[6:]), lines)
        one = self.succeed("compare", "in.0002.exr", "out.0002.exr", "--json", "-").out
        self.assertAlmostEqual(json.loads(one)["psnr_lin"], float(lines[2].split()[1]), delta=0.006)
        # Every frame with one truth, and one missing truth.
        self.succeed("compare", "in.0001.exr", "out.####.exr")
        self.refuse(3, "compare", "in.####.exr", "out.####.exr", "--frames", "1-4", says=["1 of 4 frames"])
        self.succeed("develop", "out.####.exr", "-o", "out.####.png")
        self.succeed("develop", "out.0003.exr", "-o", "one.png")
        self.assertEqual(self.content("one.png"), self.content("out.0003.png"))
        os.truncate(self.path("out.0003.png"), 300)
        self.assertIn("cut off", self.succeed("develop", "out.####.exr", "-o", "out.####.png", "--no-clobber").err)
        self.assertEqual(self.content("one.png"), self.content("out.0003.png"))
        self.refuse(2, "develop", "out.####.exr", "-o", "one.png", says=["####"])
        self.refuse(2, "develop", "out.0001.exr", "-o", "one.####.png", says=["must be the frames of a shot"])
        self.refuse(2, "inspect", "in.0001.exr", "--frames", "1-3", says=["--frames"])
        self.refuse(2, "compare", "in.####.exr", "out.####.exr", "--missing", "black", says=["--missing"])

    def test_focus_track_follows_pixels_and_defocus_takes_it(self):
        self.succeed("focus-track", "in.####.exr", "-o", "t.csv", "--at", "1:3,14", "5:30,14", "--smooth", "0", "--plot", "t.svg")
        with open(self.path("t.csv")) as file:  # 1.2 m on the left of column 15, 5 m beyond
            self.assertEqual(file.read().split(), ["frame,focus", "1,1.20000005", "2,1.20000005", "3,5", "5,5"])
        self.assertIn(b"</svg>", self.content("t.svg"))
        outside = self.run_program("focus-track", "in.####.exr", "-o", "t2.csv", "--at", "300,-1")
        self.assertIn("pixel 300,-1 is outside the picture", outside.err)
        self.assertNotIn("--focus-at", outside.err)
        self.succeed("focus-track", "in.####.exr", "-o", "s.csv", "--at", "1:3,14", "5:30,14", "--frames", "1-3", "--smooth", "2")
        with open(self.path("s.csv")) as file:
            distances = [float(line.split(",")[1]) for line in file.read().split()[1:]]
        self.assertTrue(1.2 < distances[0] < distances[1] < distances[2] < 5, distances)
        self.defocus("--track", "t.csv", "--frames", "3")
        for flags, said in ((["--at", "1:3"], "--at 1:3"), (["--at", "1:3,4", "1:3,5"], "twice"), ([], "--at"),
                            (["--at", "1-3:3,4"], "FRAME:X,Y")):
            self.refuse(2, "focus-track", "in.####.exr", "-o", "u.csv", *flags, says=[said])
        self.refuse(2, "focus-track", "in.0001.exr", "-o", "u.csv", "--at", "3,4", says=["must be the frames of a shot"])
        outcome = self.run_program("focus-track", "in.####.exr", "-o", "u.csv", "--at", "300,4")
        self.assertEqual(outcome.code, 3, outcome)
        self.assertFalse(os.path.exists(self.path("u.csv")))

    def test_a_sheet_shows_all_frames(self):
        write_exr(self.path("in.0003.exr"), picture(28, 40, lambda x, y: 0.2, lambda x, y: 1.0))  # of another shape
        self.succeed("sheet", "in.####.exr", "-o", "s.png", "--width", "80", "--columns", "3", "--tone", "none", "--no-labels")
        rows, _, _ = read_png(self.path("s.png"))
        self.assertEqual((len(rows[0]), len(rows)), (3 * (3 * 80 + 2 * 2), 2 * 56 + 2))
        third = rows[28][3 * 164:3 * 244]
        self.assertEqual(third[:15] + third[-15:], [0] * 30, "it keeps its shape, with black beside")
        self.assertGreater(min(third[3 * 35:3 * 45]), 80)
        self.succeed("sheet", "in.####.exr", "-o", "l.png", "--frames", "1-4", "--missing", "black")
        self.refuse(2, "sheet", "in.####.exr", "-o", "s.exr", says=[".png"])
        self.refuse(2, "sheet", "in.####.exr", "-o", "s.mp4", "--columns", "2", says=["--columns"])
        no_path = {"PATH": "/nowhere"}
        self.refuse(1, "sheet", "in.####.exr", "-o", "s.mp4", env=no_path, says=["ffmpeg"])

    def test_a_video_holds_all_frames(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is not installed")
        self.succeed("sheet", "in.####.exr", "-o", "s.mp4")
        with open(self.path("s.mp4"), "rb") as file:
            self.assertEqual(file.read(8)[4:], b"ftyp")
        self.assertFalse([name for name in os.listdir(self.folder) if "unfinished" in name])


if __name__ == "__main__":
    unittest.main()
