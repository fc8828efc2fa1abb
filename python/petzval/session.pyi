# Written by tools/python_stubs.py; not edited.
"""Sessions: frames made of shots and looks."""
from __future__ import annotations
import ctypes
import dataclasses
import json
from typing import Any, Callable
from . import _declared, errors
from ._interrupt import Interruptible
from ._library import call, library, made, names, struct
from ._pixels import pixels_of
from .arrays import Array, like
from .look import Look, as_look
from .shot import Shot, Window, rect, shot_struct

@dataclasses.dataclass
class Frame:
    """A frame: its image, its layers in the shot's order, and the report.

    The report has engine, lens, device, radii, seconds by stage and warnings.
    """
    image: Any
    report: dict
    layers: list = dataclasses.field(default_factory=list)

    @property
    def warnings(self) -> list[str]:
        """Sentences about choices without effect and odd input."""

@dataclasses.dataclass
class Codes:
    """A frame as codes of a display: (height, width, 3), bytes or 16-bit words, and the report."""
    codes: Any
    report: dict

class Session:
    """What outlives a frame: threads, kernels, one memory budget. May be used by many threads at once.

    threads: 0 for all. max_memory_bytes: 0 for no limit. kernel_folder: where slow kernels are kept between runs.
    device: "cpu", "gpu", "gpu:1" or "auto". Raises Unsupported for a device that is missing.
    """

    def __init__(self, *, threads: int=0, max_memory_bytes: int=0, kernel_folder: str | None=None, device: str | None=None) -> None:
        ...

    def defocus(self, shot: Shot, look: Look | str | dict | None=None, *, out=None, region: Window | None=None, progress: Callable[[float], object] | None=None) -> Frame:
        """One frame. Its image comes in the library of shot.colour (numpy, torch, else petzval.Array), float32.

        out: an array of the frame's size, float32 or float16, any strides, that is written instead; it may be
        shot.colour itself. region: (x0, y0, x1, y1), the part of the frame to make. progress: called with the share
        done, 0…1; False from it cancels, and its exceptions end the frame and are raised here. The GIL is released;
        Ctrl-C ends the frame. Raises the errors of the C API, Cancelled among them.
        """

    def stage(self, stage: str, shot: Shot, look: Look | str | dict | None=None, *, out=None, progress: Callable[[float], object] | None=None) -> Frame:
        """One stage of a frame: "blur", "falloff" or "glare", or "light": falloff and glare in one call.

        shot.colour is the result of the stage before. All stages in turn give the bits of defocus(), for looks
        without expand_highlights and shots without mask. "blur" makes the shot's layers, too.
        """

    def codes(self, shot: Shot, look: Look | str | dict | None=None, *, bits: int=8, exposure_stops: float=0, contrast: float=1, tone: str='filmic', transfer: str='srgb', dither: bool=True, progress: Callable[[float], object] | None=None) -> Codes:
        """A frame developed to codes of a display over the display window: (height, width, 3), 8 or 16 bits."""

    def region_margin_px(self, shot: Shot, look: Look | str | dict | None=None) -> int:
        """How many pixels around a region its result depends on."""

    def usage(self) -> dict:
        """{"kept_bytes": …, "lenses": …}: what is kept between frames."""

    def trim(self, kept_bytes: int=0) -> None:
        """Frees kernels, rays and stars, least recently used first, until at most so many bytes are kept."""

    def close(self) -> None:
        """Ends the session. No frame may be under way."""

    def __enter__(self) -> Session:
        ...

    def __exit__(self, *_) -> None:
        ...

def defocus(colour, *, depth_m=None, radii_px=None, camera=None, look: Look | str | dict | None=None, progress: Callable[[float], object] | None=None, **shot) -> Frame:
    """One frame without a session: petzval.defocus(colour, depth_m=depth, camera=Camera(…), look=Look(…)).

    All other fields of Shot may be given. Errors: as Session.defocus.
    """

def engine_names() -> list[str]:
    """The engines."""

def device_names() -> list[str]:
    """The devices of this machine: "cpu", "gpu:0", …. Starts drivers."""
