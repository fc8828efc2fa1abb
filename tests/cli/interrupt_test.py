"""Ctrl-C and SIGTERM in the middle of a frame, and what is said while it is made."""
import json
import os
import pty
import select
import signal
import subprocess
import time
import unittest

from pictures import camera_attributes, exr_bytes, picture, write_exr
from program import PETZVAL, CommandLineTest

# A large picture with much to do in each part of it: the signal always comes in the middle, and is soon seen.
WIDTH, HEIGHT = 1500, 1000
LONG = ["defocus", "in.exr", "-o", "out.exr", "--engine", "reference", "--pupil-points", "1024"]
SHORT = ["defocus", "small.exr", "-o", "out.exr"]


class Interrupt(CommandLineTest):
    @classmethod
    def setUpClass(cls):
        grey, depth = [[0.5] * WIDTH] * HEIGHT, [[1 + x / 200 for x in range(WIDTH)]] * HEIGHT
        cls.large = exr_bytes({"R": grey, "G": grey, "B": grey, "Z": depth}, half="RGBZ",
                              attributes=camera_attributes(50, 36, 1.4, 2))

    def setUp(self):
        super().setUp()
        with open(self.path("in.exr"), "wb") as file:
            file.write(self.large)
        write_exr(self.path("small.exr"), picture(64, 48, depth=lambda x, y: 1 + x / 40),
                  attributes=camera_attributes(50, 36, 1.4, 2))

    def start(self, *args, stderr=subprocess.PIPE):
        process = subprocess.Popen([PETZVAL, *args], cwd=self.folder, stdout=subprocess.PIPE, stderr=stderr,
                                   preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def interrupted(self, number, command):
        process = self.start(*command, "--progress", "json")
        with process.stderr as errors:
            for line in errors:  # until the work is under way
                if line.startswith(b"{"):
                    break
            process.send_signal(number)
            rest = errors.read().decode().splitlines()
        return process.wait(20), [l for l in rest if not l.startswith("{")]

    def test_a_signal_mid_frame_leaves_nothing_behind(self):
        before = sorted(os.listdir(self.folder))
        for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            outcome = self.interrupted(number, LONG)
            self.assertEqual(outcome, (code, ["petzval: interrupted"]))
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_an_output_that_was_there_stays(self):
        with open(self.path("out.exr"), "w") as old:
            old.write("old")
        self.assertEqual(self.interrupted(signal.SIGINT, LONG)[0], 130)
        with open(self.path("out.exr")) as old:
            self.assertEqual(old.read(), "old")

    def test_a_scene_can_be_interrupted(self):
        before = sorted(os.listdir(self.folder))
        scene = ["scene", "make", "slant", "-o", "s.exr", "--truth", "t.exr", "--samples", "100000"]
        self.assertEqual(self.interrupted(signal.SIGTERM, scene)[0], 143)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_logs_get_one_plain_line_a_second_and_no_carriage_returns(self):
        process, times = self.start(*LONG), []
        with process.stderr as errors:
            while len(times) < 3:
                line = errors.readline().decode()
                if line.startswith("progress"):
                    self.assertRegex(line, r"^progress \d+%\n$")
                    times.append(time.monotonic())
                self.assertNotIn("\r", line)
        for earlier, later in zip(times, times[1:]):
            self.assertGreater(later - earlier, 0.9)

    def test_quiet_says_nothing(self):
        self.assertEqual(self.succeed(*SHORT, "-q").err, "")
        self.assertEqual(self.succeed("scene", "make", "slant", "-o", "s.exr", "--width", "20", "--height", "10",
                                      "-q").err, "")

    def test_json_progress_ends_at_one(self):
        lines = self.succeed(*SHORT, "-q", "--progress", "json").lines
        last = json.loads(lines[-1])
        self.assertEqual(last["progress"], 1)
        self.assertEqual(last["stage"], "defocus")

    def on_terminal(self, command, env, until):
        try:
            master, slave = pty.openpty()
        except OSError as error:  # a container without /dev/pts
            self.skipTest(f"no terminal to be had: {error}")
        process = subprocess.Popen([PETZVAL, *command], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=slave,
                                   env={**os.environ, **env})
        os.close(slave)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        text, end = b"", time.monotonic() + 60
        while until not in text and time.monotonic() < end:
            if select.select([master], [], [], 0.1)[0]:
                try:
                    piece = os.read(master, 4096)
                except OSError:  # the other side is gone
                    break
                text += piece
        os.close(master)
        return text.decode()

    def test_a_terminal_gets_a_bar(self):
        text = self.on_terminal(LONG, {}, b"% ")
        self.assertIn("\rdefocus [", text)
        self.assertNotIn("progress ", text)

    def test_colour_only_on_a_terminal_without_no_color(self):
        self.assertIn("\x1b[1;31m", self.on_terminal(["defcus"], {"NO_COLOR": ""}, b"\n"))
        self.assertNotIn("\x1b", self.on_terminal(["defcus"], {"NO_COLOR": "1"}, b"\n"))


if __name__ == "__main__":
    unittest.main()
