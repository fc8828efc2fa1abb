# Written by tools/python_stubs.py; not edited.
"""Arrays in and out without copies: the buffer protocol, __array_interface__ and DLPack."""
from __future__ import annotations
import ctypes
import struct
import sys
from . import _dlpack, errors
from ._buffer import Buffer
FLOAT: int
HALF: int
SAMPLES: dict
BYTES: dict
INTEGERS = 'bBhHiIlLqQ'

class Memory:
    """Borrowed samples: address, shape, strides in bytes, FLOAT or HALF, and the object that owns them."""
    owner: object
    address: int
    shape: tuple[int, ...]
    strides: tuple[int, ...]
    sample: int
    readonly: bool

    def __init__(self, owner, address: int, shape: tuple[int, ...], strides: tuple[int, ...], sample: int, readonly: bool) -> None:
        ...

    def channel(self, index: int) -> int:
        """The address of a channel, the last dimension."""

def memory_of(array, name: str) -> Memory:
    """The samples of any array on the CPU; a broadcast array is copied. `name` stands for it in messages.

    Raises InvalidArgument for other devices (by their name), for integers and float64, and for objects that are no
    arrays.
    """

class Array:
    """Packed float32 that petzval made: shape (height, width, channels) or (height, width).

    numpy.asarray(array), torch.from_dlpack(array) and memoryview(array.data) share its memory.
    """
    shape: tuple[int, ...]

    def __init__(self, shape: tuple[int, ...]) -> None:
        ...

    @property
    def address(self) -> int:
        """Of the first sample."""

    @property
    def data(self) -> memoryview:
        """The samples, in the array's shape."""

    @property
    def __array_interface__(self) -> dict:
        ...

    def __dlpack__(self, *, stream=None, **_):
        ...

    def __dlpack_device__(self) -> tuple[int, int]:
        ...

    def rows(self, first: int, last: int) -> 'Array':
        """A copy of the rows first…last - 1."""

    def __getitem__(self, index):
        ...

    def __repr__(self) -> str:
        ...

def like(given, array: Array):
    """The array as an object of the library that `given` came from: numpy, torch, else itself."""
