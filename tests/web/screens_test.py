"""Screens of the lens lab against stored ones, region by region.

What is stored (tests/web/screens) are means over 10 x 10 pixels: letters that a browser draws a little otherwise do not
count, a part that is missing, cut off or elsewhere does. Usage: pages.py says it; `--accept` stores what is there now.
"""
import base64
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy
from pages import ROOT, Page
from pictures import read_png, write_png

STORED, SEEN = pathlib.Path(__file__).parent / "screens", ROOT / "build/web-screens"
BLOCK, REGION = 10, 5      # pixels of a block, blocks of a region
TOLERANCE = 12             # codes, mean of a region
ACCEPTING = "--accept" in sys.argv


def has_font():
    """True if the pages' font is there; without it everything is laid out otherwise."""
    found = shutil.which("fc-match") and subprocess.run(["fc-match", "system-ui"], capture_output=True, text=True).stdout
    return bool(found) and "DejaVu" in found


def apart(seen, stored):
    """[(codes, x, y in pixels)] of every region, the worst first."""
    differences = numpy.abs(seen.astype(float) - stored)
    regions = [(differences[y:y + REGION, x:x + REGION].mean(), x * BLOCK, y * BLOCK)
               for y in range(0, len(stored), REGION) for x in range(0, len(stored[0]), REGION)]
    return sorted(regions, reverse=True)


@unittest.skipUnless(has_font(), "the font DejaVu Sans is not there (Debian: fonts-dejavu-core)")
class Screens(Page):
    def show(self, page, width, height, dark=False):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 720})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
                                                                                {"name": "prefers-reduced-motion", "value": "reduce"}]})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        self.open(page=page)
        self.done("lab.use({ name: 'doublet', text: null, look: { blades: 9 } })")
        self.idle()
        # Times, and links that depend on what was built.
        self.browser.execute_script("""
            for (const part of document.querySelectorAll("#told, #version, header p")) part.style.visibility = "hidden";
            document.querySelector("header p").style.height = "3rem";""")

    def blocks(self, name):
        """Means of the screen's blocks; the screen itself stays in build/web-screens."""
        taken = self.browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})["data"]
        SEEN.mkdir(parents=True, exist_ok=True)
        (SEEN / f"{name}.png").write_bytes(base64.b64decode(taken))
        columns, rows, codes = self.done("""
            (async () => {
                const image = new Image();
                image.src = "data:image/png;base64," + args[0];
                await image.decode();
                const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext("2d"), side = args[1];
                pen.drawImage(image, 0, 0);
                const { data } = pen.getImageData(0, 0, image.width, image.height), columns = Math.floor(image.width / side), rows = Math.floor(image.height / side);
                const sums = new Float64Array(columns * rows * 3);
                for (let y = 0; y < rows * side; y++) for (let x = 0; x < columns * side; x++) for (let c = 0; c < 3; c++)
                    sums[3 * (Math.floor(y / side) * columns + Math.floor(x / side)) + c] += data[4 * (y * image.width + x) + c];
                return [columns, rows, Array.from(sums, (sum) => Math.round(sum / (side * side)))];
            })()""", taken, BLOCK)
        return numpy.array(codes).reshape(rows, columns, 3)

    def expect(self, name):
        seen, path = self.blocks(name), STORED / f"{name}.png"
        if ACCEPTING:
            write_png(path, seen.reshape(len(seen), -1).tolist())
            return []
        stored = numpy.array(read_png(path)[0]).reshape(-1, seen.shape[1], 3)
        self.assertEqual(seen.shape, stored.shape)
        regions = apart(seen, stored)
        print(f"{name}: regions at most {regions[0][0]:.1f} codes apart", flush=True)
        return [f"{x},{y} ({codes:.0f} codes)" for codes, x, y in regions if codes > TOLERANCE]

    def test_pages_look_as_they_did(self):
        for name, page, size, dark in (("desktop", "index.html", (1280, 900), False), ("dark", "index.html", (800, 900), True), ("phone", "index.html", (360, 740), False)):
            with self.subTest(name):
                self.show(page, *size, dark)
                self.assertEqual(self.expect(name), [], f"see {SEEN / name}.png")

    @unittest.skipIf(ACCEPTING, "nothing is compared")
    def test_a_part_that_is_missing_is_noticed(self):
        self.show("index.html", 1280, 900)
        self.browser.execute_script("document.getElementById('section').style.visibility = 'hidden'")
        self.assertTrue(self.expect("desktop"))


if __name__ == "__main__":
    if ACCEPTING:
        sys.argv.remove("--accept")
        STORED.mkdir(exist_ok=True)
    unittest.main()
