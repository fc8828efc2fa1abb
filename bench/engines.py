"""Every engine beside the others on the same frames: how close to the truth, how fast, how it looks.

Two tables, in Markdown, on stdout, from one run:
  quality   one column for each scene: PSNR in dB / SSIM / CPU s, against what a ray tracer recorded
            through the lens; CPU seconds are those of the whole command, files and all, the least of --repeat runs;
            scenes as in `./dev bench quality`, random:5 is `random` with that seed; --fstops: each built-in scene at
            each of these. --rows: scenes as rows, dB alone; `all` is every scene
  speed     1920 x 1080, largest radius 32 px: wall seconds and CPU seconds / threads, each the best of --repeat; every
            run has another picture, except in the row `same picture`: there the surfaces are kept from the run before
and build/bench/engines.png: the --frame scene through each, with the truth last. --docs: as docs/pictures/engines.png;
that alone, anew: `./dev bench engines --tables quality --scenes night --repeat 1 --docs`.

Usage: ./dev bench engines [--scenes A,B] [--width N] [--samples N] [--frame SCENE] [--repeat N] [--tables A,B] [--docs]
       ./dev bench engines --rows --scenes all --ways realtime,gather,scatter --fstops 2.8,0.7
Scenes and their truth (of --samples lens samples per pixel) are made once and kept in build/bench.
"""
import argparse
import os
import pathlib
import sys

from quality import CACHE, ROOT, SHARED, Scene, machine, path_traced, petzval, print_table, scene_state, score
from speed import THREADS, measure, picture, seconds

sys.path.insert(0, str(ROOT / "tools"))
from sample_set import read_png, side_by_side, write_png  # noqa: E402

WAYS = [("scatter final", ["--quality", "final"]), ("scatter", []), ("scatter draft", ["--quality", "draft"]),
        ("gather", ["--engine", "gather"]), ("gather draft", ["--engine", "gather", "--quality", "draft"]),
        ("sprites", ["--engine", "sprites"]),
        ("sprites, gaussian", ["--engine", "sprites", "--background", "gaussian"]),
        ("gaussian", ["--engine", "gaussian"]),
        ("gaussian wgld", ["--engine", "gaussian", "--gaussian-style", "wgld"])]
ON_GPU = ("realtime", ["--engine", "realtime", "--device", "gpu"])  # if --ways names it
EVERY = ("night fence table slant bars dynamic-range lanterns hair post meadow tori cubes rows cutouts hexadrive wgld "
         "unity random:5 random:7 shared/fence shared/table")
SAME = "standard, same picture"
SPEED = [("scatter", "final"), ("scatter", "standard"), ("scatter", SAME), ("scatter", "draft"), ("gather", "standard"),
         ("gather", "draft"), ("sprites", "standard"), ("gaussian", "standard")]
ON_SHEET = ["scatter", "gather", "sprites", "gaussian", "gaussian wgld"]


def built_in(name, width, samples, fstop=None, extra=()):
    kind = "_".join([fstop or "own", *extra])
    stem = CACHE / f"{name.replace(':', '_')}_{width}_{samples}_{kind}_{scene_state()}"
    scene, _, seed = name.partition(":")
    flags = (["--seed", seed] if seed else []) + (["--fstop", fstop] if fstop else []) + list(extra)
    sharp, truth = pathlib.Path(f"{stem}_sharp.exr"), pathlib.Path(f"{stem}_truth.exr")
    if not (sharp.exists() and truth.exists()):
        print(f"making {name}", file=sys.stderr)
        petzval("scene", "make", scene, *flags, "-o", sharp, "--truth", truth, "--width", width, "--height", width * 9 // 16,
                "--samples", samples, "--overwrite")
    return Scene(name + (f" f/{fstop}" if fstop else ""), sharp, truth, [])


def took(scene, flags, out, repeat):
    """Least CPU seconds of the command; `out` is what it wrote."""
    best = float("inf")
    for _ in range(repeat):
        before = os.times()
        petzval("defocus", scene.sharp, "-o", out, *scene.camera, *flags, "--overwrite", "-q")
        after = os.times()
        best = min(best, after.children_user + after.children_system - before.children_user - before.children_system)
    return best


def shown(light, out):
    petzval("develop", light, "-o", out, "--no-dither", "--overwrite", "-q")
    return out


def cell(scene, test, cpu_s=None):
    psnr, ssim = score(scene, test)
    return f"{float(psnr):.1f} / {float(ssim):.3f}" + ("" if cpu_s is None else f" / {cpu_s:.2f}")


def quality_column(scene, given, panels):
    """The column of a scene, top to bottom: the sharp picture itself, then WAYS."""
    yield cell(scene, scene.sharp)
    for label, flags in given.ways:
        print(f"{scene.name}: {label}", file=sys.stderr)
        out = CACHE / "engines_out.exr"
        best = took(scene, flags, out, given.repeat)
        yield cell(scene, out, best)
        if scene.name == given.frame and label in ON_SHEET:
            panels.append(shown(out, CACHE / f"engines_{label.replace(' ', '_')}.png"))
    if scene.name == given.frame:
        panels.append(shown(scene.truth, CACHE / "engines_truth.png"))


def scenes_of(given):
    """Those that are here, the built-in ones at each aperture."""
    for name in (EVERY.split() if given.scenes == "all" else given.scenes.split(",")):
        if not name.startswith("shared/"):
            yield from (built_in(name, given.width, given.samples, fstop) for fstop in given.fstops)
        elif (SHARED / name[7:]).exists():
            yield path_traced(name[7:])


def quality_rows(given):
    """dB of each of the ways, scene by scene, and their means."""
    made = []
    for scene in scenes_of(given):
        found = []
        for _, flags in given.ways:
            took(scene, flags, CACHE / "engines_out.exr", 1)
            found.append(float(score(scene, CACHE / "engines_out.exr")[0]))
        made.append(found)
        yield [scene.name, *(f"{db:.2f}" for db in found)]
    yield ["mean", *(f"{sum(of_way) / len(made):.2f}" for of_way in zip(*made))]


def sheet(panels, out, columns=2, step=4):
    """Pictures of one size side by side, row by row, with few codes."""
    pictures, rows = [read_png(p) for p in panels], []
    for first in range(0, len(pictures), columns):
        beside = side_by_side(pictures[first:first + columns], step)
        rows += ([bytes(len(beside[0]))] * 2 if rows else []) + beside
    write_png(out, rows)
    print(f"{out}: {', '.join(p.stem[8:] for p in panels)}", file=sys.stderr)


def speed_rows(given):
    for engine, quality in SPEED:
        row = [engine, quality]
        for name in ("table", "night", "fence"):
            same = {"same-picture": 1, "repeat": max(3, given.repeat)} if quality == SAME else {}
            run = measure(picture(name, 1920), given, engine=engine, quality=quality.split(",")[0], radius=32, **same)
            row.append(f"{seconds(run['wall_s'])} ({seconds(run['cpu_s'] / THREADS)})" if run else
                       f"> {given.limit / THREADS:g}")
        yield [*row, f"{run['peak_mib']:.0f}" if run else ""]


def main():
    parser = argparse.ArgumentParser(prog="./dev bench engines")
    parser.add_argument("--scenes", default="night,fence,table,lanterns,shared/fence,shared/table")
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--samples", type=int, default=256)
    parser.add_argument("--frame", default="night")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--tables", default="quality,speed")
    parser.add_argument("--docs", action="store_true", help="put the sheet of pictures into docs/pictures")
    parser.add_argument("--ways", help="the names of the rows; realtime is one that is left out unless it is asked for")
    parser.add_argument("--fstops", type=lambda s: s.split(","), default=[None])
    parser.add_argument("--rows", action="store_true")
    given = parser.parse_args()
    named = dict([*WAYS, ON_GPU])
    given.ways = [(way, named[way]) for way in given.ways.split(",")] if given.ways else WAYS
    given.limit = 60
    CACHE.mkdir(parents=True, exist_ok=True)
    if given.rows:
        print_table(["scene", *(label for label, _ in given.ways)], list(quality_rows(given)))
        print(f"\nPSNR in dB. Built-in scenes {given.width} px wide, truth of {given.samples} lens samples.\n")
    elif "quality" in given.tables:
        head, columns, panels = ["engine"], [], []
        for scene in scenes_of(given):
            head.append(scene.name)
            columns.append(list(quality_column(scene, given, panels)))
        print_table(head, list(zip(["sharp picture", *[label for label, _ in given.ways]], *columns)))
        print(f"\nBuilt-in scenes {given.width} px wide, truth of {given.samples} lens samples.\n")
        if panels:
            sheet(panels, ROOT / "docs/pictures/engines.png" if given.docs else CACHE / "engines.png")
    if "speed" in given.tables and not given.rows:
        print_table(["engine", "quality", "table s", "night s", "fence s", "peak MiB"], list(speed_rows(given)))
        print("\n1920 x 1080, radius 32 px; in brackets CPU seconds / threads.")
    print(machine())


if __name__ == "__main__":
    main()
