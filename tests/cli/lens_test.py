"""petzval lens list and show: the fixed keys, files of every kind, and errors for files that are not a lens."""
import ctypes
import json
import os
import pathlib
import shutil
import struct
import sys
import unittest

from program import CommandLineTest

KEYS = ["efl_mm", "bfl_mm", "f_number", "entrance_pupil_position_mm", "entrance_pupil_diameter_mm",
        "exit_pupil_position_mm", "exit_pupil_diameter_mm"]
SUMS = ["S_I", "S_II", "S_III", "S_IV", "S_V", "C_I", "C_II"]
LENSES = pathlib.Path(__file__).resolve().parents[2] / "lenses"

SINGLET_ZMX = """VERS 1
MODE SEQ
UNIT MM X W X CM MR CPMM
ENPD 10
FTYP 0 0 1 1
YFLN 5
WAVM 1 0.5875618 1
SURF 0
  TYPE STANDARD
  DISZ INFINITY
SURF 1
  STOP
  TYPE STANDARD
  CURV 0.01934984520123839
  DISZ 0
  GLAS ___BLANK 1 0 1.5168 64.17 0 0 0
  DIAM 6
SURF 2
  TYPE STANDARD
  CURV 0
  DISZ 100
SURF 3
  TYPE STANDARD
"""


class LensList(CommandLineTest):
    def test_lists_the_ideal_lens_curves_and_prescriptions(self):
        lenses = {lens["name"]: lens for lens in self.report("lens", "list")["lenses"]}
        self.assertEqual(lenses["ideal"]["model"], "ideal")
        self.assertEqual(lenses["doublet"]["model"], "curves")
        prescriptions = [lens for lens in lenses.values() if lens["model"] == "prescription"]
        self.assertGreaterEqual(len(prescriptions), 12)
        for lens in prescriptions:
            for key in ("title", "class", "source", "history", "efl_mm", "f_number"):
                self.assertTrue(lens[key], f"{lens['name']} {key}")
        self.assertIn("double-gauss", self.succeed("lens", "list").out)


    def names(self, *words):
        return [lens["name"] for lens in self.report("lens", "list", *words)["lenses"]]

    def test_lenses_are_found_by_the_names_people_use(self):
        for word, name in (("Helios", "biotar"), ("Speed Panchro", "speed-panchro"), ("planar", "planar"),
                           ("Sonnar", "sonnar-fe-55"), ("Biotar", "biotar")):
            self.assertIn(name, self.names(*word.split()))
            self.assertEqual(self.report("lens", "show", word)["lens"]["name"], name)
        self.assertGreaterEqual(len(self.names()), 60)
        self.refuse(2, "lens", "list", "xyzzy", says=["xyzzy"])

    def test_the_list_can_be_sorted(self):
        lenses = self.report("lens", "list", "--sort", "fstop")["lenses"]
        numbers = [lens["f_number"] for lens in lenses if lens["f_number"]]
        self.assertEqual(numbers, sorted(numbers))
        self.assertEqual(self.names("--sort", "name"), sorted(self.names()))
        years = [lens["year"] for lens in self.report("lens", "list", "--sort", "year")["lenses"] if lens["year"]]
        self.assertEqual(years, sorted(years))


TABLE = """Tronnier, f = 50 F/2
1 29.475 3.76 1.67 47.1
2 84.83 0.12
3 19.275 4.025 1.67 47.1
4 40.77 3.275 1.699 30.1
5 12.75 5.705
6 stop 4.5
7 -14.495 1.18 1.603 38.0
8 40.77 6.065 1.658 57.3
9 -20.385 0.19
10 437.065 3.22 1.717 48.0
11 -39.73 0
"""


class LensCheck(CommandLineTest):
    def write(self, text):
        with open(self.path("table.txt"), "w") as file:
            file.write(text)

    def test_a_pasted_table_is_held_against_what_it_prints(self):
        self.write(TABLE)
        outcome = self.succeed("lens", "check", "table.txt")
        self.assertIn("table of surfaces, 11 surfaces", outcome.out)
        self.assertRegex(outcome.out, r"focal length  (49|50)\.\d+ mm  \(printed 50 mm")
        self.assertIn("no doubts", outcome.out)

    def test_doubts_have_an_exit_code_of_their_own(self):
        for change, says in ((("f = 50", "f = 75"), "prints a focal length of 75 mm"),
                             (("2 84.83 0.12", "2 84.83 -3"), "surfaces 2 and 3 overlap"),
                             (("1 29.475 3.76", "1 29.475 0.5"), "surfaces 1 and 2")):
            self.write(TABLE.replace(*change))
            outcome = self.run_program("lens", "check", "table.txt")
            self.assertEqual(outcome.code, 5, outcome)
            self.assertIn("doubt: ", outcome.out)
            self.assertIn(says, outcome.out)
            report = json.loads(self.run_program("lens", "check", "table.txt", "--json", "-").out)
            self.assertTrue(any(says in doubt for doubt in report["doubts"]), report["doubts"])

    def test_a_glass_without_a_catalogue_entry_is_said_to_be_assumed(self):
        self.write(TABLE)
        report = self.report("lens", "check", "table.txt")
        self.assertTrue(report["warnings"])
        self.assertEqual(report["printed_efl_mm"], 50)
        self.assertEqual(report["printed_f_number"], 2)

    def test_what_is_no_lens_is_refused(self):
        self.write("nothing\n")
        self.refuse(3, "lens", "check", "table.txt", says=["table.txt"])
        self.refuse(2, "lens", "check", "doublet", says=["no surfaces"])


class LensShow(CommandLineTest):
    def test_fixed_keys_of_a_lens_that_ships(self):
        report = self.report("lens", "show", "triplet-sample")
        for key in KEYS:
            self.assertIsInstance(report[key], float, key)
        self.assertEqual(list(report["seidel"]), SUMS)
        self.assertAlmostEqual(report["efl_mm"], 49.99978307143194, places=10)
        self.assertAlmostEqual(report["entrance_pupil_position_mm"], 11.51215867374679, places=10)
        curves = report["longitudinal_aberration_mm"]
        for shifts in curves["axis_crossing_minus_primary_paraxial_focus"].values():
            self.assertEqual(len(shifts), len(curves["pupil_zone"]))

    def test_a_file_says_the_same_as_the_name(self):
        by_name, by_file = (self.report("lens", "show", lens) for lens in ("tessar", str(LENSES / "tessar.json")))
        for key in KEYS + ["seidel", "longitudinal_aberration_mm", "field"]:
            self.assertEqual(by_name[key], by_file[key], key)

    def test_an_entry_saved_alone_may_bring_its_own_glass(self):
        entry = json.loads((LENSES / "triplet-sample.json").read_text())
        glasses = json.loads((LENSES / "glasses.json").read_text())["glasses"]
        entry["glasses"] = [dict(glass, name="MY-" + glass["name"]) for glass in glasses]
        for surface in entry["surfaces"]:
            if surface["medium"] != "air":
                surface["medium"] = {"glass": "MY-" + surface["medium"]["glass"]}
        pathlib.Path(self.path("own.json")).write_text(json.dumps(entry))
        own, shipped = self.report("lens", "show", "own.json"), self.report("lens", "show", "triplet-sample")
        self.assertEqual(own["efl_mm"], shipped["efl_mm"])
        self.assertEqual(own["seidel"], shipped["seidel"])

    def test_zemax_in_utf16_and_latin1(self):
        for encoding in ("utf-16", "utf-16-be", "latin-1"):
            pathlib.Path(self.path("singlet.zmx")).write_text(SINGLET_ZMX, encoding=encoding)
            report = self.report("lens", "show", "singlet.zmx")
            self.assertAlmostEqual(report["efl_mm"], 100, places=6)
            self.assertEqual(report["format"], "Zemax .zmx")
            self.assertTrue(any("nd and Vd" in line for line in report["warnings"]))

    def test_a_damaged_file_is_refused_with_its_line(self):
        pathlib.Path(self.path("bad.zmx")).write_text(SINGLET_ZMX.replace("CURV 0\n", "CURV zero\n"))
        self.refuse(3, "lens", "show", "bad.zmx", says=["bad.zmx: line 20", "zero"])

    def test_an_unknown_name_is_a_usage_error_that_names_some_lenses(self):
        self.refuse(2, "lens", "show", "no-such-lens", says=["no-such-lens", "double-gauss", "petzval lens list"])

    def test_people_get_a_table(self):
        text = self.succeed("lens", "show", "petzval-portrait").out
        for word in ("Petzval", "focal length", "S_III", "587.6 nm", "tangential", "1840"):
            self.assertIn(word, text)


class Opens:
    """Counts how often a file is opened, as the kernel tells it."""
    IN_OPEN, IN_CLOSE = 0x20, 0x18  # both watched: like events that follow each other are told once

    def __init__(self, path):
        self.libc = ctypes.CDLL(None, use_errno=True)
        self.watch = self.libc.inotify_init1(os.O_NONBLOCK)
        if self.watch < 0 or self.libc.inotify_add_watch(
                self.watch, os.fsencode(path), self.IN_OPEN | self.IN_CLOSE) < 0:
            raise OSError(ctypes.get_errno(), "inotify")

    def count(self):
        """Since the last call."""
        events = 0
        try:
            data = os.read(self.watch, 1 << 16)
        except BlockingIOError:
            return 0
        while data:
            _, mask, _, length = struct.unpack_from("iIII", data)
            events += bool(mask & self.IN_OPEN)
            data = data[16 + length:]
        return events


@unittest.skipUnless(sys.platform == "linux", "inotify")
class LensFileIsOpenedOnce(CommandLineTest):
    def setUp(self):
        super().setUp()
        shutil.copy(LENSES / "tessar.json", self.path("my.json"))
        self.opens = Opens(self.path("my.json"))

    def test_by_a_run_with_ghosts_stars_and_vignetting(self):
        self.succeed("scene", "make", "night", "-o", "night.exr", "--width", "64", "--height", "36")
        self.succeed("defocus", "night.exr", "-o", "out.exr", "--lens", "my.json", "--focal-length", "50mm",
                     "--sensor-width", "36mm", "--fstop", "4", "--focus", "2m", "--blades", "6", "--ghosts", "0.1",
                     "--star", "0.1", "--vignetting", "--kernel-cache", "kept")
        self.assertEqual(self.opens.count(), 1)

    def test_by_what_shows_a_lens(self):
        for command in (["show", "my.json"], ["psf", "my.json", "-o", "disc.exr"],
                        ["table", "my.json", "--columns", "3", "--defocus", "4", "-o", "table.exr"]):
            self.succeed("lens", *command)
            self.assertEqual(self.opens.count(), 1, command)

    def test_a_pipe_is_refused_and_not_waited_for(self):
        os.mkfifo(self.path("pipe.json"))
        self.refuse(3, "lens", "show", "pipe.json", says=["pipe.json", "regular file"])


if __name__ == "__main__":
    unittest.main()
