#!/usr/bin/env python3
"""Makes the pictures of docs/guide/the-window.md: scripts under Xvfb write what is on the screen. They are made to be looked at.

Usage: tools/view_pictures.py PROGRAM [NAME…]: all, or those named. view-drag needs ffmpeg.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

PICTURES = pathlib.Path(__file__).resolve().parent.parent / "docs/pictures"
WINDOW = ["--window", "880x560", "--ui-scale", "0.85"]
# Name, what is opened, what is done; {shot} is the picture that is kept.
SHOWN = [
    ("view-focus", ["table.exr"], """
        set fstop 0.8
        click 320 200
        wipe sharp
        set view.wipe 0.72
        key o
        wait
        shot {shot}"""),
    ("view-lens", ["table.exr"], """
        set lens.name double-gauss
        set fstop 2.1
        focus 320 200
        pick 160 305
        key l
        wait
        click disc
        wait
        shot {shot}"""),
    ("view-shot", ["shot.####.exr", "--engine", "gather"], """
        set shot.keying on
        click 75 80
        frame 6
        wait
        click 180 50
        frame 11
        wait
        click 120 100
        set shot.easing on
        frame 3
        wait
        shot {shot}"""),
    ("view-panels", ["table.exr", "--against", "table.exr"], """
        click 320 200
        click "panel Look"
        click "panel Compare"
        click "panel Camera"
        click "panel Depth"
        wait
        click "panel Pixel"
        wait
        click "panel Files"
        wait
        click "panel Lenses"
        wait
        click "lens triplet"
        set fstop 1.4
        wait
        shot {shot}"""),
    ("view-sheet", ["night.exr"], """
        click "panel Camera"
        click "panel Depth"
        click "panel Look"
        click "panel Compare"
        click "panel Lenses"
        sheet doublet,planar,petzval-portrait,Helios,sonnar-fe-55,speed-panchro,takumar,triplet,uncorrected
        wait
        shot {shot}"""),
    ("view-hexadrive", ["--scene", "hexadrive"], """
        frame 6
        wait
        shot {shot}"""),
    ("view-scene", ["--scene", "cubes", "--engine", "gather"], """
        wait
        orbit 12 8
        click "panel Look"
        click "panel Compare"
        click "panel Frame"
        wait
        shot {shot}"""),
]


def make(program, name, opened, script, folder, environment):
    path = folder / "script.txt"
    path.write_text("wait\n" + script.format(shot=PICTURES / (name + ".png")) + "\n")
    subprocess.run([program, "view", *opened, *WINDOW, "--script", path], cwd=folder, env=environment, check=True)


DRAGGED = 14  # pictures of the drag, half to the left, half back


def drag(program, folder, environment):
    """What the window shows during a drag of HexaDrive's scene, before any frame is complete."""
    moves = [f"drag 240 135 {232 if i < DRAGGED // 2 else 248} 135\nsleep 0.4\nshot drag-{i:02}.png" for i in range(DRAGGED)]
    path = folder / "script.txt"
    path.write_text("wait\nkey tab\nkey 0\nwait\n" + "\n".join(moves) + "\n")
    subprocess.run([program, "view", "--scene", "hexadrive", "--window", "500x460", "--script", path], cwd=folder,
                   env=environment, check=True)
    colours = "crop=480:240:10:0,split[a][b];[a]palettegen=max_colors=64[p];[b][p]paletteuse=dither=none"
    subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", "4", "-i", "drag-%02d.png", "-filter_complex", colours,
                    PICTURES / "view-drag.gif"], cwd=folder, check=True)


def main(program, *names):
    program = str(pathlib.Path(program).resolve())
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1000x700x24"], pass_fds=[write])
    os.close(write)
    with os.fdopen(read) as says, tempfile.TemporaryDirectory() as name:
        environment = {**os.environ, "DISPLAY": ":" + says.readline().strip()}
        folder = pathlib.Path(name)
        size = ["--pinhole-samples", "16", "-q"]
        subprocess.run([program, "scene", "make", "table", "-o", "table.exr", "--width", "640", "--height", "360", *size],
                       cwd=folder, check=True)
        subprocess.run([program, "scene", "make", "night", "-o", "night.exr", "--width", "640", "--height", "360", *size],
                       cwd=folder, check=True)
        for frame in range(12):
            subprocess.run([program, "scene", "make", "tori", "-o", f"shot.{frame:04}.exr", "--frame", str(3 * frame),
                            "--width", "240", "--height", "135", *size], cwd=folder, check=True)
        for shown in SHOWN:
            if not names or shown[0] in names:
                make(program, *shown, folder, environment)
        if not names or "view-drag" in names:
            drag(program, folder, environment)
    server.terminate()
    server.wait()


if __name__ == "__main__":
    main(*sys.argv[1:] or sys.exit(__doc__))
