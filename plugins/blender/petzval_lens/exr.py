# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads passes as Blender wrote them: one part, scan lines, no compression. Other files are refused."""
import struct

import numpy

from .refused import Refused

MAGIC = 20000630
TILED, DEEP, PARTS = 0x200, 0x800, 0x1000  # flags in the version word
TYPES = {1: "<f2", 2: "<f4"}


def read(path):
    """{channel: (height, width) array, rows top-down}; the arrays are views of the mapped file. Raises Refused."""
    try:
        return _read(path)
    except (struct.error, ValueError, KeyError):  # a header or rows that end too early
        raise Refused(f"{path} is incomplete; is the disk full?") from None


def _read(path):
    with open(path, "rb") as file:
        magic, version = struct.unpack("<II", file.read(8))
        if magic != MAGIC or version & (TILED | DEEP | PARTS):
            raise Refused(f"{path} is not a file of passes: one part of scan lines is needed")
        attributes = dict(_attributes(file))
        start = file.tell()
    if attributes["compression"] != b"\0":
        raise Refused(f"{path} is compressed; the add-on reads only files that it had written")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    row = numpy.dtype([("y", "<i4"), ("bytes", "<i4")] +
                      [(name, TYPES[kind], (width,)) for name, kind in _channels(attributes["channels"])])
    rows = numpy.memmap(path, dtype=row, mode="r", offset=start + 8 * height, shape=(height,))
    if height > 1 and rows["y"][0] > rows["y"][1]:
        rows = rows[::-1]
    if not (numpy.diff(rows["y"]) == 1).all():
        raise Refused(f"{path} is incomplete: rows are missing")
    return {name: rows[name] for name in row.names[2:]}


def _text(file):
    letters = bytearray()
    while (letter := file.read(1)) not in (b"\0", b""):
        letters += letter
    return letters.decode("utf-8", "replace")


def _attributes(file):
    while name := _text(file):
        _text(file)  # its type
        size, = struct.unpack("<I", file.read(4))
        yield name, file.read(size)


def _channels(data):
    """(name, type) of each channel, in the order of the rows."""
    while data[:1] not in (b"\0", b""):
        name, data = data.split(b"\0", 1)
        kind, _, across, down = struct.unpack("<IIII", data[:16])
        if kind not in TYPES or (across, down) != (1, 1):
            raise Refused(f"channel {name.decode()} holds whole numbers or is smaller than the picture")
        yield name.decode("utf-8", "replace"), kind
        data = data[16:]
