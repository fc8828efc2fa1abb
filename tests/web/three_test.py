"""The three.js pass in a headless Chromium: beside the program on the same light and depth, and what it says of bad input.

Usage: pages.py says it.
"""
import base64
import json
import math
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

from pages import PETZVAL, ROOT, SITE, By, Page
from selenium.webdriver.common.keys import Keys

from pictures import camera_attributes, read_exr, write_exr

WIDTH, HEIGHT = 320, 180
README = (ROOT / "web/three/README.md").read_text()
# Code that the README leaves to its reader, and a frame at the end.
AROUND = """const {{ renderer, scene, camera }} = demo, width = {width}, height = {height};
{block}
const shown = () => (composer.render(), renderer.domElement.toDataURL());
export const open = shown();
blur.lens.fStop = 16;
export const stopped = shown();
export const angle = camera.fov, atlas = blur.lens.atlas;
"""
ASK = """
const base64 = (floats) => {
  const bytes = new Uint8Array(floats.buffer);
  let text = "";
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
};"""


def psnr(one, other):
    """dB of the linear light, values above 1 cut; alpha is left out."""
    error = sum((min(a, 1.0) - min(b, 1.0)) ** 2 for c in "RGB" for rows in zip(one[c], other[c]) for a, b in zip(*rows))
    return 10 * math.log10(3 * WIDTH * HEIGHT / max(error, 1e-9))


@unittest.skipUnless((SITE / "three").exists(), "npm is not installed: no demo of three.js")
class Three(Page):
    def setUp(self):
        self.open(page="three/demo.html")
        self.console()

    def console(self):
        return [entry["message"] for entry in self.browser.get_log("browser") if "petzval:" in entry["message"] or "rror" in entry["message"]]

    def frame(self, lens, focal_mm, f_number, focus_m):
        """Light, light with depth and blurred light of the scene, as channels of an EXR."""
        self.assertIsNone(self.done("demo.use(args[0])", lens))
        read = self.browser.execute_script(ASK + """
            demo.lens.focalLength = arguments[2], demo.lens.fStop = arguments[3], demo.lens.focusDistance = arguments[4];
            return Object.fromEntries(Object.entries(demo.buffers(arguments[0], arguments[1])).map(([name, floats]) => [name, base64(floats)]));""",
                                           WIDTH, HEIGHT, focal_mm, f_number, focus_m)
        values = {name: struct.unpack(f"<{4 * WIDTH * HEIGHT}f", base64.b64decode(text)) for name, text in read.items()}
        rows = {name: [[value[4 * (y * WIDTH + x):4 * (y * WIDTH + x) + 4] for x in range(WIDTH)] for y in range(HEIGHT)] for name, value in values.items()}
        plane = lambda name, c: [[texel[c] for texel in row] for row in rows[name]]  # noqa: E731
        sharp, blurred = ({c: plane(name, i) for i, c in enumerate("RGB")} for name in ("sharp", "blurred"))
        return {**sharp, "A": [[1.0] * WIDTH] * HEIGHT, "Z": plane("metres", 0)}, blurred

    def tint(self, metres, blurred, expected, focal_mm):
        """How far green / red of the floor in front of focus is off, at the worst tenth of its pixels."""
        lens_px = focal_mm / 36 * WIDTH
        floor = [(x, y) for y in range(HEIGHT * 11 // 20, HEIGHT) for x in range(WIDTH)
                 if metres[y][x] < 6 and abs(metres[y][x] * (y + 0.5 - HEIGHT / 2) / lens_px / 0.75 - 1) < 0.02]
        ratio = lambda light, x, y: light["G"][y][x] / max(light["R"][y][x], 1e-6)  # noqa: E731
        apart = sorted(abs(ratio(blurred, x, y) / ratio(expected, x, y) - 1) for x, y in floor)
        return apart[len(apart) * 9 // 10]

    def test_a_frame_is_that_of_gather(self):
        # Focused at 7 m, balls and floor lie in front.
        for lens, focal_mm, f_number, focus_m, at_least in (("doublet", 50, 2, 2, 27), ("petzval-portrait", 70, 3.6, 2, 29), ("doublet", 45, 1.4, 7, 29)):
            with self.subTest(lens, focus_m=focus_m), tempfile.TemporaryDirectory() as folder:
                sharp, blurred = self.frame(lens, focal_mm, f_number, focus_m)
                write_exr(folder + "/in.exr", sharp, attributes=camera_attributes(focal_mm, 36, f_number, focus_m))
                subprocess.run([PETZVAL, "defocus", folder + "/in.exr", "-o", folder + "/out.exr", "--engine", "gather", "--lens", lens,
                                "--max-radius", "32", "-q"], check=True, capture_output=True)
                expected = read_exr(folder + "/out.exr")[0]
                reached, before = psnr(blurred, expected), psnr(sharp, expected)
                print(f"{lens}, focused at {focus_m} m: {reached:.2f} dB, sharp {before:.2f} dB")
                self.assertGreater(reached, at_least)
                if focus_m == 2:
                    self.assertGreater(reached, before + 5)
                else:
                    tint = self.tint(sharp["Z"], blurred, expected, focal_mm)
                    print(f"tint of the floor {tint:.3f}")
                    self.assertLess(tint, 0.1)
                energy = sum(map(sum, blurred["G"])) / sum(map(sum, expected["G"]))
                self.assertAlmostEqual(energy, 1, delta=0.05)

    def test_a_straight_edge_has_no_grain(self):
        off, rim = self.done("""import("three").then((THREE) => {
            const width = 160, height = 90, { renderer, camera, lens } = demo, metres = 40;
            const pixels = new Float32Array(4 * width * height).map((_, i) => (i >= 2 * width * height ? 0 : 1));
            const colour = new THREE.DataTexture(pixels, width, height, THREE.RGBAFormat, THREE.FloatType);
            const far = camera.far, near = camera.near, at = (far / (far - near)) * (1 - near / metres);
            const depth = new THREE.DataTexture(new Float32Array(width * height).fill(at), width, height, THREE.RedFormat, THREE.FloatType);
            colour.needsUpdate = depth.needsUpdate = true;
            const made = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType }), read = new Float32Array(4 * width * height);
            Object.assign(lens, { focalLength: 85, fStop: 1, focusDistance: 1, lampFactor: 0, maxRadius: 16 });
            lens.setSize(width, height);
            lens.render(renderer, colour, depth, made);
            renderer.readRenderTargetPixels(made, 0, 0, width, height, read);
            let off = 0, rim = 0;
            for (let y = 20; y < 70; y++) {
              const row = Array.from({ length: 60 }, (_, i) => read[4 * (y * width + 50 + i)]), mean = row.reduce((a, b) => a + b) / 60;
              rim += mean > 0.05 && mean < 0.95;
              off = Math.max(off, ...row.map((value) => Math.abs(value - mean)));
            }
            return [off, rim];
        })""")
        print(f"grain of an edge: {off:.3f} of its light, {rim} rows")
        self.assertGreater(rim, 12)
        self.assertLess(off, 0.03)

    def test_the_page_focuses_where_it_is_clicked_and_changes_lenses(self):
        shown = lambda: self.browser.execute_script("demo.draw(); return document.getElementById('view').toDataURL()")  # noqa: E731
        first = shown()
        self.assertTrue(self.browser.execute_script("""
            const view = document.getElementById("view"), box = view.getBoundingClientRect();
            view.dispatchEvent(new MouseEvent("click", { clientX: box.left + 0.96 * box.width, clientY: box.top + 0.7 * box.height }));
            return demo.lens.focusDistance > 4;"""))
        clicked = shown()
        self.assertNotEqual(first, clicked)
        self.assertIsNone(self.done("demo.use('double-gauss')"))
        self.assertNotEqual(clicked, shown())
        self.assertEqual(self.console(), [])

    def test_it_fits_a_phone_and_focuses_by_keyboard(self):
        self.narrow(360)
        self.open(page="three/demo.html")
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 360)
        slider = self.browser.find_element(By.ID, "focus")
        slider.send_keys(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(self.browser.execute_script("return demo.lens.focusDistance"), 2.1)
        self.assertEqual(self.text("focus-value"), "2.10 m")
        self.assertEqual(self.console(), [])

    def test_without_depth_or_lens_it_says_so_once_and_stays_sharp(self):
        for setting, word in (("demo.lens.atlas = null", "LensAtlas.load"), ("demo.composer.readBuffer.depthTexture = demo.composer.writeBuffer.depthTexture = null", "depth texture")):
            self.open(page="three/demo.html")
            self.console()
            self.browser.execute_script(setting + "; demo.draw(); demo.draw(); demo.draw();")
            said = self.console()
            self.assertEqual(len(said), 1, said)
            self.assertIn(word, said[0])

    def test_a_bad_atlas_is_one_sentence(self):
        self.assertRegex(self.done("demo.use('no-such-lens')"), "^refused: petzval: the lens atlas lenses/no-such-lens/atlas.json cannot be loaded: 404")
        self.assertRegex(self.done("demo.use('../vendor')"), "cannot be loaded")
        damaged = self.done("""import("./index.js").then(async ({ LensAtlas }) => {
            const header = await (await fetch("lenses/doublet/atlas.json")).json();
            return new LensAtlas(header, new ArrayBuffer(100), "x"); })""")
        self.assertRegex(damaged, "^refused: petzval: the lens atlas x needs [0-9]+ bytes of texels, not 100")

    def test_the_block_of_the_readme_draws_a_frame(self):
        blocks = re.findall(r"^```js\n(.*?)^```", README, re.M | re.S)
        self.assertEqual(len(blocks), 1)
        text = AROUND.format(width=WIDTH, height=HEIGHT, block=blocks[0].replace('"petzval-three"', f'"{self.origin}/three/index.js"'))
        before = self.browser.execute_script("return demo.camera.fov")
        made = self.done("""import(URL.createObjectURL(new Blob([args[0]], { type: "text/javascript" })))
            .then(({ open, stopped, angle, atlas }) => ({ differ: open !== stopped, angle, has_lens: Boolean(atlas) }))""", text)
        self.assertIsInstance(made, dict, made)
        self.assertTrue(made["differ"] and made["has_lens"], made)
        self.assertNotAlmostEqual(made["angle"], before)
        self.assertEqual(self.console(), [])

    def test_the_command_of_the_readme_writes_the_lens_of_that_size(self):
        command, kilobytes = re.search(r"`petzval (lens atlas [^`]*)` writes the lens \((\d+) kB\)", README).groups()
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PETZVAL, *command.split(), "-q"], cwd=folder, check=True, capture_output=True)
            written = pathlib.Path(folder, command.split()[-1])
            self.assertEqual(json.loads((written / "atlas.json").read_text())["name"], command.split()[2])
            self.assertAlmostEqual(sum(f.stat().st_size for f in written.iterdir()) / 1000, int(kilobytes), delta=1)

    def test_pmndrs_composer_draws_the_same_lens(self):
        made = self.done("""Promise.all([import("three"), import("./vendor/postprocessing.js"), import("./index.js")]).then(([THREE, pmndrs, { pmndrsLensPass }]) => {
            const { renderer, scene, camera, lens } = demo;
            renderer.toneMapping = THREE.NoToneMapping;
            const composer = new pmndrs.EffectComposer(renderer, { frameBufferType: THREE.HalfFloatType });
            const pass = pmndrsLensPass(pmndrs.Pass, camera, { atlas: lens.atlas, fStop: 1.4 });
            composer.addPass(new pmndrs.RenderPass(scene, camera));
            composer.addPass(pass);
            const shown = () => (composer.render(), renderer.domElement.toDataURL());
            const open = shown();
            pass.lens.fStop = 16;
            return open !== shown() && Boolean(pass.lens.depthTexture); })""")
        self.assertIs(made, True)


if __name__ == "__main__":
    unittest.main()
