"""A shot on a Slurm cluster of three nodes on this machine, with faults. PETZVAL names the program. Needs root,
slurm-wlm and munge; starts its own daemons on loopback ports and ends them."""
import glob
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))

import program  # noqa: E402
from pictures import plane, write_exr  # noqa: E402
from program import CAMERA, CommandLineTest  # noqa: E402

program.TIME_LIMIT_S = 600  # a busy machine
NODES = ("n1", "n2", "n3")
CONF = """ClusterName=petzval
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={ports[0]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=3
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
SlurmctldPidFile={folder}/ctld.pid
SlurmdPidFile={folder}/%n.pid
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldLogFile={folder}/ctld.log
SlurmdLogFile={folder}/%n.log
ReturnToService=2
SlurmdTimeout=5
KillWait=1
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmdParameters=config_overrides
PartitionName=all Nodes=n1,n2,n3 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


@unittest.skipUnless(os.geteuid() == 0 and shutil.which("slurmctld") and shutil.which("munged"), "needs root, Slurm, munge")
class Cluster(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.slurm = self.path("slurm")
        for name in ("", "state", *NODES):
            os.makedirs(os.path.join(self.slurm, name))
        os.chmod(self.folder, 0o755)
        self.conf = os.path.join(self.slurm, "slurm.conf")
        self.env = {**os.environ, "SLURM_CONF": self.conf, "PETZVAL_KERNEL_CACHE": "off", "PETZVAL_FARM_WAIT": "1"}
        host, ports = socket.gethostname().split(".")[0], free_ports(4)
        with open(self.conf, "w") as file:
            file.write(CONF.format(host=host, ports=ports, folder=self.slurm))
            for node, port in zip(NODES, ports[1:]):
                file.write(f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1 RealMemory=2000\n")
        self.addCleanup(self.end)
        with open(os.path.join(self.slurm, "key"), "wb") as file:
            os.fchmod(file.fileno(), 0o400)
            file.write(os.urandom(1024))
        at = {k: os.path.join(self.slurm, v) for k, v in
              (("key-file", "key"), ("socket", "munge.socket"), ("pid-file", "munge.pid"), ("log-file", "munge.log"),
               ("seed-file", "seed"))}
        self.call("munged", "--force", *[f"--{name}={path}" for name, path in at.items()])
        self.call("slurmctld")

    def call(self, *command):
        done = subprocess.run(command, env=self.env, cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def processes(self, *environment):
        """Processes of this cluster whose environment also holds these lines."""
        wanted = {f"SLURM_CONF={self.conf}", *environment}
        for path in glob.glob("/proc/[0-9]*/environ"):
            try:
                with open(path, "rb") as file:
                    held = set(file.read().decode(errors="replace").split("\0"))
            except OSError:
                continue
            if wanted <= held:
                yield int(path.split("/")[2])

    def kill(self, *pids):
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def pid_of(self, name):
        with open(os.path.join(self.slurm, name + ".pid")) as file:
            return int(file.read())

    def die(self, node):
        """A node and all its processes end at once: none is left to report another's end."""
        jobs = list(self.processes(f"SLURMD_NODENAME={node}"))
        parents = {int(pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[1]) for pid in jobs}
        pids = [self.pid_of(node), *(parents - {1}), *jobs]  # a job's parent is its slurmstepd
        for pid in pids:
            os.kill(pid, signal.SIGSTOP)
        self.kill(*pids)

    def end(self):
        self.kill(*self.processes())
        if os.path.exists(os.path.join(self.slurm, "munge.pid")):
            self.kill(self.pid_of("munge"))

    def wait(self, what, condition, seconds=600, step=0.3):
        end = time.monotonic() + seconds
        while not condition():
            self.hurry()
            self.assertLess(time.monotonic(), end, f"waited too long: {what}\n{self.logs()}")
            time.sleep(step)

    def hurry(self):
        """Slurm waits about two minutes before it runs a requeued element; not here."""
        waiting = subprocess.run(["squeue", "-h", "-t", "PD", "-o", "%A"], env=self.env, text=True, capture_output=True)
        for job in waiting.stdout.split():
            subprocess.run(["scontrol", "update", f"JobId={job}", "StartTime=now"], env=self.env, capture_output=True)

    def logs(self):
        return "".join(pathlib.Path(p).read_text() for p in sorted(glob.glob(self.path("job/log.*.txt"))))

    def shot(self, output, frames, *look):
        os.makedirs(self.path("out"))
        for frame in range(1, frames + 1):
            write_exr(self.path("in.%04d.exr" % frame),
                      {"R": plane(64, 48, lambda x, y: (x * frame) % 5), "G": plane(64, 48, 1.0), "B": plane(64, 48, 0.5),
                       "A": plane(64, 48, 1.0), "Z": plane(64, 48, lambda x, y: 1 + y / 4)})
        return ["in.####.exr", "-o", output, *CAMERA, *(look or ("--engine", "reference", "--pupil-points", "16384"))]

    def test_a_shot_outlives_a_node_a_disk_a_frame_and_the_controller(self):
        words = self.shot("out/f.####.exr", 6)
        self.succeed("farm", "write", "--for", "slurm", "--chunk", "1", "-o", "job", "--", *words)
        self.succeed("defocus", *words[:2], "ref.####.exr", *words[3:])
        os.mkdir(self.path("out/f.0004.exr"))  # frame 4 cannot be written
        self.call("slurmd", "-N", "n1")
        # n2 sees a disk of 4 KiB in the place of the outputs.
        mounted = f"mount -t tmpfs -o size=4k tmpfs {self.path('out')} && exec slurmd -N n2"
        self.call("unshare", "-m", "sh", "-c", mounted)
        self.wait("two nodes", lambda: self.call("sinfo", "-h", "-N", "-t", "idle").count("\n") == 2)
        self.succeed("farm", "submit", "job", env=self.env)
        self.assertIn("Slurm: ", self.succeed("farm", "status", "job", env=self.env).out)
        self.refuse(2, "farm", "submit", "job", says=["still in Slurm's queue"], env=self.env)
        # A full disk: such frames are tried again until n2 has its disk back.
        self.wait("a full disk", lambda: "output not written: always retry" in self.logs())
        self.kill(*self.processes("SLURMD_NODENAME=n2"), self.pid_of("n2"))
        # A node dies while it renders.
        running = lambda: list(self.processes("SLURMD_NODENAME=n1"))  # noqa: E731
        self.wait("a frame on n1", running)
        self.kill(*running(), self.pid_of("n1"))
        # The controller ends and begins again with its saved state.
        self.kill(self.pid_of("ctld"))
        self.wait("the controller's end", lambda: subprocess.run(["scontrol", "ping"], env=self.env, text=True,
                                                                 capture_output=True).stdout.count("DOWN"))
        self.call("slurmctld")
        for node in ("n2", "n3"):
            self.call("slurmd", "-N", node)
        self.wait("frame 4 twice", lambda: pathlib.Path(self.path("job/log.3.txt")).exists() and
                  pathlib.Path(self.path("job/log.3.txt")).read_text().count("retry") >= 2)
        os.rmdir(self.path("out/f.0004.exr"))
        self.wait("the shot", lambda: not self.call("squeue", "-h"))
        for frame in range(1, 7):
            self.assertEqual(self.content("out/f.%04d.exr" % frame), self.content("ref.%04d.exr" % frame), self.logs())
        self.assertEqual(len(os.listdir(self.path("out"))), 6)
        # A frame that is cut later is found, and Slurm renders that one again.
        os.truncate(self.path("out/f.0002.exr"), 500)
        self.succeed("farm", "collect", "job", "--resubmit", env=self.env)
        self.wait("frame 2 again", lambda: not self.call("squeue", "-h"))
        self.assertIn("complete  6\n", self.succeed("farm", "collect", "job", env=self.env).out)
        self.assertEqual(self.content("out/f.0002.exr"), self.content("ref.0002.exr"))

    def test_a_hundred_frames_outlive_a_killed_node(self):
        words = self.shot("out/f.####.exr", 100, "--engine", "reference", "--pupil-points", "1024")
        self.succeed("defocus", *words[:2], "ref.####.exr", *words[3:])
        self.succeed("farm", "write", "--for", "slurm", "--chunk", "5", "-o", "job", "--", *words)
        for node in NODES:
            self.call("slurmd", "-N", node)
        self.wait("three nodes", lambda: self.call("sinfo", "-h", "-N", "-t", "idle").count("\n") == 3)
        self.succeed("farm", "submit", "job", env=self.env)
        complete = lambda: len(glob.glob(self.path("out/f.*.exr")))  # noqa: E731
        self.wait("a quarter of the shot", lambda: complete() >= 25, step=0.05)
        self.wait("a frame on n3", lambda: list(self.processes("SLURMD_NODENAME=n3")), step=0.05)
        self.die("n3")
        before = complete()
        self.wait("the end of n3", lambda: "n3" in self.call("sinfo", "-h", "-N", "-t", "down"))
        self.wait("the shot", lambda: not self.call("squeue", "-h"))
        self.assertIn("complete  100\n", self.succeed("farm", "collect", "job", env=self.env).out)
        for frame in range(1, 101):
            self.assertEqual(self.content("out/f.%04d.exr" % frame), self.content("ref.%04d.exr" % frame), self.logs())
        self.assertEqual(len(os.listdir(self.path("out"))), 100)
        self.assertLess(before, 100)
        print(f"n3 was killed after {before} of 100 frames", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
