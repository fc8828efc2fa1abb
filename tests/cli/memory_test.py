"""Short memory: wherever it ends, one line and exit code 1; never an abort, never half a file."""
import os
import re
import subprocess
import unittest

from pictures import camera_attributes, picture, write_exr
from program import PETZVAL, SANITIZED, CommandLineTest, address_space


@unittest.skipIf(SANITIZED, "needs a limit of addresses")
class ShortMemory(CommandLineTest):
    def least(self):
        """The least in which the program starts at all: below, the loader of libraries says why not."""
        low, high = 16, 512
        while high - low > 2:
            middle = (low + high) // 2
            started = self.run_program("--version", limits=address_space(middle)).code == 0
            low, high = (low, middle) if started else (middle, high)
        return high

    def test_every_verb_ends_with_a_line_or_with_its_result(self):
        write_exr(self.path("in.exr"), picture(64, 48, depth=lambda x, y: 1 + x / 40),
                  attributes=camera_attributes(50, 36, 1.4, 2))
        least = self.least()
        ended = {0: 0, 1: 0}
        for command in (["scene", "make", "night", "--width", "48", "--height", "27"], ["defocus", "in.exr"]):
            for more in (0, 4, 12, 30, 60, 100, 120, 140, 160, 240):
                outcome = self.run_program(*command, "-o", "out.exr", "-q", limits=address_space(least + more))
                where = "%s in %d MiB\n%s" % (" ".join(command), least + more, outcome)
                self.assertIn(outcome.code, ended, where)
                ended[outcome.code] += 1
                self.assertEqual(len(outcome.lines), outcome.code, where)
                self.assertNotIn("internal error", outcome.err)
                left = [n for n in os.listdir(self.folder) if n.endswith(".unfinished")]
                self.assertEqual(left, [], where)
        self.assertGreater(ended[0], 2)
        self.assertGreater(ended[1], 2)

    def test_a_driver_in_software_is_refused_before_addresses_run_out(self):
        self.succeed("scene", "make", "lanterns", "--width", "640", "--height", "360", "--pinhole-samples", "1", "-o", "in.exr")
        for mebibytes in (400, 450, 500, 600, 800):
            outcome = self.run_program("defocus", "in.exr", "-o", "out.exr", "--engine", "realtime", "--device", "gpu", "-q",
                                       "--overwrite", limits=address_space(mebibytes))
            where = "%s in %d MiB" % (outcome, mebibytes)
            self.assertIn(outcome.code, (0, 1, 2), where)  # 2: without a driver
            self.assertEqual(len(outcome.lines), min(outcome.code, 1), where)

    def test_a_limit_of_the_system_is_kept_to_and_what_is_enough_is_named(self):
        self.succeed("scene", "make", "table", "--width", "1280", "--height", "720", "--pinhole-samples", "1", "-o", "in.exr")
        defocus = ["defocus", "in.exr", "-o", "out.exr", "--kernel-cache", "off", "-q", "--threads", "1"]
        refused = self.refuse(1, *defocus, limits=address_space(self.least() + 72 + 80), says=["what ulimit -v leaves", "at least"])
        named = int(re.search(r"ulimit -v (\d+) would be enough", refused.err).group(1))
        self.succeed(*defocus, limits=address_space(named // 1024 + 1))
        group = "/sys/fs/cgroup/memory/petzval-test-%d" % os.getpid()
        try:
            os.mkdir(group)
        except OSError:
            return  # who runs this may make no groups
        try:
            def in_group_of(mebibytes):
                def limit():
                    with open(group + "/memory.limit_in_bytes", "w") as file:
                        file.write("%dM" % mebibytes)
                    with open(group + "/cgroup.procs", "w") as file:
                        file.write(str(os.getpid()))
                return limit
            refused = self.run_program(*defocus, "--overwrite", limits=in_group_of(50))
            self.assertEqual(refused.code, 1, refused)
            self.assertIn("the limit of the memory cgroup", refused.err)
            named = int(re.search(r"memory.limit_in_bytes (\d+)M would be enough", refused.err).group(1))
            self.succeed(*defocus, "--overwrite", limits=in_group_of(named + 8))
        finally:
            os.rmdir(group)

    def test_each_verb_that_reads_keeps_to_a_limit_of_the_system(self):
        self.succeed("scene", "make", "table", "--width", "1280", "--height", "720", "--pinhole-samples", "1", "-o", "in.exr")
        for command in (["defocus", "in.exr", "-o", "out.exr"], ["develop", "in.exr", "-o", "out.png"],
                        ["compare", "in.exr", "in.exr"], ["sheet", "in.exr", "-o", "out.png", "--lenses", "doublet"],
                        ["inspect", "in.exr"]):
            refused = self.refuse(1, *command, limits=address_space(self.least() + 16), says=["what ulimit -v leaves", "in.exr takes"])
            self.assertEqual(len(refused.lines), 1)

    def test_a_picture_of_a_lens_that_does_not_fit_is_refused_and_what_is_enough_is_named(self):
        for words in (["psf", "doublet", "--defocus", "1000"], ["psf", "ideal", "--size", "2001"],
                      ["table", "ideal", "--defocus", "128"], ["volume", "ideal", "--slices", "64", "--side", "256"]):
            command = ["lens", *words, "-o", "disc.exr", "-q"]
            refused = self.refuse(1, *command, limits=address_space(self.least() + 90), says=["what ulimit -v leaves", "at least"])
            self.assertEqual(len(refused.lines), 1)
            named = int(re.search(r"ulimit -v (\d+) would be enough", refused.err).group(1))
            self.succeed(*command, limits=address_space(named // 1024 + 24))

    def test_an_atlas_and_a_report_that_do_not_fit_are_refused_and_what_is_enough_is_named(self):
        for words, room in ((["atlas", "doublet", "-o", "atlas", "--zones", "64"], 72 + 2), (["report", "doublet", "-o", "sheet.html"], 90)):
            command = ["lens", *words]
            refused = self.refuse(1, *command, limits=address_space(self.least() + room), says=["what ulimit -v leaves", "at least"])
            self.assertEqual(len(refused.lines), 1)
            named = int(re.search(r"ulimit -v (\d+) would be enough", refused.err).group(1))
            self.succeed(*command, limits=address_space(named // 1024 + 24))

    def test_a_scene_that_does_not_fit_is_refused_before_it_is_rendered(self):
        refused = self.refuse(1, "scene", "make", "night", "--width", "8000", "--height", "8000", "-o", "big.exr", "-q",
                              limits=address_space(self.least() + 160 + 400), says=["what ulimit -v leaves", "8000 x 8000"])
        self.assertIn("would be enough", refused.err)

    def peak(self, *args):
        """Exit code and the largest memory of one run, MiB."""
        with subprocess.Popen([PETZVAL, *args], cwd=self.folder, stdin=subprocess.DEVNULL) as run:
            _, status, used = os.wait4(run.pid, 0)
            run.returncode = os.waitstatus_to_exitcode(status)
        return run.returncode, used.ru_maxrss / 1024

    def test_a_limit_counts_the_driver_of_a_device(self):
        self.succeed("scene", "make", "lanterns", "--width", "640", "--height", "360", "--pinhole-samples", "1", "-o", "in.exr")
        defocus = ["defocus", "in.exr", "-o", "out.exr", "--engine", "realtime", "--device", "gpu", "-q", "--max-memory"]
        outcome = self.run_program(*defocus, "60M")
        if outcome.code == 2:
            self.skipTest("no Vulkan driver")
        self.assertEqual(outcome.code, 1, outcome)
        named = int(re.search(r"takes about (\d+)M", outcome.err).group(1))
        code, peak = self.peak(*defocus, "%dM" % named)
        self.assertEqual(code, 0)
        self.assertLess(peak, 1.2 * named)
        self.assertGreater(peak, named / 1.2)

    def test_a_limit_names_what_is_used(self):
        self.succeed("scene", "make", "table", "--width", "1280", "--height", "720", "--pinhole-samples", "1", "-o", "in.exr")
        defocus = ["defocus", "in.exr", "-o", "out.exr", "--kernel-cache", "off", "-q", "--max-memory"]
        refused = self.refuse(1, *defocus, "20M", says=["takes at least"])
        named = int(re.search(r"at least (\d+)M", refused.err).group(1))
        code, peak = self.peak(*defocus, "%dM" % named)
        self.assertEqual(code, 0)
        self.assertLess(peak, named)
        self.assertGreater(peak, 0.85 * named)


if __name__ == "__main__":
    unittest.main()
