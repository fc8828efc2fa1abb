"""Makes pictures of docs/guide: deep, plate, render passes, troubleshooting, camera numbers, soft depth, presets, OpenFX,
GEGL, kit, packages.

Usage: guide_pictures.py PROGRAM [NAME…]. Writes docs/pictures/guide-NAME.png, or .svg. OpenFX needs `ninja petzval_ofx
ofx_check`, GEGL its operation, `gegl` and `oiiotool`, the kit a Vulkan driver.
"""
import os
import pathlib
import re
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


def plate(studio):
    hidden, matte = studio.path("exr"), studio.path("png")
    post, focus = studio.scene("post", "--frame", 26, "--layers", hidden), ["--focus", "13m"]
    run(studio.program, "defocus", post, "-o", matte, "--view", "guessed", *focus)
    write("plate", [studio.blurred(post, *focus), read_png(matte), studio.blurred(post, *focus, "--plate", hidden)])


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


def camera_numbers(studio):
    night = studio.scene("night", width=480)
    write("camera-numbers", [studio.blurred(night, "--sensor-width", width) for width in ("36mm", "24mm", "13mm")])


def soft_depth(studio):
    antialiased = studio.scene("lanterns", "--depth-filter", "mean", width=480)
    soft = studio.scene("tori", "--depth-blur", 2, "--depth-bits", 8, width=480)
    write("soft-depth", *([studio.blurred(scene, "--depth-edges", edges) for edges in ("keep", "auto")]
                          for scene in (antialiased, soft)))


def presets(studio):
    night = studio.scene("night")
    looks = [studio.blurred(night, "--preset", name)
             for name in ("portrait", "bubble", "swirl", "soft-focus", "anamorphic", "night")]
    write("presets", looks[:3], looks[3:])


def openfx(studio):
    tools, night, made = studio.program.parents[2], studio.scene("night"), studio.path("exr")
    numbers = {"focalLength": 105, "sensorWidth": 36, "fStop": 1.4, "focusDistance": 4.8, "lens": "doublet"}
    subprocess.run([tools / "apps/ofx-check/ofx-check", "render", tools / "ofx/petzval.ofx.bundle", "-o", made,
                    "--clip", f"Source={night}", "--clip", f"Depth={night}:Z",
                    *(word for name, value in numbers.items() for word in ("--param", f"{name}={value}"))], check=True)
    write("openfx", [read_png(studio.shown(night)), read_png(studio.shown(made))])


def gegl(studio):
    cubes, depth, made = studio.scene("cubes"), studio.path("exr"), studio.path("exr")
    subprocess.run(["oiiotool", cubes, "--ch", "Y=Z", "-o", depth], check=True)
    theirs = subprocess.run(["pkg-config", "--variable=pluginsdir", "gegl-0.4"], check=True, stdout=subprocess.PIPE, text=True)
    path = f"{theirs.stdout.strip()}:{studio.program.parents[2] / 'plugins/gegl'}"
    subprocess.run(["gegl", cubes, "-o", made, "--", "petzval:defocus", "f-number=1.4", "focus-distance=2.2", "lens=doublet",
                    "aux=[", "gegl:load", f"path={depth}", "]"], env={**os.environ, "GEGL_PATH": path}, check=True,
                   stderr=subprocess.DEVNULL)  # GEGL reports its own leaks
    write("gegl", [read_png(studio.shown(cubes)), read_png(studio.shown(made))])


def kit(studio):
    lanterns = studio.scene("lanterns")
    write("kit", [read_png(studio.shown(lanterns)), studio.blurred(lanterns, "--engine", "realtime", "--device", "gpu",
                                                                   "--blades", "5")])


BOX, GAP = (176, 34), (60, 12)  # of a package in the drawing; px
COLUMNS = [["petzval-ofx", "petzval", "blender-petzval", "libpetzval-dev", "petzval-gegl"], ["python3-petzval"],
           ["libpetzval0", "libpetzval-files0"]]


def packages(studio):
    """An arrow for each of our packages that another one of debian/control installs."""
    control = (PICTURES.parents[1] / "debian/control").read_text()
    place = {name: (10 + x * (BOX[0] + GAP[0]), 10 + y * (BOX[1] + GAP[1]))
             for x, column in enumerate(COLUMNS) for y, name in enumerate(column)}
    width, height = (10 + max(at[i] for at in place.values()) + BOX[i] for i in (0, 1))
    parts = []
    for name, fields in re.findall(r"^Package: (\S+)\n(.*?)(?=^Description)", control, re.DOTALL | re.MULTILINE):
        (x, y), middle = place[name], BOX[1] / 2
        parts.append(f'<rect x="{x}" y="{y}" width="{BOX[0]}" height="{BOX[1]}" rx="6"/>'
                     f'<text x="{x + BOX[0] / 2}" y="{y + 22}">{name}</text>')
        for kind, line in re.findall(r"^(Depends|Recommends): (.*(?:\n .*)*)", fields, re.MULTILINE):
            for other in sorted(place.keys() & set(re.findall(r"[\w-]+", line))):
                start, (to_x, to_y) = x + BOX[0], place[other]
                dashes = ' stroke-dasharray="5 4"' if kind == "Recommends" else ""
                parts.append(f'<path d="M{start} {y + middle}C{start + 30} {y + middle} {to_x - 40} {to_y + middle} '
                             f'{to_x - 3} {to_y + middle}"{dashes} marker-end="url(#tip)"/>')
    (PICTURES / "guide-packages.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}"><style>svg '
        '{ background: #fff; } rect { fill: #e8eef6; stroke: #35506e; } path { fill: none; stroke: #35506e; } text { font: 15px '
        'sans-serif; text-anchor: middle; fill: #111; }</style><defs><marker id="tip" markerWidth="9" markerHeight="8" refX="8" '
        'refY="4" orient="auto"><path d="M0 0L9 4L0 8z" style="fill: #35506e"/></marker></defs>\n' + "\n".join(parts) + "\n</svg>\n")


def main(program, *names):
    with tempfile.TemporaryDirectory() as folder:
        for make in (deep, plate, render_passes, troubleshooting, camera_numbers, soft_depth, presets, openfx, gegl, kit, packages):
            if not names or make.__name__.replace("_", "-") in names:
                make(Studio(pathlib.Path(program).resolve(), pathlib.Path(tempfile.mkdtemp(dir=folder))))


if __name__ == "__main__":
    main(*sys.argv[1:] or sys.exit(__doc__))
