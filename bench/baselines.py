"""Our engines beside methods that others published, on the same pictures: PSNR in dB / SSIM / CPU seconds.

The methods (bench/baselines/) are written from their descriptions and get what an engine gets: the picture and its
signed radii. Scenes, truth and measures are those of `./dev bench quality`. CPU seconds are those
of the whole command, files included.

Usage: ./dev bench baselines [--scenes A,B] [--width N]      scenes: built-in names, or shared/fence
"""
import argparse
import os
import pathlib
import subprocess
import sys

from quality import (CACHE, PROGRAM, SHARED, built_in, BUILT_IN, crossed, machine, path_traced, petzval,
                     print_table, score)

BASELINES = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_baselines"
THREADS = len(os.sched_getaffinity(0))


def radii_of(scene):
    """The file of the signed radii of a scene's pixels."""
    out = CACHE / "baselines_coc.exr"
    petzval("defocus", scene.sharp, "--view", "coc", "-o", out, *scene.camera, "--overwrite", "-q")
    return out


def timed(*command):
    """CPU seconds of a command."""
    before = os.times()
    subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL, check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def baseline_rows(scene):
    out, radii = CACHE / "baselines_out.exr", radii_of(scene)
    for method in subprocess.check_output([BASELINES], text=True).split():
        print(f"{scene.name}: {method}", file=sys.stderr)
        cpu = timed(BASELINES, method, scene.sharp, radii, out, THREADS)
        yield [method, scene.name, *score(scene, out), f"{cpu:.2f}"]


def engine_rows(scene, qualities=("draft", "standard")):
    out = CACHE / "baselines_out.exr"
    for quality in qualities:
        print(f"{scene.name}: scatter {quality}", file=sys.stderr)
        cpu = timed(PROGRAM, "defocus", scene.sharp, "-o", out, *scene.camera, "--quality", quality, "--overwrite", "-q")
        yield [f"**scatter {quality}**", scene.name, *score(scene, out), f"{cpu:.2f}"]


def scenes_of(names, width):
    for name in names:
        yield path_traced(name[7:]) if name.startswith("shared/") else built_in(name, width)


def main():
    parser = argparse.ArgumentParser(prog="./dev bench baselines")
    parser.add_argument("--scenes", help="built-in names, or shared/NAME")
    parser.add_argument("--width", type=int, default=960)
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    shared = [f"shared/{p.parent.name}" for p in sorted(SHARED.glob("*/camera.json"))]
    body = []
    for scene in scenes_of(given.scenes.split(",") if given.scenes else shared + BUILT_IN, given.width):
        body.append(["pinhole", scene.name, *score(scene, scene.sharp)])
        body += [*baseline_rows(scene), *engine_rows(scene)]
    print_table(*crossed(body, "method"))
    print(f"\n{given.width} px wide. {machine()}; command: ./dev bench baselines {' '.join(sys.argv[1:])}".rstrip() + ".")


if __name__ == "__main__":
    main()
