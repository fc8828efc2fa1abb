# Written by tools/python_stubs.py; not edited.
"""Cameras."""
from __future__ import annotations
import dataclasses
from . import _declared
from ._library import struct

@dataclasses.dataclass(frozen=True)
class Camera:
    """A camera: focal length and sensor width in mm, f-number, focus distance in m.

    thin_lens False: the sensor stands one focal length behind the pinhole, as in renderers. Where a lens is asked
    without a picture, numbers that are 0 stand for those of the lens.
    """
    focal_length_mm: float = 50
    sensor_width_mm: float = 36
    f_number: float = 2
    focus_distance_m: float = 2
    thin_lens: bool = False
