"""A device that vanishes while the window is open, by a Vulkan layer that loses it."""
import os
import subprocess
import sys
import unittest

import window
from window import PETZVAL

LAYER = os.environ.get("PETZVAL_FAULTY_DEVICE", "")  # its folder
DRIVER = "/usr/share/vulkan/icd.d/lvp_icd.%s.json" % os.uname().machine


class DeviceTest(window.WindowTest):
    def setUp(self):
        self.gone = os.path.join(self.shared, "gone")
        self.lossy = {"VK_LAYER_PATH": LAYER, "VK_INSTANCE_LAYERS": "VK_LAYER_PETZVAL_faulty_device",
                      "VK_ICD_FILENAMES": DRIVER, "PETZVAL_LOSE_DEVICE": self.gone}
        for name, value in self.lossy.items():
            os.environ[name] = value
            self.addCleanup(os.environ.pop, name)
        self.addCleanup(lambda: os.path.exists(self.gone) and os.remove(self.gone))

    def test_the_window_says_so_and_goes_on_with_the_cpu(self):
        with open(os.path.join(self.shared, "lost.txt"), "w") as file:
            file.write("wait\nexpect no error\nexpect frame.device gpu\nsay frame.device\nsleep 1\n"
                       "set fstop 1.4\nwait\nexpect error lost\nexpect error CPU\nexpect frame.device cpu\n"
                       "set fstop 2\nwait\nexpect no error\nexpect frame.device cpu\nsave after.exr\nwait\n"
                       "expect no error\nexpect notice wrote\n")
        window = self.start("table.exr", "--engine", "gather", "--device", "gpu", "--script", "lost.txt")
        self.assertIn("gpu", window.stdout.readline())
        open(self.gone, "w").close()
        self.finish(window)
        self.assertTrue(os.path.exists(os.path.join(self.shared, "after.exr")))

    def test_until_the_device_has_its_programs_the_cpu_draws_and_is_cancelled_at_once(self):
        out, _ = self.do("""
            until frame.engine gather
            say frame.device
            set fstop 2
            sleep 0.3
            wait
            expect no error
            say frame.device
            expect frame.engine scatter
            set fstop 2.8
            until frame.passes develop
            wait
            expect no error
            say frame.passes
        """, "table.exr", "--device", "gpu")
        first, last, passes = out.splitlines()
        self.assertEqual(first, "cpu")
        self.assertIn("gpu", last)
        self.assertNotIn("develop", passes, "light follows the codes of a draft")

    def test_a_command_says_so_in_one_line(self):
        open(self.gone, "w").close()
        done = subprocess.run([PETZVAL, "defocus", "table.exr", "-o", "lost.exr", "--engine", "gather", "--device", "gpu",
                               "--quiet"], cwd=self.shared, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("lost", done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.shared, "lost.exr")))


if __name__ == "__main__":
    if not os.path.exists(DRIVER):
        print("SKIPPED: lavapipe is not there (Debian: mesa-vulkan-drivers)")
        sys.exit(77)
    window.run()
