"""The sample set: the night scene through many lenses, with discs in front of focus and behind, large and small, and coma.

Usage: sample_set.py PROGRAM FOLDER [--docs]. Leaves one PNG per lens (its pictures side by side), the whole scene through
six lenses (night-NAME.png), and index.html in FOLDER; with --docs, small pictures with few codes and no page, for
docs/pictures/samples. `./dev samples` runs it.
"""
import html
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

FOCAL_LENGTH = "240mm"
# Name, where the lens is focused, and more flags. Lamps stand 15 to 240 m away.
SHOTS = [("large, behind focus", "6m", []), ("small, behind", "20m", []), ("large, in front", "240m", []),
         ("small, in front", "45m", []), ("coma", "20m", ["--coma", "3"])]
NIGHTS = ["ideal", "uncorrected", "doublet", "petzval-portrait", "double-gauss", "schneider-anamorphic"]
TRACED = ["petzval-laikin", "petzval-portrait", "triplet-cooke", "double-gauss", "takumar", "angenieux",
          "schneider-anamorphic"]


def run(program, *words):
    subprocess.run([program, *map(str, words), "-q"], check=True)


def chunks(data):
    at = 8
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        yield data[at + 4:at + 8], data[at + 8:at + 8 + size]
        at += size + 12


def read_png(path):
    """Width, height and rows of bytes, as 8-bit RGB: of such a file, or of 16-bit grey, as mattes are."""
    data = path.read_bytes()
    parts = list(chunks(data))
    width, height, bits, kind = struct.unpack(">IIBB", parts[0][1][:10])
    assert (bits, kind) in ((8, 2), (16, 0)), path
    step = 3 if kind == 2 else 2  # bytes per pixel
    raw = zlib.decompress(b"".join(body for name, body in parts if name == b"IDAT"))
    stride, rows, before = step * width, [], bytearray(step * width)
    for y in range(height):
        method, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        unfilter(method, row, before, step)
        rows.append(row if kind == 2 else bytes(code for code in row[::2] for _ in range(3)))
        before = row
    return width, height, rows


def unfilter(method, row, above, step):
    """PNG specification, 9.2: each byte was stored less a guess from its left and upper neighbours."""
    for i in range(len(row)):
        a, b = row[i - step] if i >= step else 0, above[i]
        c = above[i - step] if i >= step else 0
        if method == 4:
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            guess = a if pa <= pb and pa <= pc else b if pb <= pc else c
        else:
            guess = (0, a, b, (a + b) // 2)[method]
        row[i] = (row[i] + guess) & 255


def chunk(name, body):
    return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))


def write_png(path, rows):
    width = len(rows[0]) // 3
    # Each byte less the one above it (filter 2), which suits smooth pictures.
    packed, before = [], bytes(len(rows[0]))
    for row in rows:
        packed.append(b"\2" + bytes((x - y) & 255 for x, y in zip(row, before)))
        before = row
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(b"".join(packed), 9)) + chunk(b"IEND", b""))


def side_by_side(pictures, step):
    """Rows of several pictures with a black line between; codes rounded to multiples of `step`."""
    rounded = bytes(min(255, (x + step // 2) // step * step) for x in range(256))
    height = pictures[0][1]
    return [b"\0\0\0\0\0\0".join(bytes(rows[y]).translate(rounded) for _, _, rows in pictures) for y in range(height)]


def lenses(program):
    """(name, f-number, whether it takes --coma) of those that are shown."""
    listed = json.loads(subprocess.run([program, "lens", "list", "--json", "-"], check=True, stdout=subprocess.PIPE,
                                       text=True).stdout)["lenses"]
    for lens in listed:
        if lens["model"] != "prescription" or lens["name"] in TRACED:
            yield lens["name"], lens["f_number"] or 2, lens["model"] != "prescription"


def photograph(program, scene, lens, f_number, *flags):
    taken, shown = scene.parent / "taken.exr", scene.parent / "shown.png"
    run(program, "defocus", scene, "-o", taken, "--lens", lens, "--fstop", f"{f_number * 1.0001:.5f}", *flags,
        "--overwrite", "--progress", "off")
    run(program, "develop", taken, "-o", shown, "--no-dither", "--overwrite")
    return read_png(shown)


def make_night(program, scene, width, *flags):
    run(program, "scene", "make", "night", "-o", scene, "--width", width, "--height", width * 9 // 16, *flags, "--progress",
        "off")
    return scene


def page(names):
    heads = "".join(f"<th>{name}</th>" for name, _, _ in SHOTS)
    rows = "".join(f'<h2>{html.escape(name)}</h2><img src="{name}.png" alt="{name}"/>\n' for name in names)
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"/><title>Sample set</title><style>body { background: '
            '#111; color: #ddd; font: 15px/1.4 sans-serif; margin: 2em; } img { max-width: 100%; } h2 { font-weight: 500; } '
            f'th {{ width: 20%; }} table {{ width: 100%; }}</style></head><body><h1>The night through {len(names)} lenses'
            f'</h1><table><tr>{heads}</tr></table>\n{rows}</body></html>\n')


def main(program, folder, *words):
    small = words == ("--docs",)
    width, whole_width, step = (256, 400, 5) if small else (480, 960, 1)
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    names = []
    with tempfile.TemporaryDirectory() as name:
        whole = make_night(program, pathlib.Path(name) / "whole.exr", whole_width)
        scene = make_night(program, pathlib.Path(name) / "night.exr", width, "--focal-length", FOCAL_LENGTH)
        for lens, f_number, takes_coma in lenses(program):
            pictures = [photograph(program, scene, lens, f_number, "--focus", focus, *more)
                        for _, focus, more in SHOTS if takes_coma or not more]
            write_png(folder / f"{lens}.png", side_by_side(pictures, step))
            if lens in NIGHTS:
                write_png(folder / f"night-{lens}.png",
                          side_by_side([photograph(program, whole, lens, f_number)], step))
            names.append(lens)
            print(lens, file=sys.stderr, flush=True)
    if not small:
        (folder / "index.html").write_text(page(names))
    print(folder if small else folder / "index.html")


if __name__ == "__main__":
    main(*sys.argv[1:])
