# Written by tools/python_stubs.py; not edited.
"""How far pictures are apart."""
from __future__ import annotations
import ctypes
from ._library import json_of
from ._pixels import pixels_of, plane_of

def compare(reference, test, *, mask=None, exposure: float=1) -> dict:
    """The measures of `petzval compare` between two pictures, arrays as of a shot's colour.

    psnr_lin, psnr_srgb, psnr_log in dB (inf for equal pictures), ssim_lin, ssim_srgb, max_error, max_error_at (x, y),
    energy_ratio. mask: (height, width), pixels above 0.5 count. exposure: a factor before clipping. Raises
    InvalidArgument where sizes differ.
    """
