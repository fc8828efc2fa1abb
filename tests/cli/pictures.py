"""Pictures for the tests of the command line: EXR and PNG files written and read with the standard library alone.

EXR: single-part scanline files, uncompressed when written (OpenEXR file layout, openexr.com/en/latest), zip, zips
or none when read. A picture is a dict of channel name to rows; channels named in `half` are stored as half float.
"""
import struct
import zlib

MAGIC = struct.pack("<II", 20000630, 2)


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value


def header(names, half, width, height, display=None, data=None, compression=0, attributes=b"", aspect=1):
    data = data or (0, 0, width - 1, height - 1)
    display = display or (0, 0, width - 1, height - 1)
    channels = b"".join(
        name.encode() + b"\0" + struct.pack("<iBBBBii", 1 if name in half else 2, 0, 0, 0, 0, 1, 1)
        for name in sorted(names))
    return (MAGIC + attribute("channels", "chlist", channels + b"\0")
            + attribute("compression", "compression", bytes([compression]))
            + attribute("dataWindow", "box2i", struct.pack("<4i", *data))
            + attribute("displayWindow", "box2i", struct.pack("<4i", *display))
            + attribute("lineOrder", "lineOrder", b"\0")
            + attribute("pixelAspectRatio", "float", struct.pack("<f", aspect))
            + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
            + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
            + attributes + b"\0")


def exr_bytes(channels, half=(), display=None, origin=(0, 0), attributes=b"", aspect=1):
    names = sorted(channels)
    height, width = len(channels[names[0]]), len(channels[names[0]][0])
    data = (origin[0], origin[1], origin[0] + width - 1, origin[1] + height - 1)
    display = display or (0, 0, width - 1, height - 1)
    head = header(names, half, width, height, display, data, 0, attributes, aspect)
    lines = []
    for y in range(height):
        line = b"".join(struct.pack("<%d%s" % (width, "e" if n in half else "f"), *channels[n][y]) for n in names)
        lines.append(struct.pack("<iI", origin[1] + y, len(line)) + line)
    offsets, at = [], len(head) + 8 * height
    for line in lines:
        offsets.append(at)
        at += len(line)
    return head + struct.pack("<%dQ" % height, *offsets) + b"".join(lines)


def write_exr(path, channels, **options):
    with open(path, "wb") as file:
        file.write(exr_bytes(channels, **options))
    return path


def write_eyes(path, views):
    """A file of several parts, (view, channels, attributes) each: pictures of one size for several eyes."""
    heads, chunks = [], []
    for number, (view, channels, attributes) in enumerate(views):
        names = sorted(channels)
        height, width = len(channels[names[0]]), len(channels[names[0]][0])
        own = (attribute("name", "string", view.encode()) + attribute("type", "string", b"scanlineimage")
               + attribute("view", "string", view.encode()) + attribute("chunkCount", "int", struct.pack("<i", height)))
        heads.append(header(names, (), width, height, attributes=own + attributes)[len(MAGIC):])
        lines = [b"".join(struct.pack("<%df" % width, *channels[n][y]) for n in names) for y in range(height)]
        chunks.append([struct.pack("<iiI", number, y, len(line)) + line for y, line in enumerate(lines)])
    multi_part = 0x1000
    start = struct.pack("<II", 20000630, 2 | multi_part) + b"".join(heads) + b"\0"
    at, offsets = len(start) + 8 * sum(map(len, chunks)), []
    for chunk in (c for part in chunks for c in part):
        offsets.append(at)
        at += len(chunk)
    with open(path, "wb") as file:
        file.write(start + struct.pack("<%dQ" % len(offsets), *offsets) + b"".join(c for part in chunks for c in part))
    return path


def plane(width, height, value):
    """Rows of a constant, or of a function of (x, y)."""
    if callable(value):
        return [[value(x, y) for x in range(width)] for y in range(height)]
    return [[value] * width for _ in range(height)]


def picture(width=24, height=16, colour=0.5, depth=2.0, alpha=None):
    """A grey RGB picture with Z; colour and depth are numbers or functions of (x, y)."""
    grey = plane(width, height, colour)
    channels = {"R": grey, "G": grey, "B": grey}
    if depth is not None:
        channels["Z"] = plane(width, height, depth)
    if alpha is not None:
        channels["A"] = plane(width, height, alpha)
    return channels


def camera_attributes(focal_mm, sensor_mm, f_number, focus_m):
    def number(name, value):
        return attribute(name, "float", struct.pack("<f", value))
    return (number("aperture", f_number) + number("focus", focus_m) + number("pinholeFocalLength", focal_mm)
            + attribute("sensorOverallDimensions", "v2f", struct.pack("<2f", sensor_mm, sensor_mm)))


def unzip(packed, size):
    if len(packed) == size:  # stored as it is where packing would not help
        return packed
    raw = bytearray(zlib.decompress(packed))
    for i in range(1, len(raw)):
        raw[i] = (raw[i - 1] + raw[i] - 128) & 255
    out, middle = bytearray(len(raw)), (len(raw) + 1) // 2
    out[0::2], out[1::2] = raw[:middle], raw[middle:]
    return bytes(out)


def read_exr(path):
    """Returns (channels, attributes): rows by channel name, attribute bytes by name."""
    with open(path, "rb") as file:
        d = file.read()
    assert d[:8] == MAGIC, "not a single-part scanline EXR"
    at, attributes = 8, {}
    while d[at]:
        end = d.index(b"\0", at)
        name, at = d[at:end].decode(), d.index(b"\0", end + 1) + 1
        size = struct.unpack_from("<I", d, at)[0]
        attributes[name], at = d[at + 4:at + 4 + size], at + 4 + size
    channels, c, entry = attributes["channels"], [], 0
    while channels[entry]:
        end = channels.index(b"\0", entry)
        c.append((channels[entry:end].decode(), "e" if channels[end + 1] == 1 else "f"))
        entry = end + 17
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height, block = x1 - x0 + 1, y1 - y0 + 1, {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    rows = {name: [None] * height for name, _ in c}
    line_size = sum(width * struct.calcsize(kind) for _, kind in c)
    for offset in struct.unpack_from("<%dQ" % -(-height // block), d, at + 1):
        y, size = struct.unpack_from("<iI", d, offset)
        lines = min(block, y1 + 1 - y)
        raw, p = unzip(d[offset + 8:offset + 8 + size], lines * line_size), 0
        for line in range(y - y0, y - y0 + lines):
            for name, kind in c:
                rows[name][line] = list(struct.unpack_from("<%d%s" % (width, kind), raw, p))
                p += width * struct.calcsize(kind)
    return rows, attributes


def png_chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write_png(path, rows, channels=3, bits=8):
    """Rows of interleaved codes."""
    width = len(rows[0]) // channels
    kind = {1: 0, 3: 2, 4: 6}[channels]
    raw = b"".join(b"\0" + struct.pack(">%d%s" % (len(row), "B" if bits == 8 else "H"), *row) for row in rows)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), bits, kind, 0, 0, 0))
                   + png_chunk(b"IDAT", zlib.compress(raw)) + png_chunk(b"IEND", b""))
    return path


def unfilter(kind, row, above, step):
    for i in range(len(row)):
        a = row[i - step] if i >= step else 0
        b, c = above[i], above[i - step] if i >= step else 0
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
    return row


def read_png(path):
    """Returns (rows of interleaved codes, channels, bits)."""
    with open(path, "rb") as file:
        d = file.read()
    assert d[:8] == b"\x89PNG\r\n\x1a\n"
    width, height, bits, kind = struct.unpack_from(">IIBB", d, 16)
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[kind]
    packed, at = b"", 8
    while at < len(d):
        size = struct.unpack_from(">I", d, at)[0]
        if d[at + 4:at + 8] == b"IDAT":
            packed += d[at + 8:at + 8 + size]
        at += 12 + size
    raw, step = zlib.decompress(packed), channels * bits // 8
    stride, above, rows = width * step, bytearray(width * step), []
    for y in range(height):
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        above = unfilter(raw[y * (stride + 1)], line, above, step)
        rows.append(list(struct.unpack(">%d%s" % (width * channels, "B" if bits == 8 else "H"), bytes(above))))
    return rows, channels, bits
