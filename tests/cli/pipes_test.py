"""Pictures through pipes: in by -, out by -.exr and -.png, and nothing else on standard output."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from pictures import camera_attributes, picture, read_exr, read_png, write_exr
from program import PETZVAL, CommandLineTest


def nameless(exr):
    """An output without the digest of its inputs' names: standard input has another."""
    return re.sub(rb'"files":"[0-9a-f]{32}"', b"", exr)


class Pipes(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(24, 16, depth=lambda x, y: 1 + x / 10),
                  attributes=camera_attributes(50, 36, 1.4, 2))

    def piped(self, *args, given=b""):
        return subprocess.run([PETZVAL, *args], cwd=self.folder, input=given, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=60, env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"})

    def test_a_pipe_gives_and_takes_what_files_do(self):
        self.succeed("defocus", "in.exr", "-o", "out.exr")
        self.succeed("develop", "out.exr", "-o", "out.png")
        blurred = self.piped("defocus", "-", "-o", "-.exr", given=self.content("in.exr"))
        self.assertEqual(blurred.returncode, 0, blurred.stderr)
        self.assertEqual(nameless(blurred.stdout), nameless(self.content("out.exr")))
        shown = self.piped("develop", "-", "-o", "-.png", given=blurred.stdout)
        with open(self.path("piped.png"), "wb") as file:
            file.write(shown.stdout)
        self.assertEqual(read_png(self.path("piped.png")), read_png(self.path("out.png")), shown.stderr)
        os.remove(self.path("piped.png"))
        self.assertIn(b"display window", self.piped("inspect", "-", given=self.content("in.exr")).stdout)
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.exr", "out.exr", "out.png"])

    def test_depth_may_come_through_a_pipe(self):
        self.succeed("defocus", "in.exr", "-o", "out.exr", "--depth", "in.exr")
        piped = self.piped("defocus", "in.exr", "--depth", "-", "-o", "-.exr", given=self.content("in.exr"))
        self.assertEqual(nameless(piped.stdout), nameless(self.content("out.exr")), piped.stderr)

    def test_what_cannot_be_piped_is_said(self):
        self.refuse(2, "defocus", "in.exr", "-o", "-", says=["-.exr or -.png"])
        both = self.run_program("defocus", "in.exr", "-o", "-.exr", "--json", "-")
        self.assertEqual((both.code, both.out[:1]), (2, "{"))  # the error, as was asked
        self.assertIn("two outputs", both.err)
        self.refuse(3, "inspect", "-", says=["standard input", "empty"])
        for given, says in ((b"text", b"is not a picture"), (self.content("in.exr")[:300], b"standard input")):
            bad = self.piped("defocus", "-", "-o", "-.exr", given=given)
            self.assertEqual((bad.returncode, bad.stdout), (3, b""))
            self.assertIn(says, bad.stderr)
        much = self.piped("defocus", "-", "-o", "-.exr", "--max-memory", "1K", given=self.content("in.exr"))
        self.assertEqual((much.returncode, much.stdout), (1, b""))
        self.assertIn(b"standard input holds more than", much.stderr)

    def test_a_full_or_closed_pipe_is_an_error(self):
        with open("/dev/full", "wb") as full:
            outcome = self.run_program("defocus", "in.exr", "-o", "-.exr", stdout=full)
        self.assertEqual(outcome.code, 1)
        self.assertIn("standard output", outcome.err)

    def test_scenes_and_scripts_are_no_pipes(self):
        for name in ("p.glb", "p.gltf", "p.bin", "p.txt"):
            os.mkfifo(self.path(name))
        for name in ("p.glb", "p.gltf"):
            self.refuse(3, "scene", "make", name, "-o", "o.exr", says=[name, "not a regular file"])
        with open(self.path("a.gltf"), "w") as file:
            json.dump({"asset": {"version": "2.0"}, "buffers": [{"uri": "p.bin", "byteLength": 4}]}, file)
        self.refuse(3, "scene", "make", "a.gltf", "-o", "o.exr", says=["a.gltf"])
        if self.run_program("view", "in.exr", "--script", "none.txt").code == 3:  # was built with a window
            self.refuse(3, "view", "in.exr", "--script", "p.txt", says=["p.txt", "not a regular file"])

    def test_waiting_for_a_pipe_ends_with_a_signal(self):
        process = subprocess.Popen([PETZVAL, "inspect", "-"], cwd=self.folder, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.5)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(20), 143)
        for pipe in (process.stdin, process.stdout, process.stderr):
            pipe.close()


class Mask(CommandLineTest):
    def setUp(self):
        super().setUp()
        channels = picture(24, 16, depth=lambda x, y: 1 + x / 10, colour=lambda x, y: (x * 7 + y * 3) % 11 / 11)
        matte = {"matte": [[1.0 if x >= 12 else 0.0 for x in range(24)] for _ in range(16)]}
        write_exr(self.path("in.exr"), channels, attributes=camera_attributes(50, 36, 1.4, 2))
        write_exr(self.path("m.exr"), matte)

    def rows(self, name, channel="R"):
        return read_exr(self.path(name))[0][channel]

    def test_keeps_what_it_does_not_cover_sharp(self):
        self.succeed("defocus", "in.exr", "-o", "blurred.exr")
        for mask in ("m.exr", "m.exr:matte"):
            self.succeed("defocus", "in.exr", "-o", "limited.exr", "--mask", mask)
            sharp, blurred, limited = self.rows("in.exr"), self.rows("blurred.exr"), self.rows("limited.exr")
            for y in range(16):
                self.assertEqual(list(limited[y][12:]), list(blurred[y][12:]))
                for x in range(12):
                    self.assertAlmostEqual(limited[y][x], sharp[y][x], delta=1e-3)

    def test_what_does_not_fit_is_refused(self):
        write_exr(self.path("small.exr"), picture(8, 8))
        self.refuse(3, "defocus", "in.exr", "-o", "o.exr", "--mask", "small.exr", says=["--mask", "display window"])
        self.refuse(3, "defocus", "in.exr", "-o", "o.exr", "--mask", "none.exr", says=["none.exr"])
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--mask", "m.exr:mate", says=["mate", "did you mean matte?"])
        self.refuse(2, "defocus", "in.exr", "-o", "o.exr", "--mask", "m.exr", "--view", "coc", says=["--mask", "coc"])


if __name__ == "__main__":
    unittest.main()
