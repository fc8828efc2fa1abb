"""One frame through each door of petzval has the bits of the command line's.

Needs PETZVAL, PETZVAL_LIBRARY, PETZVAL_FILES_LIBRARY, SHOT_PROGRAM, and OFX_CHECK, PETZVAL_OFX, PETZVAL_GEGL for
those doors. Usage: doors_test.py [FOLDER]. With FOLDER the frame of each door stays there, to be looked at.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

import petzval

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/cli"))
import pictures  # noqa: E402

CAMERA = petzval.Camera(85, 36, 2, 1.7)
FLAGS = ["--focal-length", "85", "--sensor-width", "36", "--fstop", "2", "--focus", "1.7m"]
PARAMETERS = {"focalLength": 85, "sensorWidth": 36, "fStop": 2, "focusDistance": 1.7}
LENS = ROOT / "lenses/petzval-laikin.json"
WIDTH, HEIGHT = 240, 135
kept = None


def run(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=250,
                          env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"})
    assert done.returncode == 0, f"{words}: exit {done.returncode}\n{done.stdout}\n{done.stderr}"


def planes(path):
    """{channel: bytes of its floats} of the result's colour."""
    found, _ = pictures.read_exr(str(path))
    return {c: np.asarray(found[c], np.float32).tobytes() for c in "RGBA"}


class Doors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(kept or tempfile.mkdtemp(prefix="petzval-doors-"))
        if not kept:
            cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        run(os.environ["PETZVAL"], "scene", "make", "night", "-o", cls.path("scene"), "--width", WIDTH, "--height", HEIGHT,
            "--pinhole-samples", "8", "--overwrite")
        cls.write_floats()
        run(os.environ["PETZVAL"], "defocus", cls.sharp, "-o", cls.path("program"), *FLAGS, "--lens", LENS, "--overwrite")
        cls.expected = planes(cls.path("program"))

    @classmethod
    def path(cls, door):
        return cls.folder / f"{door}.exr"

    @classmethod
    def write_floats(cls):
        """The scene as floats: hosts hold no half floats, so they would be given other numbers."""
        shot = petzval.read_shot(cls.path("scene"))
        rgba, cls.sharp = np.asarray(shot.colour), cls.folder / "sharp.exr"
        channels = {c: rgba[..., i].tolist() for i, c in enumerate("RGBA")}
        pictures.write_exr(str(cls.sharp), {**channels, "Z": np.asarray(shot.depth_m).tolist()})

    def same(self, door):
        found = planes(self.path(door))
        for channel, data in self.expected.items():
            self.assertEqual(found[channel], data, f"{door}, channel {channel}")
        sharp = planes(self.sharp)
        self.assertNotEqual(found["R"], sharp["R"], "the frame is blurred")

    def needs(self, *variables):
        for variable in variables:
            if not os.environ.get(variable):
                self.skipTest(f"{variable} is not built")

    def test_c(self):
        run(os.environ["SHOT_PROGRAM"], self.sharp, LENS, "1.7", self.path("c"))
        self.same("c")

    def test_python_arrays(self):
        shot = petzval.read_shot(self.sharp)
        taken = petzval.defocus(np.array(shot.colour), depth_m=np.array(shot.depth_m), camera=CAMERA,
                                look=petzval.Look(lens=LENS))
        shot.write_like(self.path("python"), taken.image)
        self.same("python")

    def test_python_rows_from_the_bottom(self):
        shot = petzval.read_shot(self.sharp)
        colour, depth = (np.ascontiguousarray(np.asarray(a)[::-1])[::-1] for a in (shot.colour, shot.depth_m))
        shot.write_like(self.path("python-flipped"),
                        petzval.defocus(colour, depth_m=depth, camera=CAMERA, look=petzval.Look(lens=LENS)).image)
        self.same("python-flipped")

    def test_a_run_of_files_from_python(self):
        run_of = petzval.ShotRun({"input": str(self.sharp), "output": str(self.path("run")), "look": petzval.Look(lens=LENS),
                                  "camera": {"focal_length_mm": 85, "sensor_width_mm": 36, "f_number": 2, "focus_distance_m": 1.7}})
        self.assertEqual(run_of.run(), [])
        self.same("run")

    def ofx(self, door, *clips):
        self.needs("OFX_CHECK", "PETZVAL_OFX")
        words = [w for name, value in {**PARAMETERS, "lens": LENS}.items() for w in ("--param", f"{name}={value}")]
        run(os.environ["OFX_CHECK"], "render", pathlib.Path(os.environ["PETZVAL_OFX"]).parents[2], "-o", self.path(door), *words,
            *clips, "--clip", f"Source={self.sharp}")
        self.same(door)

    def test_openfx_with_a_clip_of_depth(self):
        self.ofx("openfx", "--clip", f"Depth={self.sharp}:Z")

    def test_openfx_with_a_file_of_depth(self):
        self.ofx("openfx-file", "--context", "filter", "--param", f"depthFile={self.sharp}")

    def gegl(self, door, *properties, aux=True, depth=None, stored=lambda metres: metres):
        """A frame of the GEGL operation, of depth as it is stored; what GLib warned of."""
        self.needs("PETZVAL_GEGL")
        shot = petzval.read_shot(self.sharp)
        pictures.write_exr(str(self.path("gegl-colour")), {c: shot.colour[..., i].tolist() for i, c in enumerate("RGBA")})
        pictures.write_exr(str(self.path("gegl-depth")), {"Y": stored(np.asarray(shot.depth_m)).tolist()})
        theirs = subprocess.run(["pkg-config", "--variable=pluginsdir", "gegl-0.4"], capture_output=True, text=True).stdout.strip()
        mine = pathlib.Path(os.environ["PETZVAL_GEGL"]).parent
        words = ["gegl", self.path("gegl-colour"), "-o", self.path(door), "--", "petzval:defocus", *properties]
        words += ["aux=[", "gegl:load", f"path={depth or self.path('gegl-depth')}", "]"] if aux else []
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=250,
                              env={**os.environ, "GEGL_PATH": f"{theirs}:{mine}"})
        self.assertEqual(done.returncode, 0, done.stderr)  # GEGL's own operations print of leaked buffers as well
        return done.stderr

    CAMERA = ("focal-length=85", "sensor-width=36", "f-number=2", "focus-distance=1.7", f"lens={LENS}")

    def test_gegl(self):
        self.gegl("gegl", *self.CAMERA)
        self.same("gegl")

    def test_gegl_with_negative_depth(self):
        self.gegl("gegl-negative", *self.CAMERA, stored=np.negative)
        self.same("gegl-negative")

    def test_gegl_joins_depth_of_few_codes(self):
        self.gegl("gegl-codes", *self.CAMERA, stored=lambda metres: np.round(np.minimum(metres, 25.5), 1))
        run(os.environ["PETZVAL"], "defocus", self.sharp, "--depth", self.path("gegl-depth"), "-o", self.path("program-codes"),
            *FLAGS, "--lens", LENS, "--overwrite")
        self.assertEqual(planes(self.path("gegl-codes")), planes(self.path("program-codes")))
        self.assertNotEqual(planes(self.path("gegl-codes")), self.expected)

    def test_gegl_through_a_preset(self):
        self.gegl("gegl-preset", *self.CAMERA[:-1], "preset=achromat")
        run(os.environ["PETZVAL"], "defocus", self.sharp, "-o", self.path("program-preset"), *FLAGS, "--preset", "achromat",
            "--overwrite")
        self.assertEqual(planes(self.path("gegl-preset")), planes(self.path("program-preset")))
        self.assertNotEqual(planes(self.path("gegl-preset")), self.expected)

    def test_gegl_warns_and_passes_the_picture_on(self):
        for properties, aux, says in ((self.CAMERA, False, "connect depth"), (("lens=no-such-lens",), True, "no-such-lens"),
                                      (("look=missing.look",), True, "look: Failed to open file"),
                                      ((f"look={self.path('gegl-depth')}",), True, "look: is not JSON"),
                                      (("preset=acromat",), True, "did you mean achromat"),
                                      (("preset=night", "look=own.look"), True, "both given")):
            self.assertIn(says, self.gegl("gegl-refused", *properties, aux=aux))
            self.assertEqual(planes(self.path("gegl-refused")), planes(self.path("gegl-colour")))
        self.assertIn("does not cover the picture", self.gegl("gegl-refused", depth=self.path("missing")))
        self.assertEqual(planes(self.path("gegl-refused")), planes(self.path("gegl-colour")))


if __name__ == "__main__":
    kept = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
    unittest.main(verbosity=2)
