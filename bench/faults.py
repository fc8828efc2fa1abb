#!/usr/bin/env python3
"""Every allocation of a command fails once: how its runs end.

Usage: bench/faults.py PETZVAL FAULTS [--command N] [--part K/N] [--sample N]. FAULTS is libpetzval_faults.so of the
build's tests/cli. Command 0 is `petzval --version`, whose allocations every command makes before its own; the others
are those of tests/cli/single_fault_test.py, which this counts from where --version ends. --part 1/2 runs every second
call; --sample N runs N calls chosen at random, the same ones each time. Prints one Markdown row for a command. Exit
code 1 if a run ended in another way than with its right result, or with one line and exit code 1.
"""
import argparse
import collections
import os
import pathlib
import random
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/cli"))

SEED = 32


def run(test, command, first, part, parts, sample):
    """Exit codes by count, and the runs that broke a promise."""
    test.remove_outputs()
    count, right = test.calls(command)["malloc"], test.outputs()
    codes, wrong = collections.Counter(), 0
    chosen = range(first + part - 1, count + 1, parts)
    if 0 < sample < len(chosen):
        chosen = sorted(random.Random(SEED).sample(chosen, sample))
    for call in chosen:
        try:
            codes[test.check_call(command, "malloc", call, (0, 1), right)] += 1
        except AssertionError as broken:
            wrong += 1
            print(broken, file=sys.stderr, flush=True)
    return count, codes, wrong


def main():
    parser = argparse.ArgumentParser(prog="bench/faults.py")
    parser.add_argument("petzval", type=os.path.abspath)
    parser.add_argument("faults", type=os.path.abspath)
    parser.add_argument("--command", type=int)
    parser.add_argument("--part", default="1/1")
    parser.add_argument("--sample", type=int, default=0)
    words = parser.parse_args()
    os.environ.update(PETZVAL=words.petzval, PETZVAL_FAULTS=words.faults)
    import single_fault_test as tests  # reads the environment
    part, parts = map(int, words.part.split("/"))
    commands = [["--version"], *tests.RUNS]
    test = tests.SingleFault("test_an_allocation")
    test.setUp()
    broken = 0
    print("| command | allocations | from | failed once | right result | exit code 1 | wrong | seconds |")
    print("|---|---|---|---|---|---|---|---|", flush=True)
    try:
        before = test.calls(["--version"])["malloc"]
        for number, command in enumerate(commands):
            if words.command not in (None, number):
                continue
            begin = time.monotonic()
            first = before + 1 if number else 1
            count, codes, wrong = run(test, command, first, part, parts, words.sample)
            print(f"| `{' '.join(command)}` | {count} | {first} | {sum(codes.values()) + wrong} | {codes[0]} | {codes[1]} | "
                  f"{wrong} | {time.monotonic() - begin:.0f} |", flush=True)
            broken += wrong
    finally:
        test.doCleanups()
    sys.exit(broken > 0)


if __name__ == "__main__":
    main()
