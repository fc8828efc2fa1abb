"""Does anything pop, crawl or flicker? Focus pulls and camera moves, as contact sheets, videos and numbers.

Each shot goes through --engine (`realtime`: on the first GPU). The truth is what a ray tracer saw through the lens, whose
own noise counts. In focus pulls all hidden layers are given; camera moves have to guess what is hidden.
tests/flicker/flicker.h defines the measures; the worst pop is the largest change of an 8 x 8 block between frames beyond
the truth's. The third row of every contact sheet in build/bench/flicker draws the change of the error, eight times as
strong. Videos are made if ffmpeg is there. `-temporal` looks at four frames on each side, as `--temporal 4` does; its
shots, and `-move`, may also be of a seed: random:7-move, random:7-temporal.

Usage: ./dev bench flicker [--shots A,B] [--engine NAME] [--width N] [--frames N] [--samples N]
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

from quality import CACHE, PROGRAM, machine, print_table

FLICKER = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_flicker"
OUT = CACHE / "flicker"


def video_of(shot):
    if shutil.which("ffmpeg"):
        path = OUT / f"{shot}.mp4"
        subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", "24", "-i", OUT / f"{shot}_%04d.png", "-vf",
                        "scale=trunc(iw/2)*2:trunc(ih/2)*2", "-pix_fmt", "yuv420p", "-crf", "12", path], check=True)
        print(path, file=sys.stderr)


def main():
    known = subprocess.check_output([FLICKER], text=True).split()
    parser = argparse.ArgumentParser(prog="./dev bench flicker")
    parser.add_argument("--shots", type=lambda text: text.split(","), default=known, help=", ".join(known))
    parser.add_argument("--width", type=int, default=240)
    parser.add_argument("--frames", type=int, default=12, help="up to 48 where the scene moves")
    parser.add_argument("--samples", type=int, default=256, help="lens samples per pixel of the truth")
    parser.add_argument("--engine", default="scatter")
    given = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)
    body = []
    for shot in given.shots:
        print(shot, file=sys.stderr)
        result = subprocess.run([FLICKER, shot, OUT, *map(str, (given.width, given.frames, given.samples, given.engine))],
                                stdout=subprocess.PIPE, text=True)
        if result.returncode:
            sys.exit(result.returncode)
        found = json.loads(result.stdout)
        body.append([shot, f"{given.width} px, {given.frames} frames", f"{found['error_db']:.2f}", f"{found['change_db']:.1f}",
                     f"{found['worst_pop']:.4f}", f"{found['frame']} at {found['x']},{found['y']}",
                     f"{found['shake']:.3f}"])
        print(OUT / f"{shot}_sheet.png", file=sys.stderr)
        video_of(shot)
    print_table(["shot", "size", "error, dB", "change of error, dB", "worst pop", "where", "shake"], body)
    print(f"\n{given.samples} lens samples per pixel in the truth. {machine()}; command: ./dev bench flicker "
          f"{' '.join(sys.argv[1:])}".rstrip() + ".")


if __name__ == "__main__":
    main()
