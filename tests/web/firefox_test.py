"""The pages in Firefox: tests of Chromium that need no key, pointer or network log, and the pages' consoles.

Usage: pages.py says it. Skipped where Firefox or Xvfb is not installed.
"""
import unittest

import articles_test
import firefox
import lab_test
import picture_test
import three_test
from pages import SECONDS, SITE, Page

MISSING = firefox.why_not()


@unittest.skipIf(MISSING, f"{MISSING}: pages are not tested in Firefox")
class InFirefox(Page):
    @classmethod
    def make_browser(cls):
        return firefox.Firefox(SECONDS)

    def tearDown(self):
        self.assertEqual(self.complaints(), [])


class Lab(InFirefox):
    disc_of_page = lab_test.Lab.disc_of_page
    test_discs_are_those_of_the_program = lab_test.Lab.test_discs_are_those_of_the_program
    test_every_control_changes_the_disc_or_is_switched_off = lab_test.Lab.test_every_control_changes_the_disc_or_is_switched_off


class Picture(InFirefox):
    show, rgb = picture_test.Picture.show, picture_test.Picture.rgb
    files_of_page, program = picture_test.Picture.files_of_page, picture_test.Picture.program
    test_live_and_developed_frames_are_those_of_the_program = picture_test.Picture.test_live_and_developed_frames_are_those_of_the_program


class Articles(InFirefox):
    setUp, choose = articles_test.Articles.setUp, articles_test.Articles.choose
    buffer, program = articles_test.Articles.buffer, articles_test.Articles.program
    test_tori_of_wgld_are_those_of_the_program = articles_test.Articles.test_tori_of_wgld_are_those_of_the_program


@unittest.skipUnless((SITE / "three").exists(), "npm is not installed: no demo of three.js")
class Three(InFirefox):
    setUp, console = three_test.Three.setUp, three_test.Three.console
    frame, tint = three_test.Three.frame, three_test.Three.tint
    test_a_frame_is_that_of_gather = three_test.Three.test_a_frame_is_that_of_gather


if __name__ == "__main__":
    unittest.main()
