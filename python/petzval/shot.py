"""Shots: what was rendered."""
from __future__ import annotations

import ctypes
import dataclasses
import numbers
from typing import Any, Sequence

from . import _declared, errors
from ._library import struct
from ._pixels import Kept, pixels_of, plane_of, pointer
from .arrays import FLOAT, memory_of
from .camera import Camera

Window = tuple  # (x0, y0, x1, y1), half-open, y down


@dataclasses.dataclass(frozen=True)
class Light:
    """A light for the engine "sprites". x, y in pixels, centres at +0.5; colour as it adds to one pixel in focus.

    Its depth is depth_m, or where that is NaN its signed radius is radius_px. diameter_px is its own width.
    """

    x: float
    y: float
    r: float
    g: float
    b: float
    depth_m: float = float("nan")
    radius_px: float = 0
    diameter_px: float = 0


@dataclasses.dataclass
class Deep:
    """Any number of samples in each pixel, nearest first, rows top to bottom.

    first: height * width + 1 integers; the samples of pixel i are first[i]…first[i + 1] - 1. samples: a sequence of
    (r, g, b, a, depth, depth_back), premultiplied. Large pictures: a packed float32 array (n, 6), which is borrowed,
    and a buffer of 8-byte integers.
    """

    width: int
    height: int
    first: Sequence[int]
    samples: Any

    def _struct(self) -> _declared.petzval_deep:
        count = len(self.samples)
        made = struct(_declared.petzval_deep, width=self.width, height=self.height, first=self._first(),
                      samples=self._samples(), sample_count=count)
        made.kept = self  # its arrays are borrowed
        return made

    def _first(self):
        room = (ctypes.c_uint64 * len(self.first))
        try:
            view = memoryview(self.first)  # type: ignore[arg-type]
        except TypeError:
            return room(*self.first)
        if view.itemsize != 8 or view.format not in ("L", "l", "Q", "q") or view.ndim != 1:
            raise errors.InvalidArgument(f"deep: first holds {view.format}; 8-byte integers in one row are needed")
        return room.from_buffer_copy(view)

    def _samples(self):
        if isinstance(self.samples, (list, tuple)):
            return (_declared.petzval_deep_sample * max(1, len(self.samples)))(*map(tuple, self.samples))
        memory = memory_of(self.samples, "deep.samples")
        if memory.sample != FLOAT or len(memory.shape) != 2 or memory.shape[1] != 6 or memory.strides != (24, 4):
            raise errors.InvalidArgument(f"deep: samples have shape {memory.shape} and strides {memory.strides}; a "
                                         "packed float32 array (n, 6) is needed")
        return ctypes.cast(memory.address, ctypes.POINTER(_declared.petzval_deep_sample))


@dataclasses.dataclass
class Layer:
    """Another picture of what the shot's colour shows, blurred by the same weights; for the engine "scatter".

    colour: as of a shot, and of its size; its alpha is not read. is_matte False: light; layers that sum to the
    shot's colour sum to it when blurred. spectrum: the lamp of this light, "sodium", "mercury", "neon" or "led".
    """

    colour: Any
    is_matte: bool = False
    spectrum: str | None = None


@dataclasses.dataclass
class Shot:
    """What was rendered: borrowed arrays, a camera, where the picture lies. Nothing is copied.

    colour: scene-linear, premultiplied, (height, width, 3 or 4) float32 or float16 with any strides, or a list of
    3 or 4 planes; without alpha it is 1. depth_m: planar metres, +infinity for a miss; or radii_px: signed radii of
    the circle of confusion, + behind focus. mask: 1 where the effect is wanted. deep, behind, holdout: deep samples
    of the picture, of hidden layers, of a matte. layers: more pictures that are blurred with it. Windows are (x0, y0, x1, y1); None: the picture is the frame.

    depth_kind, depth_unit_m, depth_range: the meaning of depth_m as a renderer wrote it, as --depth-kind, --unit-scale
    and --depth-range of the command line, with its rules for missing and negative depth; without these three, depth_m is
    planar metres.
    """

    colour: Any
    depth_m: Any = None
    radii_px: Any = None
    camera: Camera | None = None
    mask: Any = None
    deep: Deep | None = None
    behind: Deep | None = None
    holdout: Deep | None = None
    lights: Sequence[Light] = ()
    layers: Sequence[Layer] = ()
    display_window: Window | None = None
    data_window: Window | None = None
    pixel_aspect: float = 1
    depth_kind: str | None = None
    depth_unit_m: float = 1
    depth_range: tuple[float, float] | None = None

    def _struct(self, outs: Sequence[Any] = ()) -> tuple[_declared.petzval_shot, Kept]:
        """The C struct and what it points at. outs: where layers are written. Raises InvalidArgument."""
        if (self.depth_m is None) == (self.radii_px is None):
            raise errors.InvalidArgument("shot needs either depth_m or radii_px")
        colour, kept = pixels_of(self.colour, "colour")
        members: dict[str, Any] = {"colour": ctypes.pointer(colour)}
        for name in ("depth_m", "radii_px", "mask"):
            array = getattr(self, name)
            if array is not None:
                plane, owners = plane_of(array, name)
                members[name] = ctypes.pointer(plane)
                kept += owners
        for name, kind in (("deep", Deep), ("behind", Deep), ("holdout", Deep), ("camera", Camera)):
            value = getattr(self, name)
            members[name] = pointer(None if value is None else _petzvals(value, kind, name)._struct())
        members["depth_meaning"] = pointer(self._depth_meaning())
        layers, owners = _layers(self.layers, outs)
        kept += owners
        members.update(layers=layers, layer_count=len(self.layers))
        points = [dataclasses.astuple(_petzvals(light, Light, f"lights[{i}]")) for i, light in enumerate(self.lights)]
        lights = (_declared.petzval_light * max(1, len(points)))(*points)
        members.update(lights=lights, light_count=len(self.lights), pixel_aspect=self.pixel_aspect,
                       display_window=rect(self.display_window), data_window=rect(self.data_window))
        return struct(_declared.petzval_shot, **members), kept

    def _depth_meaning(self) -> _declared.petzval_depth_meaning | None:
        if self.depth_kind is None and self.depth_unit_m == 1 and self.depth_range is None:
            return None
        kind = None if self.depth_kind is None else self.depth_kind.encode()
        return struct(_declared.petzval_depth_meaning, kind=kind, unit_m=unit_of(self.depth_unit_m), range=range_of(self.depth_range))

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the picture."""
        colour, _ = pixels_of(self.colour, "colour")
        return colour.width, colour.height


def _layers(layers: Sequence[Layer], outs: Sequence[Any]):
    """An array of pointers to layers, and what they point at."""
    kept: Kept = []
    pointers = (ctypes.POINTER(_declared.petzval_layer) * max(1, len(layers)))()
    for i, layer in enumerate(layers):
        _petzvals(layer, Layer, f"layers[{i}]")
        colour, owners = pixels_of(layer.colour, f"layers[{i}]")
        made = struct(_declared.petzval_layer, colour=ctypes.pointer(colour), is_matte=int(layer.is_matte),
                      spectrum=layer.spectrum.encode() if layer.spectrum else None)
        kept += owners
        if i < len(outs):
            out, owners = pixels_of(outs[i], f"layers[{i}].out", written=True)
            made.out = ctypes.pointer(out)
            kept += owners
        pointers[i] = ctypes.pointer(made)
        kept.append(made)
    return pointers, kept


def _petzvals(value, kind: type, name: str):
    """The value, which must be of this class of petzval. Raises InvalidArgument."""
    return errors.of_type(value, kind, name, f"a petzval.{kind.__name__}")


def shot_struct(shot: Shot, outs: Sequence[Any] = ()):
    """Shot._struct() of an argument that may be something else. Raises InvalidArgument."""
    return _petzvals(shot, Shot, "shot")._struct(outs)


def unit_of(metres: float) -> float:
    """Metres per unit of depth; the C API takes 0 for its default. Raises InvalidArgument."""
    if errors.of_type(metres, numbers.Real, "depth_unit_m", "a number") == 0:
        raise errors.InvalidArgument("depth_unit_m is 0; it must be > 0 metres per unit")
    return metres


def range_of(ends: Sequence[float] | None):
    """Both ends of a range of depth as the C API has them; None: null. Raises InvalidArgument."""
    if ends is None:
        return None
    if len(ends) != 2:
        raise errors.InvalidArgument(f"depth_range has {len(ends)} numbers; two are needed")
    return (ctypes.c_double * 2)(*ends)


def rect(window: Window | None) -> _declared.petzval_rect:
    """A window as the C API has it; None: empty."""
    return _declared.petzval_rect(*(window or (0, 0, 0, 0)))
