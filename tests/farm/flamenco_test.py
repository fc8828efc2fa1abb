"""A shot through Flamenco's manager and worker. PETZVAL names our program, FLAMENCO the folder of flamenco-manager and
flamenco-worker."""
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time
import unittest
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))

from pictures import plane, write_exr  # noqa: E402
from program import CAMERA, CommandLineTest  # noqa: E402

FLAMENCO = os.environ.get("FLAMENCO")
FRAMES = range(1, 7)
ENDED = ("completed", "failed", "canceled")


def free_port():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


@unittest.skipUnless(FLAMENCO, "FLAMENCO names no folder with flamenco-manager and flamenco-worker")
class Flamenco(CommandLineTest):
    def setUp(self):
        super().setUp()
        for frame in FRAMES:
            write_exr(self.path("in.%04d.exr" % frame),
                      {"R": plane(24, 16, lambda x, y: (x * frame) % 5), "G": plane(24, 16, 1.0), "B": plane(24, 16, 0.5),
                       "A": plane(24, 16, 1.0), "Z": plane(24, 16, lambda x, y: 1 + y / 4)})
        self.shot = ["in.####.exr", "-o", "out.####.exr", *CAMERA, "--frames", "1-6"]
        self.succeed("farm", "write", "--for", "flamenco", "-o", "job", "--chunk", "2", "--", *self.shot)

    def start(self, program, settings, folder):
        """Starts a copy of a program of Flamenco in a folder of its own: scripts of job types lie beside the program."""
        os.makedirs(self.path(folder), exist_ok=True)
        copy = shutil.copy(os.path.join(FLAMENCO, program), self.path(folder))
        with open(self.path(f"{folder}/{program}.yaml"), "w") as file:
            file.write(json.dumps(settings))  # JSON is YAML
        log = open(self.path(f"{folder}/log"), "w")
        self.addCleanup(log.close)
        process = subprocess.Popen([copy], cwd=self.path(folder), stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                   env={**os.environ, "FLAMENCO_HOME": self.path(folder), "PETZVAL_KERNEL_CACHE": "off"})
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

    def ask(self, what, body=None):
        request = urllib.request.Request(self.url + "api/v3/" + what, json.dumps(body).encode() if body else None,
                                         {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.load(answer)

    def until(self, ready, seconds=240):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if found := ready():
                    return found
            except OSError:
                pass  # not listening yet
            time.sleep(0.5)
        self.fail("".join(open(self.path(f"{n}/log"), errors="replace").read()[-3000:] for n in ("manager", "worker")
                          if os.path.exists(self.path(f"{n}/log"))))

    def finished_job(self):
        port = free_port()
        self.url = f"http://127.0.0.1:{port}/"
        os.makedirs(self.path("manager/scripts"))
        os.rename(self.path("job/petzval_shot.js"), self.path("manager/scripts/petzval_shot.js"))
        self.start("flamenco-manager", {"_meta": {"version": 3}, "listen": f"127.0.0.1:{port}", "autodiscoverable": False,
                                        "shared_storage_path": self.path("shared"), "shaman": {"enabled": False},
                                        "task_fail_after_softfail_count": 1}, "manager")
        types = self.until(lambda: self.ask("jobs/types")["job_types"])
        self.assertIn("petzval-shot", [t["name"] for t in types])
        self.start("flamenco-worker", {"manager_url": self.url, "task_types": ["misc"]}, "worker")
        job = self.ask("jobs", {"name": "shot", "type": "petzval-shot", "priority": 50, "submitter_platform": "linux",
                                "settings": {"frames": "1-6", "chunk_size": 2, "run": self.path("job/run.sh")}})["id"]
        self.until(lambda: self.ask(f"jobs/{job}")["status"] in ENDED)
        return self.ask(f"jobs/{job}")["status"], self.ask(f"jobs/{job}/tasks")["tasks"]

    def test_a_shot_has_the_pictures_of_one_run(self):
        status, tasks = self.finished_job()
        self.assertEqual((status, len(tasks)), ("completed", 3))
        self.succeed("defocus", "in.####.exr", "-o", "ref.####.exr", *CAMERA, "--frames", "1-6")
        for frame in FRAMES:
            self.assertEqual(self.content("out.%04d.exr" % frame), self.content("ref.%04d.exr" % frame), frame)

    def test_a_damaged_input_fails_its_task(self):
        with open(self.path("in.0002.exr"), "wb") as file:
            file.write(b"junk")
        status, tasks = self.finished_job()
        self.assertEqual(status, "failed")
        self.assertEqual([t["name"] for t in tasks if t["status"] == "failed"], ["frames 1,2"])


if __name__ == "__main__":
    unittest.main()
