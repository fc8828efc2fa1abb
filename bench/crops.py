"""Where each scene is farthest from its truth: the worst twelve crops as one contact sheet a scene, to be looked at.

Sheets lie in build/bench/crops: sharp, result, truth and four times the difference of each crop, twice as large, worst first. The
table says where the worst four lie and what share of all squared error is in them and in all twelve.

Usage: ./dev bench crops [--scenes A,B] [--width N] [--known] [-- FLAGS of defocus…], as `./dev bench crops --scenes hair -- --quality final`
"""
import argparse
import json
import pathlib
import subprocess
import sys

from quality import BUILT_IN, CACHE, PROGRAM, SHARED, built_in, machine, path_traced, petzval, print_table, score

CROPS = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_crops"
OUT = CACHE / "crops"


def main():
    words = sys.argv[1:]
    flags = words[words.index("--") + 1:] if "--" in words else []
    parser = argparse.ArgumentParser(prog="./dev bench crops")
    parser.add_argument("--scenes", help="built-in names, or shared/NAME")
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--known", action="store_true", help="hidden layers and a rim of overscan are given")
    given = parser.parse_args(words[:len(words) - len(flags) - ("--" in words)])
    OUT.mkdir(parents=True, exist_ok=True)
    shared = [f"shared/{p.parent.name}" for p in sorted(SHARED.glob("*/camera.json"))]
    body = []
    for name in given.scenes.split(",") if given.scenes else BUILT_IN + shared:
        scene = path_traced(name[7:]) if name.startswith("shared/") else built_in(name, given.width)
        known = given.known and scene.behind
        result, sheet = OUT / "defocused.exr", OUT / f"{name.replace('/', '_')}{'_known' if known else ''}.png"
        if known:
            petzval("defocus", scene.wide, "-o", result, "--behind", scene.behind, *scene.camera, *flags, "--overwrite", "-q")
        else:
            petzval("defocus", scene.sharp, "-o", result, *scene.camera, *flags, "--overwrite", "-q")
        crops = json.loads(subprocess.run([CROPS, scene.sharp, result, scene.truth, str(scene.exposure), sheet], check=True,
                                          stdout=subprocess.PIPE, text=True).stdout)
        print(sheet, file=sys.stderr)
        body.append([scene.name, " ".join(f"{c['x']},{c['y']}" for c in crops[:4]), score(scene, result)[0],
                     f"{sum(c['share'] for c in crops[:4]):.2f}", f"{sum(c['share'] for c in crops):.2f}"])
    print_table(["scene", "worst four, 48 px each", "PSNR dB", "share of four", "of twelve"], body)
    print(f"\n{given.width} px wide, built in; flags: {' '.join(flags) or 'none'}. {machine()}.")


if __name__ == "__main__":
    main()
