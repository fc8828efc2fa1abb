"""Jobs for render farms: what farm write leaves, run by the tools of each system or by a stand-in of them."""
import json
import os
import re
import shutil
import subprocess
import unittest

from pictures import plane, write_exr
from program import CAMERA, PETZVAL, CommandLineTest

DTD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "shared", "farm-formats", "cjsl-1.15.dtd")
PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "reference", "farm-files.md")
# Flamenco's functions for job types, as its documentation describes them; prints the tasks.
FLAMENCO = r"""
const out = [];
const author = {
  Task: (name, type) => ({name, type, commands: [], addCommand(c) { this.commands.push(c); }}),
  Command: (name, parameters) => ({name, parameters}),
};
function frameChunker(range, size) {
  const frames = new Set();
  for (const part of range.split(",")) {
    const [a, b] = part.trim().split("-").map(Number);
    for (let f = a; f <= (b === undefined ? a : b); ++f) frames.add(f);
  }
  const sorted = [...frames].sort((a, b) => a - b), chunks = [];
  for (let i = 0; i < sorted.length; i += size) chunks.push(sorted.slice(i, i + size).join(","));
  return chunks;
}
const settings = Object.fromEntries(JOB_TYPE.settings.map((s) => [s.key, s.default]));
compileJob({name: "test", settings, addTask: (task) => out.push(task)});
console.log(JSON.stringify(out));
"""


class Farm(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in (1, 2, 3):
            self.make(frame)

    def make(self, frame):
        write_exr(self.path("in.%04d.exr" % frame),
                  {"R": plane(24, 16, lambda x, y: (x * frame) % 5), "G": plane(24, 16, 1.0),
                   "B": plane(24, 16, 0.5), "A": plane(24, 16, 1.0), "Z": plane(24, 16, lambda x, y: 1 + y / 4)})

    def shot(self, output):
        return ["in.####.exr", "-o", output, "--rack", "1:1m", "3:3m", *CAMERA[:6]]

    def write(self, system, *options, frames=(), output="out.####.exr"):
        return self.succeed("farm", "write", "--for", system, "-o", "job", *options, "--", *self.shot(output), *frames)

    def text(self, name):
        return self.content(os.path.join("job", name)).decode()

    def job(self, *command):
        return subprocess.run(command, cwd="/", capture_output=True, text=True, timeout=120,
                              env={**os.environ, "PETZVAL_KERNEL_CACHE": "off"})

    def assert_same_as_one_run(self, frames=(1, 2, 3)):
        self.succeed("defocus", *self.shot("ref.####.exr"))
        for frame in frames:
            self.assertEqual(self.content("out.%04d.exr" % frame), self.content("ref.%04d.exr" % frame))

    def test_the_page_of_farm_files_shows_what_is_written(self):
        with open(PAGE) as file:
            page = file.read()
        shown = dict(re.findall(r"`jobs/([\w/.]+)`:\n\n```\w+\n(.*?)\n```", page, re.DOTALL))
        self.assertEqual(len(shown), 6)
        for folder in ("render", "comp", "jobs"):
            os.mkdir(self.path(folder))
        for frame in range(1001, 1013):
            os.rename(self.path("in.0001.exr"), self.path("render/sh010.%d.exr" % frame))
            self.make(1)
        for name, text in shown.items():
            system = name.split("/")[0]
            self.succeed("farm", "write", "--for", system, "--chunk", "4", "-o", "jobs/" + system, "--",
                         "render/sh010.####.exr", "-o", "comp/sh010.####.exr", "--lens", "doublet", "--max-memory", "2G",
                         "--threads", "2", "-q")
            written = self.content("jobs/" + name).decode().rstrip()
            written = written.replace(os.path.realpath(self.folder), "/srv/shots/sh010")
            self.assertEqual(written.replace(os.path.realpath(PETZVAL), "/usr/bin/petzval"), text, name)

    def test_a_list_run_by_xargs_makes_the_pictures_of_one_run(self):
        self.write("list", "--chunk", "1")
        lines = self.text("commands").splitlines()
        self.assertEqual(len(lines), 3)
        done = subprocess.run(["xargs", "-d", "\\n", "-n1", "-P2", "sh", "-c"], input="\n".join(lines), text=True,
                              capture_output=True, cwd="/", timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_as_one_run()
        self.assertEqual(len(os.listdir(self.path("job/records"))), 3)

    def test_a_measured_frame_says_how_many_one_process_takes(self):
        self.write("list")
        facts = json.loads(self.text("shot.json"))
        self.assertGreater(facts["seconds_per_frame"], 0)
        self.assertEqual(facts["chunk"], 3)  # far less than a minute for all
        self.assertGreaterEqual(facts["memory_bytes"], 256 << 20)
        self.assertEqual(sorted(os.listdir(self.path("job"))), ["commands", "run.sh", "shot.json"])

    def test_a_chunk_run_again_keeps_what_is_there(self):
        self.write("list", "--chunk", "3")
        self.job(self.path("job/run.sh"), "1-2")
        before = os.stat(self.path("out.0001.exr")).st_mtime_ns
        self.assertEqual(self.job(self.path("job/run.sh"), "1-3").returncode, 0)
        self.assertEqual(os.stat(self.path("out.0001.exr")).st_mtime_ns, before)
        self.assert_same_as_one_run()

    def test_the_last_line_says_whether_to_try_again(self):
        self.write("list", "--chunk", "3")
        run = self.path("job/run.sh")
        with open(self.path("in.0002.exr"), "wb") as file:
            file.write(b"junk")
        os.mkdir(self.path("locked"))
        for frames, code, last in (("1", 0, "done"), ("1-2", 4, "wrong input of some frames: never retry"),
                                   ("9", 3, "wrong input: never retry"), ("a", 2, "wrong command: never retry")):
            done = self.job(run, frames)
            self.assertEqual((done.returncode, done.stderr.splitlines()[-1]), (code, "petzval-farm: " + last), done.stderr)

    def test_a_full_disk_is_always_tried_again(self):
        os.mkdir(self.path("disk"))
        mount = ["mount", "-t", "tmpfs", "-o", "size=4k", "tmpfs", self.path("disk")]
        if os.geteuid() != 0 or not shutil.which("mount") or subprocess.run(mount, capture_output=True).returncode:
            self.skipTest("a small disk of its own needs root and mount")
        self.addCleanup(subprocess.run, ["umount", self.path("disk")])
        self.write("list", "--chunk", "3", output="disk/out.####.exr")
        done = self.job(self.path("job/run.sh"), "1-3")
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertEqual(done.stderr.splitlines()[-1], "petzval-farm: output not written: always retry")
        subprocess.run(["mount", "-o", "remount,size=4m", self.path("disk")], check=True)
        self.assertEqual(self.job(self.path("job/run.sh"), "1-3").returncode, 0)

    def test_slurm_runs_each_frame_once(self):
        self.write("slurm", "--chunk", "2")
        self.assertEqual(self.job("bash", "-n", self.path("job/petzval.sbatch")).returncode, 0)
        self.assertIn("#SBATCH --array=0-1\n", self.text("petzval.sbatch"))
        for element in ("0", "1"):
            done = subprocess.run(["bash", self.path("job/petzval.sbatch")], capture_output=True, text=True, cwd="/",
                                  env={**os.environ, "SLURM_ARRAY_TASK_ID": element, "SLURM_CPUS_PER_TASK": "1"})
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_as_one_run()

    @unittest.skipUnless(shutil.which("node"), "needs node")
    def test_flamenco_compiles_a_job_whose_tasks_make_the_shot(self):
        self.write("flamenco", "--chunk", "2")
        script = self.path("run.js")
        with open(script, "w") as file:
            file.write('"use strict";\n' + self.text("petzval_shot.js") + FLAMENCO)
        done = self.job("node", script)
        self.assertEqual(done.returncode, 0, done.stderr)
        tasks = json.loads(done.stdout)
        self.assertEqual([t["name"] for t in tasks], ["frames 1,2", "frames 3"])
        for command in (c for task in tasks for c in task["commands"]):
            self.assertEqual(command["name"], "exec")
            parameters = command["parameters"]
            self.assertEqual(self.job(parameters["exe"], *parameters["args"]).returncode, 0)
        self.assert_same_as_one_run()

    def test_steps_are_written_as_each_system_has_them(self):
        for frame in (5, 7):
            self.make(frame)
        steps = ["--frames", "1-7x2"]
        for system, name, text in (("list", "commands", "run.sh 1-7x2\n"), ("openjd", "petzval.template.json", '"1-7:2"'),
                                   ("opencue", "petzval.xml", "<range>1-7x2</range>"),
                                   ("flamenco", "petzval_shot.js", '"1,3,5,7"'), ("slurm", "petzval.sbatch", "    1-7x2\n")):
            self.write(system, "--chunk", "4", frames=steps)
            self.assertIn(text, self.text(name), system)
        self.assertIn('"NONCONTIGUOUS"', self.text("petzval.template.json"))
        self.assertEqual(self.job(self.path("job/run.sh"), "1-7:2").returncode, 0)
        self.assert_same_as_one_run((1, 3, 5, 7))

    @unittest.skipUnless(shutil.which("xmllint") and os.path.exists(DTD), "needs xmllint and ../shared")
    def test_opencue_accepts_the_specification(self):
        self.write("opencue", "--chunk", "2")
        done = self.job("xmllint", "--nonet", "--noout", "--dtdvalid", DTD, self.path("job/petzval.xml"))
        self.assertEqual(done.returncode, 0, done.stderr)

    def damage(self, name):
        with open(self.path(name), "wb") as file:
            file.write(b"junk")

    def state(self, verb="status", code=0):
        outcome = self.run_program("farm", verb, "job", "--json", "-")
        self.assertEqual(outcome.code, code, outcome)
        return {f["frame"]: f["state"] for f in json.loads(outcome.out)["frames"]}

    def test_status_says_of_each_frame_what_became_of_it(self):
        self.write("list", "--chunk", "3")
        self.damage("in.0002.exr")
        self.assertEqual(self.state(), {1: "left", 2: "left", 3: "left"})
        self.job(self.path("job/run.sh"), "1-2")
        self.assertEqual(self.state(), {1: "complete", 2: "failed", 3: "left"})
        said = self.succeed("farm", "status", "job").out
        for line in ("job: 3 frames, 1-3", "  complete  1  1", "  failed    1  2", "  left      1  3"):
            self.assertIn(line + "\n", said)
        self.assertRegex(said, r"frame 2: in.0002.exr: .*\nseconds per frame: median [0-9.]+, slowest [0-9.]+ \(frame 1\)\n"
                               r"memory: peak [0-9]+M\n")

    def test_collect_finds_a_cut_frame_merges_records_and_leaves_commands(self):
        self.write("list", "--chunk", "1")
        self.job(self.path("job/run.sh"), "1-3")
        os.truncate(self.path("out.0002.exr"), 300)
        self.assertEqual(self.state(), {1: "complete", 2: "complete", 3: "complete"})  # a glance reads no pictures
        self.assertEqual(self.state("collect", 1), {1: "complete", 2: "damaged", 3: "complete"})
        self.assertEqual([json.loads(line)["frame"] for line in self.text("report.jsonl").splitlines()], [1, 2, 3])
        self.assertEqual(self.text("left"), self.path("job/run.sh") + " 2\n")
        self.assertEqual(self.job("sh", self.path("job/left")).returncode, 0)
        self.assertEqual(self.state("collect"), {1: "complete", 2: "complete", 3: "complete"})
        self.assertNotIn("left", os.listdir(self.path("job")))
        self.assert_same_as_one_run()

    def test_a_wrong_input_is_never_tried_again(self):
        self.write("list", "--chunk", "3")
        self.damage("in.0002.exr")
        self.job(self.path("job/run.sh"), "1-3")
        self.assertEqual(self.state("collect", 4)[2], "failed")
        self.assertNotIn("left", os.listdir(self.path("job")))

    def test_a_record_that_a_killed_process_left_unfinished_is_skipped(self):
        self.write("list", "--chunk", "3")
        self.job(self.path("job/run.sh"), "1-3")
        with open(self.path("job/records/1.n9.7.jsonl"), "w") as file:
            file.write('[]\n{"frame": "1"}\n{"frame": 1e99}\n{"frame": 2, "seconds": 3, "engine": 4}\n{"frame": 3, "er')
        self.assertEqual(self.state("collect"), {1: "complete", 2: "complete", 3: "complete"})

    def slurm(self, queue=""):
        """Stand-ins of sbatch and squeue, which note how they were called."""
        os.makedirs(self.path("bin"), exist_ok=True)
        for name, answer in (("sbatch", "41;cluster\n"), ("squeue", queue)):
            with open(self.path("bin/" + name), "w") as file:
                os.fchmod(file.fileno(), 0o755)
                file.write(f"#!/bin/sh\necho {name} \"$@\" >> {self.path('calls')}\nprintf '{answer}'\n")
        return {"PATH": self.path("bin") + ":" + os.environ["PATH"]}

    def test_submit_and_resubmit_start_only_what_is_not_complete(self):
        self.write("slurm", "--chunk", "1")
        self.succeed("farm", "submit", "job", env=self.slurm())
        self.assertEqual(self.text("slurm_jobs"), "41\n")
        busy = self.slurm("41 RUNNING\n41 PENDING\n41 PENDING\n7 RUNNING\n")
        self.assertIn("Slurm: 2 PENDING, 1 RUNNING\n", self.succeed("farm", "status", "job", env=busy).out)
        self.refuse(2, "farm", "submit", "job", env=busy, says=["still in Slurm's queue: 2 PENDING, 1 RUNNING"])
        self.job(self.path("job/run.sh"), "2")
        self.succeed("farm", "collect", "job", "--resubmit", env=self.slurm())
        with open(self.path("calls")) as file:
            calls = [line for line in file.read().splitlines() if line.startswith("sbatch")]
        script = self.path("job/petzval.sbatch")
        self.assertEqual(calls, [f"sbatch --parsable {script}", f"sbatch --parsable --array=0,2 {script}"])

    def test_a_folder_that_is_no_job_is_refused(self):
        os.mkdir(self.path("job"))
        self.refuse(3, "farm", "status", "job", says=["shot.json", "not a job"])
        for text in ("", "[]", "{}", '{"frames": "1-2000000", "output": "o"}', '{"frames": "1"}'):
            with open(self.path("job/shot.json"), "w") as file:
                file.write(text)
            for verb in ("status", "collect", "submit"):
                self.refuse(3, "farm", verb, "job", says=["shot.json"])
        self.write("list", "--chunk", "3")
        self.refuse(2, "farm", "submit", "job", says=["petzval.sbatch", "--for slurm"])

    def test_what_cannot_be_a_job_is_refused(self):
        job = ["farm", "write", "--for", "list", "-o", "job"]
        self.refuse(2, *job[:4], "--", *self.shot("out.####.exr"), says=["-o FOLDER"])
        self.refuse(2, *job, says=["after --"])
        self.refuse(2, *job, "in.####.exr", says=["the output frames after --, as -o OUT"])
        self.refuse(2, *job, "--", "in.0001.exr", "-o", "out.exr", *CAMERA, says=["####"])
        self.refuse(2, *job, "--", *self.shot("out.####.exr"), "--fstops", "2", says=["--fstops"])
        self.refuse(2, *job, "--", *self.shot("out.####.exr"), "--report", "r", says=["--report"])
        self.refuse(3, *job, "--", *self.shot("out.####.exr"), "--frames", "1-9", says=["missing"])
        self.refuse(2, "farm", "write", "--for", "pbs", "-o", "job", "--", *self.shot("out.####.exr"), says=["slurm"])
        self.make(-1)
        self.refuse(2, "farm", "write", "--for", "flamenco", "-o", "job", "--", "in.%04d.exr", "-o", "out.%04d.exr", *CAMERA,
                    "--frames=-1", says=["negative"])


if __name__ == "__main__":
    unittest.main()
