"""petzval view under Xvfb: scripts do what a hand would, and look at the screen. Prints how long windows took."""
import json
import os
import shlex
import shutil
import subprocess
import time
import unittest

import window
from window import DISPLAY, PETZVAL, TIME_LIMIT_S, png_codes


OCIO = """ocio_profile_version: 2
roles: {default: scene, scene_linear: scene}
displays:
  sRGB:
    - !<View> {name: Half, colorspace: half}
colorspaces:
  - !<ColorSpace> {name: scene}
  - !<ColorSpace>
    name: half
    from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}
"""


class ViewTest(window.WindowTest):
    def test_a_click_focuses_on_what_is_seen_there_and_the_picture_follows(self):
        # The checked ball in the middle stands 1.2 m away; the red one at the back is farther.
        out, _ = self.do("""
            wait
            click 165 100
            wait
            expect no error
            expect focus 1.18 0.02
            expect pick.radius_px 0 1e12
            expect frame.engine scatter
            expect frame.quality standard
            set fstop 0.7
            wait
            say pick.radius_px
            click 162 55
            wait
            expect pick.x 162
            say focus
        """)
        radius, focus = map(float, out.split())
        self.assertLess(abs(radius), 0.05)
        self.assertGreater(focus, 1.3)

    def test_what_is_saved_is_what_the_copied_command_makes(self):
        out, _ = self.do("""
            wait
            click 165 100
            set fstop 0.95
            set lens.blades 5
            set lens.cats_eye 0.4
            set quality draft
            set focus.max_radius_px 9
            set lens.barn_doors 0,0.2,0,0
            wait
            expect no error
            copy
            say copied
            save saved.exr
            wait
            expect notice wrote
        """)
        command = shlex.split(out.strip())
        command[command.index("out.exr")] = "commanded.exr"
        subprocess.run([PETZVAL, *command[1:]], cwd=self.shared, check=True, capture_output=True)
        saved, commanded = self.contents("saved.exr", "commanded.exr")
        self.assertTrue(saved == commanded, "other bytes by " + out)

    def test_hidden_layers_and_a_matte_stand_in_the_frame_from_the_first_draft_on(self):
        subprocess.run([PETZVAL, "scene", "make", "bars", "-o", "bars.exr", "--layers", "hidden.exr", "--width", "96",
                        "--height", "54", "--samples", "4"], cwd=self.shared, check=True, capture_output=True)
        out, _ = self.do("""
            wait
            expect no error
            say frame.engine
            save matted.exr
            wait
            expect notice wrote
        """, "bars.exr", "--behind", "hidden.exr", "--holdout", "hidden.exr")
        self.assertIn("scatter", out)
        subprocess.run([PETZVAL, "defocus", "bars.exr", "--behind", "hidden.exr", "--holdout", "hidden.exr", "-o", "by-hand.exr"],
                       cwd=self.shared, check=True, capture_output=True)
        compared = subprocess.run([PETZVAL, "compare", "by-hand.exr", "matted.exr", "--json", "-"], cwd=self.shared, check=True,
                                  capture_output=True, text=True)
        self.assertEqual(json.loads(compared.stdout)["max_error"], 0)

    def test_keys_show_channels_buffers_and_exposure_on_the_screen(self):
        # A red channel is grey; the same key again brings colour back; depth, radii and help show something else.
        self.do("""
            wait
            key 2
            wait
            shot colour.png
            key r
            wait
            shot red.png
            key r
            key e
            wait
            shot brighter.png
            expect exposure 0.5
            key shift+e
            key 5
            wait
            shot depth.png
            key 4
            wait
            shot radii.png
            key h
            wait
            shot help.png
            key h
            key 2
            wait
            shot again.png
            zoom 4
            pan 5000 -5000
            expect view.centre_x 0 0
            expect view.centre_y 180 0
        """)
        names = ["colour", "red", "brighter", "depth", "radii", "help", "again"]
        shots = list(self.contents(*[name + ".png" for name in names]))
        self.assertTrue(shots[0] == shots[-1])
        self.assertEqual(len(set(shots)), 6)

    def test_the_screen_shows_what_develop_writes(self):
        subprocess.run([PETZVAL, "develop", "table.exr", "-o", "developed.png", "--no-dither", "--exposure", "0.5"],
                       cwd=self.shared, check=True, capture_output=True)
        codes = png_codes(next(self.contents("developed.png")))
        places = [(30, 20), (165, 100), (250, 40), (80, 150), (319, 179)]
        self.do("wait\nset exposure 0.5\nzoom 2\nkey 2\nwait\n" + "".join(
            "set view.centre_x %d\nset view.centre_y %d\nwait\nexpect screen %d %d %d %d %d 0\n"
            % (x + 40, y + 30, x, y, *codes[y][x]) for x, y in places))

    def test_a_file_that_changes_or_goes_is_told_of(self):
        path = os.path.join(self.shared, "fleeting.exr")
        shutil.copy(os.path.join(self.shared, "table.exr"), path)
        with open(os.path.join(self.shared, "fleeting.txt"), "w") as file:
            file.write("wait\nsay frame.engine\nsleep 3\nexpect notice removed\nset fstop 1\nwait\nexpect no error\n"
                       "reload\nwait\nexpect error fleeting.exr\nexpect frame.engine gather\n")
        window = self.start("fleeting.exr", "--engine", "gather", "--script", "fleeting.txt")
        self.assertIn("gather", window.stdout.readline())
        os.remove(path)
        self.finish(window)

    def test_a_shot_may_lack_frames_and_lose_one(self):
        for number in (1, 2, 4, 5):
            shutil.copy(os.path.join(self.shared, "table.exr"), os.path.join(self.shared, "gap.%04d.exr" % number))
        with open(os.path.join(self.shared, "gap.txt"), "w") as file:
            file.write("wait\nframe 3\nexpect error 3\nframe 2\nwait\nframe +1\nwait\nexpect shot.frame 4\n"
                       "expect no error\nsay shot.frame\nsleep 1\nframe 5\nwait\nexpect error gap.0005.exr\n"
                       "frame 1\nwait\nexpect no error\nexpect frame.engine gaussian\n")
        window = self.start("gap.####.exr", "--engine", "gaussian", "--script", "gap.txt")
        self.assertIn("4", window.stdout.readline())
        os.remove(os.path.join(self.shared, "gap.0005.exr"))
        self.finish(window)

    def test_the_display_may_be_one_of_opencolorio(self):
        with open(os.path.join(self.shared, "config.ocio"), "w") as file:
            file.write(OCIO)
        os.environ["OCIO"] = os.path.join(self.shared, "config.ocio")
        self.addCleanup(os.environ.pop, "OCIO")
        made = subprocess.run([PETZVAL, "develop", "table.exr", "-o", "ocio.png", "--no-dither", "--ocio", "sRGB,Half"],
                              cwd=self.shared, capture_output=True, text=True)
        if "without OpenColorIO" in made.stderr:
            self.skipTest("built without OpenColorIO")
        self.assertEqual(made.returncode, 0, made.stderr)
        row = png_codes(next(self.contents("ocio.png")))[60]
        self.do("wait\nexpect view.ocio on\nzoom 2\nkey 2\nwait\nexpect screen 60 60 %d %d %d 1\n"
                "set view.ocio off\nwait\nexpect no error\nshot plain.png\nset view.ocio on\nwait\nshot ocio.png\n" % row[60],
                "table.exr", "--ocio", "sRGB,Half", "--engine", "gaussian")
        plain, by_config = self.contents("plain.png", "ocio.png")
        self.assertNotEqual(plain, by_config)

    def test_panels_and_wipe_answer_the_mouse(self):
        self.do("""
            wait
            drag camera.f_number 60
            wait
            say fstop
            click "wipe sharp"
            wait
            shot wiped.png
            drag "depth histogram" 30
            wait
            click view.overlay
            wait
            expect view.overlay on
            expect no error
            key w
            wait
        """, "table.exr", "--against", "truth.exr")

    def test_zoomed_in_only_what_is_seen_is_made_and_it_is_the_same(self):
        values = []
        for zoom in (0, 8):
            out, _ = self.do("""
                wait
                set view.centre_x 165
                set view.centre_y 100
                set view.zoom %d
                set fstop 1
                wait
                say frame.made_width
                set view.zoom 8
                wait
                expect no error
                shot zoomed%d.png
            """ % (zoom, len(values)))
            values.append(int(out))
        self.assertEqual(values[0], 320)
        self.assertLess(values[1], 200)
        whole, part = self.contents("zoomed0.png", "zoomed1.png")
        self.assertTrue(whole == part, "the screen shows something else")

    def test_the_lens_panel_follows_the_picked_pixel_and_a_click_in_the_disc_lights_its_rays(self):
        out, _ = self.do("""
            wait
            set lens double-gauss
            set fstop 2.1
            set focus 0.5
            pick 250 40
            key l
            wait
            expect no error
            say lens.rays
            say lens.disc_px
            say lens.lit_rays
            click disc
            wait
            say lens.lit_rays
            shot lens.png
            set fstop 8
            wait
            say lens.disc_px
            save_lens lens.json
            expect no error
        """)
        rays, disc_px, unlit, lit, small_px = map(int, out.split())
        self.assertGreater(rays, 150)
        self.assertEqual(unlit, 0)
        self.assertTrue(0 < lit < rays / 4, lit)
        self.assertLess(small_px, disc_px / 2)
        subprocess.run([PETZVAL, "defocus", "table.exr", "-o", "lens.exr", "--look", "lens.json", "--fstop", "4"],
                       cwd=self.shared, check=True, capture_output=True)

    def test_focus_keys_over_frames_become_the_track_that_defocus_takes(self):
        for number in range(1, 6):
            shutil.copy(os.path.join(self.shared, "table.exr"), os.path.join(self.shared, "shot.%04d.exr" % number))
        out, _ = self.do("""
            wait
            expect shot.frame 1
            set shot.keying on
            click 165 100
            frame last
            wait
            click 250 40
            expect shot.keys 2
            frame 3
            wait
            say focus
            key comma
            wait
            expect shot.frame 2
            save_track track.csv
            save made.####.exr
            wait
            copy
            say copied
            set shot.easing on
            save_track eased.csv
            set shot.focus_speed 0.05
            save_track slow.csv
            set shot.focus_speed 0
            range 3 4
            frame first
            wait
            key space
            sleep 1
            expect shot.playing on
            key space
            wait
            say shot.frame
        """, "shot.####.exr")
        middle, command, played = out.splitlines()
        self.assertIn(played, "34")
        track = [line.split(",") for line in "".join(
            text.decode() for text in self.contents("track.csv")).splitlines()[1:]]
        self.assertEqual([int(frame) for frame, _ in track], [1, 5])
        near, far = (float(metres) for _, metres in track)
        self.assertAlmostEqual(1 / float(middle), (1 / near + 1 / far) / 2, 4)
        self.assertIn("shot.0002.exr", command)
        done = subprocess.run([PETZVAL, "defocus", "shot.####.exr", "-o", "tracked.####.exr", "--frames", "2",
                               "--track", "track.csv", "--kernel-cache", "off"], cwd=self.shared, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        compared = subprocess.run([PETZVAL, "compare", "tracked.0002.exr", "made.0002.exr"], cwd=self.shared,
                                  capture_output=True, text=True)
        self.assertIn("inf", compared.stdout + compared.stderr)
        eased = next(self.contents("eased.csv")).decode()
        self.assertEqual(len(eased.splitlines()), 6)
        slow = [1 / float(line.split(",")[1]) for line in next(self.contents("slow.csv")).decode().splitlines()[1:]]
        self.assertLessEqual(max(abs(a - b) for a, b in zip(slow, slow[1:])), 0.0500001)
        self.assertAlmostEqual(slow[0], 1 / near, 6)

    def test_what_is_wrong_is_said_in_the_window_which_stays(self):
        shutil.copy(os.path.join(self.shared, "table.exr"), os.path.join(self.shared, "gone.exr"))
        out, _ = self.do("""
            wait
            set lens.blades 2
            expect error
            set lens nobody
            wait
            expect error nobody
            set lens ideal
            wait
            expect no error
            load_look missing.json
            expect error missing.json
            save missing/folder.exr
            wait
            expect error missing
            resize 1 1
            wait
            resize 1000 850
            wait
            focus 4000 4000
            expect error no depth
            show nothing
            expect error
            show hidden
            expect error --plate
            set engine realtime
            wait
            say error
        """, "gone.exr", "--ui-scale", "3")
        self.assertIn("\nengine realtime needs a GPU", "\n" + out, "the window's words, not job.engine")
        for refused in ("table.exr", "missing/folder.exr"):
            _, err = self.do("wait\nsave %s\n" % refused)  # it ends before that is written
            self.assertIn(refused, err)
        _, err = self.do("wait\nfly away\n", code=3)
        self.assertIn("script.txt:2", err)
        for size in ("-1 100", "0 0", "100 1e9", "nan 100"):
            _, err = self.do("wait\nresize %s\n" % size, code=2)
            self.assertIn("script.txt:2: resize", err)
        _, err = self.do("wait\nexpect fstop 77\n", code=2)
        self.assertIn("script.txt:2", err)

    def test_without_a_display_there_is_one_line(self):
        window = self.start("table.exr", display=":nowhere")
        _, err = self.finish(window, code=2)
        self.assertIn("no window", err)
        self.assertEqual(len(err.strip().splitlines()), 1, err)

    @unittest.skipUnless(shutil.which("xdotool"), "no xdotool")
    def test_another_hand_closes_it(self):
        window = self.start("table.exr")
        env = {**os.environ, "DISPLAY": DISPLAY.name}
        found = subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name", "petzval"], env=env,
                               capture_output=True, text=True, timeout=TIME_LIMIT_S)
        time.sleep(0.5)
        for words in (["mousemove", "300", "200"], ["click", "1"], ["key", "h"], ["key", "ctrl+q"]):
            subprocess.run(["xdotool", *words], env=env, check=True, timeout=TIME_LIMIT_S)
            time.sleep(0.1)
        self.assertTrue(found.stdout.strip())
        self.finish(window)


if __name__ == "__main__":
    window.run()
