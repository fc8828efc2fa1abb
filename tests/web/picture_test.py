"""The part "Your picture" of the lens lab: live and developed frames beside the program's, and files that are opened.

Usage: pages.py says it.
"""
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

import numpy
import pages
from pages import PETZVAL, SITE, By, Page
from pictures import camera_attributes, exr_bytes, picture, png_chunk, read_exr, write_exr


def decibels(a, b):
    """Of linear light clamped to 0…1, as `petzval compare` has it."""
    return -10 * numpy.log10(max(1e-20, float(numpy.mean((numpy.clip(a, 0, 1) - numpy.clip(b, 0, 1)) ** 2))))


def png(width, height, code):
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in code(x, y)) for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 2, 0, 0, 0)) +
            png_chunk(b"IDAT", zlib.compress(rows)) + png_chunk(b"IEND", b""))


class Picture(Page):
    def show(self, fragment=None):
        """The night scene through the doublet, or what a link says; the page of the test before is kept where it can be."""
        if fragment is None and self.browser.execute_script("return Boolean(globalThis.lab?.picture)"):
            self.done("""
                (Object.assign(lab.state.picture, { f_number: 0, focus_m: 0 }),
                 lab.use({ name: "doublet", text: null, look: {} }).then(() => lab.picture.shot.name === "night" || lab.picture.openNight()))""")
        else:
            self.open(fragment or "")
            self.assertIsNone(self.done("lab.showPicture()"))
        self.assertEqual(self.text("problem"), "")

    def rgb(self, expression, shape):
        return numpy.frombuffer(self.floats(expression), "<f4").reshape(*shape, 4)[..., :3]

    def files_of_page(self, folder):
        """The page's picture and its hidden layer as files for the program; the flags that go with them."""
        width, height = self.browser.execute_script("return [lab.picture.shot.width, lab.picture.shot.height]")
        pixels = numpy.frombuffer(self.floats("lab.picture.shot.pixels"), "<f4").reshape(height, width, 4)
        depth = numpy.frombuffer(self.floats("lab.picture.shot.depth_m"), "<f4").reshape(height, width)
        counts = numpy.diff(numpy.frombuffer(self.floats("lab.picture.shot.first"), "<u8")).astype(int)
        hidden = numpy.zeros((height * width, 5), "f4")
        hidden[counts > 0] = numpy.frombuffer(self.floats("lab.picture.shot.samples"), "<f4").reshape(-1, 6)[:, :5]
        camera = self.browser.execute_script("return lab.picture.camera()")
        attributes = camera_attributes(camera["focal_mm"], camera["sensor_mm"], camera["f_number"], camera["focus_m"])

        def written(name, planes, channels):
            return write_exr(pathlib.Path(folder, name), {c: planes[..., i].tolist() for i, c in enumerate(channels)}, attributes=attributes)
        return (height, width), (written("page.exr", numpy.dstack([pixels, depth]), "RGBAZ"),
                                 "--plate", written("plate.exr", hidden.reshape(height, width, 5), "RGBAZ"))

    def program(self, folder, files, engine, *flags):
        path = pathlib.Path(folder, f"{engine}.exr")
        subprocess.run([PETZVAL, "defocus", *files, "-o", path, "--engine", engine, *flags, "--quiet"], check=True, capture_output=True)
        channels, _ = read_exr(path)
        return numpy.dstack([numpy.array(channels[c], "f4") for c in "RGB"])

    def test_live_and_developed_frames_are_those_of_the_program(self):
        self.show()
        for lens, flags, least_live, least_developed in (({"name": "doublet", "look": {}}, ("--lens", "doublet"), 100, 90),
                                                         ({"name": "biotar", "look": {"blades": 6, "cats_eye": 0.6}}, ("--lens", "biotar", "--blades", "6", "--cats-eye", "0.6"), 90, 60)):
            with self.subTest(lens["name"]), tempfile.TemporaryDirectory() as folder:
                self.done("lab.use({ text: null, ...args[0] })", lens)
                shape, files = self.files_of_page(folder)
                live = self.rgb("lab.picture.livePixels()", shape)
                apart = decibels(live, self.program(folder, files, "gather", *flags))
                print(f"{lens['name']}: live {apart:.1f} dB", flush=True)
                self.assertGreater(apart, least_live)
                self.assertGreater(float(live.std()), 0.01)
                self.done("lab.picture.develop()")
                developed, expected = self.rgb("lab.picture.developed", shape), self.program(folder, files, "scatter", *flags)
                apart, energy = decibels(developed, expected), float(developed.sum(dtype="f8") / expected.sum(dtype="f8"))
                print(f"{lens['name']}: developed {apart:.1f} dB, energy {energy:.7f}, {self.text('picture-told')}", flush=True)
                self.assertGreater(apart, least_developed)
                self.assertAlmostEqual(energy, 1, delta=1e-4)

    def test_a_click_focuses_there_and_the_slider_closes_the_lens(self):
        self.show()
        before = self.floats("lab.picture.livePixels()")
        self.done("lab.picture.focusAt(240, 60)")
        depth = self.browser.execute_script("return lab.picture.shot.depth_m[60 * 480 + 240]")
        self.assertAlmostEqual(self.browser.execute_script("return lab.picture.camera().focus_m"), min(depth, 1e5), places=3)
        focused = self.floats("lab.picture.livePixels()")
        self.assertNotEqual(focused, before)
        self.browser.execute_script("const f = document.getElementById('picture-f'); f.value = 0.8; f.dispatchEvent(new Event('input'));")
        self.done("lab.picture.update()")
        self.assertNotEqual(self.floats("lab.picture.livePixels()"), focused)
        # A link holds both.
        self.show(self.browser.execute_script("return location.hash"))
        self.assertGreater(self.browser.execute_script("return lab.picture.camera().f_number"), 8)

    def test_developing_can_be_cancelled(self):
        self.show()
        self.browser.execute_script("globalThis.ended = lab.picture.develop()")
        self.browser.find_element(By.ID, "picture-cancel").click()
        self.assertIsNone(self.done("globalThis.ended"))
        self.assertEqual(self.text("picture-told"), "Cancelled.")
        self.assertTrue(self.browser.execute_script("return document.getElementById('picture-developed').hidden"))
        self.done("lab.picture.develop()")
        self.assertRegex(self.text("picture-told"), r"^Developed in \d")

    def opened(self, *files):
        """Opens (name, type, bytes) as if dropped; what the page says of them, and its picture's size."""
        arguments = [[name, kind, list(data)] for name, kind, data in files]
        self.done("lab.picture.openFiles(args[0].map(([name, type, bytes]) => new File([new Uint8Array(bytes)], name, { type })))", arguments)
        return self.text("picture-told"), self.browser.execute_script("const s = lab.picture.shot; return [s.width, s.height]")

    def test_an_exr_with_depth_is_opened(self):
        self.show()
        shot = picture(96, 64, lambda x, y: 5.0 if (x, y) == (40, 20) else 0.2 + 0.002 * x, lambda x, y: 1.5 if x < 48 else 9.0)
        told, size = self.opened(("mine.exr", "", exr_bytes(shot, half=("R", "G", "B"), attributes=camera_attributes(85, 36, 1.8, 1.5))))
        self.assertEqual(size, [96, 64], told)
        self.assertIn("Live", told)
        self.assertAlmostEqual(self.browser.execute_script("return lab.picture.camera().focal_mm"), 85, places=4)
        live = self.rgb("lab.picture.livePixels()", (64, 96))
        self.assertAlmostEqual(float(live[32, 4].mean()), 0.208, delta=0.002)  # in focus
        self.assertIn("stays on this machine", self.text("picture-name"))

    def test_a_photograph_and_its_depth_map_are_opened(self):
        self.show()
        photograph = png(60, 40, lambda x, y: (188, 188, 188) if x < 30 else (20, 60, 90))
        told, size = self.opened(("photo.png", "image/png", photograph), ("photo_depth.png", "image/png", png(60, 40, lambda x, y: (255,) * 3 if x < 30 else (0,) * 3)))
        self.assertEqual(size, [60, 40])
        depths = self.browser.execute_script("return [lab.picture.shot.depth_m[0], lab.picture.shot.depth_m[59]]")
        self.assertAlmostEqual(depths[0], 1, places=4)
        self.assertAlmostEqual(depths[1], 30, places=3)
        # 188 of 255 is half the light of white.
        self.assertAlmostEqual(self.browser.execute_script("return lab.picture.shot.pixels[0]"), 0.5029, places=3)

    def test_what_cannot_be_opened_is_told_and_changes_nothing(self):
        self.show()
        whole = exr_bytes(picture(16, 16))
        giant = bytearray(whole)
        at = whole.index(b"dataWindow\0box2i\0") + 17 + 4
        giant[at:at + 16] = struct.pack("<4i", 0, 0, 99999, 99999)
        for name, kind, data, told in (("cut.exr", "", whole[:len(whole) // 2], "damaged"), ("empty.exr", "", b"", "not an EXR"), ("junk.exr", "", bytes(range(256)) * 20, "not an EXR"),
                                       ("giant.exr", "", bytes(giant), "million pixels"), ("flat.exr", "", exr_bytes(picture(16, 16, depth=None)), "no depth"),
                                       ("piz.exr", "", whole.replace(b"compression\0compression\0\1\0\0\0\0", b"compression\0compression\0\1\0\0\0\4"), "PIZ"),
                                       ("alone.jpg", "image/jpeg", b"\xff\xd8\xff", "no depth")):
            with self.subTest(name):
                said, size = self.opened((name, kind, data))
                self.assertIn(told, said)
                self.assertEqual(size, [480, 270])
        for cut in range(8, len(whole), 397):
            said, size = self.opened(("cut.exr", "", whole[:cut]))
            self.assertRegex(said, r"cut\.exr was not opened: .*\.$")
        self.assertEqual(self.complaints(), [])

    def test_it_fits_a_phone_and_asks_nobody_else(self):
        self.narrow(360)
        self.requests()
        self.show("#")
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 360)
        self.assertEqual([url for url in self.requests() if not url.startswith((self.origin, "blob:", "data:", "about:"))], [])


class WithoutWebGL(Page):
    flags = ("--disable-3d-apis",)

    def test_the_page_says_so_and_develops(self):
        self.open()
        self.done("lab.showPicture()")
        self.assertRegex(self.text("picture-told"), r"no WebGL2.*Develop works")
        self.done("lab.picture.develop()")
        self.assertRegex(self.text("picture-told"), r"^Developed in \d")


class Broken(pages.WithoutWebAssembly):
    broken = "petzval-picture.wasm"

    def test_the_page_says_so_and_stays_as_it_was(self):
        self.open()
        self.done("lab.showPicture()")
        self.assertRegex(self.text("problem"), r"^The picture cannot be shown: .")
        self.assertFalse(self.browser.execute_script("return document.getElementById('picture-open').disabled"))


if __name__ == "__main__":
    unittest.main()
