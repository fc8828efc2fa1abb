"""Scenes that are rendered as one looks, under Xvfb: articles, camera paths, recordings."""
import base64
import json
import math
import os
import shlex
import struct
import subprocess

import window
from window import PETZVAL


def history_of(exr):
    before = b"petzval:history\0string\0"
    at = exr.index(before) + len(before) + 4
    return exr[at:at + struct.unpack_from("<I", exr, at - 4)[0]].decode()


class SceneTest(window.WindowTest):
    def test_a_scene_is_turned_by_a_drag_and_recorded_for_defocus(self):
        out, _ = self.do("""
            wait
            expect no error
            expect frame.width 160
            say focus
            click 80 45
            wait
            expect orbit.yaw_deg 0
            drag 80 45 100 45
            wait
            say orbit.yaw_deg
            expect no error
            show focus-index
            wait
            expect no error
            show result
            range 0 1
            record turned-####.exr
            wait
            expect no error
            copy
            say copied
            key home
            wait
            expect orbit.yaw_deg 0
        """, "--scene", "tori", "--scene-size", "160x90", "--engine", "gaussian")
        _, yaw, command = out.splitlines()
        self.assertNotEqual(float(yaw), 0)
        made, defocused = command.split(" && ")
        for line in (made.replace("tori.exr", "made.exr").replace("--frame 0", "--frame 1"),
                     defocused.replace("tori.exr", "turned-0001.exr")):
            subprocess.run([PETZVAL, *shlex.split(line)[1:]], cwd=self.shared, check=True, capture_output=True)
        compared = subprocess.run([PETZVAL, "compare", "made.exr", "turned-0001.exr"], cwd=self.shared,
                                  capture_output=True, text=True)
        self.assertIn("inf", compared.stdout + compared.stderr)

    def test_the_camera_stays_above_the_floor_and_turns_back_at_once(self):
        out, _ = self.do("""
            wait
            orbit 0 -60
            say orbit.pitch_deg
            dolly 2
            say orbit.pitch_deg
            orbit 0 10
            say orbit.pitch_deg
            orbit 0 300
            say orbit.pitch_deg
            expect no error
        """, "--scene", "hexadrive", "--scene-size", "160x90")
        low, farther, back, high = map(float, out.splitlines())
        self.assertAlmostEqual(low, -math.degrees(math.asin(0.55 / 1.6 - 0.02)), places=2)
        self.assertGreater(farther, low)  # twice as far, the floor is met earlier
        self.assertAlmostEqual(back, farther + 10, places=2)
        self.assertLess(high, 90)

    def test_a_camera_that_moves_is_seen_in_drafts_and_fine_once_it_rests(self):
        out, _ = self.do("""
            wait
            expect scene.samples 4
            orbit 1 0
            until scene.samples 1
            until frame.quality draft
            wait
            expect scene.samples 4
            expect frame.quality standard
            expect no error
            say last.picture_ms
        """, "--scene", "hexadrive", "--scene-size", "160x90")
        self.assertGreater(float(out), 0)

    def square(self, **more):
        """A glTF scene: a square of 2 x 2 m; `more` beside or in place of what it has."""
        places = struct.pack("<12f", -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
        places += struct.pack("<8f", 0, 3, 0, 0, -4, 0, 0, -2)  # two times, s, and where it is then
        return {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
            "textures": [{"source": 0}], "images": [{"uri": "missing.png"}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                          {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                          {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                            {"buffer": 0, "byteOffset": 60, "byteLength": 8}, {"buffer": 0, "byteOffset": 68, "byteLength": 24}],
            "buffers": [{"byteLength": len(places),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(places).decode()}], **more}

    def need_gltf(self):
        if "glTF" in subprocess.run([PETZVAL, "scene", "make", "x.gltf", "-o", "x.exr"], cwd=self.shared,
                                    capture_output=True, text=True).stderr.replace("no glTF", ""):
            self.skipTest("built without tinygltf")

    def test_a_gltf_file_moves_and_one_of_its_cameras_is_chosen(self):
        self.need_gltf()
        lens = {"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}
        moving = self.square(
            scenes=[{"nodes": [0, 1, 2]}], cameras=[lens],
            nodes=[{"mesh": 0}, {"camera": 0, "name": "far"}, {"camera": 0, "name": "close", "translation": [0, 0, -1]}],
            animations=[{"samplers": [{"input": 2, "output": 3}],
                         "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])
        with open(os.path.join(self.shared, "moving.gltf"), "w") as file:
            json.dump(moving, file)
        out, _ = self.do("""
            wait
            expect no error
            expect scene.camera far
            pick 30 17
            expect pick.depth_m 4
            frame 36
            wait
            expect pick.depth_m 3
            set scene.camera close
            wait
            expect pick.depth_m 2
            set scene.camera nobody
            expect error close
            expect scene.camera close
            frame last
            wait
            say shot.frame
            expect pick.depth_m 1
            expect no error
        """, "moving.gltf", "--engine", "gather", "--scene-size", "60x34")
        self.assertEqual(out.strip(), "72")

    def test_a_gltf_file_may_be_broken_lack_pictures_change_and_vanish(self):
        self.need_gltf()
        path = os.path.join(self.shared, "square.gltf")
        with open(path, "w") as file:
            json.dump(self.square(), file)
        with open(os.path.join(self.shared, "square.txt"), "w") as file:
            file.write("wait\nexpect no error\nexpect notice missing.png\nsay frame.engine\nuntil notice changed\n"
                       "orbit 5 5\nwait\nexpect no error\nkey ctrl+r\nwait\nexpect error square.gltf\norbit 5 0\nwait\n"
                       "expect no error\nexpect scene.samples 4\nsay frame.engine\nuntil notice removed\nreload\nwait\n"
                       "expect error square.gltf\n")
        window = self.start("square.gltf", "--engine", "gather", "--scene-size", "60x34", "--script", "square.txt")
        self.assertIn("gather", window.stdout.readline())
        with open(path, "w") as file:
            file.write('{"asset": broken')
        os.utime(path, (1, 1))
        self.assertIn("gather", window.stdout.readline())
        os.remove(path)
        self.finish(window)

    def buffers_of(self, scene, buffers, before=""):
        """Shows every buffer of an article; all are different pictures."""
        self.do("wait\nexpect no error\nkey tab\n" + before + "".join(
            'buffer "%s"\nwait\nexpect no error\nshot %s%d.png\n' % (name, scene, i) for i, name in enumerate(buffers)),
            "--scene", scene, "--scene-size", "120x68")
        shots = list(self.contents(*["%s%d.png" % (scene, i) for i in range(len(buffers))]))
        self.assertEqual(len(set(shots)), len(buffers), "two buffers look alike")

    def test_every_buffer_of_hexadrives_demo_can_be_seen(self):
        self.buffers_of("hexadrive", ["result", "sharp, HDR", "depth", "radii", "surfaces", "levels in one buffer",
                                      "highlights", "blurred, no glare", "glare alone", "2009: sprites", "2009: atlas"])

    def test_the_method_of_2009_draws_a_sprite_for_each_pixel_and_looks_like_scatter(self):
        out, _ = self.do("""
            wait
            shot scatter.png 8
            key s
            wait
            expect no error
            say frame.passes
            shot sprites.png 8
        """, "--scene", "hexadrive", "--scene-size", "320x180")
        self.assertIn("57600 sprites in one draw", out)
        scatter, sprites = (window.png_codes(data) for data in self.contents("scatter.png", "sprites.png"))
        # The picture is the upper left of the window; panels and timeline show other numbers.
        apart = [abs(a - b) for row, other in zip(scatter[:40], sprites[:40])
                 for one, two in zip(row[:60], other[:60]) for a, b in zip(one, two)]
        self.assertLess(sum(apart) / len(apart), 8)

    def test_every_buffer_of_wglds_page_can_be_seen(self):
        self.buffers_of("wgld", ["result", "depth index", "sharp", "small blur", "large blur",
                                 "temporary: rows", "depth"])

    def test_every_stage_of_unitys_articles_can_be_seen(self):
        self.buffers_of("unity", ["result: cure", "radii", "half size", "blind disc", "hard test", "four-tap blur",
                                  "combined: hard edges", "near and far", "sharp", "depth", "ours"], "set fstop 0.5\n")

    def test_an_article_begins_with_its_own_look_and_the_focus_follows_its_subject(self):
        out, _ = self.do("""
            wait
            expect engine gather
            expect gather.stage cure
            click scene.follow
            expect scene.follow on
            frame 24
            wait
            say focus
            say scene.subject_m
            frame 0
            wait
            say focus
            set camera.aperture_mm 25
            expect fstop 2
            drag camera.aperture_mm 20
            wait
            say camera.aperture_mm
            expect no error
        """, "--scene", "unity", "--scene-size", "120x68")
        far, subject, near, aperture = map(float, out.split())
        self.assertAlmostEqual(far, subject, 4)
        self.assertGreater(far, near + 0.5)
        self.assertGreater(aperture, 30)

    def test_every_pass_of_an_article_is_timed(self):
        for scene, passes in (("hexadrive", ["split", "complete", "sources", "atlas", "spread", "highlights", "bloom", "star"]),
                              ("wgld", ["spread", "blur", "mix"]),
                              ("unity", ["half size", "near and far", "four-tap blur", "enlarged", "combined"])):
            out, _ = self.do("wait\nexpect no error\nsay frame.passes\n", "--scene", scene, "--scene-size", "60x34")
            for one in passes:
                self.assertIn(one, out, scene)

    def test_a_camera_path_is_recorded_saved_and_played_again(self):
        out, _ = self.do("""
            wait
            set scene.recording on
            frame 0
            orbit 20 0
            frame 10
            orbit 10 5
            dolly 2
            set scene.recording off
            save_path path.csv
            forget_path
            home
            wait
            load_path path.csv
            frame 5
            wait
            say orbit.yaw_deg
            say orbit.pitch_deg
            range 4 5
            record path-####.exr
            wait
            expect no error
            load_path script.txt
            expect error script.txt:1
            load_path nothing.csv
            expect error nothing.csv
        """, "--scene", "wgld", "--scene-size", "60x34")
        yaw, pitch = map(float, out.split())
        self.assertAlmostEqual(yaw, 25)
        self.assertAlmostEqual(pitch, 2.5)
        four, five = self.contents("path-0004.exr", "path-0005.exr")
        self.assertNotEqual(four, five)

    def test_the_live_picture_is_that_of_defocus_of_the_recorded_frame(self):
        out, _ = self.do("""
            wait
            orbit 10 5
            wait
            range 0 0
            record recorded.exr
            wait
            save live.exr
            wait
            record live-####.png
            wait
            expect no error
            copy
            say copied
        """, "--scene", "unity", "--scene-size", "120x68")
        defocus = out.strip().split(" && ")[1].replace("unity.exr", "recorded.exr").replace("out.exr", "made.exr")
        subprocess.run([PETZVAL, *shlex.split(defocus)[1:]], cwd=self.shared, check=True, capture_output=True)
        done = subprocess.run([PETZVAL, "compare", "live.exr", "made.exr", "--json", "live.json"], cwd=self.shared,
                              capture_output=True, text=True)
        print("live against recorded:", done.stdout.strip())
        with open(os.path.join(self.shared, "live.json")) as file:
            psnr = json.load(file)["psnr_lin"]
        self.assertTrue(psnr is None or psnr == "inf" or float(psnr) > 55, psnr)  # files hold halves
        live, made = (history_of(exr) for exr in self.contents("live.exr", "made.exr"))
        self.assertTrue(live.startswith("defocus R: petzval "), live)
        self.assertEqual(live, made)
        self.assertEqual(next(self.contents("live-0000.png"))[1:4], b"PNG")


if __name__ == "__main__":
    window.run()
