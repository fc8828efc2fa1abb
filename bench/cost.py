"""Work of the real-time pass a pixel, counted while it draws, and the least time that it takes on six cards.

Usage: ./dev bench cost [--scenes A,B] [--radii R,R] [--width N] [--quality Q] [--bright N,N]
--bright: instead of the scenes a plane of each radius, with so many bright pixels in a thousand: the worst case of lamps.
A counter in each block of each program counts how often invocations ran it; a block's work is read from its SPIR-V
(bench/counted_spirv.h): 32-bit operations of one lane, with 4 for a root or reciprocal; samples and fetches of images;
reads and writes of buffers. Any device serves, as counts do not depend on it.
The model: the largest of operations, samples and bytes, each divided by the card's published peak; RGBA16F is sampled at
half rate on GeForce and GCN. Bytes are those that dispatches must read and write at least once (./dev bench gpu).
Its error: the last column compares the operations in a program's text with the instructions that Mesa's AMD compiler makes
of it for Navi 21, scalar ones and waits included. Where only the compiler unrolls a loop, its count is higher.
Not in the model: lanes that wait for others of their subgroup, latency, barriers, shared memory.
"""
import argparse
import json
import os
import pathlib
import platform
import subprocess
import sys

from gpu import picture, table
from quality import PROGRAM

COST = pathlib.Path(PROGRAM).parents[2] / "bench/petzval_bench_cost"
# Operations and samples of RGBA16F a second, bytes a second, pixels. Published peaks: half of the teraflops, texels a second
# (half of them on GeForce and GCN), memory. Read on 2026-11-27, besides those that bench/gpu.py names:
# RTX 4090: 82.6 TFLOPS, 512 texture units, 2.52 GHz (https://www.notebookcheck.pl/NVIDIA-NVIDIA-GeForce-RTX-4090.677670.0.html),
# 1010 GB/s (https://pcspecchart.com/pc_parts/gpu/25). H100 SXM: 132 multiprocessors (the page in gpu.py); that each has four
# texture units is assumed, and a clock of 1.77 GHz. RX 480: 5.834 TFLOPS, 182.3 GT/s, 256 GB/s
# (https://fpsbench.com/compare/gpu/amd-radeon-rx-480-vs-nvidia-tesla-k8). Steam Deck: 8 compute units at 1.6 GHz, 88 GB/s
# (https://vuink.com/post/nefgrpuavpn-d-dpbz/gaming/2021/11/valve-provides-a-deep-dive-into-steam-decks-custom-hardware-design),
# 1.6 TFLOPS (https://gist.github.com/TylerRudie/29939a0b0021cca18df7a2e423846d59); four texture units in each are assumed, and
# in each of the 60 of the RX 7800 XT at 2.43 GHz. The RTX 4060's texels are assumed as well: 96 units at 2.46 GHz.
CARDS = {
    "RTX 4090, 1080p": (41.3e12, 645e9, 1008e9, 1920 * 1080),
    "H100 SXM, 1080p": (33.5e12, 466e9, 3350e9, 1920 * 1080),
    "RTX 4060, 1080p": (7.55e12, 118e9, 272e9, 1920 * 1080),
    "RX 7800 XT, 1080p": (18.7e12, 583e9, 624e9, 1920 * 1080),
    "RX 480, 1080p": (2.9e12, 91e9, 256e9, 1920 * 1080),
    "Steam Deck, 800p": (0.8e12, 51e9, 88e9, 1280 * 800),
}
BYTES = 76.4  # a pixel, of a host's frame
STEPS = ("measure", "split", "reach", "gather", "combine")


def counted(scene, radius, given):
    """`scene`: a name, or a number of bright pixels in a thousand."""
    words = ["--radius", str(radius), "--quality", given.quality]
    if scene.isdigit():
        words += ["--bright", scene]
    result = subprocess.run([COST, picture("night" if scene.isdigit() else scene, given.width), *words], stdout=subprocess.PIPE, text=True)
    if result.returncode:
        sys.exit(result.returncode)
    return json.loads(result.stdout)


def instructions():
    """Of each program, by Mesa's AMD compiler; empty where it is not installed."""
    driver = f"/usr/share/vulkan/icd.d/radeon_icd.{platform.machine()}.json"
    result = subprocess.run([COST.with_name("petzval_bench_registers")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                            env={**os.environ, "VK_ICD_FILENAMES": driver, "RADV_FORCE_FAMILY": "navi21",
                                 "MESA_SHADER_CACHE_DISABLE": "true"})
    programs = {} if result.returncode else json.loads(result.stdout)["programs"]
    return {name.removeprefix("realtime "): stats["Instructions"] for name, stats in programs.items() if name.startswith("realtime")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=lambda s: s.split(","), default=["night", "table", "fence", "hair", "lanterns"])
    parser.add_argument("--radii", type=lambda s: s.split(","), default=["12", "40"], help="largest radius, px")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--quality", default="standard")
    parser.add_argument("--bright", type=lambda s: s.split(","), default=[])
    given = parser.parse_args()
    rows, times, last = [], [], {}
    for scene in given.bright or given.scenes:
        for radius in given.radii:
            last = counted(scene, radius, given)
            all_of = {unit: sum(step[unit] for step in last.values()) for unit in ("operations", "samples", "reads")}
            rows.append([scene, radius, *(f"{last[step]['operations']:.0f}" for step in STEPS if step in last),
                         *(f"{all_of[unit]:.0f}" for unit in all_of)])
            times.append([max(all_of["operations"] / ops, all_of["samples"] / samples, BYTES / moved) * pixels * 1e3
                          for ops, samples, moved, pixels in CARDS.values()])
    print(table(["scene", "radius, px", *(s for s in STEPS if s in last), "operations/px", "samples/px", "buffer reads/px"], rows))
    print("\n" + table(["ms", *CARDS], [[name, *(f"{of(column):.2f}" for column in zip(*times))]
                                        for name, of in (("least", min), ("largest", max))]))
    made = instructions()
    print("\n" + table(["program", "operations in its text", "instructions, Navi 21"],
                       [[step, f"{last[step]['text']:.0f}", f"{made[step]:.0f}" if step in made else "–"] for step in last]))


if __name__ == "__main__":
    main()
