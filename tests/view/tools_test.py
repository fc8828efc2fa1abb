"""What one does beside a picture in the window: bends curves, loads tracks, pushes pictures and takes them."""
import json
import os
import shlex
import shutil
import socket
import struct
import subprocess
import threading
import time

import window
from window import PETZVAL, TIME_LIMIT_S


def packet(kind, *fields):
    body = bytes([kind])
    for field in fields:
        if isinstance(field, str):
            body += field.encode() + b"\0"
        elif isinstance(field, bytes):
            body += field
        else:
            body += struct.pack("<i", field)
    return struct.pack("<I", len(body) + 4) + body


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ToolsTest(window.WindowTest):
    def test_a_sheet_shows_lenses_and_presets_on_the_picture_and_a_click_uses_one(self):
        out, err = self.do("""
            wait
            sheet doublet,Helios
            wait
            expect no error
            shot sheet.png
            click "tile Helios  f/2"
            wait
            expect lens Helios
            expect fstop 2
            shot same.png
            undo
            expect lens ideal
            sheet presets
            wait
            expect no error
            shot presets.png
            sheet off
            sheet nonsense
            expect error no lens is called nonsense
        """)
        sheet, presets = self.contents("sheet.png", "presets.png")
        self.assertNotEqual(sheet, presets)

    def test_nothing_that_is_saved_replaces_a_picture_that_the_window_reads(self):
        before = list(self.contents("table.exr", "truth.exr"))
        os.symlink("truth.exr", os.path.join(self.shared, "link.exr"))
        for line in ("shot table.exr", "shot link.exr", "save table.exr", "save_look truth.exr", "save_lens table.exr"):
            _, err = self.do("wait\n%s\nexpect no error\n" % line, "table.exr", "--against", "truth.exr", code=2)
            self.assertIn("would replace the input", err)
        self.assertEqual(list(self.contents("table.exr", "truth.exr")), before)

    def test_curves_that_are_bent_make_another_lens_that_can_be_saved(self):
        out, _ = self.do("""
            wait
            set lens doublet
            set fstop 2
            set focus 0.5
            pick 250 40
            key l
            wait
            shot before.png
            drag curves 30
            wait
            expect no error
            bend 1 0.4
            bend 0.5 -0.1 549
            wait
            expect no error
            shot bent.png
            say lens.bent_mm
            save_curves bent.json
            wait
            expect lens bent.json
            copy
            say copied
            bend 2 1
            expect error zone
            save_curves missing/folder.json
            expect error missing
        """)
        rim_mm, command = out.strip().splitlines()
        self.assertGreater(abs(float(rim_mm)), 0.3)
        self.assertIn("--lens bent.json", command)
        before, bent = self.contents("before.png", "bent.png")
        self.assertNotEqual(before, bent)
        with open(os.path.join(self.shared, "bent.json")) as file:
            curves = json.load(file)
        self.assertAlmostEqual(curves["curves"][0]["shift"][-1], float(rim_mm), 4)
        subprocess.run([PETZVAL, "defocus", "table.exr", "-o", "bent.exr", "--lens", "bent.json", "--quality", "draft"],
                       cwd=self.shared, check=True, capture_output=True)

    def test_stop_sensor_rims_and_blades_are_dragged_where_they_are_drawn(self):
        out, _ = self.do("""
            wait
            set lens double-gauss
            set fstop 4
            pick 250 40
            key l
            wait
            say lens.disc_px
            drag stop 0 -6
            wait
            say fstop
            say lens.disc_px
            drag stop 0 -200
            wait
            expect no error
            expect fstop 2.03 0.01
            set lens doublet
            wait
            shot still.png
            drag sensor 40
            wait
            expect lens.focus_mode shift
            say lens.focus_shift_mm
            shot shifted.png
            set lens.focus_mode best
            set lens.barrel 20,30
            wait
            drag "rim 1" -20 -4
            wait
            say lens.barrel
            drag behind 42
            say lens.blades
            drag lens.spherical 40
            say lens.spherical
            set lens.axial_colour 0
            set lens ideal
            drag sensor 40
            wait
            expect lens.focus_mode best
            set lens.axial_colour 0.5
            expect notice "axial colour has no effect"
            copy
            say copied
        """, "table.exr", "--engine", "gaussian")
        small_px, fstop, large_px, shift_mm, rim, blades, spherical, command = out.strip().splitlines()
        self.assertLess(float(fstop), 3.9)
        self.assertGreater(int(large_px), int(small_px))
        self.assertGreater(float(shift_mm), 0.2)
        still, shifted = self.contents("still.png", "shifted.png")
        self.assertNotEqual(still, shifted)
        radius_mm, distance_mm = map(float, rim.split(","))
        self.assertGreater(radius_mm, 20.2)
        self.assertGreater(distance_mm, 31)
        self.assertGreaterEqual(int(blades), 3)
        self.assertGreater(float(spherical), 1.05)
        self.assertNotIn("colour", command)  # it has no effect, and would be refused
        done = subprocess.run([PETZVAL, *shlex.split(command)[1:], "--quiet"], cwd=self.shared, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_track_is_loaded_with_its_keys(self):
        for number in range(1, 6):
            shutil.copy(os.path.join(self.shared, "table.exr"), os.path.join(self.shared, "pull.%04d.exr" % number))
        with open(os.path.join(self.shared, "pull.csv"), "w") as file:
            file.write("frame,focus,fstop,lens.blades\n1,0.6,2,\n3,1.2,,6\n5,1.2,4,\n")
        out, _ = self.do("""
            wait
            load_track pull.csv
            wait
            expect no error
            expect shot.keys 3
            expect fstop 2
            frame 2
            wait
            expect focus 0.8
            frame 5
            wait
            expect fstop 4
            expect lens.blades 6
            load_track missing.csv
            expect error missing.csv
            save_track again.csv
            frame 3
            wait
            expect focus 1.2
        """, "pull.####.exr", "--engine", "gaussian")
        again = next(self.contents("again.csv")).decode().splitlines()
        self.assertEqual(len(again), 4, again)

    def push(self, port, *packets):
        with socket.create_connection(("127.0.0.1", port), timeout=TIME_LIMIT_S) as to:
            for one in packets:
                to.sendall(one)
            to.shutdown(socket.SHUT_WR)
            try:
                to.recv(1)  # until it was taken
            except OSError:
                pass  # what sends nonsense is hung up on

    def test_pictures_are_taken_as_tev_takes_them_and_nonsense_is_refused(self):
        port = free_port()
        with open(os.path.join(self.shared, "listen.txt"), "w") as file:
            file.write("wait\nsay frame.engine\nuntil frame.width 40\nuntil against.width 8\nuntil error picture\npick 3 3\n"
                       "expect pick.depth_m 2\nset engine gather\nwait\nsay frame.width\n")
        window = self.start("table.exr", "--engine", "gaussian", "--fstop", "2", "--focal-length", "50", "--sensor-width",
                            "36", "--focus", "1", "--listen", str(port), "--script", "listen.txt")
        self.assertIn("gaussian", window.stdout.readline())
        floats = struct.pack("<4f", 0.5, 0.4, 0.3, 2.0) * (40 * 30)
        names = ("R", "G", "B", "depth.Z")
        offsets = struct.pack("<4q", 0, 1, 2, 3) + struct.pack("<4q", 4, 4, 4, 4)
        self.push(port, packet(4, b"\1", "beauty", 40, 30, 4, *names),
                  packet(6, b"\0", "beauty", 4, *names, 0, 0, 40, 30, offsets, floats))
        self.push(port, packet(4, b"\1", "flat", 8, 6, 1, "R"),
                  packet(3, b"\0", "flat", "R", 0, 0, 8, 6, struct.pack("<48f", *[0.25] * 48)))
        for nonsense in (b"GET / HTTP/1.1\r\n\r\n", packet(77, "what"), packet(4, b"\1", "huge", 1 << 30, 1 << 30, 4),
                         packet(6, b"\0", "beauty", 4, *names, 0, 0, 40, 31, offsets, floats),
                         packet(6, b"\0", "beauty", 4, *names, 0, 0, 40, 30, offsets, floats[:-4]),
                         packet(3, b"\0", "nobody", "R", 0, 0, 1, 1, floats[:4]), packet(4, b"\1", "cut")[:9]):
            self.push(port, nonsense)
        out, _ = self.finish(window)
        self.assertEqual(out.strip(), "40")

    def test_a_picture_that_is_only_announced_takes_no_memory(self):
        port = free_port()
        with open(os.path.join(self.shared, "announce.txt"), "w") as file:
            file.write("wait\nsay frame.engine\nuntil frame.width 24\nsay frame.width\n")
        window = self.start("table.exr", "--engine", "gaussian", "--listen", str(port), "--script", "announce.txt")
        self.assertIn("gaussian", window.stdout.readline())
        for number in range(4):
            name = "huge %d" % number
            self.push(port, packet(4, b"\1", name, 8192, 8192, 5, *"RGBAZ"),
                      packet(3, b"\0", name, "R", 8000, 8000, 1, 1, bytes(4)))
        with open("/proc/%d/status" % window.pid) as status:
            most = next(int(line.split()[1]) >> 10 for line in status if line.startswith("VmHWM"))
        self.assertLess(most, 900, "MiB")
        channels = [packet(3, b"\0", "small", name, 0, 0, 24, 6, struct.pack("<144f", *[2.0] * 144)) for name in "RGBZ"]
        self.push(port, packet(4, b"\1", "small", 24, 6, 4, *"RGBZ"), *channels)
        out, _ = self.finish(window)
        self.assertEqual(out.strip(), "24")

    def test_without_a_file_it_waits_for_a_renderer_and_shows_what_is_pushed(self):
        port = free_port()
        with open(os.path.join(self.shared, "wait.txt"), "w") as file:
            file.write("sleep 0.2\nshot waiting.png\nsay error\nsave early.exr\nexpect error\n"
                       "until frame.width 24\nset exposure 0\nwait\nsay notice\n"
                       "until frame.engine gaussian\nwait\nexpect frame.width 40\nexpect focus 2\nexpect notice assum\n"
                       "set fstop 1\nwait\nsave pushed.exr\nwait\nexpect notice wrote\ncopy\nexpect error pushed\n"
                       "reload\nwait\nexpect frame.width 40\n")
        window = self.start("--engine", "gaussian", "--listen", str(port), "--script", "wait.txt")
        self.assertEqual(window.stdout.readline().strip(), "")
        self.push(port, b"GET / HTTP/1.1\r\n\r\n")
        self.push(port, packet(4, b"\1", "flat", 24, 6, 1, "R"),
                  packet(3, b"\0", "flat", "R", 0, 0, 24, 6, struct.pack("<144f", *[0.25] * 144)))
        time.sleep(1.5)
        names = ("R", "G", "B", "Z")
        offsets = struct.pack("<4q", 0, 1, 2, 3) + struct.pack("<4q", 4, 4, 4, 4)
        self.push(port, packet(4, b"\1", "beauty", 40, 30, 4, *names),
                  packet(6, b"\0", "beauty", 4, *names, 0, 0, 40, 30, offsets,
                         struct.pack("<4f", 0.5, 0.4, 0.3, 2.0) * (40 * 30)))
        out, _ = self.finish(window)
        self.assertIn("depth", out)
        self.assertTrue(os.path.exists(os.path.join(self.shared, "pushed.exr")))
        done = subprocess.run([PETZVAL, "view"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--listen", done.stderr)

    def test_what_is_made_is_pushed_to_a_viewer_that_listens(self):
        listener = socket.socket()
        listener.bind(("127.0.0.1", 0))
        listener.listen()
        taken = []

        def take():
            connection, _ = listener.accept()
            with connection:
                while piece := connection.recv(1 << 16):
                    taken.append(piece)

        thread = threading.Thread(target=take)
        thread.start()
        self.do("wait\ntev %d\nwait\nexpect no error\nexpect notice wrote\ntev 1\nwait\nexpect error listens\n"
                % listener.getsockname()[1], "table.exr", "--engine", "gaussian")
        thread.join(TIME_LIMIT_S)
        listener.close()
        data, floats, at = b"".join(taken), 0, 0
        while at < len(data):
            size, kind = struct.unpack("<IB", data[at:at + 5])
            self.assertIn(kind, (4, 6))
            floats += kind == 6 and (size - len(packet(6, b"\0", "petzval: table.exr", 4, "R", "G", "B", "A", 0, 0, 0, 0,
                                                       bytes(64)))) // 4
            at += size
        self.assertEqual(floats, 4 * 320 * 180)


if __name__ == "__main__":
    window.run()
