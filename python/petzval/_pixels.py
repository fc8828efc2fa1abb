"""Arrays as the C API's pictures and planes."""
from __future__ import annotations

import ctypes

from . import _declared, errors
from ._library import struct
from .arrays import Memory, memory_of

Kept = list  # objects that must live as long as the struct that points at them


def _checked_planes(planes, name: str) -> list[Memory]:
    memories = [memory_of(plane, f"{name}[{i}]") for i, plane in enumerate(planes)]
    first = memories[0]
    for memory in memories:
        if len(memory.shape) != 2:
            raise errors.InvalidArgument(f"{name}: separate planes have shape (height, width), not {memory.shape}")
        if (memory.shape, memory.strides, memory.sample) != (first.shape, first.strides, first.sample):
            raise errors.InvalidArgument(f"{name}: its planes must have one shape, type and strides")
    return memories


def _channels(array, name: str) -> tuple[Memory, list[int], Kept]:
    """The first memory, the addresses of 3 or 4 channels, and what must be kept."""
    if isinstance(array, (tuple, list)):
        if len(array) not in (3, 4):
            raise errors.InvalidArgument(f"{name} has {len(array)} planes; 3 or 4 are needed")
        memories = _checked_planes(array, name)
        return memories[0], [m.address for m in memories], memories
    memory = memory_of(array, name)
    if len(memory.shape) != 3 or memory.shape[2] not in (3, 4):
        hint = "; permute(1, 2, 0) shows it so without a copy" if memory.shape[:1] in ((3,), (4,)) else ""
        raise errors.InvalidArgument(
            f"{name} has shape {memory.shape}; (height, width, 3 or 4) is needed, or separate planes{hint}")
    return memory, [memory.channel(c) for c in range(memory.shape[2])], [memory]


def pixels_of(array, name: str, written: bool = False) -> tuple[_declared.petzval_pixels, Kept]:
    """A picture's struct and what it points at. written: petzval is to write it. Raises InvalidArgument."""
    memory, channels, kept = _channels(array, name)
    if written and memory.readonly:
        raise errors.InvalidArgument(f"{name} is read-only")
    height, width = memory.shape[:2]
    red, green, blue, *alpha = channels
    return struct(_declared.petzval_pixels, width=width, height=height, sample=memory.sample, r=red, g=green, b=blue,
                  a=alpha[0] if alpha else None, pixel_stride=memory.strides[1], row_stride=memory.strides[0]), kept


def plane_of(array, name: str) -> tuple[_declared.petzval_plane, Kept]:
    """A plane's struct and what it points at; (height, width), or with one channel. Raises InvalidArgument."""
    memory = memory_of(array, name)
    if len(memory.shape) not in (2, 3) or (len(memory.shape) == 3 and memory.shape[2] != 1):
        raise errors.InvalidArgument(f"{name} has shape {memory.shape}; (height, width) is needed")
    return struct(_declared.petzval_plane, width=memory.shape[1], height=memory.shape[0], sample=memory.sample,
                  data=memory.address, pixel_stride=memory.strides[1], row_stride=memory.strides[0]), [memory]


def pointer(value):
    """A pointer to a struct, or None."""
    return None if value is None else ctypes.pointer(value)
