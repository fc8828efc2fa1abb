#!/usr/bin/env python3
"""Sends a signal to a shot at a random instant, resumes the shot, and compares the frames with those of one run.

Usage: bench/signals.py PETZVAL [--runs N] [--seed S]. Prints the outcomes as a Markdown table; exit code 1 if a run left
a partial frame, another file, or other bits. Frames are 160 x 90.
"""
import argparse
import collections
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL)
FRAMES = 4


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.glob("out.*")}


def ended(code, said):
    """The outcome in words; empty if it breaks a promise."""
    if code == 0:
        return "had ended before the signal"
    if code == -signal.SIGKILL:
        return "ended by SIGKILL"
    if code < 0:
        return "ended by the signal itself, before the program watched for signals" if not said else ""
    if code in (129, 130, 143) and said.count("\n") == 1:
        return "exit 129, 130 or 143 with one line"
    return ""


def one(command, folder, seconds, dice):
    """Starts a run, interrupts it: the outcome."""
    with subprocess.Popen(command, cwd=folder, stderr=subprocess.PIPE, text=True) as process:
        time.sleep(dice.uniform(0, 1.15 * seconds))
        process.send_signal(dice.choice(SIGNALS))
        said = process.stderr.read()
    return ended(process.returncode, said) or f"WRONG: exit {process.returncode}: {said!r}"


def main():
    parser = argparse.ArgumentParser(prog="bench/signals.py")
    parser.add_argument("petzval", type=os.path.abspath)
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--seed", type=int, default=time.time_ns() % 10**6)
    words = parser.parse_args()
    dice, outcomes, wrong = random.Random(words.seed), collections.Counter(), 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for frame in range(1, FRAMES + 1):
            subprocess.run([words.petzval, "scene", "make", "tori", "--width", "160", "--height", "90", "--frame", str(frame),
                            "--pinhole-samples", "1", "-q", "-o", f"in.{frame:04}.exr"], cwd=folder, check=True)
        command = [words.petzval, "defocus", "in.####.exr", "-o", "out.####.exr", "-q", "--kernel-cache", "off"]
        begin = time.monotonic()
        subprocess.run(command, cwd=folder, check=True)
        seconds, right = time.monotonic() - begin, contents(folder)
        for _ in range(words.runs):
            for path in folder.glob("out.*"):
                path.unlink()
            outcome = one(command, folder, seconds, dice)
            partial = [n for n, bits in contents(folder).items() if n in right and bits != right[n]]
            subprocess.run([*command, "--no-clobber"], cwd=folder, check=True)
            left = {path.name for path in folder.iterdir() if not path.name.startswith("in.")}
            if partial or left != set(right) or contents(folder) != right or outcome.startswith("WRONG"):
                wrong += 1
                print(f"{outcome}; partial {partial}, left {sorted(left - set(right))}", file=sys.stderr)
            outcomes[outcome] += 1
    print(f"| outcome of {words.runs} runs, seed {words.seed} | count |\n|---|---|")
    for outcome, count in outcomes.most_common():
        print(f"| {outcome} | {count} |")
    print(f"| partial frames, files left, or other bits after resuming | {wrong} |")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
