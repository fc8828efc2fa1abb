"""The story of the lens lab: every figure answers its controls.

Usage: pages.py says it.
"""
import unittest

from pages import SECONDS, Page, WebDriverWait


class Story(Page):
    def setUp(self):
        self.browser.get(f"{self.origin}/story.html")
        WebDriverWait(self.browser, SECONDS).until(
            lambda b: b.execute_script('return document.getElementById("tale").getAttribute("aria-busy") === "false"'))

    def drawn(self, figure):
        return self.browser.execute_script("""
            return [...document.querySelectorAll(`[data-figure="${arguments[0]}"] canvas, [data-figure="${arguments[0]}"] svg`)]
                .map((d) => d.toDataURL ? d.toDataURL() : d.innerHTML);""", figure)

    def names(self):
        return self.browser.execute_script("return [...document.querySelectorAll('[data-figure]')].map((f) => f.dataset.figure)")

    def test_every_control_changes_its_figure(self):
        self.assertEqual(len(self.names()), 8)
        for name in self.names():
            self.done("story[args[0]].update()", name)
            usual = self.drawn(name)
            for number in range(self.browser.execute_script("return document.querySelectorAll(`[data-figure='${arguments[0]}'] :is(input, select)`).length", name)):
                with self.subTest(f"{name} {number}"):
                    self.browser.execute_script("""
                        const knob = document.querySelectorAll(`[data-figure="${arguments[0]}"] :is(input, select)`)[arguments[1]];
                        knob.value = knob.options ? knob.options[knob.options.length - 1].value : Number(knob.max) * 0.3;
                        knob.dispatchEvent(new Event("input"));""", name, number)
                    self.done("story[args[0]].update()", name)
                    changed = self.drawn(name)
                    self.assertTrue(changed != usual, "nothing changed")
                    usual = changed
        self.assertEqual(self.complaints(), [])

    def test_a_simple_lens_is_hard_in_front_and_soft_behind(self):
        """As the text says: the brightest ring of the disc lies at the rim in front of focus and in the middle behind it."""
        self.done("story.rims.update()")
        front, behind = self.browser.execute_script("""
            return [...document.querySelectorAll('[data-figure="rims"] canvas')].map((canvas) => {
                const { width, height } = canvas, row = canvas.getContext("2d").getImageData(0, height >> 1, width, 1).data;
                const line = Array.from({ length: width >> 1 }, (_, i) => row[4 * ((width >> 1) + i)]);
                return { middle: line[0], rim: Math.max(...line.slice(line.length >> 1)) };
            });""")
        self.assertGreater(front["rim"], front["middle"])
        self.assertGreater(behind["middle"], behind["rim"])

    def test_it_fits_a_phone_and_asks_nobody_else(self):
        self.narrow(360)
        self.requests()
        self.setUp()
        self.assertLessEqual(self.browser.execute_script("return document.documentElement.scrollWidth"), 360)
        self.assertEqual([url for url in self.requests() if not url.startswith((self.origin, "blob:", "data:", "about:"))], [])


if __name__ == "__main__":
    unittest.main()
