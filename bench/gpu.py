"""What a GPU takes for each pass of an engine, and what it should take by the numbers of its data sheet.

Usage: ./dev bench gpu [--device gpu:N] [--engines A,B] [--widths W,W] [--radii R,R] [--scenes A,B] [--repeat N]
One unattended command: on a machine with a GPU it measures 1080p and 4K and writes Markdown to
bench/results/gpu_NAME.md, beside the model. Milliseconds are the device's own, by timestamps, after a frame that
warms it up. A software driver is measured on small pictures only, and its times are not shown: they say nothing
about a GPU; bytes and operations do not depend on the driver.

The model of the pass `composite`: the larger of the bytes that must cross memory at least once (sources, arrivals, sums of
one sector, the result), divided by the bandwidth, and its multiply-adds, divided by the rate; both as published, so
that no pass can be faster. What a frame at 1080p needs is counted by drawing it on the CPU; 4K is four times that.
Of engines `gather`, `gaussian` and `sprites` all passes, as the device's own code counts what it hands them (src/device/vulkan):
the lists of cells and lights, kernels, pixels, what they leave behind; of each light its kernel's pixels, 4 multiply-adds each, 6
in `gather`; of a blur 5 for each tap of each cell. A pixel of a small picture stands for one of a large.
Of engine `realtime` all passes: the bytes that its images and buffers hold, each once for each pass that reads or writes
it, as the pass itself counts them (src/device/vulkan/realtime/pass.cpp); hosts have colours of 16 bits and save 8 bytes a
pixel for each of the four times that these cross memory.
`host` is not an engine: the real-time pass as a host embeds it (bench/host_pass.cpp), medians of 160 frames, two in flight;
besides the scenes a plane with as many bright pixels in a thousand at 48 px. It draws on the first device of all.
`glare` is not one: bloom and veil with the quick star, then with the final one, over the picture as it is, at any radius.
`develop` is none either: light to codes of 8 bits, at any radius.
Not in it: what is looked at and not hit, waiting, copies from and to the host. docs/results/gpu.md has what two GPUs took.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

from quality import CACHE, PROGRAM, ROOT, machine, petzval, scene_state

BENCH = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_gpu"
SPEED = BENCH.with_name("petzval_bench_speed")
HOST = BENCH.with_name("petzval_bench_host_pass")
# Bytes a second of memory, FP32 multiply-adds a second (half the FLOPS), as published; read on 2026-11-22:
# https://fpsbench.com/compare/gpu/nvidia-geforce-rtx-4060-vs-nvidia-t600 (272.0 GB/s, 15.11 TFLOPS),
# https://www.gpu-monkey.com/en/gpu-amd_radeon_rx_7800_xt (624 GB/s), https://cputronic.com/gpu/amd-radeon-rx-7800-xt
# (37.32 TFLOPS), https://archive-lib.hpctech.co.jp/gpuproduct/nvidia-h100.html (3,350 GB/s, 67 TFLOPS).
DATA_SHEETS = {
    "GeForce RTX 4060": (272e9, 15.11e12 / 2),
    "Radeon RX 7800 XT": (624e9, 37.32e12 / 2),
    "H100 SXM": (3350e9, 67e12 / 2),
}


def picture(scene, width):
    path = CACHE / f"{scene}_{width}_{scene_state()}_gpu.exr"
    if not path.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        petzval("scene", "make", scene, "-o", path, "--width", width, "--height", width * 9 // 16, "--pinhole-samples", 16,
                "-q")
    return path


def measure(path, given, device, engine, radius):
    words = ["--device", device, "--radius", radius, "--repeat", given.repeat, "--engine", engine]
    result = subprocess.run([BENCH, path, *map(str, words)], stdout=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(result.returncode)
    return json.loads(result.stdout)


def chosen_device(name):
    found = json.loads(subprocess.run([PROGRAM, "devices", "--json", "-"], stdout=subprocess.PIPE, check=True).stdout)
    gpus = [d for d in found["devices"] if d["name"] != "cpu" and not d["lacks"]]
    if not gpus:
        sys.exit(f"bench gpu: {found['no_gpu']}")
    return next((d for d in gpus if name in (None, d["name"])), None) or sys.exit(f"bench gpu: {name} is not there")


def composite_model(scene, radius):
    """Rows of what composite would take at least, by data sheet."""
    words = [SPEED, picture(scene, 1920), "--radius", str(radius)]
    spread = json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)["stages"]["spread"]
    pixels = 1920 * 1080
    # Of the stage's bytes 48 for every 4 multiply-adds are kernels and sums, which stay in caches.
    moved = (spread["bytes"] - 12 * spread["multiply_adds"]) / pixels + 2 * 20 + 16
    madds = spread["multiply_adds"] / pixels
    for size, name in ((pixels, "1080p"), (4 * pixels, "4K")):
        yield [scene, f"{radius:g}", name, f"{madds:.0f}", f"{moved:.0f}"] + [
            f"{1e3 * size * max(moved / bandwidth, madds / rate):.2f}" for bandwidth, rate in DATA_SHEETS.values()]


REALTIME_PASSES = ["measure", "split", "reach", "gather", "combine"]
SAVED_BY_HALVES = {"measure": 8, "split": 8, "combine": 16}  # bytes a pixel


def realtime_model(bytes_per_pixel):
    """Rows of what each pass would take at least, by data sheet: as the program draws files, and as hosts have it."""
    hosts = {name: count - SAVED_BY_HALVES.get(name, 0) for name, count in bytes_per_pixel.items()}
    rows = [(name, count) for name, count in bytes_per_pixel.items()]
    rows += [("all", sum(bytes_per_pixel.values())), ("all, of a host", sum(hosts.values()))]
    for name, count in rows:
        yield [name, f"{count:.1f}"] + [f"{1e3 * size * count / bandwidth:.3f}" for size in (1920 * 1080, 3840 * 2160)
                                       for bandwidth, _ in DATA_SHEETS.values()]


def pass_model(counted):
    """Rows of what passes would take at least, by data sheet, as they were counted."""
    for engine, scene, radius, name, moved, madds in counted:
        yield [engine, scene, f"{radius:g}", name, f"{madds:.0f}", f"{moved:.1f}"] + [
            f"{1e3 * size * max(moved / bandwidth, madds / rate):.2f}" for size in (1920 * 1080, 3840 * 2160)
            for bandwidth, rate in DATA_SHEETS.values()]


def rows_of(engine, given, device, counted):
    """Of every pass of an engine; notes in `counted` the bytes and multiply-adds a pixel of those that count them."""
    software = device["software"]
    for scene in given.scenes:
        for width in given.widths or ([320] if software else [1920, 3840]):
            for radius in given.radii[:1] if engine in ("glare", "develop") else given.radii:
                scaled = radius * width / 1920 if software else radius
                found = measure(picture(scene, width), given, device["name"], engine, scaled)
                given.copied = found["copied_bytes_per_s"]
                given.longest = max(given.longest, found["longest_submission_ms"])
                pixels = found["width"] * found["height"]
                passes = found["passes"]
                for name in sorted(passes, key=lambda n: REALTIME_PASSES.index(n) if n in REALTIME_PASSES else -1):
                    p = passes[name]
                    madds, seconds = p["multiply_adds"], p["ms"] / 1e3
                    if p["bytes"]:
                        counted.append((engine, scene, radius, name, p["bytes"] / pixels, madds / pixels))
                    yield [engine, scene, found["width"], f"{scaled:.3g}", name, "–" if software else f"{p['ms']:.3f}",
                           f"{p['runs']:g}", f"{madds / pixels:.0f}" if madds else "–",
                           "–" if software or not madds else f"{madds / seconds / 1e9:.0f}",
                           f"{p['bytes'] / pixels:.1f}" if p["bytes"] else "–",
                           "–" if software or not p["bytes"] else f"{p['bytes'] / seconds / 1e9:.0f}"]


def hosted(path, radius, given, *more):
    words = [HOST, path, "--radius", radius, "--repeat", 2 if given.software else 200, *more]
    result = subprocess.run([*map(str, words)], stdout=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(result.returncode)
    found = json.loads(result.stdout)
    return ["–" if given.software else f"{found[step]:.3f}" for step in [*REALTIME_PASSES, "all"]]


def host_rows(given):
    widths = given.widths or ([320] if given.software else [1920, 3840])
    for width in widths:
        for scene in given.scenes:
            for radius in given.radii:
                yield [scene, width, f"{radius:g}", *hosted(picture(scene, width), radius * width / 1920 if given.software else radius, given)]
    for quality in ("draft", "final"):
        path = picture(given.scenes[0], widths[0])
        yield [f"{given.scenes[0]}, {quality}", widths[0], "40", *hosted(path, 40, given, "--quality", quality)]
    for bright in (0, 1, 3, 10, 30, 100):
        yield [f"bright pixels, {bright} ‰", widths[0], "48", *hosted(picture(given.scenes[0], widths[0]), 48, given, "--bright", bright)]


def page(given, device):
    software, counted = device["software"], []
    given.software = software
    rows = [row for engine in given.engines if engine != "host" for row in rows_of(engine, given, device, counted)]
    text = []
    say = text.append
    say(f"# {device['name']}, {device['title']}\n")
    say(f"{machine()}; `./dev bench gpu`." + (" A software driver: no milliseconds." if software else "") +
        (f" Its memory copies {given.copied / 1e9:.0f} GB/s, reads and writes counted; the longest submission took "
         f"{given.longest:.0f} ms." if rows and not software else "") + "\n")
    if "host" in given.engines:
        say("The real-time pass of a host, ms of the device.\n")
        say(table(["picture", "width", "radius", *REALTIME_PASSES, "all"], host_rows(given)) + "\n")
    if rows:
        say(table(["engine", "scene", "width", "radius", "pass", "ms", "submissions", "multiply-adds/px", "G multiply-adds/s",
                   "bytes/px", "GB/s"], rows))
    if "scatter" in given.engines:
        say("\nThe model: no faster than this, by published bandwidth and rate; ms for the pass `composite`.\n")
        say(table(["scene", "radius", "size", "multiply-adds/px", "bytes/px", *DATA_SHEETS],
                  [row for scene in given.scenes for radius in given.radii for row in composite_model(scene, radius)]))
    sheets = [f"{name}, {size}" for size in ("1080p", "4K") for name in DATA_SHEETS]
    others = [c for c in counted if c[0] not in ("scatter", "realtime")]
    if others:
        say("\nThe model of other engines: no faster than this, by published bandwidth and rate; ms.\n")
        say(table(["engine", "scene", "radius", "pass", "multiply-adds/px", "bytes/px", *sheets], pass_model(others)))
    realtime = {name: moved for engine, _, _, name, moved, _ in counted if engine == "realtime"}
    if realtime:
        say("\nThe model of `realtime`: no faster than this, by published bandwidth; ms.\n")
        say(table(["pass", "bytes/px", *sheets], realtime_model(realtime)))
    return "\n".join(text) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--device")
    parser.add_argument("--engines", "--engine", type=lambda s: s.split(","),
                        default=["host", "scatter", "gather", "gaussian", "sprites", "realtime", "glare", "develop"])
    parser.add_argument("--widths", type=lambda s: [int(w) for w in s.split(",")])
    parser.add_argument("--radii", type=lambda s: [float(r) for r in s.split(",")], default=[16, 64])
    parser.add_argument("--scenes", type=lambda s: s.split(","), default=["night", "table"])
    parser.add_argument("--repeat", type=int, default=3)
    given = parser.parse_args()
    given.longest = 0
    device = chosen_device(given.device)
    if device["software"]:
        given.repeat = 1
    made = page(given, device)
    print(made)
    if not device["software"]:
        folder = ROOT / "bench/results"
        folder.mkdir(exist_ok=True)
        (folder / f"gpu_{re.sub('[^A-Za-z0-9]+', '_', device['title']).strip('_')}.md").write_text(made)


def table(head, rows):
    return "\n".join("| " + " | ".join(map(str, r)) + " |" for r in [head, ["---"] * len(head), *rows])


if __name__ == "__main__":
    main()
