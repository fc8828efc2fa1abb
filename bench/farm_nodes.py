#!/usr/bin/env python3
"""One shot on one, two and three nodes of a Slurm cluster on this machine: what a further node adds.

Usage: bench/farm_nodes.py PETZVAL [--nodes 1,2,3] [--frames N] [--chunk N] [--core SHARE] [--runs N]. As root; needs
slurm-wlm, munge and a cgroup for the cpu (version 1). A node gets SHARE of a core (default 0.15) by the kernel's quota,
so three nodes do not compete for this machine's cores. Prints one Markdown row for each run. Frames are 64 x 48 by the
engine reference.
"""
import argparse
import glob
import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/farm"))
PERIOD_US = 20000


class Node:
    """A share of a core, with a slurmd in it."""

    def __init__(self, cluster, name, core):
        self.groups = [pathlib.Path(f"/sys/fs/cgroup/{kind}/petzval-{os.getpid()}-{name}") for kind in ("cpu", "cpuacct")]
        for group in self.groups:
            group.mkdir(exist_ok=True)
        (self.groups[0] / "cpu.cfs_period_us").write_text(str(PERIOD_US))
        (self.groups[0] / "cpu.shares").write_text("10240")  # other work of this machine slows no node down
        (self.groups[0] / "cpu.cfs_quota_us").write_text(str(int(core * PERIOD_US)))
        join = "".join(f"echo $$ > {group}/cgroup.procs && " for group in self.groups)
        cluster.call("sh", "-c", f"{join}exec slurmd -N {name}")

    def seconds(self):
        """CPU seconds so far."""
        return int((self.groups[1] / "cpuacct.usage").read_text()) / 1e9

    def remove(self):
        """Requires: the cluster was ended."""
        for group in self.groups:
            for _ in range(100):
                try:
                    group.rmdir()
                    break
                except OSError:  # its processes are ending
                    time.sleep(0.1)


def measure(test, nodes, words):
    """Seconds from the submission to the last frame, CPU seconds of each node, which `nodes` gets."""
    job = test.shot("out/f.####.exr", words.frames, "--engine", "reference", "--pupil-points", "4096", "--threads", "1")
    test.succeed("farm", "write", "--for", "slurm", "--chunk", str(words.chunk), "-o", "job", "--", *job)
    nodes += [Node(test, name, words.core) for name in test.nodes]
    test.wait("nodes", lambda: test.call("sinfo", "-h", "-N", "-t", "idle").count("\n") == len(nodes))
    used = [node.seconds() for node in nodes]
    begin = time.time()
    test.succeed("farm", "submit", "job", env=test.env)
    test.wait("the shot", lambda: len(glob.glob(test.path("out/f.*.exr"))) == words.frames)
    end = max(os.path.getmtime(path) for path in glob.glob(test.path("out/f.*.exr")))
    used = [node.seconds() - before for node, before in zip(nodes, used)]
    test.wait("the queue", lambda: not test.call("squeue", "-h"))
    assert f"complete  {words.frames}\n" in test.succeed("farm", "collect", "job", env=test.env).out
    return end - begin, used


def main():
    parser = argparse.ArgumentParser(prog="bench/farm_nodes.py")
    parser.add_argument("petzval", type=os.path.abspath)
    parser.add_argument("--nodes", default="1,2,3")
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--chunk", type=int, default=5)
    parser.add_argument("--core", type=float, default=0.15)
    parser.add_argument("--runs", type=int, default=1)
    words = parser.parse_args()
    os.environ["PETZVAL"] = words.petzval
    import slurm_test
    print(f"{words.frames} frames in chunks of {words.chunk}, {words.core} of a core for a node\n")
    print("| nodes | seconds | frames a second | speed of a node | CPU seconds of the nodes | share of the quota used |\n"
          "|---|---|---|---|---|---|", flush=True)
    first = None
    for count in [int(n) for n in words.nodes.split(",") for _ in range(words.runs)]:
        test = slurm_test.Cluster("test_a_hundred_frames_outlive_a_killed_node")
        test.nodes, nodes = slurm_test.NODES[:count], []
        try:
            test.setUp()
            seconds, used = measure(test, nodes, words)
        finally:
            test.doCleanups()
            for node in nodes:
                node.remove()
        first = first or seconds * count
        print(f"| {count} | {seconds:.1f} | {words.frames / seconds:.2f} | {first / seconds / count:.2f} | "
              f"{', '.join(f'{u:.1f}' for u in used)} | {sum(used) / (seconds * words.core * count):.2f} |", flush=True)


if __name__ == "__main__":
    sys.exit(main())
