#!/usr/bin/env python3
"""Scores a program on this data set: pictures with depth in, pictures through a lens out.

    score.py add [--keep DIR] NAME COMMAND…    run a command for every frame, score what it writes, add its column
    score.py table                             all columns as one table, in Markdown

Words of COMMAND in braces are replaced: {sharp} the EXR with R, G, B, A and planar depth Z in metres, {radius} an EXR with the
signed radius of the blur in pixels (channel coc_radius_px, + behind focus), {blur} a grey EXR of its share of the largest radius,
{out} the EXR to write, {focal_mm} {sensor_mm} {fstop} {focus_m} the camera, {largest_px} the largest radius, {width} {height}.
The command runs once for each frame, without a shell.

Needs Python 3.9 with numpy and OpenEXR (pip install numpy OpenEXR). Measures are defined in README.md.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import OpenEXR

HERE = pathlib.Path(__file__).resolve().parent


def channels(path, names):
    """Channels of an EXR as one float array, height x width x names; 'RGB' may also be stored as one array."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        stored = file.channels()
        missing = [name for name in names if name not in stored]
        if missing:
            sys.exit(f"{path}: channels {', '.join(missing)} are missing; it has {', '.join(stored)}")
        return np.stack([np.asarray(stored[name].pixels, np.float32) for name in names], axis=-1)


def reach_of_silhouettes(depth, radius):
    """Pixels within the blur's radius of a step of depth of more than a tenth: where hidden surfaces show."""
    with np.errstate(divide="ignore", invalid="ignore"):
        reached = np.zeros(depth.shape, bool)
        largest = np.zeros(depth.shape, np.float32)  # px, at silhouettes
        for axis in (0, 1):
            a, b = np.moveaxis(depth, axis, 0)[:-1], np.moveaxis(depth, axis, 0)[1:]
            ra, rb = np.moveaxis(radius, axis, 0)[:-1], np.moveaxis(radius, axis, 0)[1:]
            step = np.minimum(a, b) * 1.1 < np.maximum(a, b)
            both = np.where(step, np.maximum(np.abs(ra), np.abs(rb)) + 1, 0)
            view = np.moveaxis(largest, axis, 0)
            view[:-1] = np.maximum(view[:-1], both)
    for whole in np.unique(np.floor(largest[largest > 0])):
        points = np.floor(largest) == whole
        n = int(whole)
        y, x = np.mgrid[-n:n + 1, -n:n + 1]
        disc = (y * y + x * x <= whole * whole).astype(np.float32)
        size = [p + 2 * n for p in depth.shape]
        near = np.fft.irfft2(np.fft.rfft2(points, size) * np.fft.rfft2(disc, size), size)
        reached |= near[n:n + depth.shape[0], n:n + depth.shape[1]] > 0.5
    return reached


def decibels(error):
    return -10 * math.log10(max(float(np.mean(error)), 1e-10)) if error.size else float("nan")


def shown(picture, exposure):
    return np.clip(np.nan_to_num(picture) * exposure, 0, 1)


def scored(frame, out):
    """dB of the whole frame and within reach of silhouettes."""
    truth, exposure = channels(HERE / frame["truth"], "RGB"), frame["exposure"]
    result = channels(out, "RGB")
    if result.shape != truth.shape:
        sys.exit(f"{out} is {result.shape[1]} x {result.shape[0]}; the truth is {truth.shape[1]} x {truth.shape[0]}")
    error = (shown(result, exposure) - shown(truth, exposure)) ** 2
    depth, radius = channels(HERE / frame["sharp"], "Z")[..., 0], channels(HERE / frame["radius"], ["coc_radius_px"])[..., 0]
    reached = reach_of_silhouettes(depth, radius)
    return {"db": round(decibels(error), 3), "edges_db": round(decibels(error[reached]), 3)}


def words_of(frame, out):
    camera = frame["camera"]
    return {**{file: HERE / frame[file] for file in ("sharp", "radius", "blur")}, "out": out,
            "focal_mm": camera["focal_length_mm"], "sensor_mm": camera["sensor_width_mm"], "fstop": camera["f_number"], "focus_m": camera["focus_distance_m"],
            "largest_px": frame["largest_radius_px"], "width": frame["width"], "height": frame["height"]}


def add(given):
    column, keep = {}, given.keep or pathlib.Path(tempfile.mkdtemp())
    keep.mkdir(parents=True, exist_ok=True)
    for frame in json.loads((HERE / "frames.json").read_text()):
        out = (keep / f"{frame['name']}.exr").resolve()
        before, start = os.times(), time.monotonic()
        command = [word.format(**words_of(frame, out)) for word in given.command]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        after, wall_s = os.times(), time.monotonic() - start
        cpu_s = after.children_user + after.children_system - before.children_user - before.children_system
        if done.returncode or not out.exists():
            column[frame["name"]] = {"failed": (done.stdout.strip().splitlines() or ["no output"])[-1][-200:]}
        else:
            column[frame["name"]] = {**scored(frame, out), "wall_s": round(wall_s, 2), "cpu_s": round(cpu_s, 2)}
        print(frame["name"], column[frame["name"]], file=sys.stderr, flush=True)
    told = {"command": " ".join(given.command), "date": time.strftime("%Y-%m-%d"), "frames": column}
    (HERE / "columns").mkdir(exist_ok=True)
    (HERE / "columns" / f"{given.name}.json").write_text(json.dumps(told, indent=1) + "\n")


def table(_):
    columns = {p.stem: json.loads(p.read_text())["frames"] for p in sorted((HERE / "columns").glob("*.json"))}
    frames = json.loads((HERE / "frames.json").read_text())
    print("dB of the frame / within reach of silhouettes\n")
    print("| frame | " + " | ".join(columns) + " |\n|---|" + "---|" * len(columns))

    def cell(column, name):
        found = column.get(name, {})
        return f"{found['db']:.1f} / {found['edges_db']:.1f}" if "db" in found else "failed" if found else ""
    for frame in frames:
        print(f"| {frame['name']} | " + " | ".join(cell(c, frame["name"]) for c in columns.values()) + " |")
    # Means are comparable only over the frames that every program drew.
    common = [f["name"] for f in frames if all("db" in c.get(f["name"], {}) for c in columns.values())]

    def mean(column, key):
        return np.mean([column[name][key] for name in common]) if common else float("nan")
    for label, keys, form in (("**mean**", ("db", "edges_db"), "{:.2f} / {:.2f}"), ("CPU s, mean", ("cpu_s",), "{:.2f}")):
        print(f"| {label} | " + " | ".join(form.format(*(mean(c, k) for k in keys)) for c in columns.values()) + " |")
    print(f"\nMeans over the {len(common)} frames that every program drew.")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    adding = verbs.add_parser("add")
    adding.add_argument("name")
    adding.add_argument("--keep", type=pathlib.Path, help="keep what the command writes in this folder")
    adding.add_argument("command", nargs=argparse.REMAINDER)
    adding.set_defaults(run=add)
    verbs.add_parser("table").set_defaults(run=table)
    given = parser.parse_args()
    given.run(given)


if __name__ == "__main__":
    main()
