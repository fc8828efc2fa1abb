"""How far pictures are apart."""
from __future__ import annotations

import ctypes

from ._library import json_of
from ._pixels import pixels_of, plane_of


def compare(reference, test, *, mask=None, exposure: float = 1) -> dict:
    """The measures of `petzval compare` between two pictures, arrays as of a shot's colour.

    psnr_lin, psnr_srgb, psnr_log in dB (inf for equal pictures), ssim_lin, ssim_srgb, max_error, max_error_at (x, y),
    energy_ratio. mask: (height, width), pixels above 0.5 count. exposure: a factor before clipping. Raises
    InvalidArgument where sizes differ.
    """
    first, kept = pixels_of(reference, "reference")
    second, held = pixels_of(test, "test")
    counted, owners = plane_of(mask, "mask") if mask is not None else (None, [])
    found = json_of("petzval_compare", ctypes.byref(first), ctypes.byref(second),
                    ctypes.byref(counted) if counted is not None else None, exposure)
    del kept, held, owners
    return found
