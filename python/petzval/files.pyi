# Written by tools/python_stubs.py; not edited.
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

class FileShot(Shot):
    """A shot that was read from files, or a scene. Its arrays lie in the memory of the file that was read.

    Everything that Shot has may be changed before a frame is taken: camera, mask, layers. info: what was detected,
    warnings, names of layers. truth: of a scene, the picture a lens would have taken, or None.
    """
    info: dict
    truth: Any

    def __init__(self, handle) -> None:
        ...

    def write_like(self, path: str | os.PathLike, image, layers: Sequence[Any]=()) -> None:
        """Writes an EXR with this image (and layers, in the shot's order) and everything else that the input held.

        The file is complete or untouched. Raises InvalidArgument for other sizes, OutputFailed.
        """

def read_shot(path: str | os.PathLike, *, layer: str | None=None, view_name: str | None=None, depth_file: str | os.PathLike | None=None, depth_channel: str | None=None, depth_kind: str | None=None, depth_unit_m: float=1, behind: str | os.PathLike | None=None, holdout: str | os.PathLike | None=None, mask: str | None=None, lights: str | os.PathLike | None=None, layers: Sequence[str]=(), camera: Camera | None=None, threads: int=0, max_memory_bytes: int=0, depth_range: tuple[float, float] | None=None) -> FileShot:
    """A shot from EXR, PNG, JPEG or TIFF, as `petzval defocus` reads it; names are those of its options.

    camera: numbers that are not 0 win over the file's. layers: names of colour layers to blur as well, or ["all"].
    Raises InvalidFile, InvalidArgument for names that the file does not have, Unsupported without the library.
    """

def inspect(path: str | os.PathLike) -> dict:
    """A file by its headers, pixels unread.

    Keys: parts (name, type, view, compression, data_window, channels), display_window, data_window, pixel_aspect,
    views, camera (value and origin of each number), detected, warnings. Raises InvalidFile.
    """

def make_scene(name: str, width: int=960, height: int=540, *, seed: int=1, truth_samples: int=0) -> FileShot:
    """A built-in scene (`petzval scene list`) with its hidden layers; with truth_samples also its truth.

    truth_samples: lens samples per pixel. Raises InvalidArgument for an unknown scene.
    """
