"""Kernels kept on disk: the second run reads them, the picture never depends on them, damage costs only time."""
import os
import pathlib
import subprocess
import unittest

from program import CAMERA, PETZVAL, CommandLineTest


class KernelCache(CommandLineTest):
    LENS = ["--lens", "doublet", "--cats-eye", "0.6", "--blades", "6"]

    def setUp(self):
        super().setUp()
        self.succeed("scene", "make", "night", "-o", "night.exr", "--width", "64", "--height", "36")

    def defocus(self, name, *flags, **options):
        report = self.report("defocus", "night.exr", "-o", name, *self.LENS, *CAMERA, *flags, **options)
        return report["kernels_from_cache"], pathlib.Path(self.path(name)).read_bytes()

    def segments(self):
        return sorted(pathlib.Path(self.path("kept")).rglob("*.kernels"))

    def test_the_second_run_reads_what_the_first_made(self):
        made, without = self.defocus("off.exr", "--kernel-cache", "off")
        self.assertEqual(made, 0)
        first, picture = self.defocus("first.exr", "--kernel-cache", "kept")
        self.assertEqual((first, picture), (0, without))
        second, picture = self.defocus("second.exr", "--kernel-cache", "kept", "--threads", "1")
        self.assertGreater(second, 5)
        self.assertEqual(picture, without)

    def test_another_lens_finds_nothing(self):
        self.defocus("first.exr", "--kernel-cache", "kept")
        self.assertEqual(self.defocus("other.exr", "--kernel-cache", "kept", "--dust", "0.5")[0], 0)

    def test_damage_is_made_again(self):
        _, good = self.defocus("good.exr", "--kernel-cache", "kept")
        for damage in (lambda b: b[:len(b) // 2], lambda b: b"", lambda b: b[:200] + b"\xff" * 100 + b[300:],
                       lambda b: b[:-64] + bytes(64)):
            for segment in self.segments():
                segment.write_bytes(damage(segment.read_bytes()))
            self.assertEqual(self.defocus("again.exr", "--kernel-cache", "kept", "--overwrite")[1], good)

    def test_the_environment_says_where(self):
        self.defocus("first.exr", env={"PETZVAL_KERNEL_CACHE": self.path("kept")})
        self.assertTrue(self.segments())
        self.defocus("second.exr", env={"PETZVAL_KERNEL_CACHE": "", "XDG_CACHE_HOME": self.path("xdg")})
        self.assertTrue(list(pathlib.Path(self.path("xdg/petzval/kernels")).rglob("*.kernels")))

    def test_a_folder_that_cannot_be_used_is_no_error(self):
        pathlib.Path(self.path("file")).write_text("not a folder")
        self.assertEqual(self.defocus("out.exr", "--kernel-cache", "file")[0], 0)

    def test_several_at_once(self):
        runs = [subprocess.Popen([PETZVAL, "defocus", "night.exr", "-o", f"{i}.exr", *self.LENS, *CAMERA, "-q",
                                  "--kernel-cache", "kept"], cwd=self.folder) for i in range(4)]
        self.assertEqual([run.wait() for run in runs], [0] * 4)
        pictures = {pathlib.Path(self.path(f"{i}.exr")).read_bytes() for i in range(4)}
        self.assertEqual(len(pictures), 1)
        self.assertEqual(self.defocus("after.exr", "--kernel-cache", "kept")[1], pictures.pop())
        self.assertFalse([name for name in os.listdir(self.path("kept")) if name.endswith(".part")])


if __name__ == "__main__":
    unittest.main()
