"""One lens, five places, one picture: the night scene by the command line, on a GPU, in Python, in OpenFX and in the browser.

The lens file and its controls are one link of the lens lab, which every place takes as it is. Usage: pages.py says it.
"""
import base64
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy
from pages import PETZVAL, ROOT, Page
from pictures import camera_attributes, exr_bytes, read_exr

BUILD = pathlib.Path(PETZVAL).resolve().parents[2]
os.environ.setdefault("PETZVAL_LIBRARY", str(BUILD / "lib/libpetzval.so"))
sys.path.insert(0, str(ROOT / "python"))
import petzval  # noqa: E402

FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M = 50, 36, 2, 4.8
WIDTH, HEIGHT = 320, 180


def link_of(lens_file, look):
    """A link whose lens has a name that no place knows: only its text can say what it is."""
    state = {"lens": {"name": "mine", "text": lens_file.read_text(), "look": look}}
    return "lens=1." + base64.urlsafe_b64encode(json.dumps(state).encode()).decode().rstrip("=")


def planes(channels, names):
    return numpy.dstack([numpy.array(channels[c], "f4") for c in names])


class Places(Page):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.run_here(PETZVAL, "scene", "make", "night", "-o", "scene.exr", "--width", WIDTH, "--height", HEIGHT, "--pinhole-samples", 8)
        channels, _ = read_exr(self.folder / "scene.exr")
        self.sharp = {**{c: channels[c] for c in "RGBZ"}, "A": numpy.ones((HEIGHT, WIDTH)).tolist()}
        self.bytes = exr_bytes(self.sharp, attributes=camera_attributes(FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M))
        (self.folder / "night.exr").write_bytes(self.bytes)
        self.link = link_of(ROOT / "lenses/biotar.json", {"blades": 6, "cats_eye": 0.6})

    def run_here(self, *words):
        done = subprocess.run([str(word) for word in words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def picture(self, name):
        return planes(read_exr(self.folder / name)[0], "RGB")

    def by_program(self, *flags):
        self.run_here(PETZVAL, "defocus", "night.exr", "-o", "program.exr", "--look", self.link, "--quiet", "--overwrite", *flags)
        return self.picture("program.exr")

    def by_python(self):
        colour = planes(self.sharp, "RGBA")
        camera = petzval.Camera(FOCAL_MM, SENSOR_MM, F_NUMBER, FOCUS_M)
        frame = petzval.defocus(colour, depth_m=numpy.array(self.sharp["Z"], "f4"), camera=camera, look=petzval.Look.from_json(self.link))
        return frame.image[..., :3]

    def by_openfx(self):
        numbers = {"focalLength": FOCAL_MM, "sensorWidth": SENSOR_MM, "fStop": F_NUMBER, "focusDistance": FOCUS_M, "look": self.link}
        self.run_here(BUILD / "apps/ofx-check/ofx-check", "render", BUILD / "ofx/petzval.ofx.bundle", "-o", "host.exr",
                      *(word for name, value in numbers.items() for word in ("--param", f"{name}={value}")),
                      "--clip", "Source=night.exr", "--clip", "Depth=night.exr:Z")
        return self.picture("host.exr")

    def by_browser(self):
        self.open("#" + self.link)
        self.assertIsNone(self.done("lab.showPicture()"))
        self.done("lab.picture.openFiles([new File([Uint8Array.from(atob(args[0]), (c) => c.charCodeAt(0))], 'night.exr')])", base64.b64encode(self.bytes).decode())
        self.done("lab.picture.develop()")
        self.assertIn("Developed", self.text("picture-told"))
        return numpy.frombuffer(self.floats("lab.picture.developed"), "<f4").reshape(HEIGHT, WIDTH, 4)[..., :3]

    def test_one_lens_makes_one_picture_in_five_places(self):
        expected = self.by_program()
        sharp = planes(self.sharp, "RGB")
        self.assertGreater(float(numpy.abs(expected - sharp).mean()), 0.01, "the lens blurs the scene")
        for place, make in (("GPU", lambda: self.by_program("--device", "gpu")), ("Python", self.by_python), ("OpenFX", self.by_openfx), ("browser", self.by_browser)):
            with self.subTest(place):
                made = make()
                error = float(numpy.mean((numpy.clip(made, 0, 1) - numpy.clip(expected, 0, 1)) ** 2, dtype="f8"))
                apart, energy = -10 * numpy.log10(max(1e-20, error)), float(made.sum(dtype="f8") / expected.sum(dtype="f8"))
                print(f"{place}: {apart:.1f} dB, energy {energy:.7f} of the command line's", flush=True)
                self.assertGreater(apart, 45)
                self.assertAlmostEqual(energy, 1, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
