"""How long a frame goes on after another thread told it to stop.

Usage: ./dev bench cancel [--width 3840] [--lenses ideal,doublet] [--engines scatter,gather,gaussian,sprites] [--times 12]. The
built-in night; each frame is stopped at an even spread of instants, kernels being made included.
"""
import argparse
import json
import pathlib
import subprocess

from quality import CACHE, PROGRAM, machine, print_table

CANCEL = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_cancel"


def main():
    parser = argparse.ArgumentParser(prog="./dev bench cancel")
    parser.add_argument("--width", type=int, default=3840)
    parser.add_argument("--lenses", type=lambda text: text.split(","), default=["ideal", "doublet"])
    parser.add_argument("--engines", type=lambda text: text.split(","), default=["scatter", "gather", "gaussian", "sprites"])
    parser.add_argument("--times", default="12")
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    picture = CACHE / f"cancel_night_{given.width}_16x9.exr"
    if not picture.exists():
        subprocess.run([PROGRAM, "scene", "make", "night", "-o", picture, "--width", str(given.width),
                        "--height", str(given.width * 9 // 16), "-q"], check=True)
    rows = []
    for lens in given.lenses:
        for engine in given.engines:
            done = subprocess.run([CANCEL, picture, lens, engine, given.times], check=True, stdout=subprocess.PIPE, text=True)
            found = json.loads(done.stdout)
            rows.append([lens, engine, f"{found['frame_s']:.2f}", str(found["stopped"]), f"{found['median_ms']:.0f}",
                         f"{found['worst_ms']:.0f}", f"{100 * found['worst_at']:.0f} %"])
    print(f"night {given.width} px wide, {machine()}\n")
    print_table(["lens", "engine", "frame, s", "stopped", "median, ms", "worst, ms", "told at"], rows)


if __name__ == "__main__":
    main()
