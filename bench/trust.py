"""Shots that are stopped: a shot of 20 frames, killed at random instants, and completed by the same command.

Usage: ./dev bench trust [--times 200] [--signal TERM|KILL|HUP|INT|any] [--seed N]. After each stop: every file under a final
name can be read to its end and holds the frame that an undisturbed run makes; the next run completes the shot and leaves nothing else
in the folder. Exit status 1 if any of it fails.
"""
import argparse
import filecmp
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from quality import PROGRAM

FRAMES = 20
SIGNALS = {"TERM": signal.SIGTERM, "KILL": signal.SIGKILL, "HUP": signal.SIGHUP, "INT": signal.SIGINT}


def shot(folder, *more):
    return [PROGRAM, "defocus", folder / "in.####.exr", "-o", folder / "out.####.exr", "--no-clobber", "-q", *more]


def main():
    parser = argparse.ArgumentParser(prog="./dev bench trust")
    parser.add_argument("--times", type=int, default=200)
    parser.add_argument("--signal", default="any", choices=["any", *SIGNALS])
    parser.add_argument("--seed", type=int, default=1, help="of the instants: several may run beside each other")
    given = parser.parse_args()
    random.seed(given.seed)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="petzval-trust-"))
    for frame in range(1, FRAMES + 1):
        subprocess.run([PROGRAM, "scene", "make", "night", "-o", folder / f"in.{frame:04}.exr", "--frame", str(frame), "--width", "96",
                        "-q"], check=True)
    begin = time.monotonic()
    subprocess.run(shot(folder), check=True)
    whole_s = time.monotonic() - begin
    names = {f"out.{frame:04}.exr" for frame in range(1, FRAMES + 1)}
    truth = folder / "truth"
    truth.mkdir()
    for name in names:
        shutil.move(folder / name, truth / name)
    codes, wrong, partly = {}, [], 0
    for time_no in range(given.times):
        name = random.choice(list(SIGNALS)) if given.signal == "any" else given.signal
        # Shells start what runs in their background with SIGINT ignored.
        run = subprocess.Popen(shot(folder), preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        time.sleep(random.uniform(0, whole_s))
        run.send_signal(SIGNALS[name])
        code = run.wait()
        codes[code] = codes.get(code, 0) + 1
        made = [path for path in folder.glob("out.*.exr") if path.name in names]
        partly += 0 < len(made) < FRAMES
        wrong += [f"{time_no} {name}: {path.name} differs" for path in made if not filecmp.cmp(path, truth / path.name, False)]
        if name != "KILL":
            wrong += [f"{time_no} {name}: left {path.name}" for path in folder.iterdir()
                      if path.is_file() and not path.name.startswith("in.") and path.name not in names]
        subprocess.run(shot(folder), check=True)
        left = {path.name for path in folder.iterdir() if path.is_file() and not path.name.startswith("in.")}
        if left != names:
            wrong.append(f"{time_no} {name}: after completing, {sorted(left ^ names)}")
        for path in folder.glob("out.*"):
            if not filecmp.cmp(path, truth / path.name, False):
                wrong.append(f"{time_no} {name}: {path.name} differs after completing")
            path.unlink()
    shutil.rmtree(folder)
    print(f"{given.times} stops of a shot of {FRAMES} frames ({whole_s:.2f} s), {partly} with some frames made; exit codes "
          + ", ".join(f"{code}: {count}" for code, count in sorted(codes.items())))
    print("\n".join(wrong) or "nothing lost, nothing half-written, nothing left over")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
