#!/usr/bin/env python3
"""Compares the memory that an engine asks for with the peak of the process.

Usage: bench/memory.py PETZVAL [--sizes WxH,…] [--scenes NAME,…] [--engines NAME,…] [--colour-layers]
Prints one Markdown row for each picture and engine: the least --max-memory that is accepted, the peak of the resident
memory in a run with that limit, and the peak without a limit. Kernels are cold. Wall times are not measured. The engine
realtime draws on the first GPU. With --colour-layers, each picture also has the layers key and fill, which sum to its
colour, and all are blurred, at 50 mm and f/2, focused at 4 m.
"""
import argparse
import multiprocessing
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests/cli"))
from pictures import read_exr, write_exr  # noqa: E402

LAYERED = ["--layers", "all", "--focal-length", "50mm", "--sensor-width", "36mm", "--fstop", "2", "--focus", "4m"]
NEEDED = re.compile(r"(?:least|about|takes) (\d+)M")


def run(program, *args):
    """Exit code, peak in MiB, and what was said."""
    with subprocess.Popen([program, *args], stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True) as process:
        said = process.stderr.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_maxrss / 1024, said


def least(program, command):
    """The least --max-memory in MiB: what refusals ask for until a run succeeds, and its peak."""
    asked = 1
    while True:
        code, peak, said = run(program, *command, "--max-memory", f"{asked}M")
        more = NEEDED.search(said)
        if code == 0:
            return asked, peak
        if not more or int(more.group(1)) <= asked:
            sys.exit(f"{' '.join(command)} --max-memory {asked}M: {said}")
        asked = int(more.group(1))


def add_layers(path):
    """Gives a picture the layers key and fill: three quarters and one quarter of its light."""
    channels, _ = read_exr(path)
    for layer, share in (("key", 0.75), ("fill", 0.25)):
        for colour in "RGB":
            channels[f"{layer}.{colour}"] = [[share * value for value in row] for row in channels[colour]]
    write_exr(path, channels)


def main():
    parser = argparse.ArgumentParser(prog="bench/memory.py")
    parser.add_argument("petzval", type=os.path.abspath)
    parser.add_argument("--sizes", default="960x540,1920x1080,3840x2160")
    parser.add_argument("--scenes", default="table,night,meadow")
    parser.add_argument("--engines", default="gaussian,gather,sprites,scatter")
    parser.add_argument("--colour-layers", action="store_true")
    words = parser.parse_args()
    print("| picture | engine | asked MiB | peak MiB | asked / peak | peak without limit MiB |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for size in words.sizes.split(","):
            for scene in words.scenes.split(","):
                width, height = size.split("x")
                picture = f"{folder}/{scene}_{size}.exr"
                if run(words.petzval, "scene", "make", scene, "--width", width, "--height", height,
                       "--pinhole-samples", "1", "-q", "-o", picture)[0]:
                    sys.exit(f"{scene} cannot be made")
                if words.colour_layers:
                    child = multiprocessing.Process(target=add_layers, args=(picture,))  # or its memory counts in peaks
                    child.start()
                    child.join()
                for engine in words.engines.split(","):
                    command = ["defocus", picture, "-o", f"{folder}/out.exr", "--overwrite", "--engine", engine,
                               "--kernel-cache", "off", "-q", *(LAYERED if words.colour_layers else []),
                               *(["--device", "gpu"] if engine == "realtime" else [])]
                    asked, peak = least(words.petzval, command)
                    free = run(words.petzval, *command)[1]
                    print(f"| {scene} {size} | {engine} | {asked} | {peak:.0f} | {asked / peak:.2f} | {free:.0f} |", flush=True)


if __name__ == "__main__":
    main()
