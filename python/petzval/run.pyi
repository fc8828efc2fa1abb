# Written by tools/python_stubs.py; not edited.
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

    def __init__(self, settings: dict, *, threads: int=0, max_memory_bytes: int=0, kernel_folder: str | None=None, device: str | None=None) -> None:
        ...

    @property
    def frames(self) -> list[int]:
        """The frames that are made. Raises what can be refused before the work, as InvalidFile for missing inputs."""

    def run(self, frame_done: Callable[[dict], object] | None=None) -> list[int]:
        """Makes all frames; returns those that failed.

        frame_done: called with {"frame", "state": "made" | "kept" | "black" | "failed", "why", "record"}; False from
        it stops the run, its exceptions stop it and are raised here. Ctrl-C stops it too. Raises Cancelled.
        """
