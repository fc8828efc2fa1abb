"""Screens of the window against stored ones, region by region.

What is stored (tests/view/screens) are means over 10 x 10 pixels: letters and edges that a driver draws a little
otherwise do not count, a panel that is missing, cut off or elsewhere does. `--accept` stores what is there now.
"""
import os
import sys

import window
from window import png_codes

STORED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "screens")
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # the window's; without it all is laid out otherwise
BLOCK, REGION = 10, 5      # pixels of a block, blocks of a region
TOLERANCE = 12             # codes, mean of a region


def regions_apart(seen, stored):
    """(codes apart, x, y in pixels) of every region, the worst first."""
    apart = []
    for y in range(0, len(stored), REGION):
        for x in range(0, len(stored[0]), REGION):
            differences = [abs(a - b) for row, other in zip(seen[y:y + REGION], stored[y:y + REGION])
                           for one, two in zip(row[x:x + REGION], other[x:x + REGION]) for a, b in zip(one, two)]
            apart.append((sum(differences) / len(differences), x * BLOCK, y * BLOCK))
    return sorted(apart, reverse=True)


class ScreensTest(window.WindowTest):
    accepting = False

    def setUp(self):
        if not os.path.exists(FONT):
            self.skipTest(FONT + " is not there (Debian: fonts-dejavu-core)")

    def expect_screens(self, *names):
        wrong = []
        for name in names:
            blocks, screen = self.contents(name + "-blocks.png", name + ".png")
            path = os.path.join(STORED, name + ".png")
            if self.accepting:
                with open(path, "wb") as file:
                    file.write(blocks)
                continue
            with open(path, "rb") as file:
                seen, stored = png_codes(blocks), png_codes(file.read())
            self.assertEqual((len(seen), len(seen[0])), (len(stored), len(stored[0])), name)
            regions = regions_apart(seen, stored)
            print("%s: at most %.1f codes apart" % (name, regions[0][0]))
            bad = ["%d,%d (%.0f codes)" % (x, y, codes) for codes, x, y in regions if codes > TOLERANCE]
            if bad:
                kept = os.path.abspath(name + "-screen.png")
                with open(kept, "wb") as file:
                    file.write(screen)
                wrong.append("%s: %d regions differ, at %s; see %s" % (name, len(bad), ", ".join(bad[:4]), kept))
        if wrong:
            self.fail("\n".join(wrong))

    def test_a_picture_with_its_panels(self):
        self.do("""
            wait
            focus 165 100
            set fstop 2
            click view.overlay
            click "wipe sharp"
            wait
            shot focus.png
            shot focus-blocks.png %d
            click "wipe sharp"
            click view.overlay
            set lens doublet
            pick 250 40
            key l
            wait
            expect no error
            shot lens.png
            shot lens-blocks.png %d
            key l
            key tab
            key h
            wait
            shot help.png
            shot help-blocks.png %d
        """ % (BLOCK, BLOCK, BLOCK))
        self.expect_screens("focus", "lens", "help")

    def test_a_scene_of_an_article(self):
        self.do("""
            wait
            buffer "depth index"
            wait
            expect no error
            shot wgld.png
            shot wgld-blocks.png %d
        """ % BLOCK, "--scene", "wgld", "--scene-size", "320x180")
        self.expect_screens("wgld")


if __name__ == "__main__":
    if "--accept" in sys.argv:
        sys.argv.remove("--accept")
        ScreensTest.accepting = True
    window.run()
