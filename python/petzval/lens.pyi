# Written by tools/python_stubs.py; not edited.
"""Lenses: what they are and what they do to a point of light."""
from __future__ import annotations
import ctypes
import os
from . import _declared, errors
from ._library import call, json_of, library, made, names, struct, text_of
from ._pixels import pixels_of
from .arrays import Array
from .camera import Camera
OWN: Camera

class Lens:
    """A lens that ships, by name, or a lens file, by path. The file is read once, here.

    Raises InvalidArgument for an unknown name and InvalidFile for a file that describes no lens.
    """

    def __init__(self, name_or_file: str | os.PathLike) -> None:
        ...

    @classmethod
    def from_text(cls, text: str | bytes, name: str='lens') -> Lens:
        """A lens from the content of a lens file; `name` stands for it in messages. Raises InvalidFile."""

    def used(self, look=None, **fields) -> Lens:
        """This lens with the lens options of a look, or with given ones: lens.used(blades=5, cats_eye=0.4)."""

    @property
    def name(self) -> str:
        """As it was opened."""

    @property
    def facts(self) -> dict:
        """First-order numbers, Seidel sums, aberrations: the keys of `petzval lens show --json`. Lengths in mm."""

    @property
    def curves(self) -> dict:
        """Aberrations to plot: "longitudinal_aberration_mm" over the pupil, "field" over the field angle."""

    def section(self, depth_m: float=..., field: tuple[float, float]=(0, 0), rays_across: int=21, *, camera: Camera=..., size: tuple[int, int]=(1920, 1080)) -> dict:
        """The lens cut open: "glass" outlines and "rays" paths as points [z_mm, y_mm], for light from depth_m.

        field: place in the picture, -1…1 of its half diagonal, x right, y up.
        """

    def disc(self, radius_px: float, field: tuple[float, float]=(0, 0), *, camera: Camera=..., size: tuple[int, int]=(1920, 1080), pixel_aspect: float=1, size_px: int | None=None, raw: bool=False) -> Array:
        """What a point of light becomes: (n, n, 4) float32, r, g, b and alpha's weight each summing to 1.

        radius_px: signed radius of the circle of confusion, + behind focus, in a picture of `size` pixels. The source
        stands in the middle pixel. n is as large as the disc needs, or the odd size_px. raw keeps colours that no
        screen has, as negative values. Raises InvalidArgument for numbers out of range.
        """

    def texture(self, columns: int=512, largest_radius_px: float=64, *, rows_per_px: int=4, even: bool=False, view: bool=False, raw: bool=False, camera: Camera=..., size: tuple[int, int]=(1920, 1080), threads: int=0) -> tuple[Array, list[float]]:
        """All discs on the axis: (rows, columns, 4) float32, a disc's profile per column, and the columns' radii in px.

        Row v lies v / rows_per_px pixels from the middle of the disc.
        """

    def atlas(self, largest_radius_px: float=64, zones: int=5, *, camera: Camera=..., size: tuple[int, int]=(1920, 1080)) -> tuple[str, bytes]:
        """Discs by place in the frame and by radius, for shaders: the content of atlas.json and of atlas.bin.

        docs/reference/lens-atlas.md describes both. zones: rings from the middle of the frame to its corners. Raises
        InvalidArgument for several zones of a lens whose pupil is not round.
        """

    def buffer(self, quality: str='standard', *, camera: Camera=..., size: tuple[int, int]=(1920, 1080)) -> bytes:
        """The lens for the programs of the shader kit: the content of lens.bin, as `petzval lens buffer` writes it.

        docs/explain/shader-kit.md describes it. quality: "draft", "standard" or "final".
        """

    @staticmethod
    def check_buffer(buffer: bytes) -> None:
        """Raises InvalidFile if these bytes, such as those of a lens.bin, are no buffer for the programs of this version."""

    def __repr__(self) -> str:
        ...

def lens_names() -> list[str]:
    """The lenses that ship."""

def lens_list() -> list[dict]:
    """Name, title, class, year, focal length and f-number of every lens that ships."""
