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
        return self.report["warnings"]


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

    def __init__(self, *, threads: int = 0, max_memory_bytes: int = 0, kernel_folder: str | None = None,
                 device: str | None = None) -> None:
        settings = struct(_declared.petzval_session_settings, threads=threads, max_memory_bytes=max_memory_bytes,
                          kernel_folder=kernel_folder.encode() if kernel_folder else None,
                          device=device.encode() if device else None)
        self._handle = made(_declared.petzval_session, "petzval_session_open", ctypes.byref(settings))

    def defocus(self, shot: Shot, look: Look | str | dict | None = None, *, out=None, region: Window | None = None,
                progress: Callable[[float], object] | None = None) -> Frame:
        """One frame. Its image comes in the library of shot.colour (numpy, torch, else petzval.Array), float32.

        out: an array of the frame's size, float32 or float16, any strides, that is written instead; it may be
        shot.colour itself. region: (x0, y0, x1, y1), the part of the frame to make. progress: called with the share
        done, 0…1; False from it cancels, and its exceptions end the frame and are raised here. The GIL is released;
        Ctrl-C ends the frame. Raises the errors of the C API, Cancelled among them.
        """
        given, kept = shot_struct(shot)
        images = [_image_for(shot, given, region) for _ in shot.layers]
        if images:
            given, kept = shot_struct(shot, images)
        image = _image_for(shot, given, region) if out is None else out
        into, held = pixels_of(image, "out", written=True)
        report = self._run("petzval_defocus", (), given, look, ctypes.byref(into), progress, region)
        del kept, held
        layers = [like(_first(layer.colour), made_layer) for layer, made_layer in zip(shot.layers, images)]
        return Frame(like(_first(shot.colour), image) if out is None else out, report, layers)

    def stage(self, stage: str, shot: Shot, look: Look | str | dict | None = None, *, out=None,
              progress: Callable[[float], object] | None = None) -> Frame:
        """One stage of a frame: "blur", "falloff" or "glare", or "light": falloff and glare in one call.

        shot.colour is the result of the stage before. All stages in turn give the bits of defocus(), for looks
        without expand_highlights and shots without mask. "blur" makes the shot's layers, too.
        """
        given, kept = shot_struct(shot)
        images = [_image_for(shot, given, None) for _ in shot.layers] if stage == "blur" else []
        if images:
            given, kept = shot_struct(shot, images)
        image = _image_for(shot, given, None) if out is None else out
        into, held = pixels_of(image, "out", written=True)
        report = self._run("petzval_defocus_stage", (stage.encode(),), given, look, ctypes.byref(into), progress, None)
        del kept, held
        layers = [like(_first(layer.colour), made_layer) for layer, made_layer in zip(shot.layers, images)]
        return Frame(like(_first(shot.colour), image) if out is None else out, report, layers)

    def codes(self, shot: Shot, look: Look | str | dict | None = None, *, bits: int = 8, exposure_stops: float = 0,
              contrast: float = 1, tone: str = "filmic", transfer: str = "srgb", dither: bool = True,
              progress: Callable[[float], object] | None = None) -> Codes:
        """A frame developed to codes of a display over the display window: (height, width, 3), 8 or 16 bits."""
        given, kept = shot_struct(shot)
        width, height = shot.size
        x0, y0, x1, y1 = shot.display_window or shot.data_window or (0, 0, width, height)
        height, width = y1 - y0, x1 - x0
        kind, letter = (ctypes.c_uint16, "H") if bits == 16 else (ctypes.c_uint8, "B")
        memory = (kind * (3 * width * height))()
        wanted = struct(_declared.petzval_codes, data=ctypes.addressof(memory), width=width, height=height, bits=bits,
                        row_stride=3 * width * ctypes.sizeof(kind), exposure_stops=exposure_stops, contrast=contrast,
                        tone=tone.encode(), transfer=transfer.encode(), no_dither=int(not dither))
        report = self._run("petzval_defocus_codes", (), given, look, ctypes.byref(wanted), progress, None)
        del kept
        return Codes(memoryview(memory).cast("B").cast(letter, (height, width, 3)), report)

    def _run(self, name: str, first: tuple, given, look, into, progress, region) -> dict:
        """Calls a function that makes a frame; its report."""
        chosen = as_look(look)  # lives until the call returns
        report = ctypes.POINTER(_declared.petzval_report)()
        running = Interruptible()
        control = _control(running, progress, region)
        running.call(lambda: call(name, self._open(), *first, ctypes.byref(given), chosen._handle, control, into,
                                  ctypes.byref(report)))
        text = library().petzval_report_json(report)
        library().petzval_report_close(report)
        return json.loads(text)

    def region_margin_px(self, shot: Shot, look: Look | str | dict | None = None) -> int:
        """How many pixels around a region its result depends on."""
        given, kept = shot_struct(shot)
        chosen = as_look(look)
        margin = ctypes.c_int()
        call("petzval_region_margin_px", self._open(), ctypes.byref(given), chosen._handle, ctypes.byref(margin))
        del kept
        return margin.value

    def usage(self) -> dict:
        """{"kept_bytes": …, "lenses": …}: what is kept between frames."""
        usage = struct(_declared.petzval_usage)
        call("petzval_session_usage", self._open(), ctypes.byref(usage))
        return {"kept_bytes": usage.kept_bytes, "lenses": usage.lenses}

    def trim(self, kept_bytes: int = 0) -> None:
        """Frees kernels, rays and stars, least recently used first, until at most so many bytes are kept."""
        call("petzval_session_trim", self._open(), kept_bytes)

    def close(self) -> None:
        """Ends the session. No frame may be under way."""
        handle, self._handle = getattr(self, "_handle", None), None
        if handle:
            library().petzval_session_close(handle)

    def _open(self):
        if not self._handle:
            raise errors.InvalidArgument("the session is closed")
        return self._handle

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()


def _control(running: Interruptible, progress, region: Window | None):
    """A pointer to the control of a frame."""
    control = struct(_declared.petzval_control, region=rect(region), stop=ctypes.pointer(running.stop))
    if progress is not None:
        def report(_host, done: float) -> int:
            return 0 if progress(done) is False else 1
        control.progress = type(control.progress)(running.guarded(report, 0))
    return ctypes.pointer(control)


def _first(colour):
    return colour[0] if isinstance(colour, (tuple, list)) else colour


def _image_for(shot: Shot, given: _declared.petzval_shot, region: Window | None) -> Array:
    """An image of the frame's size, or of the part of the region inside it, with as many channels as colour."""
    colour = given.colour.contents
    x0, y0, x1, y1 = shot.data_window or (0, 0, colour.width, colour.height)
    if region:
        x0, y0, x1, y1 = max(x0, region[0]), max(y0, region[1]), min(x1, region[2]), min(y1, region[3])
    return Array((max(1, y1 - y0), max(1, x1 - x0), 4 if colour.a else 3))


def defocus(colour, *, depth_m=None, radii_px=None, camera=None, look: Look | str | dict | None = None,
            progress: Callable[[float], object] | None = None, **shot) -> Frame:
    """One frame without a session: petzval.defocus(colour, depth_m=depth, camera=Camera(…), look=Look(…)).

    All other fields of Shot may be given. Errors: as Session.defocus.
    """
    with Session() as session:
        rendered = Shot(colour, depth_m=depth_m, radii_px=radii_px, camera=camera, **shot)
        return session.defocus(rendered, look, progress=progress)


def engine_names() -> list[str]:
    """The engines."""
    return names("petzval_engine_name")


def device_names() -> list[str]:
    """The devices of this machine: "cpu", "gpu:0", …. Starts drivers."""
    return names("petzval_device_name")
