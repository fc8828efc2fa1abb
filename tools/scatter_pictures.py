"""Makes the pictures of docs/explain/scatter.md: what each step of the engine leaves of the night scene.

Usage: scatter_pictures.py PROGRAM. Writes docs/pictures/scatter-N-NAME.png.
"""
import pathlib
import sys
import tempfile

from sample_set import make_night, read_png, run, side_by_side, write_png

PICTURES = pathlib.Path(__file__).resolve().parent.parent / "docs/pictures"
WIDTH, HEIGHT = 384, 216
# Name: the view, and the panels of it that are shown, by their column and row.
STEPS = {"0-sharp": ("sharp", [(0, 0)]), "1-layers": ("layers", [(0, 0), (0, 1)]), "2-highlights": ("highlights", [(1, 0)]),
         "3-order": ("layers", [(1, 0), (1, 1)]), "4-levels": ("levels", [(0, 1), (1, 1)]), "6-spread": ("levels", [(0, 0)]),
         "8-lights": ("highlights", [(0, 0)]), "9-result": ("beauty", [(0, 0)])}
CODES = 5  # rounded to multiples of it, so that files are small


def panel(picture, column, row):
    _, _, rows = picture
    return WIDTH, HEIGHT, [line[3 * WIDTH * column:3 * WIDTH * (column + 1)]
                           for line in rows[HEIGHT * row:HEIGHT * (row + 1)]]


def padded(picture):
    """Rows below a shorter picture are black, so that panels may stand beside each other."""
    width, _, rows = picture
    return width, HEIGHT, rows + [bytearray(3 * width)] * (HEIGHT - len(rows))


def main(program):
    with tempfile.TemporaryDirectory() as name:
        scene = make_night(program, pathlib.Path(name) / "night.exr", WIDTH)
        views = {}
        for view in {view for view, _ in STEPS.values()}:
            shown = pathlib.Path(name) / f"{view}.png"
            more = ["--engine", "gaussian"] if view == "sharp" else []
            run(program, "defocus", scene, "-o", shown, "--view", view, "--exposure", 0.8, *more)
            views[view] = read_png(shown)
        for step, (view, panels) in STEPS.items():
            shown = [padded(panel(views[view], *place)) for place in panels]
            write_png(PICTURES / f"scatter-{step}.png", side_by_side(shown, CODES))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve())
