"""The Defocus node of Blender's compositor on one frame of the data set:

    blender.py PYTHON_WITH_BPY SHARP.exr OUT.exr FOCAL_MM SENSOR_MM FSTOP FOCUS_M LARGEST_PX

Blender reads R, G, B, A of an EXR whose depth is a channel Z, but not Z: the depth goes to it as a picture of its own.
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
z = np.minimum(channels(sharp, "Z")[..., 0], 1e6)
with tempfile.TemporaryDirectory() as folder:
    depth = pathlib.Path(folder) / "depth.exr"
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {name: np.ascontiguousarray(z) for name in "RGB"}) as file:
        file.write(str(depth))
    inner = pathlib.Path(__file__).with_name("in_blender.py")
    sys.exit(subprocess.run([bpy_python, inner, sharp, depth, out, *camera]).returncode)
