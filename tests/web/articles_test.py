"""The page of articles: its methods beside the program's on the same frame, its buffers and its keys.

Usage: pages.py says it.
"""
import pathlib
import subprocess
import tempfile
import unittest

import numpy
from pages import PETZVAL, Page
from pictures import camera_attributes, read_exr, write_exr

WIDTH, HEIGHT, FOCAL_MM, SENSOR_MM = 640, 360, 300, 216  # the camera of web/lab/tori.js


def decibels(a, b):
    return -10 * numpy.log10(max(1e-20, float(numpy.mean((numpy.clip(a, 0, 1) - numpy.clip(b, 0, 1)) ** 2))))


class Articles(Page):
    def setUp(self):
        self.browser.get(f"{self.origin}/articles.html")
        self.assertEqual(self.text("problem"), "")

    def choose(self, method, **values):
        self.browser.execute_script("""
            Object.assign(articles.view.values[arguments[0]], arguments[1]);
            const button = document.querySelector(`[name="method"][value="${arguments[0]}"]`);
            if (button.checked) articles.redraw();
            else button.click();""", method, values)

    def buffer(self, name):
        """r, g, b, a of a buffer; its own size."""
        width, height = self.browser.execute_script("const b = articles.view.drawn[arguments[0]]; return [b.width, b.height]", name)
        return numpy.frombuffer(self.floats(f"articles.view.pixels(articles.view.drawn.{name})"), "<f4").reshape(height, width, 4)

    def program(self, f_number, focus_m, *flags):
        """The page's frame through the program."""
        sharp, depth = self.buffer("sharp"), numpy.frombuffer(self.floats("articles.view.pixels(articles.view.scene.depth)"), "<f4").reshape(HEIGHT, WIDTH, 4)
        with tempfile.TemporaryDirectory() as folder:
            rendered, made = pathlib.Path(folder, "tori.exr"), pathlib.Path(folder, "made.exr")
            planes = {c: sharp[..., i].tolist() for i, c in enumerate("RGBA")}
            write_exr(rendered, {**planes, "Z": depth[..., 0].tolist()}, attributes=camera_attributes(FOCAL_MM, SENSOR_MM, f_number, focus_m))
            subprocess.run([PETZVAL, "defocus", rendered, "-o", made, "--quiet", *flags], check=True, capture_output=True)
            channels, _ = read_exr(made)
        return numpy.dstack([numpy.array(channels[c], "f4") for c in "RGB"])

    def test_tori_of_wgld_are_those_of_the_program(self):
        self.choose("wgld", radius_px=12)
        for offset in (0.33, -0.1):
            with self.subTest(offset):
                self.choose("wgld", offset=offset)
                result = self.buffer("result")[..., :3]
                # A lens so wide that the largest radius is the limit. The article leaves the near distance out of its depth.
                program = self.program(0.2, 8, "--engine", "gaussian", "--gaussian-style", "wgld", "--max-radius", "12", "--depth-along", "ray",
                                       "--depth-band-range", "0.1m,30m", "--depth-offset", str(offset + 0.1 / 29.9))
                apart = decibels(result, program)
                print(f"wgld, depth offset {offset}: {apart:.1f} dB", flush=True)
                self.assertGreater(apart, 45)
                self.assertLess(decibels(result, self.buffer("sharp")[..., :3]), 40)

    def test_tori_gathered_are_those_of_the_program(self):
        for taps in (16, 43):
            with self.subTest(taps):
                self.choose("gather", focus_m=7, radius_px=14, taps=taps)
                f_number = 0.5 * FOCAL_MM ** 2 / (7000 * 14) * WIDTH / SENSOR_MM
                apart = decibels(self.buffer("result")[..., :3], self.program(f_number, 7, "--engine", "gather", "--gather-stage", "cure", "--gather-taps", str(taps)))
                print(f"gather, {taps} taps: {apart:.1f} dB", flush=True)
                self.assertGreater(apart, 45)

    def test_one_sprite_per_pixel_keeps_the_light(self):
        self.choose("hexadrive", every=4, radius_px=20)
        self.assertEqual(self.text("told"), "14,400 sprites in one draw.")
        result, sharp = self.buffer("result")[..., :3], self.buffer("sharp")[..., :3]
        self.assertAlmostEqual(float(result.mean() / sharp.mean()), 1, delta=0.1)
        self.assertLess(decibels(result, sharp), 35)
        self.assertTrue(numpy.isfinite(self.buffer("atlas")).all())

    def test_a_key_shows_the_levels(self):
        self.choose("hexadrive", every=8)
        def press(key):
            self.browser.execute_script('dispatchEvent(new KeyboardEvent("keydown", { key: arguments[0] }))', key)
            return self.browser.execute_script('return [articles.view.buffer, document.getElementById("view").width]')
        self.assertEqual(press("a"), ["atlas", 1424])
        self.assertEqual(press("a"), ["result", 640])

    def test_every_buffer_and_control_changes_the_canvas(self):
        for method in ("wgld", "gather"):
            self.choose(method)
            seen = set()
            for buffer in self.browser.execute_script('return [...document.querySelectorAll("[name=buffer]")].map((i) => i.value)'):
                self.browser.execute_script('document.querySelector(`[name="buffer"][value="${arguments[0]}"]`).click()', buffer)
                seen.add(self.browser.execute_script('return document.getElementById("view").toDataURL()'))
            self.assertEqual(len(seen), 6)
            self.browser.execute_script('document.querySelector(`[name="buffer"][value="result"]`).click()')
            usual = self.browser.execute_script('return document.getElementById("view").toDataURL()')
            for knob in self.browser.execute_script('return [...document.querySelectorAll("#knobs input, #knobs select")].map((i) => i.id)'):
                self.browser.execute_script("""
                    const knob = document.getElementById(arguments[0]);
                    knob.value = knob.options ? knob.options[0].value : Number(knob.max) * 0.8;
                    knob.dispatchEvent(new Event("input"));""", knob)
                moved = self.browser.execute_script('return document.getElementById("view").toDataURL()')
                self.assertNotEqual(moved, usual, knob)
                usual = moved
        self.assertEqual(self.complaints(), [])

    def test_it_turns_and_holds_still(self):
        self.browser.execute_script('document.getElementById("turn").click()')
        self.done("new Promise((r) => setTimeout(r, 1500))")
        self.browser.execute_script('document.getElementById("turn").click()')
        turns = self.browser.execute_script("return articles.view.turns")
        self.assertGreater(turns, 0.06)
        self.done("new Promise((r) => setTimeout(r, 300))")
        self.assertEqual(self.browser.execute_script("return articles.view.turns"), turns)

    def test_it_fits_a_phone(self):
        self.narrow(360)
        self.setUp()
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 360)


class WithoutWebGL(Page):
    flags = ("--disable-3d-apis",)

    def test_the_page_says_so(self):
        self.browser.get(f"{self.origin}/articles.html")
        self.assertRegex(self.text("problem"), "has no WebGL2")


if __name__ == "__main__":
    unittest.main()
