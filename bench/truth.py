"""Writes the data set of bench/truth: scenes with depth, their truth through a lens, hidden layers, motion, and the scorer.

Usage: ./dev bench truth OUT [--width N] [--scenes A,B] [--seeds 5,6,7]. About three minutes of two cores at 480 px. What is there already
stays. OUT/README.md says what each file holds; OUT/score.py adds any program's column and needs no petzval.
"""
import argparse
import json
import math
import pathlib
import shutil
import subprocess
import sys

from quality import PROGRAM, ROOT, petzval

RADIUS_MAP = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_radius_map"

BUILT_IN = ["night", "fence", "table", "bars", "hair", "post", "meadow"]
SEEDS = [10 * tens + last for tens in range(3) for last in range(5, 10)]
MOVING = {"random-5": (11, 12, 13), "random-6": (11, 12, 13), "post": (20, 21, 22)}


def frames(built_in, seeds):
    """(name, scene, flags, shot or None, frame) of all frames."""
    for name, scene, flags in [(n, n, []) for n in built_in] + [(f"random-{s}", "random", ["--seed", s]) for s in seeds]:
        if name not in MOVING:
            yield name, scene, flags, None, 0
            continue
        for frame in MOVING[name]:
            yield f"{name}-{frame:04}", scene, [*flags, "--frame", frame, "--motion"], name, frame


def exposure_of(report):
    """In whole stops, three at most, so that the median comes near middle grey."""
    return 2.0 ** min(3, max(0, round(math.log2(0.18 / max(report["dynamic_range"]["middle"], 1e-6)))))


def write(out, name, scene, flags, width):
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    names = ("sharp", "truth", "layers", "radius", "blur")
    sharp, truth, layers, radius, blur = (folder / f"{what}.exr" for what in names)
    size = ["--width", width, "--height", width * 9 // 16]
    if not layers.exists():
        print(f"making {name}", file=sys.stderr, flush=True)
        petzval("scene", "make", scene, "-o", sharp, "--truth", truth, "--layers", layers, "--samples", 512, *flags, *size, "--overwrite")
    petzval("defocus", sharp, "-o", radius, "--view", "coc", "--overwrite", "-q")
    largest = subprocess.check_output([RADIUS_MAP, sharp, radius, blur], text=True)
    return {name: str((folder / f"{name}.exr").relative_to(out)) for name in names}, float(largest)


def main():
    parser = argparse.ArgumentParser(prog="./dev bench truth")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--scenes", type=lambda text: text.split(","), default=BUILT_IN, help="built-in ones")
    parser.add_argument("--seeds", type=lambda text: text.split(","), default=SEEDS)
    given = parser.parse_args()
    listed = []
    for name, scene, flags, shot, frame in frames(given.scenes, given.seeds):
        files, largest_px = write(given.out, name, scene, flags, given.width)
        report = json.loads(petzval("inspect", given.out / files["sharp"], "--json", "-"))
        camera = {key: report["camera"][key] for key in ("focal_length_mm", "sensor_width_mm", "f_number", "focus_distance_m")}
        listed.append({"name": name, **files,
                       "camera": camera, "exposure": exposure_of(report), "width": given.width,
                       "height": given.width * 9 // 16, "largest_radius_px": largest_px,
                       **({"shot": shot, "frame": frame} if shot else {})})
    (given.out / "frames.json").write_text(json.dumps(listed, indent=1) + "\n")
    for file in ("README.md", "LICENSE.txt", "score.py"):
        shutil.copy(ROOT / "bench/truth" / file, given.out / file)
    print(f"{len(listed)} frames in {given.out}")


if __name__ == "__main__":
    main()
