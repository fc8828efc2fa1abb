"""The wheel: installed without an index it takes a frame; libraries that must not travel are refused; stubs are true.

Usage: wheel_test.py LIBPETZVAL.SO
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import wheel  # noqa: E402

FRAME = """
import petzval
picture, radii = petzval.Array((16, 16, 3)), petzval.Array((16, 16))
for y in range(16):
    for x in range(16):
        radii.data[y, x] = 2
picture.data[8, 8, 1] = 1
image = petzval.defocus(picture, radii_px=radii).image
print(petzval.__file__, sum(image.data[y, x, 1] for y in range(16) for x in range(16)))
"""
# The variables that load the runtime of a sanitizer; empty without a sanitizer.
SANITIZER = {name: os.environ[name] for name in ("LD_PRELOAD", "ASAN_OPTIONS", "TSAN_OPTIONS") if name in os.environ}
library = ""


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def made(self):
        """A wheel of the library under test, whatever it links."""
        refused = wheel.NOT_PACKED
        wheel.NOT_PACKED = wheel.re.compile("^$")
        try:
            return wheel.write(self.folder, [library])
        finally:
            wheel.NOT_PACKED = refused

    def test_installed_without_an_index_it_takes_a_frame_without_numpy(self):
        target = self.folder / "site"
        pip = [sys.executable, "-m", "pip"]
        if subprocess.run([*pip, "--version"], capture_output=True).returncode:
            self.skipTest("pip is missing")
        subprocess.run([*pip, "install", "--quiet", "--no-index", "--no-deps", "--target", target, self.made()],
                       check=True)
        out = subprocess.run([sys.executable, "-S", "-c", FRAME], check=True, capture_output=True, text=True,
                             env={"PYTHONPATH": str(target), **SANITIZER}, cwd=self.folder).stdout
        place, light = out.split()
        self.assertTrue(place.startswith(str(target)))
        self.assertAlmostEqual(float(light), 1, delta=1e-4)

    def test_its_bytes_depend_on_its_content_alone(self):
        first = self.made().read_bytes()
        self.assertEqual(self.made().read_bytes(), first)

    def test_every_file_is_in_the_record(self):
        with zipfile.ZipFile(self.made()) as archive:
            record = next(name for name in archive.namelist() if name.endswith("/RECORD"))
            listed = {line.split(",")[0] for line in archive.read(record).decode().splitlines()}
            self.assertEqual(listed, set(archive.namelist()))
            self.assertIn("petzval/libpetzval.so.0", listed)
            self.assertIn("petzval/py.typed", listed)

    def test_a_library_that_needs_tbb_is_refused(self):
        if not any(name.startswith("libtbb") for name, _ in wheel.needed(library)):
            self.skipTest("this library was built without TBB")
        with self.assertRaisesRegex(wheel.Refused, "portable"):
            wheel.write(self.folder, [library])


class Stubs(unittest.TestCase):
    def test_they_are_written_from_the_sources(self):
        subprocess.run([sys.executable, ROOT / "tools/python_stubs.py", "--check"], check=True)

    def test_stubtest_finds_them_true(self):
        stubtest = shutil.which("stubtest")
        if not stubtest:
            self.skipTest("stubtest (package mypy) is missing")
        done = subprocess.run([stubtest, "petzval", "--ignore-missing-stub"], cwd=ROOT / "python", text=True,
                              env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(ROOT / "python"), "PETZVAL_LIBRARY": library,
                                   "MYPY_CACHE_DIR": tempfile.gettempdir()},
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    library = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
