"""Files from Python: the bits of the command line for one shot with layers and a lens file; scenes with their truth."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)
if "PETZVAL_FILES_LIBRARY" not in os.environ:
    print("skipped: libpetzval-files.so is not built")
    sys.exit(77)

import petzval

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
import pictures  # noqa: E402

LENS_FILE = ROOT / "lenses/petzval-laikin.json"
program = c_program = c_buffer = ""


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *words):
        subprocess.run([program, *map(str, words)], check=True, capture_output=True)

    def layered(self, frame):
        """A frame of a shot in motion: colour that is the sum of two lights, depth, a matte."""
        def is_near(x, y):
            return 20 + frame <= x < 44 and 14 <= y < 36

        def light(x, y):
            return 40.0 if (x, y) == (60, 10) else 0.2 + (x * 37 + y * 91) % 17 / 20

        def key(x, y):
            return light(x, y) * (0.8 if is_near(x, y) else 0.3)
        width, height = 72, 48
        channels = pictures.picture(width, height, light, lambda x, y: 1 if is_near(x, y) else 4, 1)
        for name, value in (("key", key), ("fill", lambda x, y: light(x, y) - key(x, y))):
            for c in "RGB":
                channels[f"{name}.{c}"] = pictures.plane(width, height, value)
        channels["matte"] = pictures.plane(width, height, lambda x, y: float(is_near(x, y)))
        return pictures.write_exr(str(self.folder / f"in.{frame:04}.exr"), channels)

    def test_an_atlas_is_that_of_the_command_line(self):
        for words, zones in ((("--cats-eye", 0.5), 2), ((), 5)):
            lens = petzval.Lens("doublet").used(cats_eye=0.5) if words else petzval.Lens("doublet")
            self.run_program("lens", "atlas", "doublet", *words, "--zones", zones, "--defocus", 20, "--width", 960, "-o",
                             self.folder / "atlas", "--overwrite")
            header, texels = lens.atlas(20, zones, size=(960, 540))
            self.assertEqual(header + "\n", (self.folder / "atlas/atlas.json").read_text())
            self.assertEqual(texels, (self.folder / "atlas/atlas.bin").read_bytes())

    def test_a_lens_buffer_is_that_of_the_command_line(self):
        for cats_eye, quality, places in ((0, "standard", 1), (0.5, "draft", 45)):
            self.run_program("lens", "buffer", "doublet", *(("--cats-eye", cats_eye) if cats_eye else ()), "--quality",
                             quality, "--width", 960, "-o", self.folder / "program.bin", "--overwrite")
            expected = (self.folder / "program.bin").read_bytes()
            taps, _, columns, rows = np.frombuffer(expected, "<f4")[:4]
            self.assertEqual((taps, columns * rows), (48 if quality == "standard" else 24, places))
            lens = petzval.Lens("doublet").used(cats_eye=cats_eye)
            self.assertEqual(lens.buffer(quality, size=(960, 540)), expected)
            subprocess.run([c_buffer, "doublet", str(cats_eye), quality, self.folder / "c.bin"], check=True)
            self.assertEqual((self.folder / "c.bin").read_bytes(), expected)
            petzval.Lens.check_buffer(expected)
        with self.assertRaisesRegex(petzval.InvalidArgument, "draft, standard, final"):
            lens.buffer("best")
        older = expected[:16] + bytes(4) + expected[20:]
        for wrong, reason in ((older, "no mark PZL2"), (expected[:-16], "bytes instead of"), (b"GIF89a", "no mark PZL2")):
            with self.assertRaisesRegex(petzval.InvalidFile, reason):
                petzval.Lens.check_buffer(wrong)

    def test_c_python_and_the_command_line_give_the_same_bits(self):
        """One shot with layers, a lens file and a track of focus distances."""
        focus_m = {1: 1.0, 2: 1.6, 3: 3.2}
        sharp = {frame: self.layered(frame) for frame in focus_m}
        (self.folder / "track.csv").write_text("frame,focus\n" + "".join(f"{f},{m}\n" for f, m in focus_m.items()))
        self.run_program("defocus", self.folder / "in.####.exr", "-o", self.folder / "program.####.exr", "--track",
                         self.folder / "track.csv", "--layers", "all", "--lens", LENS_FILE, "--focal-length", 85,
                         "--sensor-width", 36, "--fstop", 2)
        look = petzval.Look(lens=LENS_FILE)
        with petzval.Session() as session:
            for frame, distance_m in focus_m.items():
                shot = petzval.read_shot(sharp[frame], layers=["all"], camera=petzval.Camera(85, 36, 2, distance_m))
                self.assertEqual(len(shot.layers), 3)
                taken = session.defocus(shot, look)
                shot.write_like(self.folder / f"python.{frame:04}.exr", taken.image, taken.layers)
        for frame, distance_m in focus_m.items():
            subprocess.run([c_program, sharp[frame], LENS_FILE, str(distance_m), self.folder / f"c.{frame:04}.exr"],
                           check=True)
            expected, _ = pictures.read_exr(str(self.folder / f"program.{frame:04}.exr"))
            for host in ("python", "c"):
                found, _ = pictures.read_exr(str(self.folder / f"{host}.{frame:04}.exr"))
                self.assertEqual(set(found), set(expected), host)
                for channel in expected:
                    self.assertEqual(found[channel], expected[channel], (host, frame, channel))

    def test_a_scene_its_truth_and_what_it_hides(self):
        scene = petzval.make_scene("bars", 96, 54, truth_samples=64)
        with petzval.Session() as session:
            image = session.defocus(scene, petzval.Look(quality="final")).image
            bare = petzval.Shot(scene.colour, depth_m=scene.depth_m, camera=scene.camera)
            without = session.defocus(bare, petzval.Look(quality="final")).image
        found = petzval.compare(scene.truth, image)
        self.assertGreater(found["psnr_lin"], 25)
        self.assertGreater(found["psnr_lin"], petzval.compare(scene.truth, scene.colour)["psnr_lin"])
        self.assertFalse(np.array_equal(image, without), "hidden layers count")

    def test_a_scene_written_and_read_again(self):
        scene = petzval.make_scene("bars", 32, 18)
        scene.write_like(self.folder / "scene.exr", scene.colour)
        again = petzval.read_shot(self.folder / "scene.exr")
        np.testing.assert_array_equal(again.depth_m, scene.depth_m)
        np.testing.assert_allclose(again.colour, scene.colour, rtol=1e-3)  # half
        self.assertAlmostEqual(again.camera.f_number, scene.camera.f_number, 5)

    def test_a_focus_pull_by_changing_the_camera(self):
        scene = petzval.make_scene("bars", 96, 54)
        with petzval.Session() as session:
            images = []
            for distance_m in (1, 4):
                scene.camera = petzval.Camera(50, 36, 1.4, distance_m)
                images.append(session.defocus(scene).image)
        self.assertFalse(np.array_equal(*images))

    def test_arrays_outlive_the_shot_they_came_from(self):
        colour = petzval.make_scene("bars", 32, 18).colour
        self.assertTrue(np.isfinite(colour).all())

    def test_a_file_is_inspected_by_its_headers(self):
        found = petzval.inspect(self.layered(1))
        self.assertEqual(found["display_window"], [0, 0, 72, 48])
        self.assertIn("matte float", found["parts"][0]["channels"])
        with self.assertRaisesRegex(petzval.InvalidFile, "missing.exr"):
            petzval.inspect(self.folder / "missing.exr")

    def test_depth_of_a_file_may_have_a_range(self):
        pictures.write_exr(str(self.folder / "shares.exr"), pictures.picture(8, 6, 0.5, lambda x, y: x / 10))
        shot = petzval.read_shot(self.folder / "shares.exr", depth_kind="normalized", depth_range=(1, 11))
        np.testing.assert_allclose(shot.depth_m[2], 1 + np.arange(8), rtol=1e-6)

    def test_errors(self):
        with self.assertRaisesRegex(petzval.InvalidFile, "missing.exr"):
            petzval.read_shot(self.folder / "missing.exr")
        with self.assertRaisesRegex(petzval.InvalidArgument, "bars"):
            petzval.make_scene("no such scene", 32, 18)
        with self.assertRaises(petzval.InvalidArgument):
            petzval.read_shot(self.folder / "x.exr", depth_kind="nonsense")
        with self.assertRaisesRegex(petzval.InvalidArgument, "two are needed"):
            petzval.read_shot(self.folder / "x.exr", depth_kind="normalized", depth_range=(1,))
        scene = petzval.make_scene("bars", 32, 18)
        with self.assertRaises(petzval.InvalidArgument):
            scene.write_like(self.folder / "out.exr", np.zeros((4, 4, 4), np.float32))
        with self.assertRaisesRegex(petzval.InvalidArgument, "out.jpg: the name must end in .exr"):
            scene.write_like(self.folder / "out.jpg", scene.colour)
        self.assertFalse((self.folder / "out.jpg").exists())
        for given, says in (({"path": 3}, "^path is int; a file name is needed"), ({"path": "x.exr", "depth_unit_m": 0}, "depth_unit_m is 0"),
                            ({"path": "x.exr", "camera": (50, 36)}, "^camera is tuple")):
            with self.assertRaisesRegex(petzval.InvalidArgument, says):
                petzval.read_shot(**given)
        with self.assertRaises(petzval.OutputFailed):
            scene.write_like(self.folder / "no/such/folder/out.exr", scene.colour)


if __name__ == "__main__":
    program, c_program, c_buffer = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1)
    unittest.main(verbosity=2)
