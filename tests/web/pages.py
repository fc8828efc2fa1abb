"""A headless Chromium and a server of the lens lab, for the tests of its pages.

Tests take the path of the program as their first argument, and run with /usr/bin/python3 (Debian's: selenium is its
package) after ./dev web.
"""
import base64
import json
import os
import pathlib
import shutil
import sys
import tempfile
import threading
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/cli"), str(ROOT / "tests/browser"), str(ROOT / "tools")]
from chromium import browser  # noqa: E402
from web import SITE, server_of  # noqa: E402

from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.support.ui import WebDriverWait  # noqa: E402

PETZVAL = sys.argv.pop(1)
SECONDS = 120


class Page(unittest.TestCase):
    site, flags = SITE, ()

    @classmethod
    def setUpClass(cls):
        cls.server = server_of(cls.site)
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.origin = f"http://127.0.0.1:{cls.server.server_port}"
        cls.browser = cls.make_browser()

    @classmethod
    def make_browser(cls):
        made = browser(*cls.flags)
        made.set_script_timeout(SECONDS)
        return made

    @classmethod
    def tearDownClass(cls):
        cls.browser.quit()
        cls.server.shutdown()

    def open(self, fragment="", width=1280, height=900, page="index.html"):
        self.browser.set_window_size(width, height)
        self.browser.get("about:blank")
        self.browser.get(f"{self.origin}/{page}{fragment}")
        WebDriverWait(self.browser, SECONDS).until(
            lambda b: b.execute_script('return document.getElementById("lab").getAttribute("aria-busy") === "false"'))

    def text(self, name):
        return self.browser.execute_script("return document.getElementById(arguments[0]).textContent", name)

    def ask(self, call, **args):
        """A call of the page's kernel; pixels come as a list."""
        done = self.browser.execute_async_script("""
            const [call, args, finish] = arguments;
            lab.kernel.ask(call, args).then(({ result }) => finish(result?.pixels ? { ...result, pixels: Array.from(result.pixels) } : result),
                                            (error) => finish({ refused: error.message }));""", call, args)
        self.assertFalse(isinstance(done, dict) and "refused" in done, done)
        return done

    def done(self, promise, *args):
        """What a promise of the page comes to; a refusal is the sentence of its error."""
        return self.browser.execute_async_script(f"""
            const args = [...arguments], finish = args.pop();
            ({promise}).then((value) => finish(value ?? null), (error) => finish(`refused: ${{error.message}}`));""", *args)

    def floats(self, expression):
        """An array of the page, as bytes."""
        return base64.b64decode(self.browser.execute_script(f"""
            const array = {expression}, bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
            let text = "";
            for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
            return btoa(text);"""))

    def cpu_ms(self):
        """CPU time of the browser's pages and their workers: the clock says little on a busy machine."""
        parents, ticks = {}, {}
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                fields = stat.read_text().rsplit(")", 1)[1].split()
                parents[stat.parent.name] = fields[1]
                if "--type=renderer" in (stat.parent / "cmdline").read_text():
                    ticks[stat.parent.name] = int(fields[11]) + int(fields[12])
            except (FileNotFoundError, ProcessLookupError):
                pass

        def is_ours(process):
            while process in parents and process != str(self.browser.service.process.pid):
                process = parents[process]
            return process == str(self.browser.service.process.pid)
        return 1000 * sum(ticks[process] for process in ticks if is_ours(process)) / os.sysconf("SC_CLK_TCK")

    def yardstick_ms(self):
        """CPU time of a fixed piece of arithmetic in the page, and its time by the page's clock: limits of speed are multiples of it, since machines differ."""
        measured = []
        for _ in range(3):
            start = self.cpu_ms()
            clock = self.browser.execute_script("""
                const start = performance.now();
                let x = 2;
                for (let i = 0; i < 2e7; ++i) x = Math.sqrt(x + 1 / x);
                return x > 1 ? performance.now() - start : NaN;""")
            measured.append(((self.cpu_ms() - start) / 2, clock / 2))
        return tuple(map(min, zip(*measured)))

    def idle(self):
        """Waits until the kernel has answered all that was asked, and the texture's turn is over."""
        self.done("new Promise((later) => setTimeout(later, 350)).then(() => lab.kernel.ask('version'))")

    def narrow(self, width):
        # A window is never that narrow in headless mode; the device's metrics are.
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": 700, "deviceScaleFactor": 2, "mobile": True})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.clearDeviceMetricsOverride", {})

    def requests(self):
        """Since the last call: addresses, and bytes that came."""
        events = [json.loads(entry["message"])["message"] for entry in self.browser.get_log("performance")]
        return [event["params"]["request"]["url"] for event in events if event["method"] == "Network.requestWillBeSent"]

    def complaints(self):
        """Errors and warnings of the console, but for the driver's remarks on reading pixels back."""
        return [entry["message"] for entry in self.browser.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING") and "GL Driver Message" not in entry["message"]]


class WithoutWebAssembly(Page):
    """A copy of the site with a program that is not WebAssembly. Subclasses name its file."""

    broken = "petzval-lab.wasm"

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = pathlib.Path(shutil.copytree(SITE, folder.name, dirs_exist_ok=True))
        (cls.site / cls.broken).write_bytes(b"no program")
        super().setUpClass()
