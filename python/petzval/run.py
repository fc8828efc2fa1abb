"""Runs: a shot of many frames, from files to files."""
from __future__ import annotations

import ctypes
import json
from typing import Callable

from . import _declared
from ._interrupt import Interruptible
from ._library import call_files, files_library, struct
from .look import Look


class ShotRun:
    """A run over the frames of a shot, with the rules of `petzval defocus`. Needs libpetzval-files.so.

        run = petzval.ShotRun({"input": "beauty.####.exr", "output": "out.####.exr", "frames": "1001-1100",
                               "camera": {"f_number": 2, "focus_distance_m": 3}, "existing": "keep"})
        failed = run.run(lambda frame: print(frame["frame"], frame["state"]))

    settings: keys as in docs/reference/c-api.md, petzval_files_run_open; "look" may be a Look. A run with "existing":
    "keep" or "update" that was killed goes on where it ended: outputs are complete or missing. The other arguments
    are those of Session. Raises InvalidArgument for unknown keys and wrong values, Unsupported without the library.
    """

    def __init__(self, settings: dict, *, threads: int = 0, max_memory_bytes: int = 0, kernel_folder: str | None = None,
                 device: str | None = None) -> None:
        wanted = {key: json.loads(value.to_json()) if isinstance(value, Look) else value
                  for key, value in settings.items()}
        session = struct(_declared.petzval_session_settings, threads=threads, max_memory_bytes=max_memory_bytes,
                         kernel_folder=kernel_folder.encode() if kernel_folder else None,
                         device=device.encode() if device else None)
        self._done: Callable[[dict], object] | None = None
        self._interruptible = Interruptible()
        self._host = struct(_declared.petzval_run_host, stop=ctypes.pointer(self._interruptible.stop))
        self._host.frame_done = type(self._host.frame_done)(self._interruptible.guarded(self._frame_done, 0))
        self._handle = ctypes.POINTER(_declared.petzval_files_run)()
        call_files("petzval_files_run_open", ctypes.byref(session), json.dumps(wanted).encode(),
                   ctypes.byref(self._host), ctypes.byref(self._handle))

    def _frame_done(self, _host, frame: int, state: bytes, why: bytes, record: bytes) -> int:
        if self._done is None:
            return 1
        told = {"frame": frame, "state": state.decode(), "why": why.decode("utf-8", "replace"),
                "record": json.loads(record) if record else None}
        return 0 if self._done(told) is False else 1

    @property
    def frames(self) -> list[int]:
        """The frames that are made. Raises what can be refused before the work, as InvalidFile for missing inputs."""
        call_files("petzval_files_run_plan", self._handle)
        return self._numbers("petzval_files_run_frames")

    def run(self, frame_done: Callable[[dict], object] | None = None) -> list[int]:
        """Makes all frames; returns those that failed.

        frame_done: called with {"frame", "state": "made" | "kept" | "black" | "failed", "why", "record"}; False from
        it stops the run, its exceptions stop it and are raised here. Ctrl-C stops it too. Raises Cancelled.
        """
        self._done = frame_done
        self._interruptible.call(lambda: call_files("petzval_files_run_all", self._handle))
        return self._numbers("petzval_files_run_failed")

    def _numbers(self, function: str) -> list[int]:
        first, count = ctypes.POINTER(ctypes.c_int)(), ctypes.c_uint64()
        call_files(function, self._handle, ctypes.byref(first), ctypes.byref(count))
        return [first[i] for i in range(count.value)]

    def __del__(self) -> None:
        handle = getattr(self, "_handle", None)
        if handle:
            files_library().petzval_files_run_close(handle)
