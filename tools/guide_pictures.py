"""Makes pictures of docs/guide: deep, render passes, troubleshooting, OpenFX.

Usage: guide_pictures.py PROGRAM. Writes docs/pictures/guide-NAME.png. That of OpenFX needs `ninja petzval_ofx ofx_check`.
"""
import pathlib
import subprocess
import sys
import tempfile

from sample_set import read_png, run, side_by_side, write_png

PICTURES = pathlib.Path(__file__).resolve().parent.parent / "docs/pictures"
CODES = 6  # rounded to multiples of it, so that files are small
NIGHT = ["--focal-length", "105mm", "--sensor-width", "36mm", "--fstop", "1.4", "--focus", "4.8m"]


class Studio:
    """Scenes and pictures in a folder; `program` makes them."""

    def __init__(self, program, folder):
        self.program, self.folder, self.made = program, pathlib.Path(folder), 0

    def path(self, ending):
        self.made += 1
        return self.folder / f"{self.made}.{ending}"

    def scene(self, name, *flags, width=320):
        path = self.path("exr")
        run(self.program, "scene", "make", name, "-o", path, "--width", width, *flags)
        return path

    def shown(self, path, *flags):
        picture = self.path("png")
        run(self.program, "develop", path, "-o", picture, "--no-dither", *flags)
        return picture

    def blurred(self, path, *flags):
        """Without the noise of dither, so that files are small; a display picture keeps its tone."""
        light = self.path("exr")
        run(self.program, "defocus", path, "-o", light, *flags)
        return read_png(self.shown(light, *(["--tone", "none"] if path.suffix == ".png" else [])))

    def focus_map(self, path, *flags):
        picture = self.path("png")
        run(self.program, "defocus", path, "-o", picture, "--view", "focus", *flags)
        return read_png(picture)


def cut(picture, x, y, width, height):
    return width, height, [row[3 * x:3 * (x + width)] for row in picture[2][y:y + height]]


def write(name, *lines):
    """Lines of pictures, one below the other with a black line between."""
    rows = side_by_side(lines[0], CODES)
    for line in lines[1:]:
        rows += [bytes(len(rows[0]))] * 2 + side_by_side(line, CODES)
    write_png(PICTURES / f"guide-{name}.png", rows)


def deep(studio):
    cubes, tori = studio.scene("cubes"), studio.scene("tori")
    write("deep", [read_png(studio.shown(cubes)), read_png(studio.shown(tori))],
          [studio.blurred(cubes, "--merge", tori), studio.blurred(cubes, "--holdout", tori)])


def render_passes(studio):
    pictures = [studio.blurred(studio.scene("night", "--depth-blur", px, width=640), "--depth-edges", "keep")
                for px in (0, 2)]
    write("render-passes", [cut(picture, 300, 150, 340, 200) for picture in pictures])


def troubleshooting(studio):
    table, night = studio.scene("table"), studio.scene("night")
    clipped = studio.shown(night, "--tone", "none")
    maps = [["--focus-at", "200,110"], ["--focus-at", "200,110", "--depth-kind", "inverse"], ["--unit-scale", "100"]]
    write("troubleshooting", [studio.focus_map(table, *flags) for flags in maps],
          [studio.blurred(night, *NIGHT), *(studio.blurred(clipped, "--depth", night, *NIGHT, *flags)
                                            for flags in ([], ["--expand-highlights"]))])


def openfx(studio):
    tools, night, made = studio.program.parents[2], studio.scene("night"), studio.path("exr")
    numbers = {"focalLength": 105, "sensorWidth": 36, "fStop": 1.4, "focusDistance": 4.8, "lens": "doublet"}
    subprocess.run([tools / "apps/ofx-check/ofx-check", "render", tools / "ofx/petzval.ofx.bundle", "-o", made,
                    "--clip", f"Source={night}", "--clip", f"Depth={night}:Z",
                    *(word for name, value in numbers.items() for word in ("--param", f"{name}={value}"))], check=True)
    write("openfx", [read_png(studio.shown(night)), read_png(studio.shown(made))])


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        for make in (deep, render_passes, troubleshooting, openfx):
            make(Studio(pathlib.Path(program).resolve(), pathlib.Path(tempfile.mkdtemp(dir=folder))))


if __name__ == "__main__":
    main(*sys.argv[1:] or sys.exit(__doc__))
