"""The static pages of ./dev site in a headless Chromium: on a phone, in the dark scheme, by keyboard, and without other hosts.

Usage: site_test.py SITE [--pictures FOLDER] [ARGS of unittest]; runs with /usr/bin/python3 (Debian's: selenium is its
package). --pictures writes a page of each kind, as a desktop and a phone show it, as PNG.
"""
import base64
import functools
import http.server
import json
import pathlib
import sys
import threading
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "browser")]
from chromium import browser  # noqa: E402

SITE = pathlib.Path(sys.argv.pop(1))
PICTURES = pathlib.Path(sys.argv.pop(sys.argv.index("--pictures") + 1)) if "--pictures" in sys.argv else None
if PICTURES:
    sys.argv.remove("--pictures")
KINDS = {"start": "index.html", "guide": "guide/first-picture.html", "reference": "reference/look-fields.html",
         "explain": "explain/scatter.html", "results": "results/quality.html", "conventions": "conventions.html"}
DESKTOP, PHONE = (1280, 900, False), (360, 740, True)

# Texts whose contrast with the first opaque background behind them is below WCAG 2.1, 1.4.3: 4.5, or 3 for large text.
FAINT = """
    const light = ([r, g, b]) => [r, g, b].map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const colour = (css) => {  // any CSS colour, as red, green, blue and alpha of 255
        canvas.clearRect(0, 0, 1, 1), canvas.fillStyle = css, canvas.fillRect(0, 0, 1, 1);
        return [...canvas.getImageData(0, 0, 1, 1).data];
    };
    const over = (top, below) => top.slice(0, 3).map((c, i) => c * top[3] / 255 + below[i] * (1 - top[3] / 255));
    const behind = (element) => {
        const own = element ? colour(getComputedStyle(element).backgroundColor) : [255, 255, 255, 255];
        return own[3] === 255 ? own.slice(0, 3) : over(own, behind(element.parentElement));
    };
    const found = [], walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const text = walker.currentNode.textContent.trim(), element = walker.currentNode.parentElement;
        const style = getComputedStyle(element);
        if (!text || !element.getClientRects().length || style.visibility === "hidden" || element.closest(".headerlink")) continue;
        const ground = behind(element), ink = over(colour(style.color), ground);
        const [a, b] = [light(ink), light(ground)].sort((x, y) => y - x);
        const px = parseFloat(style.fontSize), large = px >= 24 || (px >= 18.66 && style.fontWeight >= 700);
        if ((a + 0.05) / (b + 0.05) < (large ? 3 : 4.5)) found.push(`${((a + 0.05) / (b + 0.05)).toFixed(1)}: ${text.slice(0, 60)}`);
    }
    return found;"""

# What has the focus of the keyboard, and whether the page shows that.
FOCUSED = """
    const e = document.activeElement, s = getComputedStyle(e);
    const shown = s.outlineStyle !== "none" && parseFloat(s.outlineWidth) > 0 || s.boxShadow !== "none";
    return [e.tagName, e.className + "", e.getAttribute("href") || "", shown];"""


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        class Quiet(http.server.SimpleHTTPRequestHandler):
            def log_message(self, *_):
                pass

        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(SITE)))
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.origin = f"http://127.0.0.1:{cls.server.server_port}"
        cls.browser = browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.shutdown()

    def open(self, page, screen=DESKTOP, scheme="light"):
        width, height, mobile = screen
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": mobile})
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                     {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
        self.browser.get(f"{self.origin}/{page}")
        if self.browser.execute_script("const kept = localStorage.length; localStorage.clear(); return kept"):
            self.browser.get(f"{self.origin}/{page}")  # the scheme is the visitor's choice, and stored

    def press(self, key, code):
        for kind in ("rawKeyDown", "keyUp"):
            self.browser.execute_cdp_cmd("Input.dispatchKeyEvent", {"type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code})

    def test_no_page_scrolls_sideways_at_360_px(self):
        pages = sorted(p.relative_to(SITE).as_posix() for p in SITE.rglob("*.html"))
        self.assertGreater(len(pages), 40)
        for page in pages:
            with self.subTest(page):
                self.open(page, PHONE)
                wide = self.browser.execute_script("return document.documentElement.scrollWidth")
                self.assertLessEqual(wide, 360)

    def test_texts_stand_out_in_both_schemes(self):
        for page in KINDS.values():
            for scheme in ("light", "dark"):
                with self.subTest(page, scheme=scheme):
                    self.open(page, DESKTOP, scheme)
                    dark = self.browser.execute_script("return document.body.dataset.mdColorScheme")
                    self.assertEqual(dark, "slate" if scheme == "dark" else "default")
                    self.assertEqual(self.browser.execute_script(FAINT), [])

    def test_the_scheme_follows_the_system_on_later_visits(self):
        self.open(KINDS["start"])
        for scheme, shown in (("light", "default"), ("dark", "slate"), ("light", "default")):
            self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                         {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
            self.browser.get(f"{self.origin}/{KINDS['guide']}")
            self.assertEqual(self.browser.execute_script("return document.body.dataset.mdColorScheme"), shown)

    def test_every_link_of_a_page_is_reached_by_tab_and_shows_it(self):
        self.open(KINDS["guide"])
        links = set(self.browser.execute_script("""return [...document.querySelectorAll("article a[href], .md-tabs a[href]")]
            .filter((a) => a.getClientRects().length && !a.classList.contains("headerlink")).map((a) => a.getAttribute("href"))"""))
        reached = set()
        for _ in range(300):
            self.press("Tab", 9)
            tag, kind, target, shown = self.browser.execute_script(FOCUSED)
            if tag == "BODY":
                break
            reached.add(target)
            self.assertTrue(shown or tag != "A", f"{target} ({kind}) has the focus, but does not show it")
        self.assertEqual(links - reached, set())

    def test_nothing_is_asked_of_other_hosts(self):
        self.browser.get_log("performance")
        for page in KINDS.values():
            self.open(page)
        asked = [json.loads(row["message"])["message"] for row in self.browser.get_log("performance")]
        urls = [m["params"]["request"]["url"] for m in asked if m["method"] == "Network.requestWillBeSent"]
        self.assertGreater(len(urls), len(KINDS))
        self.assertEqual([u for u in urls if not u.startswith((self.origin, "data:", "blob:"))], [])

    @unittest.skipUnless(PICTURES, "--pictures was not given")
    def test_pictures_of_a_page_of_each_kind(self):
        PICTURES.mkdir(parents=True, exist_ok=True)
        for kind, page in KINDS.items():
            for name, screen, scheme in (("desktop", DESKTOP, "light"), ("phone", PHONE, "light"), ("phone-dark", PHONE, "dark")):
                self.open(page, screen, scheme)
                shot = self.browser.execute_cdp_cmd("Page.captureScreenshot", {"format": "png"})
                (PICTURES / f"{kind}-{name}.png").write_bytes(base64.b64decode(shot["data"]))


if __name__ == "__main__":
    unittest.main()
