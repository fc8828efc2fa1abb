"""Bad files and full disks: one clear line, the right exit code, nothing half-written, memory bounded."""
import ctypes
import os
import random
import resource
import signal
import struct
import subprocess
import unittest

import pictures
from pictures import camera_attributes, exr_bytes, picture, read_exr, write_exr
from program import CAMERA, SANITIZED, CommandLineTest, address_space


class BadInput(CommandLineTest):
    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data)
        return name

    def refuse_input(self, name, says=(), **options):
        """By every verb that reads pictures."""
        says = [name, *says]
        self.refuse(3, "defocus", name, "-o", "out.exr", *CAMERA, says=says, **options)
        self.refuse(3, "inspect", name, says=says, **options)
        self.refuse(3, "develop", name, "-o", "out.png", says=says, **options)
        self.refuse(3, "compare", name, name, says=says, **options)

    def test_missing_file(self):
        self.refuse_input("nowhere.exr")
        self.write("in.exr", exr_bytes(picture(8, 6)))
        self.refuse(3, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--behind", "no.exr", says=["no.exr"])
        self.refuse(3, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--depth", "no.exr", says=["no.exr"])
        self.refuse(3, "compare", "in.exr", "in.exr", "--mask", "no.png", says=["no.png"])

    def test_a_folder_is_not_a_picture(self):
        os.mkdir(self.path("folder.exr"))
        self.refuse_input("folder.exr")

    def test_a_folder_or_a_device_is_not_a_lens(self):
        self.write("in.exr", exr_bytes(picture(8, 6)))
        os.mkdir(self.path("doublet"))
        # Kernels of a file are kept by what it holds: also with a store for them nothing is read without end.
        stored = {"PETZVAL_KERNEL_CACHE": self.path("store")}
        for lens in (".", "/dev/zero"):
            self.refuse(3, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--lens", lens, says=[lens], env=stored)
        self.succeed("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--lens", "doublet", env=stored)

    def test_a_focus_shift_beyond_all_measure(self):
        self.write("in.exr", exr_bytes(picture(8, 6)))
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--lens", "doublet", "--focus-shift", "1e30",
                    says=["--focus-shift", "1000"])

    def test_empty_file(self):
        self.write("empty.exr", b"")
        self.refuse_input("empty.exr")

    def test_text_named_exr(self):
        self.write("notes.exr", b"This is not a picture.\n" * 100)
        self.refuse_input("notes.exr")

    def test_truncated_exr_wherever_it_is_cut(self):
        whole = exr_bytes(picture(40, 30))
        for eighth in range(8):
            self.write("cut.exr", whole[:len(whole) * eighth // 8 + 5])
            self.refuse(3, "defocus", "cut.exr", "-o", "out.exr", *CAMERA, says=["cut.exr"])
        self.write("cut.exr", whole[:-1])
        self.refuse_input("cut.exr")

    def test_damaged_bytes_never_crash(self):
        whole, dice = exr_bytes(picture(12, 9)), random.Random(4)
        for _ in range(60):
            damaged = bytearray(whole)
            for _ in range(dice.choice((1, 3, 20))):
                damaged[dice.randrange(8, len(whole))] = dice.randrange(256)
            self.write("damaged.exr", damaged)
            outcome = self.run_program("defocus", "damaged.exr", "-o", "out.exr", *CAMERA, "--max-radius", "4",
                                       "-q", limits=address_space(2048))
            self.assertIn(outcome.code, (0, 1, 2, 3), outcome)
            self.assertLessEqual(len(outcome.lines), 1, outcome)

    def test_exr_without_depth_names_the_ways_out(self):
        self.write("flat.exr", exr_bytes(picture(8, 6, depth=None)))
        self.refuse(3, "defocus", "flat.exr", "-o", "out.exr", *CAMERA, says=["flat.exr", "depth", "--depth"])
        self.succeed("inspect", "flat.exr")
        self.succeed("develop", "flat.exr", "-o", "out.png")
        self.succeed("compare", "flat.exr", "flat.exr")

    def test_nan_and_infinite_pixels_are_counted_and_never_come_out(self):
        nan, inf = float("nan"), float("inf")
        odd = {(3, 2): nan, (7, 5): inf, (9, 1): -inf}
        self.write("nan.exr", exr_bytes(picture(16, 12, colour=lambda x, y: odd.get((x, y), 0.5),
                                                depth=lambda x, y: odd.get((y, x), 2.5))))
        report = self.report("defocus", "nan.exr", "-o", "out.exr", *CAMERA)
        self.assertEqual(report["non_finite"], {"colour": 9, "depth": 3})
        rows, _ = read_exr(self.path("out.exr"))
        for channel in "RGB":
            for row in rows[channel]:
                self.assertTrue(all(0 <= v <= 65504 for v in row), channel)
        outcome = self.succeed("defocus", "nan.exr", "-o", "out.exr", *CAMERA)
        self.assertTrue(any(l.startswith("petzval: warning: ") for l in outcome.lines), outcome)

    def test_negative_depth_is_taken_by_its_size_if_all_is_negative(self):
        self.write("plus.exr", exr_bytes(picture(8, 6, depth=lambda x, y: 1 + x)))
        self.write("minus.exr", exr_bytes(picture(8, 6, depth=lambda x, y: -1 - x)))
        for name in ("plus", "minus"):
            outcome = self.succeed("defocus", name + ".exr", "-o", name + "_coc.exr", "--view", "coc", *CAMERA)
        self.assertEqual(sum("warning" in l for l in outcome.lines), 1, outcome)
        self.assertEqual(read_exr(self.path("plus_coc.exr"))[0], read_exr(self.path("minus_coc.exr"))[0])

    def test_some_negative_depth_is_a_miss_with_one_warning(self):
        self.write("some.exr", exr_bytes(picture(8, 6, depth=lambda x, y: -1 if x == 0 else 2)))
        report = self.report("inspect", "some.exr")
        self.assertEqual(report["depth"]["misses"], 6)
        self.assertEqual(len(report["warnings"]), 1)

    def test_a_picture_without_pixels(self):
        head = pictures.header("BGRZ", (), 0, 0, display=(0, 0, 7, 7), data=(0, 0, -1, -1))
        self.write("none.exr", head + b"\0" * 64)
        self.refuse_input("none.exr")

    def test_pictures_one_pixel_wide_or_high(self):
        for width, height in ((1, 1), (1, 9), (9, 1)):
            self.write("thin.exr", exr_bytes(picture(width, height, depth=lambda x, y: 1 + x + y)))
            for view in ("beauty", "coc", "focus", "depth", "alpha"):
                for end in ("exr", "png"):
                    self.succeed("defocus", "thin.exr", "-o", "out." + end, "--view", view, *CAMERA)
            self.succeed("compare", "thin.exr", "out.png")
            self.succeed("inspect", "thin.exr")

    def test_a_huge_header_without_data_takes_neither_time_nor_memory(self):
        for width, height in ((40000, 40000), (40000, 4000), (40000, 1), (2 ** 31 - 2, 2 ** 31 - 2)):
            data = (0, 0, width - 1, height - 1)
            head = pictures.header("ABGRZ", "ABGR", width, height, display=data, data=data)
            self.write("huge.exr", head + struct.pack("<16Q", *range(16)))
            self.refuse_input("huge.exr", limits=address_space(1024))

    def test_a_huge_display_window_around_a_small_picture(self):
        self.write("far.exr", exr_bytes(picture(8, 6), display=(0, 0, 200000, 200000)))
        self.refuse_input("far.exr", says=["200001 x 200001"], limits=address_space(1024))

    @unittest.skipIf(SANITIZED, "needs a limit of addresses")
    def test_too_little_memory_is_one_line(self):
        self.write("in.exr", exr_bytes(picture(600, 500), half="RGB"))
        codes = set()
        for mib in (24, 32, 48, 64, 96, 128, 192, 256, 512, 1024):
            outcome = self.run_program("defocus", "in.exr", "-o", "out.exr", *CAMERA, "--max-radius", "3", "-q",
                                       "--engine", "scatter", limits=address_space(mib))
            if outcome.code == 127:  # not even the program's libraries fit
                continue
            codes.add(outcome.code)
            where = "with %d MiB: %s" % (mib, outcome)
            self.assertIn(outcome.code, (0, 1), where)
            self.assertEqual(len(outcome.lines), outcome.code, where)
            self.assertEqual(os.path.exists(self.path("out.exr")), outcome.code == 0, where)
            if outcome.code == 0:
                os.remove(self.path("out.exr"))
        self.assertEqual(codes, {0, 1})

    def test_hidden_layers_of_another_size(self):
        self.write("in.exr", exr_bytes(picture(8, 6)))
        self.write("other.exr", exr_bytes(picture(9, 6, alpha=1)))
        self.refuse(3, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--behind", "other.exr",
                    says=["other.exr", "9 x 6", "8 x 6"])

    def test_pictures_of_different_size_cannot_be_compared(self):
        self.write("a.exr", exr_bytes(picture(8, 6)))
        self.write("b.exr", exr_bytes(picture(8, 7)))
        self.refuse(2, "compare", "a.exr", "b.exr", says=["a.exr", "8 x 6", "b.exr", "8 x 7"])

    def test_a_layer_a_channel_and_a_pixel_that_are_not_there(self):
        self.write("in.exr", exr_bytes(picture(8, 6)))
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--layer", "nope", says=["nope"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *CAMERA, "--depth-channel", "nope", says=["nope", "Z"])
        self.refuse(2, "defocus", "in.exr", "-o", "out.exr", *CAMERA[:-2], "--focus-at", "8,0",
                    says=["--focus-at 8,0", "columns 0 to 7"])


def noise(x, y):
    return (x * 7919 + y * 104729) % 997 / 997


class BadOutput(CommandLineTest):
    def setUp(self):
        super().setUp()
        attributes = camera_attributes(50, 36, 2, 3)
        write_exr(self.path("in.exr"), picture(200, 150, noise, lambda x, y: 1 + 9 * noise(y, x)),
                  attributes=attributes)

    def each_writer(self, folder):
        yield ["defocus", "in.exr", "-o", folder + "out.exr", "--max-radius", "2"]
        yield ["defocus", "in.exr", "-o", folder + "out.png", "--max-radius", "2"]
        yield ["defocus", "in.exr", "-o", folder + "coc.exr", "--view", "coc"]
        yield ["develop", "in.exr", "-o", folder + "out.png"]
        yield ["scene", "make", "slant", "-o", folder + "out.exr", "--width", "150", "--height", "100",
               "--pinhole-samples", "1"]
        yield ["compare", "in.exr", "in.exr", "--json", folder + "r.json"]

    def test_a_folder_that_is_not_there(self):
        for command in self.each_writer("nowhere/"):
            if command[0] != "compare":
                self.refuse(1, *command, says=["nowhere"])

    def test_an_output_that_is_a_folder(self):
        os.mkdir(self.path("out.exr"))
        self.refuse(1, "defocus", "in.exr", "-o", "out.exr", says=["out.exr", "folder"])

    def test_no_right_to_write(self):
        def without_override():  # even root keeps to permissions without CAP_DAC_OVERRIDE (capabilities(7))
            drop_from_bounding_set, dac_override = 24, 1
            ctypes.CDLL(None).prctl(drop_from_bounding_set, dac_override)
        os.mkdir(self.path("locked"), 0o500)
        for command in self.each_writer("locked/"):
            if command[0] != "compare":
                self.refuse(1, *command, says=["locked"], limits=without_override)

    def test_a_disk_that_fills_up_while_writing(self):
        # A file size limit fails a write in the middle, as a full disk does, without needing rights.
        def limits():
            resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600))
        with open(self.path("out.exr"), "wb") as old:
            old.write(b"what was there before")
        for command in self.each_writer(""):
            if command[0] != "compare":
                self.refuse(1, *command, limits=limits)
        with open(self.path("out.exr"), "rb") as old:
            self.assertEqual(old.read(), b"what was there before")

    def test_a_full_file_system(self):
        disk = self.path("disk")
        os.mkdir(disk)
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk], stderr=subprocess.PIPE)
        if mounted.returncode != 0:
            self.skipTest("only root can mount a small file system")
        try:
            for command in self.each_writer("disk/"):
                if command[0] != "compare":
                    outcome = self.run_program(*command)
                    self.assertEqual(outcome.code, 1, outcome)
                    self.assertIn("space", outcome.lines[-1])
                    self.assertEqual(os.listdir(disk), [], "something was left on the full disk")
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_standard_output_that_cannot_be_written(self):
        for command in (["inspect", "in.exr"], ["compare", "in.exr", "in.exr"], ["scene", "list"], ["--help"],
                        ["inspect", "in.exr", "--json", "-"]):
            with open("/dev/full", "w") as full:
                outcome = self.run_program(*command, stdout=full)
            self.assertEqual(outcome.code, 1, (command, outcome))
            self.assertEqual(len(outcome.lines), 1, (command, outcome))


if __name__ == "__main__":
    unittest.main()
