"""The pages of the lens lab without a mouse, for screen readers, with less motion, and without WebAssembly.

Usage: pages.py says it.
"""
import unittest

import pages
from pages import SECONDS, SITE, ActionChains, Page, WebDriverWait
from selenium.webdriver.common.keys import Keys

PAGES = ("index.html", "story.html", "articles.html", "lenses/index.html", "lenses/takumar.html",
         *(["three/demo.html"] if (SITE / "three").exists() else []))
NAMED = {"button", "link", "slider", "textbox", "searchbox", "combobox", "spinbutton", "checkbox", "radio", "image", "img", "list", "group"}


class Access(Page):
    def load(self, page):
        self.browser.get("about:blank")
        self.browser.get(f"{self.origin}/{page}")
        WebDriverWait(self.browser, SECONDS).until(
            lambda b: b.execute_script("return document.readyState === 'complete' && !document.querySelector('[aria-busy=\"true\"]')"))

    def test_everything_that_is_used_or_shown_has_a_name(self):
        for page in PAGES:
            with self.subTest(page):
                self.load(page)
                nodes = self.browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
                used = [node for node in nodes if not node.get("ignored") and node["role"]["value"] in NAMED - {"group", "list"}]
                self.assertGreater(len(used), 1)
                html = [self.browser.execute_cdp_cmd("DOM.describeNode", {"backendNodeId": node["backendDOMNodeId"]})["node"].get("attributes")
                        for node in used if not node.get("name", {}).get("value")]
                self.assertEqual(html, [])

    def test_tab_reaches_everything_and_shows_where_it_is(self):
        for page in PAGES[:3]:
            with self.subTest(page):
                self.load(page)
                names = self.browser.execute_script("""
                    globalThis.stops = [...document.querySelectorAll('a[href], button, input:not([type="radio"]), select, textarea, summary, [tabindex="0"], input:checked')]
                        .filter((e) => !e.disabled && e.checkVisibility() && e.getClientRects().length);
                    return stops.map((e) => e.id || e.textContent || e.outerHTML.slice(0, 60));""")
                seen = {}
                for _ in range(len(names) + 3):
                    ActionChains(self.browser).send_keys(Keys.TAB).perform()
                    stop, is_shown = self.browser.execute_script("""
                        const e = document.activeElement, seen = e.classList.contains("hidden-file") ? e.closest("label") : e, style = getComputedStyle(seen);
                        return [stops.indexOf(e), style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0];""")
                    if stop >= 0:
                        seen[names[stop]] = is_shown
                self.assertEqual(set(names) - set(seen), set())
                self.assertEqual([name for name, is_shown in seen.items() if not is_shown], [])

    def test_arrow_keys_move_the_light(self):
        self.load("index.html")
        self.browser.execute_script("document.getElementById('frame').focus()")
        ActionChains(self.browser).send_keys(Keys.ARROW_RIGHT).perform()
        self.assertAlmostEqual(self.browser.execute_script("return lab.state.light.x"), 0.05)

    def test_nothing_moves_by_itself_for_who_wants_less_motion(self):
        self.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-reduced-motion", "value": "reduce"}]})
        self.addCleanup(self.browser.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        for page in PAGES[:3]:
            with self.subTest(page):
                self.load(page)
                moving = self.browser.execute_script("""
                    return [...document.querySelectorAll("*")].filter((e) => parseFloat(getComputedStyle(e).transitionDuration) > 0 || getComputedStyle(e).animationName !== "none").length
                        + document.getAnimations().length + document.querySelectorAll('[aria-pressed="true"]').length;""")
                self.assertEqual(moving, 0)


class Broken(pages.WithoutWebAssembly):
    def test_the_story_says_so_and_can_be_read(self):
        self.browser.get(f"{self.origin}/story.html")
        WebDriverWait(self.browser, SECONDS).until(lambda b: self.text("problem"))
        self.assertRegex(self.text("problem"), "cannot compute the figures")
        self.assertGreater(len(self.text("tale")), 2000)


if __name__ == "__main__":
    unittest.main()
