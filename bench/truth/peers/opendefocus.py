"""OpenDefocus on one frame of the data set: opendefocus.py PROGRAM SHARP.exr RADIUS.exr OUT.exr LARGEST_PX [-1]

PROGRAM is what `cargo build --release` makes of the folder opendefocus. -1 swaps the sign of the radius.
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenEXR

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from score import channels

program, sharp, radius, out, largest = sys.argv[1:6]
sign = -1 if sys.argv[6:] == ["-1"] else 1
picture = np.dstack([channels(sharp, "RGBA"), sign * channels(radius, ["coc_radius_px"])]).astype("<f4")
height, width = picture.shape[:2]
with tempfile.TemporaryDirectory() as folder:
    given, made = pathlib.Path(folder) / "in.raw", pathlib.Path(folder) / "out.raw"
    given.write_bytes(picture.tobytes())
    subprocess.run([program, given, made, str(width), str(height), largest], check=True)
    result = np.frombuffer(made.read_bytes(), "<f4").reshape(height, width, 4)
header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
planes = {name: np.ascontiguousarray(result[..., k]) for k, name in enumerate("RGBA")}
with OpenEXR.File(header, planes) as file:
    file.write(out)
