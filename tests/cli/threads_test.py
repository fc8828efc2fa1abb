"""--threads: how many threads the program really has, counted by the kernel."""
import os
import subprocess
import unittest

from pictures import camera_attributes, picture, write_exr
from program import PETZVAL, CommandLineTest

SIZE = 160


def most_threads(process):
    """The largest number of threads seen until the process ends. Pools stay until then, so none is missed."""
    most = 0
    while process.poll() is None:
        try:
            most = max(most, len(os.listdir("/proc/%d/task" % process.pid)))
        except OSError:
            pass
    return most


@unittest.skipUnless(os.path.isdir("/proc/self/task"), "threads are counted in /proc")
class Threads(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(SIZE, SIZE, lambda x, y: (x * 37 + y * 91) % 17 / 3, lambda x, y: 1 + x / 40),
                  attributes=camera_attributes(200, 36, 1.4, 2))

    def threads_of(self, *args):
        with subprocess.Popen([PETZVAL, *args], cwd=self.folder, stderr=subprocess.PIPE,
                              env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"}) as process:
            most = most_threads(process)
            self.assertEqual(process.returncode, 0, process.stderr.read().decode())
        return most

    def test_one_thread_is_one_thread(self):
        for engine in ("scatter", "gather", "gaussian", "sprites"):
            self.assertEqual(self.threads_of("defocus", "in.exr", "-o", "out.exr", "--engine", engine, "-q",
                                             "--bloom", "0.1", "--veil", "0.1", "--threads", "1"), 1, engine)
        self.assertEqual(self.threads_of("develop", "out.exr", "-o", "out.png", "-q", "--threads", "1"), 1)

    def test_one_thread_reads_hidden_layers_and_traces_a_lens(self):
        self.succeed("scene", "make", "bars", "-o", "bars.exr", "--width", "64", "--height", "36", "--samples", "4",
                     "--layers", "behind.exr", "-q")
        self.assertEqual(self.threads_of("defocus", "bars.exr", "-o", "out.exr", "--behind", "behind.exr", "-q",
                                         "--lens", "doublet", "--threads", "1"), 1)

    @unittest.skipUnless(len(os.sched_getaffinity(0)) > 1, "one processor has no second thread")
    def test_several_threads_are_seen(self):
        self.assertGreater(self.threads_of("defocus", "in.exr", "-o", "out.exr", "-q", "--threads", "2"), 1)


if __name__ == "__main__":
    unittest.main()
