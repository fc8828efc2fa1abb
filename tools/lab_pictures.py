"""Takes the pictures of docs/results/lens-lab.md in a headless Chromium.

Usage: /usr/bin/python3 tools/lab_pictures.py PETZVAL, after ./dev web. Writes docs/pictures/lab/*.png.
"""
import base64
import pathlib
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/web"))
from pages import SECONDS, SITE, browser, server_of  # noqa: E402
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

OUT = ROOT / "docs/pictures/lab"
PATENT = """f = 100  F/3.5   front group of a triplet, made up
1   26.2    5.0   1.6170  53.9   24
2   ∞       10.1                 24
3   -58.0   1.5   1.5796  41.0   19
4   24.5    2.5                  18
5   stop    10.0
6   166.0   5.6   1.6170  53.9   20
7   -40.5   85.0                 20
"""


class Camera:
    def __init__(self):
        self.server = server_of(SITE)
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        self.browser = browser()
        self.browser.set_script_timeout(5 * SECONDS)

    def open(self, page, width=1280, height=900, dark=False):
        self.width, self.height = width, height
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 720})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})
        self.browser.get("about:blank")
        self.browser.get(f"http://127.0.0.1:{self.server.server_port}/{page}")
        self.until("!document.querySelector('[aria-busy=\"true\"]')")

    def until(self, condition):
        WebDriverWait(self.browser, 5 * SECONDS).until(lambda b: b.execute_script(f"return {condition}"))

    def does(self, script):
        self.browser.execute_async_script(f"const done = arguments[arguments.length - 1]; (async () => {{ {script} }})().finally(done);")

    def settled(self):
        """The kernel has answered everything that was asked."""
        self.does("for (let i = 0; i < 3; i++) { await new Promise((later) => setTimeout(later, 400)); await lab.kernel.ask('version'); }")

    def take(self, name, selector=None):
        if selector:
            self.browser.execute_script(f"document.querySelector({selector!r}).scrollIntoView()")
            time.sleep(0.5)
        clip = {"x": 0, "y": self.browser.execute_script("return scrollY"), "width": self.width, "height": self.height, "scale": 0.5}
        taken = self.browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png", "clip": clip})["data"]
        (OUT / f"{name}.png").write_bytes(base64.b64decode(taken))
        print(name, flush=True)


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    camera = Camera()
    for name, size in (("desktop", (1280, 900)), ("phone", (360, 740)), ("dark", (800, 900))):
        camera.open("index.html", *size, dark=name == "dark")
        camera.does("await lab.use({ name: 'doublet', text: null, look: { blades: 9 } }); document.getElementById('texture-details').open = true")
        camera.settled()
        camera.take(name, "#controls" if name == "phone" else None)
    camera.open("story.html")
    camera.does("await Promise.all([story.rims.update(), story.colour.update()])")
    camera.take("story", "[data-figure=rims]")
    camera.open("articles.html")
    camera.take("articles")
    camera.open("lenses/triplet-cooke.html", 1280, 1100)
    camera.take("lens-page")
    camera.open("index.html", 1280, 900)
    camera.browser.execute_script("document.getElementById('paste-details').open = true; document.getElementById('paste').value = arguments[0]", PATENT)
    camera.take("patent-1", ".lens")
    camera.browser.execute_script("document.getElementById('use-paste').click()")
    camera.until("lab.state.lens.text && document.querySelectorAll('#paste-notes li').length")
    camera.settled()
    camera.take("patent-2", "#paste-notes")
    camera.browser.quit()


if __name__ == "__main__":
    main()
