"""Programs that people use today, on the same pictures: PSNR in dB / SSIM / CPU seconds, beside ours.

GEGL's lens blur (Debian: gegl) and the Defocus node of Blender's compositor (Debian: blender) run as programs of their
own, where they are installed; what is missing is left out, and said so. GEGL gets a map of the absolute radii, Blender
the depth and the camera. Scenes, truth and measures are those of `./dev bench quality`.

CPU seconds are those of the whole process, start, reading and writing included, ours too.

Usage: ./dev bench peers [--scenes A,B] [--width N]          scenes: built-in names, or shared/fence
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

from quality import CACHE, PROGRAM, ROOT, SHARED, BUILT_IN, crossed, machine, petzval, print_table, score
from baselines import radii_of, scenes_of

OUT = CACHE / "peers_out.exr"


def timed(*command, **options):
    """CPU seconds of a command; its output is shown if it fails."""
    before = os.times()
    result = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
    after = os.times()
    if result.returncode:
        sys.exit(f"bench: {command[0]} failed\n{result.stdout[-2000:]}")
    return after.children_user + after.children_system - before.children_user - before.children_system


def ours(scene):
    yield "petzval scatter, standard", timed(PROGRAM, "defocus", scene.sharp, "-o", OUT, *scene.camera, "--overwrite",
                                             "-q")


def radius_map(scene):
    """A file of the absolute radii, 0…1 times the largest, and that one, px; made by petzval_bench_radius_map."""
    file = CACHE / "peers_radius.exr"
    maker = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_radius_map"
    return file, float(subprocess.check_output([maker, scene.sharp, radii_of(scene), file], text=True))


def gegl(scene):
    file, largest = radius_map(scene)
    yield "GEGL lens-blur", timed("gegl", scene.sharp, "-o", OUT, "--", "gegl:lens-blur", f"radius={largest}",
                                  "linear-mask=true", "aux=[", "gegl:load", f"path={file}", "]")


def blender(scene):
    """The node's discs are 1000 / sensor_width_mm times too large for its f-stop; asked for that many times the
    f-number, a point at 200 mm, f/4 (36 mm sensor) and f/2.8 (24 mm) got discs of 7.29 and 15.68 px radius where
    7.41 and 15.87 were due (Blender 3.4.1). The f-stop ends at 128."""
    report = json.loads(petzval("inspect", scene.sharp, *scene.camera, "--json", "-"))
    camera = report["camera"]
    f_stop = camera["f_number"] * 1000 / camera["sensor_width_mm"]
    if f_stop > 128:
        print(f"Blender: f/{camera['f_number']:g} is beyond what its Defocus node can express: left out", file=sys.stderr)
        return
    job = {"sharp": str(scene.sharp), "out": str(OUT), "f_stop": f_stop, "largest_px": radius_map(scene)[1],
           "width": report["data_window"]["width"], "height": report["data_window"]["height"],
           "threads": len(os.sched_getaffinity(0)),
           **{name: camera[name] for name in ("focal_length_mm", "sensor_width_mm", "focus_distance_m")}}
    yield "Blender Defocus node", timed("blender", "--background", "--factory-startup", "--python-exit-code", 1,
                                        "--python", ROOT / "bench/_peers_blender.py", "--", json.dumps(job))


PEERS = {"gegl": gegl, "blender": blender}


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
            body += [[scene.name, label, *score(scene, OUT), f"{cpu:.2f}"] for label, cpu in method(scene)]
    print_table(*crossed(body))
    print(f"\n{given.width} px wide, whole processes. {machine()}; command: ./dev bench peers "
          f"{' '.join(sys.argv[1:])}".rstrip() + ".")


if __name__ == "__main__":
    main()
