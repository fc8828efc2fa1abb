"""Every file that is written goes through one door: none replaces an input, another output, a device, a pipe or a
link; what a signal or a dead process leaves unfinished goes."""
import os
import signal
import stat
import subprocess
import unittest

from pictures import camera_attributes, picture, write_exr
from program import CAMERA, PETZVAL, CommandLineTest

LEFT = ".out.exr.999999-0.unfinished"
# Verbs that write a report, and those that write something else besides.
READS = [["inspect", "in.exr"], ["compare", "in.exr", "in.exr"], ["defocus", "in.exr", "-o", "out.exr"],
         ["develop", "in.exr", "-o", "out.png"]]
WRITES = READS[2:] + [["scene", "make", "slant", "-o", "out.exr", "--width", "20", "--height", "10"],
                      ["scene", "points", "city", "-o", "out.csv"], ["lens", "report", "doublet", "-o", "out.html"],
                      ["lens", "psf", "doublet", "-o", "out.exr"], ["lens", "table", "doublet", "-o", "out.exr"]]
TELLS = [["lens", "show", "doublet"], ["lens", "list"], ["scene", "list"]]


class Outputs(CommandLineTest):
    def setUp(self):
        super().setUp()
        write_exr(self.path("in.exr"), picture(24, 16, depth=lambda x, y: 1 + x / 10),
                  attributes=camera_attributes(50, 36, 1.4, 2))

    def test_a_report_never_replaces_an_input(self):
        before = self.content("in.exr")
        os.symlink("in.exr", self.path("link.exr"))
        os.link(self.path("in.exr"), self.path("twin.exr"))
        for verb in READS:
            for name in ("in.exr", "./in.exr", "link.exr", "twin.exr"):
                self.refuse(2, *verb, "--json", name, says=["replace the input"])
        self.assertEqual(self.content("in.exr"), before)

    def test_a_report_never_replaces_a_lens(self):
        with open(self.path("lens.zmx"), "w") as file:
            file.write("SURF 0\n")
        self.refuse(2, "lens", "show", "lens.zmx", "--json", "lens.zmx", says=["replace the input"])

    def test_a_report_never_replaces_the_result(self):
        for verb in WRITES:
            output = verb[verb.index("-o") + 1]
            self.refuse(2, *verb, "--json", output, says=["replace the output", output])
            self.assertFalse(os.path.exists(self.path(output)))

    def test_no_output_is_a_device_a_pipe_or_a_link_to_itself(self):
        os.mkfifo(self.path("pipe"))
        os.symlink("circle", self.path("circle"))
        bad = [("pipe", "pipe"), ("circle", "leads to itself"), (".", "folder"), ("no/report.json", "no such folder")]
        if os.geteuid() == 0:  # a device of our own: a program that fails here would replace the system's
            os.mknod(self.path("null"), 0o666 | stat.S_IFCHR, os.makedev(1, 3))
            bad.append(("null", "device"))
        for verb in READS + WRITES + TELLS:
            for name, says in bad:
                self.refuse(1, *verb, "--json", name, says=[says])
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("pipe")).st_mode))
        self.assertTrue(os.path.islink(self.path("circle")))

    def test_through_a_link_to_nothing_a_result_is_written_where_it_points(self):
        os.symlink("new.exr", self.path("link.exr"))
        self.refuse(2, "defocus", "in.exr", "-o", "link.exr", "--json", "new.exr", says=["replace the output"])
        self.succeed("defocus", "in.exr", "-o", "link.exr")
        self.assertTrue(os.path.islink(self.path("link.exr")))
        self.assertTrue(os.path.isfile(self.path("new.exr")))

    def test_a_report_keeps_a_link_and_the_rights_of_the_file_behind_it(self):
        with open(self.path("real.json"), "w"):
            pass
        os.chmod(self.path("real.json"), 0o640)
        os.symlink("real.json", self.path("link.json"))
        self.succeed("inspect", "in.exr", "--json", "link.json")
        self.assertTrue(os.path.islink(self.path("link.json")))
        self.assertEqual(stat.S_IMODE(os.stat(self.path("real.json")).st_mode), 0o640)
        self.assertIn(b'"verb": "inspect"', self.content("real.json"))

    def test_the_next_run_clears_away_what_a_dead_one_left(self):
        for verb in (READS[0] + ["--json", "report.json"], WRITES[0], WRITES[1]):
            with open(self.path(LEFT), "w") as file:
                file.write("half")
            self.succeed(*verb)
            self.assertNotIn(LEFT, os.listdir(self.folder))

    def test_a_hang_up_leaves_nothing_as_a_termination_does(self):
        scene = ["scene", "make", "slant", "-o", "s.exr", "--truth", "t.exr", "--samples", "100000"]
        for number, code in ((signal.SIGHUP, 129), (signal.SIGTERM, 143)):
            process = subprocess.Popen([PETZVAL, *scene, "--progress", "json"], cwd=self.folder, stderr=subprocess.PIPE,
                                       preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL))
            with process.stderr as errors:
                errors.readline()
                process.send_signal(number)
                errors.read()
            self.assertEqual(process.wait(20), code)
            self.assertEqual(sorted(os.listdir(self.folder)), ["in.exr"])

    def test_nohup_is_obeyed(self):
        process = subprocess.Popen([PETZVAL, "defocus", "in.exr", "-o", "out.exr", "--progress", "json"],
                                   cwd=self.folder, stderr=subprocess.PIPE,
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        with process.stderr as errors:
            process.send_signal(signal.SIGHUP)
            errors.read()
        self.assertEqual(process.wait(20), 0)


class NamesOfFrames(CommandLineTest):
    """A name with #### stands for many files: a run that writes one file refuses it before the work."""

    def test_one_file_has_no_frame_number(self):
        write_exr(self.path("in.exr"), picture(16, 8, 0.5, 3))
        for words in (["inspect", "in.exr", "--json", "x.####.json"],
                      ["defocus", "in.exr", "-o", "out.exr", *CAMERA, "--json", "x.%04d.json"],
                      ["defocus", "in.exr", "-o", "out.exr", *CAMERA, "--save-look", "x.####.json"],
                      ["develop", "in.exr", "-o", "out.png", "--json", "x.####.json"],
                      ["compare", "in.exr", "in.exr", "--json", "x.####.json"],
                      ["scene", "make", "bars", "-o", "out.exr", "--truth", "x.####.exr"],
                      ["scene", "points", "city", "-o", "x.####.csv"],
                      ["lens", "psf", "doublet", "-o", "x.####.png"],
                      ["lens", "show", "doublet", "--json", "x.####.json"],
                      ["lens", "report", "doublet", "-o", "x.####.html"]):
            self.refuse(2, *words, says=["names many frames", next(w for w in words if w.startswith("x."))])
        self.assertEqual(os.listdir(self.folder), ["in.exr"])

    def test_one_file_of_a_shot_has_none_either(self):
        for frame in (1, 2):
            write_exr(self.path("in.000%d.exr" % frame), picture(16, 8, 0.5, 3))
        before = sorted(os.listdir(self.folder))
        for words in (["sheet", "in.####.exr", "-o", "x.####.png"],
                      ["focus-track", "in.####.exr", "-o", "x.####.csv", "--at", "3,3"],
                      ["focus-track", "in.####.exr", "-o", "t.csv", "--plot", "x.####.svg", "--at", "3,3"],
                      ["inspect", "in.####.exr", "--report", "x.####.jsonl"]):
            self.refuse(2, *words, says=["names many frames"])
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.succeed("inspect", "in.####.exr", "--json", "x.####.json")
        self.assertTrue(os.path.exists(self.path("x.0002.json")))

    def test_a_file_of_that_very_name_is_one_file(self):
        write_exr(self.path("in.exr"), picture(16, 8, 0.5, 3))
        open(self.path("take #2.json"), "w").close()
        self.succeed("inspect", "in.exr", "--json", "take #2.json")


if __name__ == "__main__":
    unittest.main()
