"""The Defocus node of Blender's compositor on one frame of the data set:

    blender.py PYTHON_WITH_BPY SHARP.exr OUT.exr FOCAL_MM SENSOR_MM FSTOP FOCUS_M LARGEST_PX

Blender takes an EXR with more channels than R, G, B, A for layers, or leaves these channels out: picture and depth go to it as files
of their own.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenEXR

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from score import channels

bpy_python, sharp, out, *camera = sys.argv[1:]
z = np.minimum(channels(sharp, "Z"), 1e6)


def written(path, picture, names):
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {n: np.ascontiguousarray(picture[..., k]) for k, n in enumerate(names)}) as file:
        file.write(str(path))
    return path


with tempfile.TemporaryDirectory() as folder:
    picture = written(pathlib.Path(folder) / "picture.exr", channels(sharp, "RGBA"), "RGBA")
    depth = written(pathlib.Path(folder) / "depth.exr", np.repeat(z, 3, axis=2), "RGB")
    inner = pathlib.Path(__file__).with_name("in_blender.py")
    sys.exit(subprocess.run([bpy_python, inner, picture, depth, out, *camera]).returncode)
