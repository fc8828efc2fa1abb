"""How long the engines take, where the time goes, what it costs in memory, and what the machine could do.

Tables, in Markdown, on stdout:
  main      built-in night and table, 4K and 1080p, largest radius 16, 32, 64, 128 px: wall and CPU seconds without
            the making of kernels, the slowest radius against the fastest, peak memory, and the stages of each
  engines   every engine with a lens at the smallest and the largest radius, beside scatter
  pixels    the same content from 0.23 to 33 Mpx, largest radius 32 px
  threads   one thread against two
  command   whole `petzval defocus` commands at 1080p and 4K, ZIP half EXR in and out, GEGL's lens-blur beside
  ceilings  memory bandwidth and multiply-adds of this machine, and how near each stage comes to them

Usage: ./dev bench speed [--tables A,B] [--scenes A,B] [--widths W,W] [--radii R,R] [--lenses A,B] [--limit S]
On a machine that others use, wall seconds say how busy they are: CPU / threads is what an idle one would need at
least. A run that needs more than --limit CPU seconds is stopped and listed as such. Pictures are kept in
build/bench; they have few samples per pixel, since only time is measured.
"""
import argparse
import itertools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from quality import CACHE, PROGRAM, ROOT, machine, petzval, print_table, scene_state

BUILT = pathlib.Path(PROGRAM).parents[2] / "bench"
THREADS = len(os.sched_getaffinity(0))
DOUBLET = "doublet"
# engine, quality, of every line of the main table; reference is asked for few points and small pictures alone
WAYS = [("scatter", "standard"), ("scatter", "draft")]
ENGINES = ["scatter", "gather", "sprites", "gaussian"]
LIMITS = {(3840, "standard"): 1.5, (1920, "standard"): 0.4}  # seconds asked of wall


def picture(scene, width, height=None, samples=16):
    """A built-in scene as EXR, ZIP half, made if it is not there yet."""
    path = CACHE / f"{scene}_{width}_{scene_state()}_speed.exr"
    if not path.exists():
        print(f"making {path.name}", file=sys.stderr)
        petzval("scene", "make", scene, "-o", path, "--width", width, "--height", height or width * 9 // 16,
                "--pinhole-samples", samples, "-q")
    return path


def measure(path, given, **flags):
    """One run in a process of its own: what petzval_bench_speed printed, or None where it was stopped."""
    flags = {"limit": given.limit, "threads": THREADS, "repeat": given.repeat, **flags}
    words = [str(word) for name, value in flags.items() for word in (f"--{name}", value)]
    print(f"{path.name} {' '.join(words)}", file=sys.stderr)
    result = subprocess.run([BUILT / "petzval_bench_speed", path, *words], stdout=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(result.returncode)
    found = json.loads(result.stdout)
    if "cancelled_after_cpu_s" in found:
        return None
    kernels = found["stages"].pop("kernels")["seconds"]
    share = (found["wall_s"] - kernels) / found["wall_s"] if found["wall_s"] else 0
    return {**found, "kernels_s": found["kernels_s"] + kernels, "wall_s": found["wall_s"] - kernels, "cpu_s": found["cpu_s"] * share}


def seconds(value):
    return f"{value:.2f}" if value >= 0.095 else f"{value:.3f}"


def ratio(values):
    return f"{max(values) / min(values):.2f}" if values and all(values) else "-"


def main_table(given):
    head = ["picture", "engine, lens", *[f"{r} px" for r in given.radii], "slowest / fastest", "kernels s", "peak MiB"]
    body, stages = [], []
    for width in given.widths:
        for scene in given.scenes:
            for engine, quality in WAYS:
                for lens in given.lenses:
                    runs = [measure(picture(scene, width), given, engine=engine, quality=quality, lens=lens, radius=r)
                            for r in given.radii]
                    name = [f"{scene} {width}", f"{engine} {quality}, {lens}"]
                    body.append([*name, *[f"{seconds(r['wall_s'])} ({seconds(r['cpu_s'] / THREADS)})" if r else
                                          f"> {given.limit / THREADS:g}" for r in runs],
                                 ratio([r and r["cpu_s"] for r in runs]),
                                 seconds(max((r["kernels_s"] for r in runs if r), default=0)),
                                 f"{max((r['peak_mib'] for r in runs if r), default=0):.0f}"])
                    stages += [[*name, f"{r['radius_px']:.0f}", r] for r in runs if r]
    print(f"\n### Seconds by largest radius: wall (CPU / {THREADS} threads)\n")
    print_table(head, body)
    asked = ", ".join(f"{s} s at {w} px wide" for (w, _), s in LIMITS.items())
    print(f"\nAsked of `standard` on an idle machine: {asked}; slowest / fastest (by CPU) 1.5.")
    names = list(dict.fromkeys(name for *_, run in stages for name in run["stages"]))
    print("\n### Wall seconds of each stage\n")
    print_table(["picture", "engine, lens", "radius px", *names],
                [[*row, *[seconds(run["stages"][name]["seconds"]) if name in run["stages"] else "" for name in names]] for *row, run in stages])


def engines_table(given):
    """A lens spreads light wider than the radius says: what that costs, whichever engine draws it."""
    least, most = min(given.radii), max(given.radii)
    width, lens = min(given.widths), given.lenses[-1]
    body = []
    for scene in given.scenes:
        runs = {(engine, radius): measure(picture(scene, width), given, engine=engine, quality="standard", lens=lens,
                                          radius=radius)
                for engine in ENGINES for radius in (least, most)}
        for engine in ENGINES:
            small, large = runs[engine, least], runs[engine, most]
            beside = [run["cpu_s"] / other["cpu_s"] if run and other else None
                      for run, other in ((small, runs["scatter", least]), (large, runs["scatter", most]))]
            body.append([scene, engine, *[seconds(run["cpu_s"]) if run else f"> {given.limit:g}" for run in (small, large)],
                         ratio([run and run["cpu_s"] for run in (small, large)]),
                         *["-" if share is None else f"{share:.2f}" for share in beside]])
    print(f"\n### CPU seconds of every engine: {width} px wide, {lens}, standard\n")
    print_table(["picture", "engine", f"{least} px", f"{most} px", "slower / faster", f"of scatter, {least} px",
                 f"of scatter, {most} px"], body)
    print("\nAsked of `gather`: 0.25 of scatter, slower / faster 1.5.")


def pixels_table(given):
    """Mirrored copies of one picture: the same content in more pixels."""
    body = []
    for times in (1, 2, 4, 8, 12):
        run = measure(picture("table", 640), given, mirror=times, radius=32, repeat=1)
        if run:
            mpx = run["width"] * run["height"] / 1e6
            body.append([f"{mpx:.2f}", seconds(run["wall_s"]), seconds(run["cpu_s"]), f"{run['cpu_s'] / mpx:.3f}",
                         f"{run['peak_mib']:.0f}", f"{run['peak_mib'] * 2**20 / mpx / 1e6:.0f}"])
    print("\n### Time against pixels: table, ideal lens, standard, largest radius 32 px\n")
    print_table(["Mpx", "wall s", "CPU s", "CPU s / Mpx", "peak MiB", "bytes / px"], body)


def threads_table(given):
    body = []
    for scene in given.scenes:
        runs = [measure(picture(scene, 1920), given, threads=n, radius=32) for n in (1, 2)]
        if all(runs):
            one, two = runs
            body.append([scene, seconds(one["wall_s"]), seconds(two["wall_s"]), f"{one['wall_s'] / two['wall_s']:.2f}",
                         seconds(one["cpu_s"]), seconds(two["cpu_s"]), f"{2 * one['cpu_s'] / two['cpu_s']:.2f}"])
    print("\n### One thread, two threads: 1920 px wide, ideal lens, standard, largest radius 32 px\n")
    print_table(["picture", "wall s, 1", "wall s, 2", "speed-up", "CPU s, 1", "CPU s, 2", "at most, by CPU"], body)
    print("\n`at most, by CPU`: the speed-up on an idle machine if no thread ever waited.")


COMMANDS = [  # scene, width, flags: whole commands, as users give them
    ("table", 1920, ["--lens", DOUBLET]),
    ("night", 1920, ["--lens", DOUBLET]),
    ("night", 3840, ["--lens", DOUBLET, "--fstop", "4.2", "--max-radius", "64"]),
    ("night", 3840, ["--lens", DOUBLET, "--fstop", "1", "--max-radius", "64"]),
]


def whole(words):
    """Wall, user and system seconds of a process, and its peak memory in MiB."""
    with tempfile.NamedTemporaryFile("r") as seconds_of:
        subprocess.run(["/usr/bin/env", "time", "-o", seconds_of.name, "-f", "%e %U %S %M", *map(str, words)], check=True,
                       stdout=subprocess.DEVNULL)
        wall, user, system, kib = map(float, seconds_of.read().split())
    return wall, user, system, kib / 1024


def gegl_lens_blur(source, flags, out):
    """The words of GEGL's lens-blur with the same radii; they are made here, and not counted."""
    radii, share = CACHE / "speed_coc.exr", CACHE / "speed_radius.exr"
    petzval("defocus", source, "--view", "coc", "-o", radii, *flags[2:], "--overwrite", "-q")
    largest = float(subprocess.check_output([BUILT / "petzval_bench_radius_map", source, radii, share], text=True))
    return ["gegl", source, "-o", out, "--", "gegl:lens-blur", f"radius={largest}", "linear-mask=true", "aux=[",
            "gegl:load", f"path={share}", "]"]


def command_table(given):
    """Commands in turn, so that a machine that others use treats them alike; the least CPU seconds of each count."""
    out, ours, theirs = CACHE / "speed_out.exr", {}, {}
    beside = shutil.which("gegl")
    for scene, width, flags in COMMANDS:
        source, name = picture(scene, width), f"{scene} {width}, {' '.join(flags)}"
        runs = {"cold": [PROGRAM, "defocus", source, "-o", out, *flags, "--kernel-cache", "off", "--overwrite", "-q"]}
        if beside and width == 3840:
            runs["gegl"] = gegl_lens_blur(source, flags, out)
        took = {}
        for way, words in [*runs.items()] * given.repeat:
            print(f"{name}: {way}", file=sys.stderr)
            found = whole(words)
            took[way] = min(took.get(way, found), found, key=lambda t: t[1] + t[2])
        ours[name], theirs[name] = took["cold"], took.get("gegl")
    body = []
    for name, (wall, user, system, mib) in ours.items():
        cpu, peer = user + system, theirs[name]
        body.append([name, seconds(wall), seconds(user), seconds(system), f"{mib:.0f}",
                     *([f"{peer[0]:.2f}", f"{peer[1] + peer[2]:.2f}", f"{cpu / (peer[1] + peer[2]):.2f}"] if peer else ["", "", ""])])
    print("\n### Whole commands: petzval defocus, ZIP half EXR in and out, no kernels kept; GEGL's lens-blur beside\n")
    print_table(["picture and flags", "wall s", "user s", "system s", "peak MiB", "GEGL wall s", "GEGL CPU s", "CPU, ours / GEGL"], body)
    if not beside:
        print("\nGEGL is not installed (Debian: gegl).")


def ceilings_table(given):
    found = json.loads(subprocess.run([BUILT / "petzval_bench_ceilings"], stdout=subprocess.PIPE, text=True,
                                      check=True).stdout)
    simd = found.pop("simd")
    print(f"\n### What the machine can do ({simd}; by each thread's CPU time)\n")
    print_table(["threads", "", "read GB/s", "copy GB/s", "stamp GB/s, in cache", "10^9 multiply-adds / s"],
                [[n, "", *[f"{v:.1f}" for v in of.values()]] for n, of in found.items()])
    body = []
    for scene, threads in itertools.product(given.scenes, found):
        most = found[threads]
        run = measure(picture(scene, given.widths[0]), given, radius=32, threads=threads, lens=DOUBLET)
        for stage, took in (run["stages"].items() if run else ()):
            per_s = lambda count: 1e-9 * took[count] / took["seconds"]
            of_stamp = bool(took["multiply_adds"])
            adds = [f"{per_s('multiply_adds'):.1f}", f"{100 * per_s('multiply_adds') / most['giga_fma_per_s']:.0f} %"]
            body.append([scene, threads, stage, seconds(took["seconds"]), f"{1e-9 * took['bytes']:.2f}",
                         f"{per_s('bytes'):.1f}",
                         f"{100 * per_s('bytes') / most['stamp_gb_per_s' if of_stamp else 'copy_gb_per_s']:.0f} %",
                         *(adds if of_stamp else ["", ""])])
    print(f"\n### How far from that: {given.widths[0]} px wide, {DOUBLET}, largest radius 32 px, wall seconds\n")
    print_table(["picture", "threads", "stage", "seconds", "GB", "GB/s", "of ceiling", "10^9 multiply-adds / s",
                 "of ceiling"], body)
    print("\nBytes and multiply-adds as the engine counts them (docs/reference/command-line.md, the report). Bytes of stages that"
          "\nstamp are held against stamping within the first cache, those of others against copying in memory.")


TABLES = {"main": main_table, "engines": engines_table, "pixels": pixels_table, "threads": threads_table,
          "command": command_table, "ceilings": ceilings_table}


def main():
    words = lambda text: text.split(",")
    numbers = lambda text: [int(word) for word in text.split(",")]
    parser = argparse.ArgumentParser(prog="./dev bench speed")
    parser.add_argument("--tables", type=words, default=list(TABLES))
    parser.add_argument("--scenes", type=words, default=["night", "table"])
    parser.add_argument("--widths", type=numbers, default=[3840, 1920])
    parser.add_argument("--radii", type=numbers, default=[16, 32, 64, 128])
    parser.add_argument("--lenses", type=words, default=["ideal", DOUBLET])
    parser.add_argument("--limit", type=float, default=60, help="CPU seconds after which a run is stopped")
    parser.add_argument("--repeat", type=int, default=2, help="runs in one process; the least of each time counts")
    given = parser.parse_args()
    unknown = set(given.tables) - set(TABLES)
    if unknown:
        parser.error(f"no table {', '.join(sorted(unknown))}; there are: {', '.join(TABLES)}")
    CACHE.mkdir(parents=True, exist_ok=True)
    for name in given.tables:
        TABLES[name](given)
    print(f"\n{machine()}; command: ./dev bench speed {' '.join(sys.argv[1:])}".rstrip() + ".")


if __name__ == "__main__":
    main()
