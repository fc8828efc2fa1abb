#!/usr/bin/env python3
"""How far the live picture of every scene is from what `defocus` makes of the frame that it recorded.

Under Xvfb each scene is opened in the window with its own look, its sharp frame recorded, and kept as it is shown: at
rest, as it is drawn while the camera moves, and by the pass for real time. Each is held against the command that the
window copies, done to the recorded frame; the pass for real time against engine scatter. Prints a table of PSNR in dB,
of linear light and of what a display shows.

Usage: tools/view_agreement.py PROGRAM [SCENE…]
"""
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

SIZE = "480x270"
ONCE_MORE = "set engine scatter\nset gather.stage final\n"
# What is called so, the device, what is set first, and what of the frame by defocus it is held against.
KEPT = [("at rest", "cpu", "", "own"), ("moving", "cpu", "set quality draft\n", "own"),
        ("pass for real time", "gpu", ONCE_MORE + "set engine realtime\n", "scatter")]


def window(program, folder, environment, scene, device, script):
    """The lines that a script says; raises where the window fails."""
    (folder / "script.txt").write_text("wait 300\n" + script)
    return subprocess.run([program, "view", "--scene", scene, "--scene-size", SIZE, "--device", device, "--script",
                           "script.txt"], cwd=folder, env=environment, capture_output=True, text=True, check=True).stdout


def decibels(program, folder, one, other):
    subprocess.run([program, "compare", one, other, "--json", "apart.json"], cwd=folder, check=True, capture_output=True)
    found = json.loads((folder / "apart.json").read_text())
    return [float(found[name]) if found[name] is not None else float("inf") for name in ("psnr_lin", "psnr_srgb")]


def row(program, folder, environment, scene):
    said = window(program, folder, environment, scene, "cpu", "range 0 0\nrecord sharp.exr\nwait 300\nexpect no error\n"
                  "say engine\ncopy\nsay copied\n" + ONCE_MORE + "copy\nsay copied\n").strip().splitlines()
    for name, command in zip(("own", "scatter"), said[1:]):
        defocus = shlex.split(command.split(" && ")[1])
        defocus[2], defocus[defocus.index("out.exr")] = "sharp.exr", name + ".exr"
        subprocess.run([program, *defocus[1:], "--quiet"], cwd=folder, check=True, capture_output=True)
    cells = []
    for kept, device, look, against in KEPT:
        if kept == "moving" and said[0] == "scatter":  # which takes its time: sprites stand in for it
            look += "set engine sprites\n"
        window(program, folder, environment, scene, device, look + "save live.exr\nwait 300\nexpect no error\n")
        cells.append("%.1f (%.1f)" % tuple(decibels(program, folder, "live.exr", against + ".exr")))
    return cells


def main(program, *scenes):
    program = str(pathlib.Path(program).resolve())
    listed = subprocess.run([program, "scene", "list"], capture_output=True, text=True, check=True).stdout
    scenes = scenes or [line.split()[0] for line in listed.splitlines() if line[:1].strip() and "points" not in line[:7]]
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1300x900x24"], pass_fds=[write])
    os.close(write)
    with os.fdopen(read) as says, tempfile.TemporaryDirectory() as name:
        environment = {**os.environ, "DISPLAY": ":" + says.readline().strip()}
        print("| scene | " + " | ".join(kept for kept, *_ in KEPT) + " |\n|---|" + "---|" * len(KEPT))
        for scene in scenes:
            print("| `%s` | " % scene + " | ".join(row(program, pathlib.Path(name), environment, scene)) + " |", flush=True)
    server.terminate()
    server.wait()


if __name__ == "__main__":
    main(*sys.argv[1:] or sys.exit(__doc__))
