# Written by tools/python_stubs.py; not edited.
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
Window = tuple

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
    depth_m: float = float('nan')
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

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) of the picture."""

def shot_struct(shot: Shot, outs: Sequence[Any]=()):
    """Shot._struct() of an argument that may be something else. Raises InvalidArgument."""

def unit_of(metres: float) -> float:
    """Metres per unit of depth; the C API takes 0 for its default. Raises InvalidArgument."""

def range_of(ends: Sequence[float] | None):
    """Both ends of a range of depth as the C API has them; None: null. Raises InvalidArgument."""

def rect(window: Window | None) -> _declared.petzval_rect:
    """A window as the C API has it; None: empty."""
