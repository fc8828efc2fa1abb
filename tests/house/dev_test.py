"""The door itself: what it prints on a machine where something is missing, and what it leaves on stdout."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

DEV = pathlib.Path(__file__).resolve().parents[2] / "dev"
TOOLS = ["sh", "sed", "dirname", "mktemp", "rm", "tail", "env"]


def dev(*words, path=None):
    environment = {**os.environ, **({"PATH": path} if path else {})}
    return subprocess.run([DEV, *words], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)


def machine(folder, **programs):
    """A PATH with the few tools that a bare system has, and programs of one line each."""
    for tool in TOOLS:
        (pathlib.Path(folder) / tool).symlink_to(shutil.which(tool))
    # The interpreter itself: what a PATH calls python3 may be a script that needs more (pyenv).
    (pathlib.Path(folder) / "python3").symlink_to(sys.executable)
    for name, line in programs.items():
        program = pathlib.Path(folder) / name.replace("_", "-")
        program.write_text(f"#!/bin/sh\n{line}\n")
        program.chmod(0o755)
    return str(folder)


class Door(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_without_rights_it_names_the_command_in_one_line(self):
        path = machine(self.folder.name, dpkg_query="exit 1", id="echo 1000", apt_get="exit 1")
        result = dev("help", path=path)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertIn("as root, run: apt-get install --no-install-recommends cmake ninja-build", result.stderr)

    def test_it_asks_for_what_is_missing_and_nothing_else(self):
        installed = "for p; do case $p in -*|*{*|cmake) ;; *) printf 'installed:%s ' $p;; esac; done"
        path = machine(self.folder.name, dpkg_query=installed, id="echo 0", apt_get="exit 0")
        result = dev("help", path=path)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"(?m)^\+ .*apt-get .*install -y --no-install-recommends cmake$")

    def test_a_failed_installation_ends_in_one_sentence(self):
        path = machine(self.folder.name, dpkg_query="exit 1", id="echo 0", apt_get="echo no network; exit 100")
        result = dev("help", path=path)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertIn("no network\n", result.stderr)
        self.assertRegex(result.stderr.splitlines()[-1], "^dev: could not install; as root, run: apt-get install")

    def test_a_machine_without_apt_is_told_what_it_needs(self):
        path = machine(self.folder.name, dpkg_query="exit 1")
        result = dev("help", path=path)
        self.assertEqual(result.returncode, 1)
        self.assertIn("no apt-get", result.stderr)

    def test_an_unknown_verb_is_a_usage_error_that_lists_the_verbs(self):
        result = dev("dmeo")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("demo", result.stderr)

    def test_help_names_every_verb(self):
        words = dev("help").stdout.split()
        for verb in ("demo", "build", "test", "path", "run", "bench", "format", "lint", "check", "golden",
                     "validate-lenses", "gpu-laws"):
            self.assertIn(verb, words)

    def test_skipped_tests_are_found_in_the_log_of_every_runner(self):
        log = ("1/2 Testing: device.vulkan.Heap.Lends\n----\n[ RUN      ] Heap.Lends\nheap_test.cpp:16: Skipped\nno Vulkan device\n\n"
               "[  SKIPPED ] Heap.Lends (0 ms)\n"
               "2/2 Testing: cli.frames_test\n----\ntest_video (frames_test.Frames) ... skipped 'ffmpeg is not installed'\n"
               "test_frames (frames_test.Frames) ... ok\n")
        self.assertEqual(list(dev_tool().skipped_tests(log)),
                         [("device.vulkan.Heap.Lends", "no Vulkan device"), ("test_video", "ffmpeg is not installed")])


def dev_tool():
    spec = importlib.util.spec_from_file_location("dev", DEV.parent / "tools/dev.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


if __name__ == "__main__":
    unittest.main()
