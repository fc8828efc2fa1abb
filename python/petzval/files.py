"""Shots from files, results written like the input, and built-in scenes with their truth.

Needs libpetzval-files.so; without it these functions raise Unsupported, and everything else works.
"""
from __future__ import annotations

import ctypes
import json
import os
from typing import Any, Sequence

from . import _declared, errors
from ._library import call_files, files_library, struct
from ._pixels import pixels_of
from .camera import Camera
from .shot import Layer, Shot, range_of, unit_of


class _Lent:
    """Floats inside a shot of libpetzval-files.so, which lives as long as this."""

    def __init__(self, owner: _Handle, address: int, shape: tuple, strides: tuple) -> None:
        self._owner = owner
        self.__array_interface__ = {"version": 3, "shape": shape, "typestr": "<f4", "data": (address, False),
                                    "strides": strides}


class _Handle:
    """A petzval_shot_file; closed with the last array that points into it."""

    def __init__(self, handle) -> None:
        self.handle = handle

    def __del__(self) -> None:
        files_library().petzval_files_close(self.handle)


def _array(lent: _Lent):
    """As numpy's array where numpy is installed; the memory is the same."""
    try:
        import numpy
    except ImportError:
        return lent
    return numpy.asarray(lent)


class FileShot(Shot):
    """A shot that was read from files, or a scene. Its arrays lie in the memory of the file that was read.

    Everything that Shot has may be changed before a frame is taken: camera, mask, layers. info: what was detected,
    warnings, names of layers. truth: of a scene, the picture a lens would have taken, or None.
    """

    info: dict
    truth: Any

    def __init__(self, handle) -> None:
        self._handle = _Handle(handle)
        self._lent = files_library().petzval_files_shot(handle).contents
        self.info = json.loads(files_library().petzval_files_json(handle))
        lent = self._lent
        planes = {name: self._plane(getattr(lent, name)) for name in ("depth_m", "radii_px", "mask")}
        layers = [Layer(self._picture(lent.layers[i].contents.colour.contents), bool(lent.layers[i].contents.is_matte),
                        (lent.layers[i].contents.spectrum or b"").decode() or None) for i in range(lent.layer_count)]
        super().__init__(self._picture(lent.colour.contents), camera=_camera(lent.camera.contents), layers=layers,
                         display_window=_window(lent.display_window), data_window=_window(lent.data_window),
                         pixel_aspect=lent.pixel_aspect, **planes)
        truth = files_library().petzval_files_truth(handle)
        self.truth = self._picture(truth.contents) if truth else None

    def _picture(self, p: _declared.petzval_pixels):
        return _array(_Lent(self._handle, p.r, (p.height, p.width, 4), (p.row_stride, p.pixel_stride, 4)))

    def _plane(self, pointer):
        if not pointer:
            return None
        p = pointer.contents
        return _array(_Lent(self._handle, p.data, (p.height, p.width), (p.row_stride, p.pixel_stride)))

    def _struct(self, outs: Sequence[Any] = ()):
        made, kept = super()._struct(outs)
        for name in ("deep", "behind", "holdout"):
            if getattr(self, name) is None:
                setattr(made, name, getattr(self._lent, name))
        if not self.lights:
            made.lights, made.light_count = self._lent.lights, self._lent.light_count
        kept.append(self._handle)
        return made, kept

    def write_like(self, path: str | os.PathLike, image, layers: Sequence[Any] = ()) -> None:
        """Writes an EXR with this image (and layers, in the shot's order) and everything else that the input held.

        The file is complete or untouched. Raises InvalidArgument for other sizes, OutputFailed.
        """
        colour, kept = pixels_of(image, "image")
        made = [pixels_of(layer, f"layers[{i}]") for i, layer in enumerate(layers)]
        pointers = (ctypes.POINTER(_declared.petzval_pixels) * max(1, len(made)))(
            *[ctypes.pointer(pixels) for pixels, _ in made])
        call_files("petzval_files_write_like", self._handle.handle, ctypes.byref(colour), pointers, len(made),
                   os.fspath(path).encode())
        del kept


def _camera(c: _declared.petzval_camera) -> Camera:
    return Camera(c.focal_length_mm, c.sensor_width_mm, c.f_number, c.focus_distance_m, bool(c.thin_lens))


def _window(r: _declared.petzval_rect) -> tuple:
    return r.x0, r.y0, r.x1, r.y1


def _text(value: str | os.PathLike | None) -> bytes | None:
    return None if value is None else os.fspath(value).encode()


def read_shot(path: str | os.PathLike, *, layer: str | None = None, view_name: str | None = None,
              depth_file: str | os.PathLike | None = None, depth_channel: str | None = None,
              depth_kind: str | None = None, depth_unit_m: float = 1, behind: str | os.PathLike | None = None,
              holdout: str | os.PathLike | None = None, mask: str | None = None,
              lights: str | os.PathLike | None = None, layers: Sequence[str] = (), camera: Camera | None = None,
              threads: int = 0, max_memory_bytes: int = 0, depth_range: tuple[float, float] | None = None) -> FileShot:
    """A shot from EXR, PNG, JPEG or TIFF, as `petzval defocus` reads it; names are those of its options.

    camera: numbers that are not 0 win over the file's. layers: names of colour layers to blur as well, or ["all"].
    Raises InvalidFile, InvalidArgument for names that the file does not have, Unsupported without the library.
    """
    names = (ctypes.c_char_p * max(1, len(layers)))(*[name.encode() for name in layers])
    errors.of_type(path, (str, os.PathLike), "path", "a file name")
    own = None if camera is None else errors.of_type(camera, Camera, "camera", "a petzval.Camera")._struct()
    source = struct(_declared.petzval_shot_source, path=_text(path), layer=_text(layer), view_name=_text(view_name),
                    depth_file=_text(depth_file), depth_channel=_text(depth_channel), depth_kind=_text(depth_kind),
                    depth_unit_m=unit_of(depth_unit_m), behind=_text(behind), holdout=_text(holdout), mask=_text(mask),
                    lights=_text(lights), layers=names, layer_count=len(layers),
                    camera=ctypes.pointer(own) if own is not None else None, threads=threads,
                    max_memory_bytes=max_memory_bytes, depth_range=range_of(depth_range))
    handle = ctypes.POINTER(_declared.petzval_shot_file)()
    call_files("petzval_files_read_shot", ctypes.byref(source), ctypes.byref(handle))
    return FileShot(handle)


def inspect(path: str | os.PathLike) -> dict:
    """A file by its headers, pixels unread.

    Keys: parts (name, type, view, compression, data_window, channels), display_window, data_window, pixel_aspect,
    views, camera (value and origin of each number), detected, warnings. Raises InvalidFile.
    """
    handle = ctypes.POINTER(_declared.petzval_shot_file)()
    call_files("petzval_files_inspect", os.fspath(path).encode(), ctypes.byref(handle))
    held = _Handle(handle)
    return json.loads(files_library().petzval_files_json(held.handle))


def make_scene(name: str, width: int = 960, height: int = 540, *, seed: int = 1, truth_samples: int = 0) -> FileShot:
    """A built-in scene (`petzval scene list`) with its hidden layers; with truth_samples also its truth.

    truth_samples: lens samples per pixel. Raises InvalidArgument for an unknown scene.
    """
    if width < 1 or height < 1:
        raise errors.InvalidArgument(f"a scene of {width} x {height} pixels is empty")
    handle = ctypes.POINTER(_declared.petzval_shot_file)()
    call_files("petzval_files_make_scene", name.encode(), width, height, seed, truth_samples, ctypes.byref(handle))
    return FileShot(handle)
