"""Lenses: what they are and what they do to a point of light."""
from __future__ import annotations

import ctypes
import os

from . import _declared, errors
from ._library import call, json_of, library, made, names, struct, text_of
from ._pixels import pixels_of
from .arrays import Array
from .camera import Camera

OWN = Camera(0, 0, 0, 0)  # the camera that a lens was built for, focused at infinity


class Lens:
    """A lens that ships, by name, or a lens file, by path. The file is read once, here.

    Raises InvalidArgument for an unknown name and InvalidFile for a file that describes no lens.
    """

    def __init__(self, name_or_file: str | os.PathLike) -> None:
        errors.of_type(name_or_file, (str, os.PathLike), "lens", "a name or a path")
        self._handle = made(_declared.petzval_lens, "petzval_lens_open", os.fspath(name_or_file).encode())

    @classmethod
    def from_text(cls, text: str | bytes, name: str = "lens") -> Lens:
        """A lens from the content of a lens file; `name` stands for it in messages. Raises InvalidFile."""
        data = text.encode() if isinstance(text, str) else bytes(text)
        return cls._of(made(_declared.petzval_lens, "petzval_lens_from_memory", data, len(data), name.encode()))

    @classmethod
    def _of(cls, handle) -> Lens:
        lens = cls.__new__(cls)
        lens._handle = handle
        return lens

    def used(self, look=None, **fields) -> Lens:
        """This lens with the lens options of a look, or with given ones: lens.used(blades=5, cats_eye=0.4)."""
        from .look import Look, as_look
        chosen = Look(**{f"lens.{field}": value for field, value in fields.items()}) if fields else as_look(look)
        return self._of(made(_declared.petzval_lens, "petzval_lens_with", self._handle, chosen._handle))

    @property
    def name(self) -> str:
        """As it was opened."""
        return library().petzval_lens_title(self._handle).decode()

    @property
    def facts(self) -> dict:
        """First-order numbers, Seidel sums, aberrations: the keys of `petzval lens show --json`. Lengths in mm."""
        return self._known("petzval_lens_facts")

    @property
    def curves(self) -> dict:
        """Aberrations to plot: "longitudinal_aberration_mm" over the pupil, "field" over the field angle."""
        return self._known("petzval_lens_curves")

    def _known(self, function: str) -> dict:
        """JSON that is asked for once."""
        known = self.__dict__.setdefault("_answers", {})
        if function not in known:
            known[function] = json_of(function, self._handle)
        return known[function]

    def section(self, depth_m: float = float("inf"), field: tuple[float, float] = (0, 0), rays_across: int = 21, *,
                camera: Camera = OWN, size: tuple[int, int] = (1920, 1080)) -> dict:
        """The lens cut open: "glass" outlines and "rays" paths as points [z_mm, y_mm], for light from depth_m.

        field: place in the picture, -1…1 of its half diagonal, x right, y up.
        """
        with _Mount(camera, size, 1) as mount:
            return json_of("petzval_lens_section", self._handle, mount, depth_m, *field, rays_across)

    def disc(self, radius_px: float, field: tuple[float, float] = (0, 0), *, camera: Camera = OWN,
             size: tuple[int, int] = (1920, 1080), pixel_aspect: float = 1, size_px: int | None = None,
             raw: bool = False) -> Array:
        """What a point of light becomes: (n, n, 4) float32, r, g, b and alpha's weight each summing to 1.

        radius_px: signed radius of the circle of confusion, + behind focus, in a picture of `size` pixels. The source
        stands in the middle pixel. n is as large as the disc needs, or the odd size_px. raw keeps colours that no
        screen has, as negative values. Raises InvalidArgument for numbers out of range.
        """
        asked = struct(_declared.petzval_disc, coc_radius_px=radius_px, field_x=field[0], field_y=field[1],
                       raw=int(raw))
        with _Mount(camera, size, pixel_aspect) as mount:
            side = ctypes.c_int(size_px or 0)
            if size_px is None:
                call("petzval_lens_disc_size", self._handle, mount, ctypes.byref(asked), ctypes.byref(side))
            made_disc = Array((side.value, side.value, 4))
            report = struct(_declared.petzval_disc_report)
            out, kept = pixels_of(made_disc, "out")
            call("petzval_lens_disc", self._handle, mount, ctypes.byref(asked), ctypes.byref(out),
                 ctypes.byref(report))
            del kept
        return made_disc if size_px else _middle(made_disc, report.needed_px)

    def texture(self, columns: int = 512, largest_radius_px: float = 64, *, rows_per_px: int = 4, even: bool = False,
                view: bool = False, raw: bool = False, camera: Camera = OWN, size: tuple[int, int] = (1920, 1080),
                threads: int = 0) -> tuple[Array, list[float]]:
        """All discs on the axis: (rows, columns, 4) float32, a disc's profile per column, and the columns' radii in px.

        Row v lies v / rows_per_px pixels from the middle of the disc.
        """
        asked = struct(_declared.petzval_texture, columns=columns, largest_coc_px=largest_radius_px, even=int(even),
                       rows_per_px=rows_per_px, raw=int(raw), view=int(view), threads=threads)
        radii, rows = (ctypes.c_double * columns)(), ctypes.c_int()
        with _Mount(camera, size, 1) as mount:
            call("petzval_lens_texture_rows", self._handle, mount, ctypes.byref(asked), ctypes.byref(rows))
            texture = Array((rows.value, columns, 4))
            out, kept = pixels_of(texture, "out")
            call("petzval_lens_texture", self._handle, mount, ctypes.byref(asked), ctypes.byref(out), radii,
                 ctypes.byref(rows))
            del kept
        return texture.rows(0, rows.value), list(radii)

    def atlas(self, largest_radius_px: float = 64, zones: int = 5, *, camera: Camera = OWN,
              size: tuple[int, int] = (1920, 1080)) -> tuple[str, bytes]:
        """Discs by place in the frame and by radius, for shaders: the content of atlas.json and of atlas.bin.

        docs/reference/lens-atlas.md describes both. zones: rings from the middle of the frame to its corners. Raises
        InvalidArgument for several zones of a lens whose pupil is not round.
        """
        asked = struct(_declared.petzval_atlas, largest_coc_px=largest_radius_px, zones=zones)
        count = ctypes.c_size_t()
        call("petzval_lens_atlas_bytes", ctypes.byref(asked), ctypes.byref(count))
        texels = ctypes.create_string_buffer(count.value)
        with _Mount(camera, size, 1) as mount:
            header = text_of("petzval_lens_atlas", self._handle, mount, ctypes.byref(asked), texels, count)
        return header, texels.raw

    def buffer(self, quality: str = "standard", *, camera: Camera = OWN, size: tuple[int, int] = (1920, 1080)) -> bytes:
        """The lens for the programs of the shader kit: the content of lens.bin, as `petzval lens buffer` writes it.

        docs/explain/shader-kit.md describes it. quality: "draft", "standard" or "final".
        """
        chosen, count = errors.of_type(quality, str, "quality", "a name").encode(), ctypes.c_size_t()
        with _Mount(camera, size, 1) as mount:
            call("petzval_lens_buffer_bytes", self._handle, mount, chosen, ctypes.byref(count))
            floats = ctypes.create_string_buffer(count.value)
            call("petzval_lens_buffer", self._handle, mount, chosen, floats, count)
        return floats.raw

    @staticmethod
    def check_buffer(buffer: bytes) -> None:
        """Raises InvalidFile if these bytes, such as those of a lens.bin, are no buffer for the programs of this version."""
        data = bytes(buffer)
        call("petzval_check_lens_buffer", data, len(data))

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle:
            library().petzval_lens_close(handle)

    def __repr__(self) -> str:
        return f"petzval.Lens({self.name!r})"


class _Mount:
    """The camera and the picture's size, for the time of a call."""

    def __init__(self, camera: Camera, size: tuple[int, int], pixel_aspect: float) -> None:
        self._camera = errors.of_type(camera, Camera, "camera", "a petzval.Camera")._struct()
        self._mount = struct(_declared.petzval_lens_mount, camera=ctypes.pointer(self._camera), width=size[0],
                             height=size[1], pixel_aspect=pixel_aspect)

    def __enter__(self):
        return ctypes.byref(self._mount)

    def __exit__(self, *_) -> None:
        pass


def _middle(disc: Array, side: int) -> Array:
    first = (disc.shape[0] - side) // 2
    cut = Array((side, side, 4))
    for y in range(side):
        start = 4 * ((first + y) * disc.shape[1] + first)
        ctypes.memmove(cut.address + 16 * y * side, disc.address + 4 * start, 16 * side)
    return cut


def lens_names() -> list[str]:
    """The lenses that ship."""
    return names("petzval_lens_name")


def lens_list() -> list[dict]:
    """Name, title, class, year, focal length and f-number of every lens that ships."""
    return json_of("petzval_lens_list")
