"""What a window opens, and how a choice is taken back: files without camera or depth, undo, defaults."""
import os
import shlex
import shutil
import struct
import subprocess
import unittest

import drop
import window
from window import DISPLAY, PETZVAL, TIME_LIMIT_S


def flat_exr(path, attributes=b"", channels="BGR", width=32, height=16):
    """An EXR of uncompressed floats: colour 0.25, Z 4."""
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value
    listed = b"".join(c.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for c in channels) + b"\0"
    window_ = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    head = (b"\x76\x2f\x31\x01" + struct.pack("<I", 2) + attribute("channels", "chlist", listed)
            + attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window_)
            + attribute("displayWindow", "box2i", window_) + attribute("lineOrder", "lineOrder", b"\0")
            + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
            + attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
            + attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + attributes + b"\0")
    row = b"".join(struct.pack("<f", 4 if c == "Z" else 0.25) * width for c in channels)
    line = 8 + len(row)
    first = len(head) + 8 * height
    table = b"".join(struct.pack("<Q", first + y * line) for y in range(height))
    with open(path, "wb") as file:
        file.write(head + table + b"".join(struct.pack("<iI", y, len(row)) + row for y in range(height)))


class OpenTest(window.WindowTest):
    def path(self, name):
        return os.path.join(self.shared, name)

    def test_a_file_without_camera_numbers_opens_with_assumed_ones_which_the_command_gives(self):
        flat_exr(self.path("bare.exr"), channels="BGRZ")
        out, _ = self.do("""
            wait
            expect no error
            expect frame.engine scatter
            expect focal_length 50
            expect sensor_width 36
            expect fstop 2.8
            expect focus 4
            set fstop 2
            reset fstop
            expect fstop 2.8
            set fstop 1.4
            wait
            save saved.exr
            wait
            copy
            say copied
        """, "bare.exr")
        command = shlex.split(out.strip())
        command[command.index("out.exr")] = "commanded.exr"
        subprocess.run([PETZVAL, *command[1:]], cwd=self.shared, check=True, capture_output=True)
        saved, commanded = self.contents("saved.exr", "commanded.exr")
        self.assertEqual(saved, commanded)

    def test_a_file_without_depth_is_shown_sharp_until_depth_is_chosen(self):
        flat_exr(self.path("flat.exr"))
        flat_exr(self.path("far.exr"), channels="BGRZ")
        self.do("""
            wait
            expect no error
            expect notice depth
            expect frame.width 32
            expect screen 5 5 137 137 137 3
            set input.depth_file far.exr
            wait
            expect no error
            expect frame.engine scatter
            expect focus 4
            undo
            wait
            expect input.depth_file file
            expect notice depth
            set input.depth_kind sideways
            expect error sideways
            set input.depth_range 1
            expect error range
        """, "flat.exr", "--tone", "none")

    def test_a_path_that_cannot_be_opened_ends_the_window_with_3_and_a_line(self):
        with open(self.path("broken.exr"), "wb") as file:
            file.write(b"no picture")
        for name in ("nowhere.exr", "broken.exr"):
            window_ = self.start(name)
            _, err = self.finish(window_, code=3)
            self.assertIn(name, err)

    def test_another_file_opens_in_the_window_and_a_missing_one_leaves_what_is_shown(self):
        flat_exr(self.path("other.exr"), channels="BGRZ")
        for number in (1, 2, 3):
            shutil.copy(self.path("other.exr"), self.path("take.%02d.exr" % number))
        self.do("""
            wait
            expect frame.width 320
            open other.exr
            wait
            expect no error
            expect frame.width 32
            expect frame.engine scatter
            open nothing.exr
            wait
            expect error nothing.exr
            expect input.path other.exr
            expect frame.width 32
            open take.##.exr
            wait
            expect shot.frame 1
            frame 3
            wait
            expect no error
            open none.##.exr
            expect error no frame
            key ctrl+o
            expect view.open on
            sleep 0.2
            click "file other.exr"
            wait
            expect view.open off
            expect frame.width 32
        """)
        with open(os.path.join(self.shared, "state", "petzval", "recent")) as file:
            recent = file.read().splitlines()
        self.assertTrue(recent[0].endswith("/other.exr"), recent)
        self.assertEqual(len(recent), len(set(recent)))

    def test_choices_are_undone_one_by_one_and_a_drag_is_one(self):
        self.do("""
            wait
            undo
            expect error nothing
            set fstop 4
            set lens.blades 5
            drag camera.focal_length_mm 40
            wait
            undo
            expect lens.blades 5
            key ctrl+z
            expect lens.blades 0
            expect fstop 4
            key ctrl+shift+z
            expect lens.blades 5
            undo
            undo
            redo
            expect fstop 4
            set exposure 2
            redo
            expect error nothing
            undo
            expect exposure 0
            expect fstop 4
            wait
            expect no error
        """)

    def test_two_clicks_make_a_rack_whose_keys_can_be_dragged(self):
        for number in range(1, 7):
            shutil.copy(self.path("table.exr"), self.path("rack.%04d.exr" % number))
        out, _ = self.do("""
            wait
            rack
            click 165 100
            wait
            expect shot.frame 6
            click 250 40
            wait
            expect no error
            expect shot.frame 1
            expect shot.keys 2
            say focus
            sleep 0.2
            shot rack.png
            drag "key 1" 330 -40
            wait
            expect shot.keys 2
            frame 1
            wait
            say focus
            say shot.frame
            undo
            expect shot.keys 2
            say focus
            move_key 1 2 3
            frame 2
            expect focus 3
            move_key 9 1 3
            expect error no key
            move_key 2 99 3
            expect error 99
            wait
        """, "rack.####.exr")
        before, dragged, _, undone = map(float, out.split())
        self.assertAlmostEqual(before, 1.18, 1)
        self.assertLess(dragged, before)
        self.assertAlmostEqual(undone, before, 4)

    def test_a_right_click_brings_a_default_back(self):
        self.do("""
            wait
            set fstop 9
            wait
            right_click camera.f_number
            sleep 0.1
            say fstop
            set lens.cats_eye 0.5
            wait
            right_click lens.cats_eye
            sleep 0.1
            expect lens.cats_eye 0
            preset nothing
            expect error nothing
            set lens.blades 6
            set glare.bloom 0.2
            reset look
            expect lens.blades 0
            expect glare.bloom 0
            reset view.zoom
            expect error default
            wait
        """)

    @unittest.skipUnless(shutil.which("xdotool"), "no xdotool")
    def test_a_file_that_is_dropped_on_the_window_opens(self):
        flat_exr(self.path("a drop of #1.exr"), channels="BGRZ", width=48, height=20)
        with open(self.path("dropped.txt"), "w") as file:
            file.write("wait\nsay frame.width\nuntil frame.width 48\nwait\nexpect no error\nsay focus\n")
        shown = self.start("table.exr", "--script", "dropped.txt")
        self.assertEqual(shown.stdout.readline(), "320\n")
        found = subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name", "petzval"],
                               env={**os.environ, "DISPLAY": DISPLAY.name}, capture_output=True, text=True,
                               timeout=TIME_LIMIT_S)
        heard = drop.drop(DISPLAY.name, int(found.stdout.split()[0]), [self.path("a drop of #1.exr")])
        self.assertEqual(heard, ["XdndStatus", "XdndFinished"])
        out, _ = self.finish(shown)
        self.assertEqual(out, "4\n")


if __name__ == "__main__":
    window.run()
