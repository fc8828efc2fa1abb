"""Sessions, looks and lenses from Python: results, errors, threads, Ctrl-C."""
import base64
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import traceback
import unittest
import unittest.mock

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is missing")
    sys.exit(77)

import petzval

ROOT = pathlib.Path(__file__).resolve().parents[2]
LENS_FILE = ROOT / "lenses/petzval-laikin.json"

# A frame of some seconds, in the main thread; prints how long it took to stop after SIGINT came.
INTERRUPTED = """
import os, signal, sys, threading, time
import numpy as np
import petzval
rng = np.random.default_rng(1)
colour = rng.random((1080, 1920, 4), np.float32)
radii = (60 * rng.random((1080, 1920), np.float32)).astype(np.float32)
sent = []
def interrupt():
    sent.append(time.process_time())
    os.kill(os.getpid(), signal.SIGINT)
threading.Timer(float(sys.argv[1]), interrupt).start()
try:
    petzval.defocus(colour, radii_px=radii, look=petzval.Look(engine="reference"))
    print("finished")
except KeyboardInterrupt:
    print(time.process_time() - sent[0])
"""


def shot(height=24, width=32, radius=3, camera=None):
    colour = np.full((height, width, 4), 0.25, np.float32)
    colour[height // 2, width // 2, :3] = 50
    return petzval.Shot(colour, radii_px=np.full((height, width), radius, np.float32), camera=camera)


class Depth(unittest.TestCase):
    def frame(self, **given):
        given.setdefault("camera", petzval.Camera(85, 36, 1.4, 3))
        return petzval.defocus(shot().colour, **given).image

    def test_a_shot_says_what_its_depth_means(self):
        metres = np.linspace(2, 9, 24 * 32, dtype=np.float32).reshape(24, 32)
        expected = self.frame(depth_m=metres)
        np.testing.assert_array_equal(self.frame(depth_m=-2 * metres, depth_unit_m=0.5), expected)
        self.assertFalse(np.array_equal(self.frame(depth_m=metres, depth_kind="ray"), expected))
        shares = np.full((24, 32), 0.75, np.float32)
        np.testing.assert_array_equal(self.frame(depth_m=shares, depth_kind="coc-px", depth_range=(-6, 6)),
                                      self.frame(radii_px=np.full((24, 32), 3, np.float32)))

    def test_a_meaning_that_is_none_is_refused(self):
        metres = np.full((24, 32), 2, np.float32)
        for given, says in (({"depth_kind": "z"}, "depth_meaning.kind"), ({"depth_kind": "normalized"}, "depth.range"),
                            ({"depth_range": (1, 2, 3)}, "two are needed"), ({"depth_unit_m": 0}, "depth_unit_m is 0")):
            with self.assertRaisesRegex(petzval.InvalidArgument, says):
                self.frame(depth_m=metres, **given)


class Looks(unittest.TestCase):
    def test_fields_have_the_names_of_the_json(self):
        look = petzval.Look(engine="gather", lens="doublet", **{"lens.blades": 5})
        self.assertEqual((look["engine"], look["lens.blades"], look["lens.name"]), ("gather", 5, "doublet"))
        again = petzval.Look.from_json(look.to_json())
        self.assertEqual(again.to_json(), look.to_json())
        look["lens.name"] = "ideal"
        self.assertIsNone(look.lens)

    def test_an_unknown_field_is_refused_with_the_one_that_was_meant(self):
        with self.assertRaisesRegex(petzval.InvalidArgument, "lens.blades"):
            petzval.Look(**{"lens.blade": 5})
        with self.assertRaisesRegex(petzval.InvalidFile, "^look: is not JSON"):
            petzval.Look.from_json("{")

    def test_a_link_of_the_lens_lab_and_a_preset_are_looks(self):
        told = json.dumps({"lens": {"name": "tessar", "text": None, "look": {"blades": 5}}}).encode()
        link = "lens=1." + base64.urlsafe_b64encode(told).decode().rstrip("=")
        for text in (link, "https://example.org/lab/#" + link):
            look = json.loads(petzval.Look.from_json(text).to_json())
            self.assertEqual((look["lens"]["name"], look["lens"]["blades"]), ("tessar", 5))
        table = "F/3\n50 4 1.5168 64.2 20\nstop 1 14\n-50 30 20\n"
        pasted = json.dumps({"lens": {"name": "mine", "text": table}}).encode()
        kept = petzval.Look.from_json("lens=1." + base64.urlsafe_b64encode(pasted).decode().rstrip("=")).to_json()
        self.assertEqual(json.loads(kept)["lens"]["name"], table)
        with self.assertRaisesRegex(petzval.InvalidFile, "link of the lens lab"):
            petzval.Look.from_json(link[:-5])
        night = json.loads(petzval.Look.from_json('{"petzval_look": 1, "preset": "night"}').to_json())
        self.assertEqual(night["lens"]["blades"], 8)
        with self.assertRaises(KeyError):
            petzval.Look()["lens.nothing"]

    def test_presets_have_names(self):
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict(os.environ, PETZVAL_PRESETS=folder):
            self.assertEqual(petzval.Look.preset("night")["lens.blades"], 8)
            pathlib.Path(folder, "mine.json").write_text('{"petzval_look": 1, "lens": {"blades": 5}}')
            self.assertEqual(petzval.Look.preset("mine")["lens.blades"], 5)
            with self.assertRaisesRegex(petzval.InvalidArgument, "did you mean night.*there are mine, portrait, bubble"):
                petzval.Look.preset("nigt")
            pathlib.Path(folder, "broken.json").write_text("{")
            with self.assertRaisesRegex(petzval.InvalidFile, "broken.json"):
                petzval.Look.preset("broken")
        listed = subprocess.run([sys.executable, "-c", "import petzval; print(*petzval.preset_names())"], text=True,
                                capture_output=True, check=True, env={**os.environ, "PETZVAL_PRESETS": self.own_presets()})
        self.assertEqual(listed.stdout.split()[:3], ["mine", "portrait", "bubble"])

    def own_presets(self):
        folder = tempfile.mkdtemp(prefix="petzval-presets-")
        self.addCleanup(shutil.rmtree, folder)
        pathlib.Path(folder, "mine.json").write_text(petzval.Look().to_json())
        return folder

    def test_a_look_may_be_a_dictionary(self):
        with petzval.Session(threads=1) as session:
            frame = session.defocus(shot(), {"engine": "gather", "lens.blades": 6})
        self.assertEqual(frame.report["engine"], "gather")


class Lenses(unittest.TestCase):
    def test_a_disc_is_light(self):
        lens = petzval.Lens("triplet-cooke")
        disc = np.asarray(lens.disc(9, (0.5, 0)))
        self.assertEqual(disc.shape[0] % 2, 1)
        np.testing.assert_allclose(disc.sum((0, 1)), 1, atol=1e-4)
        pentagon = np.asarray(petzval.Lens("ideal").used(blades=5).disc(9))
        self.assertEqual(pentagon.shape, (19, 19, 4))
        self.assertEqual(np.asarray(lens.disc(9, size_px=5)).shape, (5, 5, 4))

    def test_a_disc_is_the_one_of_the_command_line(self):
        program = ROOT / "build/release/apps/cli/petzval"
        if not program.exists():
            self.skipTest("the program is not built")
        out = subprocess.run([program, "lens", "show", "triplet-cooke", "--json", "-"], check=True,
                             capture_output=True, text=True).stdout
        facts = petzval.Lens("triplet-cooke").facts
        said = json.loads(out)
        self.assertEqual({key: said[key] for key in facts}, facts)

    def test_facts_curves_and_sections(self):
        lens = petzval.Lens(LENS_FILE)
        self.assertGreater(lens.facts["efl_mm"], 0)
        self.assertEqual(lens.facts["object_distance_mm"], float("inf"))
        self.assertEqual(len(lens.curves["field"]), len(lens.facts["field"]))
        section = lens.section(2.0, (0.3, 0), 11)
        self.assertGreater(len(section["glass"]), 2)
        self.assertGreater(len(section["rays"][0]["path_mm"]), 5)

    def test_a_texture_holds_all_discs(self):
        texture, radii = petzval.Lens("doublet").texture(16, 8, threads=1)
        self.assertEqual((texture.shape[1], radii[0], radii[-1]), (16, -8, 8))

    def test_an_atlas_of_rings_is_of_a_round_pupil(self):
        lens = petzval.Lens("doublet").used(blades=5)
        header, texels = lens.atlas(8, zones=1)
        self.assertEqual((json.loads(header)["zones"], len(texels)), ([0], 4 * 31 * 31 * 14))
        with self.assertRaisesRegex(petzval.InvalidArgument, "lens.blades"):
            lens.atlas()

    def test_text_and_file_are_one_lens(self):
        by_text = petzval.Lens.from_text(LENS_FILE.read_bytes(), "mine")
        np.testing.assert_array_equal(np.asarray(by_text.disc(-6)), np.asarray(petzval.Lens(LENS_FILE).disc(-6)))
        with self.assertRaisesRegex(petzval.InvalidFile, "mine"):
            petzval.Lens.from_text("no lens", "mine")
        with self.assertRaisesRegex(petzval.InvalidArgument, "near it|did you mean"):
            petzval.Lens("tessart")

    def test_every_lens_that_ships_is_listed(self):
        self.assertEqual([lens["name"] for lens in petzval.lens_list()], petzval.lens_names())


class Frames(unittest.TestCase):
    def test_bits_do_not_depend_on_threads(self):
        frames = []
        for threads in (1, 3):
            with petzval.Session(threads=threads) as session:
                frames.append(session.defocus(shot(camera=petzval.Camera()), petzval.Look(lens="doublet")).image)
        np.testing.assert_array_equal(*frames)

    def test_a_report_and_its_warnings(self):
        frame = petzval.defocus(**vars_of(shot()), look=petzval.Look(engine="gather"))
        self.assertEqual((frame.report["engine"], frame.report["device"]), ("gather", "cpu"))
        self.assertIsInstance(frame.warnings, list)

    def test_errors_name_the_field(self):
        with self.assertRaisesRegex(petzval.InvalidArgument, "depth_m"):
            petzval.defocus(shot().colour)
        with self.assertRaises(petzval.OutOfMemory), petzval.Session(max_memory_bytes=1000) as session:
            session.defocus(shot(400, 400))
        with self.assertRaisesRegex(petzval.InvalidArgument, "gpu:99"), petzval.Session(device="gpu:99"):
            pass
        with self.assertRaises(petzval.InvalidArgument):
            closed = petzval.Session()
            closed.close()
            closed.defocus(shot())

    def test_a_value_of_another_type_is_refused_by_its_name(self):
        given = {"depth_m": np.full((24, 32), 2, np.float32), "camera": petzval.Camera()}
        for wrong, says in (({"camera": {"focal_length_mm": 50}}, "^camera is dict; a petzval.Camera is needed"),
                            ({"camera": petzval.Camera("50mm")}, "^focal_length_mm is str; a number is needed"),
                            ({"depth_unit_m": "1cm"}, "^depth_unit_m is str; a number is needed"),
                            ({"lights": "lights.csv"}, r"^lights\[0\] is str; a petzval.Light is needed"),
                            ({"layers": {"key": 1}}, r"^layers\[0\] is str; a petzval.Layer is needed"),
                            ({"look": "doublet"}, "^look: is not JSON"), ({"look": 3}, "^look is int"),
                            ({"behind": given["depth_m"]}, "^behind is ndarray; a petzval.Deep is needed")):
            with self.subTest(says), self.assertRaisesRegex((petzval.InvalidArgument, petzval.InvalidFile), says):
                petzval.defocus(shot().colour, **{**given, **wrong})
        with self.assertRaisesRegex(petzval.InvalidArgument, "^shot is ndarray; a petzval.Shot is needed"), petzval.Session() as session:
            session.defocus(given["depth_m"])
        with self.assertRaisesRegex(petzval.InvalidArgument, "^lens is NoneType; a name or a path is needed"):
            petzval.Lens(None)

    def test_progress_rises_and_may_cancel(self):
        shares = []
        with petzval.Session(threads=2) as session:
            session.defocus(shot(100, 100), progress=shares.append)
            self.assertTrue(shares and shares == sorted(shares) and shares[-1] <= 1)
            with self.assertRaises(petzval.Cancelled):
                session.defocus(shot(100, 100), progress=lambda done: False)

    def test_an_exception_of_a_callback_is_raised_as_itself(self):
        def broken(done):
            return 1 / 0
        with petzval.Session(threads=2) as session:
            try:
                session.defocus(shot(100, 100), progress=broken)
                self.fail("nothing was raised")
            except ZeroDivisionError as raised:
                self.assertIn("broken", [frame.name for frame in traceback.extract_tb(raised.__traceback__)])

    def test_other_threads_run_meanwhile(self):
        ticks, done = [], threading.Event()

        def tick():
            while not done.wait(0.002):
                ticks.append(time.monotonic())
        ticker = threading.Thread(target=tick)
        ticker.start()
        start = time.monotonic()
        petzval.defocus(**vars_of(shot(300, 300, 9)))
        end = time.monotonic()
        done.set()
        ticker.join()
        during = [t for t in ticks if start < t < end]
        self.assertGreater(len(during), 3, "the GIL is released")

    def test_threads_share_a_session(self):
        with petzval.Session() as session:
            expected = session.defocus(shot()).image
            found = [None] * 4

            def take(i):
                found[i] = session.defocus(shot()).image
            threads = [threading.Thread(target=take, args=(i,)) for i in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            for image in found:
                np.testing.assert_array_equal(image, expected)
            self.assertGreater(session.usage()["lenses"], 0)
            session.trim()
            self.assertEqual(session.usage()["kept_bytes"], 0)


class CtrlC(unittest.TestCase):
    def test_a_frame_stops_within_a_tenth_of_a_second(self):
        # Seconds of work after the signal, not elapsed time: a wait for a core is not petzval's. The frame takes
        # minutes; its preparation is over after the first of these delays or, on a slow machine, the second.
        worked = []
        for delay in ("0.7", "3"):
            out = subprocess.run([sys.executable, "-c", INTERRUPTED, delay], check=True, capture_output=True,
                                 text=True, timeout=120).stdout.strip()
            self.assertNotEqual(out, "finished")
            worked.append(float(out))
            if worked[-1] < 0.1:
                break
        self.assertLess(min(worked), 0.1)

    def test_the_handler_of_a_signal_is_heard(self):
        class Alarm(Exception):
            pass

        def ring(*_):
            raise Alarm
        before = signal.signal(signal.SIGALRM, ring)
        self.addCleanup(signal.signal, signal.SIGALRM, before)
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(Alarm):
            petzval.defocus(**vars_of(shot(700, 700, 40)), look=petzval.Look(engine="reference"))


def vars_of(rendered):
    return {"colour": rendered.colour, "radii_px": rendered.radii_px}


if __name__ == "__main__":
    unittest.main(verbosity=2)
