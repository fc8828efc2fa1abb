"""Runs of many frames from Python: a hundred frames, killed and resumed; the bits of the command line; Ctrl-C."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

if "PETZVAL_FILES_LIBRARY" not in os.environ:
    print("skipped: libpetzval-files.so is not built")
    sys.exit(77)

import petzval

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
import pictures  # noqa: E402

COUNT, WIDTH, HEIGHT = 100, 40, 24
program = ""

RUN = """
import json, sys
import petzval
run = petzval.ShotRun(json.loads(sys.argv[1]), threads=1)
print(len(run.frames), flush=True)
print("failed", run.run(lambda done: print(done["frame"], done["state"], flush=True)))
"""


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def shot(self, count, width=WIDTH, height=HEIGHT):
        """Frames with a lamp that moves, and the settings of a run."""
        for frame in range(1, count + 1):
            channels = pictures.picture(width, height, lambda x, y: 30.0 if (x, y) == (frame % width, 10) else 0.2,
                                        lambda x, y: 1 if x < 20 else 5, 1)
            pictures.write_exr(str(self.folder / f"in.{frame:04}.exr"), channels)
        return {"input": str(self.folder / "in.####.exr"), "output": str(self.folder / "out.####.exr"),
                "camera": {"focal_length_mm": 50, "sensor_width_mm": 36, "f_number": 2, "focus_distance_m": 1},
                "existing": "keep"}

    def outputs(self):
        return {path.name: (path.stat().st_mtime_ns, path.read_bytes()) for path in self.folder.glob("out.*.exr")}

    def started(self, settings):
        import json
        return subprocess.Popen([sys.executable, "-c", RUN, json.dumps(settings)], stdout=subprocess.PIPE, text=True)

    def test_a_hundred_frames_killed_and_resumed(self):
        settings = self.shot(COUNT)
        with self.started(settings) as process:
            self.assertEqual(process.stdout.readline().strip(), str(COUNT))
            for _ in range(30):
                self.assertIn("made", process.stdout.readline())
            process.kill()
        before = self.outputs()
        self.assertTrue(30 <= len(before) < COUNT, len(before))
        done = {}
        failed = petzval.ShotRun(settings, threads=1).run(lambda told: done.__setitem__(told["frame"], told["state"]))
        after = self.outputs()
        self.assertEqual((failed, len(after), len(done)), ([], COUNT, COUNT))
        for name, (written, content) in before.items():
            self.assertEqual(after[name], (written, content), f"{name} was made again")
        self.assertEqual(sum(state == "kept" for state in done.values()), len(before))
        whole = self.shot(3) | {"output": str(self.folder / "whole.####.exr"), "frames": "2-3"}
        petzval.ShotRun(whole, threads=1).run()
        self.assertEqual(pictures.read_exr(str(self.folder / "whole.0002.exr"))[0],
                         pictures.read_exr(str(self.folder / "out.0002.exr"))[0])

    def test_the_bits_of_the_command_line(self):
        settings = self.shot(3) | {"look": petzval.Look(engine="gather")}
        self.assertEqual(petzval.ShotRun(settings).run(), [])
        subprocess.run([program, "defocus", self.folder / "in.####.exr", "-o", self.folder / "cli.####.exr", "--engine",
                        "gather", "--focal-length", "50", "--sensor-width", "36", "--fstop", "2", "--focus", "1"],
                       check=True, capture_output=True)
        for frame in (1, 2, 3):
            self.assertEqual(pictures.read_exr(str(self.folder / f"out.{frame:04}.exr"))[0],
                             pictures.read_exr(str(self.folder / f"cli.{frame:04}.exr"))[0])

    def test_a_callback_stops_the_run_and_its_exceptions_are_raised(self):
        settings = self.shot(5)

        def broken(_):
            raise KeyError("mine")
        with self.assertRaises(KeyError):
            petzval.ShotRun(settings, threads=1).run(broken)
        self.assertLess(len(self.outputs()), 5)

    def test_ctrl_c_ends_a_run_between_whole_files(self):
        settings = self.shot(60)
        with self.started(settings) as process:
            process.stdout.readline()
            process.stdout.readline()
            process.send_signal(signal.SIGINT)
            start = time.monotonic()
            process.stdout.read()
            self.assertNotEqual(process.wait(), 0)
            self.assertLess(time.monotonic() - start, 20)
        for name in self.outputs():
            pictures.read_exr(str(self.folder / name))

    def test_what_is_wrong_is_refused_before_the_work(self):
        with self.assertRaisesRegex(petzval.InvalidArgument, "inptu"):
            petzval.ShotRun({"inptu": "x"})
        missing = {"input": str(self.folder / "none.####.exr"), "output": str(self.folder / "o.####.exr")}
        with self.assertRaises(petzval.Error):
            petzval.ShotRun(missing).run()
        settings = self.shot(3)
        (self.folder / "in.0002.exr").write_bytes(b"damaged")
        self.assertEqual(petzval.ShotRun(settings, threads=1).run(), [2])


if __name__ == "__main__":
    program = sys.argv.pop(1)
    unittest.main(verbosity=2)
