#!/usr/bin/env python3
"""Simulates a render farm that makes a film of petzval frames, from the measured cost of a frame.

Usage: bench/farm_simulator.py [--nodes N,N…] [--frames F] [--cpu-seconds S,S…] [--read-mb M] [--write-mb M] …
Prints one table row for each number of nodes. Defaults are the numbers of docs/results/farm-scale.md.

A node takes a chunk of frames, starts a process, and for each frame reads it, renders it and writes it. All nodes
share one storage, which serves requests in order of arrival; a node never transfers faster than its own link. The
scheduler starts a limited number of processes each second. Nodes fail at random: frames that are complete stay, and
the others of the chunk are queued again, as petzval does it.
"""
import argparse
import dataclasses
import heapq
import random


@dataclasses.dataclass
class Farm:
    nodes: int
    frames: int
    cpu_seconds: tuple = (1.0,)  # of a frame; each frame draws one of them
    cores: int = 16              # of a node
    efficiency: float = 1.0      # share of the cores that a frame keeps busy
    chunk: int = 10
    start_s: float = 0.0         # of a process, kernels included
    read_mb: float = 0.0
    write_mb: float = 0.0
    storage_mb_s: float = 1e12
    link_mb_s: float = 1e12
    starts_per_s: float = 1e12
    hours_to_failure: float = 1e12  # mean, of one node
    repair_s: float = 600.0
    requeue_s: float = 120.0
    seed: int = 32


@dataclasses.dataclass
class Outcome:
    seconds: float = 0.0
    busy_s: float = 0.0      # spent rendering frames that counted
    lost_s: float = 0.0      # spent on frames that a failure ended
    failures: int = 0
    traffic_mb: float = 0.0
    all_but_1_percent_s: float = 0.0  # the time at which 99 % of the frames were complete


class Simulation:
    def __init__(self, farm):
        self.farm, self.dice, self.outcome = farm, random.Random(farm.seed), Outcome()
        self.storage_free = self.scheduler_free = 0.0
        self.queue = [(0.0, first, list(range(first, min(first + farm.chunk, farm.frames))))
                      for first in range(0, farm.frames, farm.chunk)]  # ready at, key, frames
        self.done = 0

    def transferred(self, now, megabytes):
        """When a request that arrives now is served."""
        if megabytes == 0:
            return now
        self.outcome.traffic_mb += megabytes
        begin = max(now, self.storage_free)
        self.storage_free = begin + megabytes / self.farm.storage_mb_s
        return max(self.storage_free, now + megabytes / self.farm.link_mb_s)

    def run(self):
        farm, heap = self.farm, []
        for node in range(farm.nodes):
            self.push(heap, 0.0, node, "idle", [], self.dice.expovariate(1 / (farm.hours_to_failure * 3600)))
        while self.done < farm.frames:
            now, node, step, chunk, fails_at = heapq.heappop(heap)[:5]
            if now >= fails_at and step != "idle":
                self.fail(heap, fails_at, node, chunk)
                continue
            getattr(self, step)(heap, now, node, chunk, fails_at)
        return self.outcome

    def push(self, heap, at, node, step, chunk, fails_at):
        heapq.heappush(heap, (at, node, step, chunk, fails_at))

    def fail(self, heap, at, node, chunk):
        farm = self.farm
        self.outcome.failures += 1
        self.outcome.lost_s += self.cost(chunk[0])
        heapq.heappush(self.queue, (at + farm.requeue_s, chunk[0], chunk))
        back = at + farm.repair_s
        self.push(heap, back, node, "idle", [], back + self.dice.expovariate(1 / (farm.hours_to_failure * 3600)))

    def cost(self, frame):
        seconds = self.farm.cpu_seconds
        return seconds[random.Random(frame).randrange(len(seconds))] / (self.farm.cores * self.farm.efficiency)

    def idle(self, heap, now, node, chunk, fails_at):
        if not self.queue:  # frames of failed nodes may come back
            return self.push(heap, now + 10, node, "idle", [], max(fails_at, now + 20))
        if self.queue[0][0] > now:
            return self.push(heap, self.queue[0][0], node, "idle", [], fails_at)
        chunk = heapq.heappop(self.queue)[2]
        self.scheduler_free = max(self.scheduler_free, now) + 1 / self.farm.starts_per_s
        self.push(heap, self.scheduler_free + self.farm.start_s, node, "read", chunk, fails_at)

    def read(self, heap, now, node, chunk, fails_at):
        self.push(heap, self.transferred(now, self.farm.read_mb), node, "render", chunk, fails_at)

    def render(self, heap, now, node, chunk, fails_at):
        self.push(heap, now + self.cost(chunk[0]), node, "write", chunk, fails_at)

    def write(self, heap, now, node, chunk, fails_at):
        self.push(heap, self.transferred(now, self.farm.write_mb), node, "complete", chunk, fails_at)

    def complete(self, heap, now, node, chunk, fails_at):
        self.outcome.busy_s += self.cost(chunk[0])
        self.done += 1
        self.outcome.seconds = max(self.outcome.seconds, now)
        if self.done * 100 <= self.farm.frames * 99:
            self.outcome.all_but_1_percent_s = now
        self.push(heap, now, node, "read" if chunk[1:] else "idle", chunk[1:], fails_at)


def numbers(text):
    return tuple(float(word) for word in text.split(","))


def main():
    parser = argparse.ArgumentParser(prog="bench/farm_simulator.py", description="a film on a farm, simulated")
    add = parser.add_argument
    add("--nodes", type=numbers, default=(1, 3, 10, 30, 100, 300, 1000))
    add("--frames", type=int, default=144000, help="100 minutes at 24 frames a second")
    add("--cpu-seconds", type=numbers, default=(11.4, 11.6), help="of one frame, user and system")
    add("--cores", type=int, default=16)
    add("--efficiency", type=float, default=0.9)
    add("--chunk", type=int, default=60)
    add("--start-s", type=float, default=2.0)
    add("--read-mb", type=float, default=35.8)
    add("--write-mb", type=float, default=33.0)
    add("--storage-mb-s", type=float, default=10000)
    add("--link-mb-s", type=float, default=1200)
    add("--starts-per-s", type=float, default=50)
    add("--hours-to-failure", type=float, default=1000)
    words = vars(parser.parse_args())
    print("| nodes | hours | frames per second | speed-up per node | last 1 % of the time | failures | TB |")
    print("|---|---|---|---|---|---|---|")
    alone = None
    for nodes in map(int, words.pop("nodes")):
        out = Simulation(Farm(nodes=nodes, **words)).run()
        alone = alone or out.seconds * nodes
        print(f"| {nodes} | {out.seconds / 3600:.2f} | {words['frames'] / out.seconds:.1f} "
              f"| {alone / out.seconds / nodes:.2f} | {1 - out.all_but_1_percent_s / out.seconds:.1%} "
              f"| {out.failures} | {out.traffic_mb / 1e6:.1f} |", flush=True)


if __name__ == "__main__":
    main()
