"""How close each engine comes to what a lens sampled by a ray tracer recorded, and how long it takes.

One table, in Markdown, on stdout: every engine on eight built-in scenes, and on the path-traced scenes that lie in
../shared/scenes where that folder is there; a cell has PSNR in dB / SSIM / CPU s. `pinhole` is the sharp picture
itself, the line to beat. `all known`: what the picture does not show is given, hidden layers and a rim of overscan; where it is known, the reference is
run with it only, for that is what it defines. PSNR and SSIM are those of docs/reference/command-line.md on linear light
times the scene's exposure, clipped to 0…1. CPU seconds are those of the whole command, files included.

Usage: ./dev bench quality [--scenes A,B] [--engines A,B] [--width N] [--pupil-points N] [--quality Q]
Scenes and their truth are made once and kept in build/bench until the sources of the scenes change.
"""
import argparse
import dataclasses
import datetime
import hashlib
import json
import os
import pathlib
import re
import resource
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared/scenes"
PROGRAM = os.environ["PETZVAL"]
CACHE = ROOT / "build/bench"
BUILT_IN = ["night", "fence", "table", "slant", "bars", "hair", "post", "meadow"]
OVERSCAN = 14  # a rim of 1/14 of the width: more than the largest blur of any scene


@dataclasses.dataclass
class Scene:
    name: str
    sharp: pathlib.Path
    truth: pathlib.Path
    camera: list  # flags; empty where the file says it
    wide: pathlib.Path = None  # the same picture with overscan, where known
    behind: pathlib.Path = None  # its hidden layers
    mask: pathlib.Path = None
    exposure: float = 1


def petzval(*words):
    result = subprocess.run([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(f"bench: petzval {' '.join(map(str, words))}\n{result.stderr}")
    return result.stdout


def engine_names():
    """As the program's own help lists them, but for that of GPUs alone."""
    listed = re.search(r"--engine ([\w|]+)", petzval("defocus", "--help"))[1]
    return [name for name in listed.split("|") if name != "realtime"]


def scene_state():
    """Changes when the sources of the scenes do."""
    sources = sorted(p for p in (ROOT / "src/scene").rglob("*") if p.is_file()) + sorted((ROOT / "src/optics").glob("circle*"))
    return hashlib.sha1(b"".join(p.read_bytes() for p in sources)).hexdigest()[:8]


def built_in(name, width):
    """Pictures of a built-in scene, made if they are not there yet: pinhole, truth, and all that is known."""
    stem = f"{name}_{width}_{scene_state()}"
    files = [CACHE / f"{stem}_{what}.exr" for what in ("sharp", "truth", "wide", "behind")]
    if not all(file.exists() for file in files):
        print(f"making {name}", file=sys.stderr)
        sharp, truth, wide, behind = files
        size = ["--width", width, "--height", width * 9 // 16, "--overwrite"]
        petzval("scene", "make", name, "-o", sharp, "--truth", truth, *size)
        petzval("scene", "make", name, "-o", wide, "--layers", behind, "--overscan", width // OVERSCAN, *size)
    return Scene(name, files[0], files[1], [], files[2], files[3])


def path_traced(name):
    """A scene of ../shared/scenes with its camera; `table` counts inside the mask of its truth's low noise."""
    folder = SHARED / name
    camera = json.loads((folder / "camera.json").read_text())
    truth = camera["ground_truths"]["mod"]
    flags = ["--focal-length", camera["focal_length_mm"], "--sensor-width", camera["sensor_width_mm"],
             "--focus", camera["focus_distance_m"], "--fstop", truth["f_stop"]]
    mask = folder / "gt_mod_valid.png" if name == "table" else None
    return Scene(f"{name} (Cycles{', masked' if mask else ''})", folder / "pinhole.exr", folder / truth["file"],
                 flags, mask=mask, exposure=camera["comparison_exposure"])


def methods(scene, engines, quality, pupil_points):
    """(label, input, flags) of each way to defocus the scene."""
    for engine in engines:
        flags = ["--engine", engine]
        flags += {"reference": ["--pupil-points", pupil_points], "gaussian": []}.get(engine, ["--quality", quality])
        if engine != "reference" or not scene.behind:
            yield engine, scene.sharp, flags
        if scene.behind:
            yield f"{engine}, all known", scene.wide, [*flags, "--behind", scene.behind]


def score(scene, test):
    mask = ["--mask", scene.mask] if scene.mask else []
    found = json.loads(petzval("compare", scene.truth, test, "--exposure", scene.exposure, *mask, "--json", "-"))
    return f"{found['psnr_lin']:.2f}", f"{found['ssim_lin']:.4f}"


def cpu_seconds():
    """Of all commands so far."""
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    return spent.ru_utime + spent.ru_stime


def rows(scene, engines, quality, pupil_points):
    yield [scene.name, "pinhole", *score(scene, scene.sharp), ""]
    for label, given, flags in methods(scene, engines, quality, pupil_points):
        out = CACHE / "defocused.exr"
        before = cpu_seconds()
        petzval("defocus", given, "-o", out, *scene.camera, *flags, "--overwrite", "-q")
        seconds = cpu_seconds() - before
        row = [scene.name, label, *score(scene, out), f"{seconds:.1f}"]
        print(f"{scene.name}: {label}: {row[2]} dB", file=sys.stderr, flush=True)
        yield row


def crossed(body, corner="scene"):
    """Head and rows of a table with a row for each first word of `body` and a column for each second one. A cell has
    the rest of that row of `body`, or is empty."""
    left, top = list(dict.fromkeys(row[0] for row in body)), list(dict.fromkeys(row[1] for row in body))
    cells = {(row[0], row[1]): " / ".join(value for value in row[2:] if value) for row in body}
    return [corner, *top], [[name, *(cells.get((name, other), "") for other in top)] for name in left]


def first_line(*command):
    try:
        return subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True).stdout.splitlines()[0]
    except (OSError, IndexError):
        return "unknown"


def machine():
    model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return (f"{model[1] if model else 'unknown processor'}, {len(os.sched_getaffinity(0))} threads, "
            f"{first_line('c++', '--version')}, petzval {first_line('git', 'describe', '--always', '--dirty')}, "
            f"{datetime.date.today()}")


def print_table(head, body):
    widths = [max(len(row[i]) for row in [head, *body]) for i in range(len(head))]
    for row in [head, ["-" * w for w in widths], *body]:
        print("| " + " | ".join(cell.ljust(w) if i < 2 else cell.rjust(w)
                                for i, (cell, w) in enumerate(zip(row, widths))) + " |")


def main():
    parser = argparse.ArgumentParser(prog="./dev bench quality")
    parser.add_argument("--scenes", help="built-in names, or shared/NAME")
    parser.add_argument("--engines")
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--pupil-points", type=int, default=4096)
    parser.add_argument("--quality", default="standard")
    given = parser.parse_args()
    CACHE.mkdir(parents=True, exist_ok=True)
    shared = [f"shared/{p.parent.name}" for p in sorted(SHARED.glob("*/camera.json"))]
    names = given.scenes.split(",") if given.scenes else BUILT_IN + shared
    engines = given.engines.split(",") if given.engines else engine_names()
    body = []
    for name in names:
        scene = path_traced(name[7:]) if name.startswith("shared/") else built_in(name, given.width)
        body += rows(scene, engines, given.quality, given.pupil_points)
    print_table(*crossed(body))
    print(f"\n{given.width} px wide, --quality {given.quality}, reference with {given.pupil_points} pupil points. "
          f"{machine()}.")


if __name__ == "__main__":
    main()
