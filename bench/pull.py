"""Many frames of one picture: one session beside as many runs of the program, in one run.

Usage: ./dev bench pull [--frames 24] [--width 960] [--lenses doublet,petzval-laikin] [--engines scatter,gather]. The built-in
night. Focus moves from 2 m to 6 m, evenly in dioptres; then it stays at 2 m while five blades turn. CPU seconds are user +
system of all processes. Runs of the program read and write their frame; the session reads once and writes nothing. So the
column of computing leaves out the time that the report of a run gives for reading and writing.
"""
import argparse
import itertools
import json
import pathlib
import resource
import subprocess

from quality import CACHE, PROGRAM, machine, print_table

PULL = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_pull"
NEAR_M, FAR_M = 2.0, 6.0


def children_cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def one_by_one(picture, frames, lens, engine, change):
    """CPU seconds of all, and wall seconds that the reports give to kernels and computing."""
    begin, computing = children_cpu_s(), 0
    for i in range(frames):
        share = i / (frames - 1)
        moved = share if change == "focus" else 0
        focus_m = 1 / ((1 - moved) / NEAR_M + moved / FAR_M)
        blades = ["--blades", "5", "--blade-rotation", str(72 * share)] if change == "blades" else []
        done = subprocess.run([PROGRAM, "defocus", picture, "-o", CACHE / "pull_out.exr", "--lens", lens, "--engine", engine,
                               "--focus", f"{focus_m}m", *blades, "--json", "-", "-q"], check=True,
                              stdout=subprocess.PIPE, text=True)
        seconds = json.loads(done.stdout)["seconds"]
        computing += seconds["kernels"] + seconds["compute"]
    return children_cpu_s() - begin, computing


def main():
    parser = argparse.ArgumentParser(prog="./dev bench pull")
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--lenses", type=lambda text: text.split(","), default=["ideal", "doublet", "petzval-laikin"])
    parser.add_argument("--engines", type=lambda text: text.split(","), default=["scatter", "gather"])
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    picture = CACHE / f"pull_night_{given.width}.exr"
    if not picture.exists():
        subprocess.run([PROGRAM, "scene", "make", "night", "-o", picture, "--width", str(given.width), "--height",
                        str(given.width * 9 // 16), "-q"], check=True)
    rows = []
    for lens, engine, change in itertools.product(given.lenses, given.engines, ["focus", "blades"]):
        alone_s, computing_s = one_by_one(picture, given.frames, lens, engine, change)
        done = subprocess.run([PULL, picture, str(given.frames), lens, engine, str(NEAR_M), str(FAR_M),
                               *(["turn"] if change == "blades" else [])], check=True, stdout=subprocess.PIPE, text=True)
        kept = json.loads(done.stdout)
        rows.append([lens, engine, change, f"{alone_s:.2f}", f"{computing_s:.2f}", f"{kept['cpu_s']:.2f}",
                     f"{kept['cpu_s'] / alone_s:.2f}", f"{kept['kept_mib']:.0f}", str(kept["lenses"])])
    print(f"{given.frames} frames, night {given.width} px wide, {machine()}\n")
    print_table(["lens", "engine", "changes", "runs, CPU s", "of it computing, wall s", "one session, CPU s", "ratio", "kept MiB", "lenses kept"],
                rows)


if __name__ == "__main__":
    main()
