"""One allocation, write or read of a run fails, once: the run ends with its right result or with one line and an
exit code, never with a signal or half a file. PETZVAL_FAULTS names the library that makes calls fail."""
import json
import os
import pathlib
import random
import shutil
import struct
import unittest

from pictures import camera_attributes, picture, write_exr
from program import CommandLineTest

FAULTS = os.environ.get("PETZVAL_FAULTS", "")
EACH = int(os.environ.get("PETZVAL_FAULTS_EACH", "16"))  # runs of a command; 0: every call
RUNS = (["defocus", "in.0001.exr", "-o", "out.exr"],
        ["defocus", "in.####.exr", "-o", "out.####.png", "--frames", "1-2", "--engine", "gather"],
        ["scene", "make", "tori", "-o", "out.exr", "--width", "32", "--height", "18", "--pinhole-samples", "1"],
        ["scene", "make", "in.gltf", "-o", "out.exr", "--width", "32", "--height", "18", "--pinhole-samples", "1"],
        ["lens", "psf", "doublet", "-o", "out.exr"],
        *(["develop", name, "-o", "out.png"] for name in ("in.jpg", "in.png", "in.tif")))
CORPUS = pathlib.Path(__file__).resolve().parent.parent / "fuzz/corpus"
TRIANGLE = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"camera": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [{"byteLength": 36, "uri": "in.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, -3], "max": [1, 1, -3]}]}


@unittest.skipUnless(os.path.exists(FAULTS), "this build has an allocator of its own")
class SingleFault(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2):
            write_exr(self.path("in.%04d.exr" % frame), picture(48, 32, depth=lambda x, y: 1 + x / 40),
                      attributes=camera_attributes(50, 36, 1.4, 2))

        for name in ("jpeg/turned.jpg", "png/a.png", "tiff/rgb16.tif"):
            shutil.copy(CORPUS / name, self.path("in" + name[-4:]))
        with open(self.path("in.gltf"), "w") as file:
            json.dump(TRIANGLE, file)
        with open(self.path("in.bin"), "wb") as file:
            file.write(struct.pack("<9f", -1, -1, -3, 1, -1, -3, 0, 1, -3))

    def outputs(self):
        return {name: self.content(name) for name in os.listdir(self.folder) if not name.startswith(("in.", "counts"))}

    def remove_outputs(self):
        for name in self.outputs():
            os.remove(self.path(name))

    def with_fault(self, command, fault):
        return self.run_program(*command, "-q", env={"LD_PRELOAD": FAULTS, "PETZVAL_FAULT": fault,
                                                     "PETZVAL_FAULT_COUNT": self.path("counts")})

    def calls(self, command):
        self.assertEqual(self.with_fault(command, "").code, 0)
        with open(self.path("counts")) as file:
            return {kind: int(count) for kind, count in (line.split() for line in file)}

    def check(self, kind, codes):
        """All calls of a kind, or a sample: the first and the last eight, and as many of the last sixth, where the
        work is done once the flags are known, as of the rest."""
        dice = random.Random(32)
        for command in RUNS:
            self.remove_outputs()
            count, right = self.calls(command)[kind], self.outputs()
            chosen = range(1, count + 1)
            if 0 < EACH < count:
                late = range(count - count // 6, count + 1)
                chosen = sorted({*range(1, 9), *range(count - 7, count + 1), *dice.sample(chosen, EACH // 2),
                                 *dice.sample(late, min(EACH // 2, len(late)))})
            for call in chosen:
                self.check_call(command, kind, call, codes, right)

    def check_call(self, command, kind, call, codes, right):
        """One run; `right` are the outputs of a run without a fault. Returns its exit code."""
        self.remove_outputs()
        outcome = self.with_fault(command, f"{kind}:{call}")
        where = f"{' '.join(command)}, {kind} {call}\n{outcome}"
        self.assertIn(outcome.code, codes, where)
        left = self.outputs()
        if kind == "read" and outcome.code != 0:  # a farm tries again, and a user knows what to look at
            self.assertIn(": cannot be read: Input/output error", outcome.err, where)
            self.assertRegex(outcome.err, r"in\.(000[12]\.exr|gltf|bin|jpg|png|tif): cannot", where)
        if outcome.code == 0:
            self.assertEqual(left, right, where)
        else:
            self.assertTrue(outcome.lines and outcome.lines[-1].startswith("petzval: "), where)
            for name, content in left.items():  # another frame of the shot
                self.assertEqual(content, right.get(name), where)
        return outcome.code

    def test_an_allocation(self):
        self.check("malloc", (0, 1))

    def test_an_allocation_of_the_parser_of_a_gltf_file(self):
        """About 70 allocations in a row are its own: some are among every 25th."""
        command = next(words for words in RUNS if "in.gltf" in words)
        self.remove_outputs()
        before, count, right = self.calls(["--version"])["malloc"], self.calls(command)["malloc"], self.outputs()
        for call in range(before + 1, count + 1, 25):
            self.check_call(command, "malloc", call, (0, 1), right)

    def test_a_write(self):
        self.check("write", (0, 1, 6))

    def test_a_read(self):
        self.check("read", (0, 1))


if __name__ == "__main__":
    unittest.main()
