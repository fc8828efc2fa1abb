"""Packs a built-in scene for the lens lab: colour, depth and one hidden layer, as the program renders them.

Usage: scene_textures.py PETZVAL SCENE WIDTH HEIGHT FILE. The file is gzip of: the length of a JSON header (4 bytes,
little-endian), the header, then planes of bytes, row by row. Of the picture and of each hidden sample: red, green, blue and
their shared exponent (a channel is byte * 2^(exponent - 136)), and the two bytes, low first, of a depth code: metres are
2^(code / 4096 - 4), 65535 is infinity. Before the planes of hidden samples one bit a pixel says whether it has one.
"""
import gzip
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/cli"))
from pictures import MAGIC, read_exr, unzip  # noqa: E402

APART = 1.03  # a sample this many times as far as what is seen is hidden


def deep_rows(path):
    """Of a deep EXR (zips; channels A B G R half, Z float): per row the number of samples of each pixel, and the samples."""
    d = path.read_bytes()
    at = len(MAGIC)
    while d[at]:
        end = d.index(b"\0", d.index(b"\0", at) + 1) + 1
        name, size = d[at:d.index(b"\0", at)].decode(), struct.unpack_from("<I", d, end)[0]
        if name == "dataWindow":
            x0, y0, x1, y1 = struct.unpack_from("<4i", d, end + 4)
        at = end + 4 + size
    for offset in struct.unpack_from(f"<{y1 - y0 + 1}Q", d, at + 1):
        _, table, packed, unpacked = struct.unpack_from("<iQQQ", d, offset)
        offset += 28
        ends = numpy.frombuffer(unzip(d[offset:offset + table], 4 * (x1 - x0 + 1)), "<i4")
        data = unzip(d[offset + table:offset + table + packed], unpacked)
        count = int(ends[-1])
        halves = numpy.frombuffer(data, "<f2", 4 * count).reshape(4, count)
        yield numpy.diff(ends, prepend=0), halves[::-1].astype("f4").T, numpy.frombuffer(data, "<f4", count, 8 * count)


def hidden_samples(path, depth):
    """Of each pixel the nearest sample behind what is seen: a mask, colours of opaque surfaces, depths."""
    mask, colours, depths = numpy.zeros(depth.shape, bool), [], []
    for y, (counts, rgba, z) in enumerate(deep_rows(path)):
        first = 0
        for x, count in enumerate(counts):
            for i in range(first, first + count):
                if z[i] > APART * depth[y, x] and rgba[i, 3] > 0.5:
                    mask[y, x] = True
                    colours.append(rgba[i, :3] / rgba[i, 3])
                    depths.append(z[i])
                    break
            first += count
    return mask, numpy.array(colours, "f4").reshape(-1, 3), numpy.array(depths, "f4")


def planes(colours, depths):
    largest = numpy.maximum(colours.max(axis=1), 2.0 ** -120)
    exponent = numpy.ceil(numpy.log2(largest * (256 / 255.49)))
    mantissa = numpy.clip(numpy.rint(colours * (256 / 2.0 ** exponent)[:, None]), 0, 255).astype("u1")
    code = numpy.rint(4096 * (numpy.log2(numpy.clip(depths, 1 / 16, 2.0 ** 11)) + 4))
    code = numpy.where(depths >= 2.0 ** 11, 65535, code).astype("<u2")
    return b"".join(mantissa[:, c].tobytes() for c in range(3)) + (exponent + 128).astype("u1").tobytes() + \
        (code & 255).astype("u1").tobytes() + (code >> 8).astype("u1").tobytes()


def pack(petzval, scene, width, height, path):
    with tempfile.TemporaryDirectory() as folder:
        sharp, layers = pathlib.Path(folder, "sharp.exr"), pathlib.Path(folder, "layers.exr")
        report = subprocess.run([petzval, "scene", "make", scene, "-o", sharp, "--layers", layers, "--width", str(width), "--height", str(height),
                                 "--quiet", "--json", "-"], check=True, capture_output=True, text=True).stdout
        channels, attributes = read_exr(sharp)
        depth = numpy.array(channels["Z"], "f4")
        colours = numpy.stack([numpy.array(channels[c], "f4") for c in "RGB"], axis=-1).reshape(-1, 3)
        mask, hidden_colours, hidden_depths = hidden_samples(layers, depth)

    def number(name):
        return struct.unpack("<f", attributes[name][:4])[0]

    header = json.dumps({
        "scene": scene, "width": width, "height": height, "hidden": int(mask.sum()),
        "camera": {"focal_mm": number("pinholeFocalLength"), "sensor_mm": number("sensorOverallDimensions"), "f_number": number("aperture"), "focus_m": number("focus")},
    }).encode()
    body = struct.pack("<I", len(header)) + header + planes(colours, depth.reshape(-1)) + \
        numpy.packbits(mask.reshape(-1), bitorder="little").tobytes() + planes(hidden_colours, hidden_depths)
    path.write_bytes(gzip.compress(body, 9, mtime=0))
    assert math.isfinite(depth.min()) and report


if __name__ == "__main__":
    petzval, scene, width, height, path = sys.argv[1:]
    pack(petzval, scene, int(width), int(height), pathlib.Path(path))
