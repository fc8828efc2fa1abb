"""Programs that people use today, on the same pictures: dB, SSIM and seconds beside ours.

GEGL's lens blur (Debian: gegl) runs as a program of its own, where it is installed; what is missing is left out, and
said so. It gets a map of the absolute radii. Scenes, truth and measures are those of `./dev bench quality`. Blender's
Defocus node is not here yet; its radius is 27.8 times too large for a 36 mm sensor and metres, see
../shared/research/peers.md.

Wall and CPU seconds are those of the whole process, start, reading and writing included, ours too.

Usage: ./dev bench peers [--scenes A,B] [--width N]          scenes: built-in names, or shared/fence
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

from quality import CACHE, PROGRAM, SHARED, BUILT_IN, machine, print_table, score
from baselines import radii_of, scenes_of

OUT = CACHE / "peers_out.exr"


def timed(*command, **options):
    """Wall and CPU seconds of a command; its output is shown if it fails."""
    before, start = os.times(), time.monotonic()
    result = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    wall, after = time.monotonic() - start, os.times()
    if result.returncode:
        sys.exit(f"bench: {command[0]} failed\n{result.stdout[-2000:]}")
    return wall, after.children_user + after.children_system - before.children_user - before.children_system


def ours(scene):
    yield "petzval scatter, standard", timed(PROGRAM, "defocus", scene.sharp, "-o", OUT, *scene.camera, "--overwrite",
                                             "-q")


def gegl(scene):
    """The map of absolute radii as GEGL wants it, 0…1 times the largest, made by petzval_bench_radius_map."""
    radius_map = CACHE / "peers_radius.exr"
    maker = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_radius_map"
    largest = subprocess.check_output([maker, scene.sharp, radii_of(scene), radius_map], text=True).strip()
    yield "GEGL lens-blur", timed("gegl", scene.sharp, "-o", OUT, "--", "gegl:lens-blur", f"radius={largest}",
                                  "linear-mask=true", "aux=[", "gegl:load", f"path={radius_map}", "]")


PEERS = {"gegl": gegl}


def main():
    parser = argparse.ArgumentParser(prog="./dev bench peers")
    parser.add_argument("--scenes", help="built-in names, or shared/NAME")
    parser.add_argument("--width", type=int, default=960)
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    there = [ours]
    for program, peer in PEERS.items():
        if shutil.which(program):
            there.append(peer)
        else:
            print(f"{program} is not installed (apt-get install {program}): left out", file=sys.stderr)
    shared = [f"shared/{p.parent.name}" for p in sorted(SHARED.glob("*/camera.json"))]
    names = given.scenes.split(",") if given.scenes else shared + BUILT_IN
    body = []
    for scene in scenes_of(names, given.width):
        for method in there:
            for label, (wall, cpu) in method(scene):
                body.append([scene.name, label, *score(scene, OUT), f"{wall:.2f}", f"{cpu:.2f}"])
    print_table(["scene", "program", "PSNR dB", "SSIM", "wall s", "CPU s"], body)
    print(f"\n{given.width} px wide, whole processes. {machine()}; command: ./dev bench peers "
          f"{' '.join(sys.argv[1:])}".rstrip() + ".")


if __name__ == "__main__":
    main()
