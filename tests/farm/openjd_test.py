"""A shot through openjd-cli, the reference of Open Job Description. PETZVAL and OPENJD name the programs."""
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))

from pictures import plane, write_exr  # noqa: E402
from program import CAMERA, CommandLineTest  # noqa: E402

OPENJD = os.environ.get("OPENJD", "openjd")
CHUNKING = ["--extensions", "TASK_CHUNKING"]


class OpenJobDescription(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2, 3, 5, 7):
            write_exr(self.path("in.%04d.exr" % frame),
                      {"R": plane(24, 16, lambda x, y: (x * frame) % 5), "G": plane(24, 16, 1.0), "B": plane(24, 16, 0.5),
                       "A": plane(24, 16, 1.0), "Z": plane(24, 16, lambda x, y: 1 + y / 4)})

    def openjd(self, verb, *options):
        return subprocess.run([OPENJD, verb, self.path("job/petzval.template.json"), *CHUNKING, *options], text=True,
                              capture_output=True, timeout=300, env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"})

    def run_shot(self, frames, chunks):
        shot = ["in.####.exr", "-o", "out.####.exr", *CAMERA, "--frames", frames]
        self.succeed("farm", "write", "--for", "openjd", "-o", "job", "--chunk", "2", "--",
                     *shot)
        checked = self.openjd("check")
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        done = self.openjd("run")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count("petzval-farm: done"), chunks, done.stdout)
        self.succeed("defocus", "in.####.exr", "-o", "ref.####.exr", *CAMERA, "--frames", frames)
        made = sorted(n for n in os.listdir(self.folder) if n.startswith("out."))
        self.assertEqual(len(made), sum(n.startswith("ref.") for n in os.listdir(self.folder)))
        for name in made:
            self.assertEqual(self.content(name), self.content(name.replace("out.", "ref.")), name)

    def test_chunks_of_a_range_make_the_pictures_of_one_run(self):
        self.run_shot("1-3", 2)

    def test_chunks_of_every_second_frame_make_the_pictures_of_one_run(self):
        self.run_shot("1-7x2", 2)

    def test_a_damaged_input_fails_the_job(self):
        with open(self.path("in.0002.exr"), "wb") as file:
            file.write(b"junk")
        self.succeed("farm", "write", "--for", "openjd", "-o", "job", "--chunk", "3", "--", "in.####.exr", "-o",
                     "out.####.exr", *CAMERA, "--frames", "1-3")
        done = self.openjd("run")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("petzval-farm: wrong input of some frames: never retry", done.stdout)
        self.assertTrue(os.path.exists(self.path("out.0003.exr")))


if __name__ == "__main__":
    unittest.main()
