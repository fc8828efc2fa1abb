"""Arrays in and out without copies: the buffer protocol, __array_interface__ and DLPack."""
from __future__ import annotations

import ctypes
import struct
import sys

from . import _dlpack, errors
from ._buffer import Buffer

FLOAT, HALF = 0, 1  # as PETZVAL_FLOAT, PETZVAL_HALF
SAMPLES = {"f": FLOAT, "e": HALF, "f4": FLOAT, "f2": HALF, "float32": FLOAT, "float16": HALF}
BYTES = {FLOAT: 4, HALF: 2}
INTEGERS = "bBhHiIlLqQ"  # letters of the buffer protocol; capitals are unsigned


class Memory:
    """Borrowed samples: address, shape, strides in bytes, FLOAT or HALF, and the object that owns them."""

    owner: object
    address: int
    shape: tuple[int, ...]
    strides: tuple[int, ...]
    sample: int
    readonly: bool

    def __init__(self, owner, address: int, shape: tuple[int, ...], strides: tuple[int, ...], sample: int,
                 readonly: bool) -> None:
        self.owner, self.address, self.sample, self.readonly = owner, address, sample, readonly
        self.shape, self.strides = shape, strides

    def channel(self, index: int) -> int:
        """The address of a channel, the last dimension."""
        return self.address + index * self.strides[2]


def _type_name(kind: str) -> str:
    """A type as numpy calls it, from a letter of the buffer protocol or the code of an array interface."""
    if len(kind) == 1 and kind in INTEGERS:
        return f"{'u' if kind.isupper() else ''}int{8 * struct.calcsize(kind)}"
    if len(kind) == 2 and kind[0] in "iuf" and kind[1].isdigit():
        return {"i": "int", "u": "uint", "f": "float"}[kind[0]] + str(8 * int(kind[1]))
    return {"d": "float64", "?": "bool", "b1": "bool"}.get(kind, kind)


def _sample(kind: str, name: str) -> int:
    if kind in SAMPLES:
        return SAMPLES[kind]
    kind = _type_name(kind)
    if kind in ("uint8", "uint16"):
        raise errors.InvalidArgument(
            f"{name} holds {kind}: display codes, which are not light. petzval takes scene-linear float32 or float16; "
            "decode the picture with its transfer function first")
    raise errors.InvalidArgument(f"{name} holds {kind}; float32 or float16 is needed (nothing is converted silently)")


def _of_interface(array, name: str) -> Memory:
    found = array.__array_interface__
    kind = found["typestr"]
    if kind[0] == ">":
        raise errors.InvalidArgument(f"{name} has big-endian samples; the machine's order is needed")
    address, readonly = found["data"]
    sample = _sample(kind[1:], name)
    shape = tuple(found["shape"])
    strides = found.get("strides") or _dlpack.row_major(shape, BYTES[sample])
    return Memory(array, address, shape, tuple(strides), sample, readonly)


def _packed(array, found: Buffer, sample: int) -> Memory:
    """A read-only copy of a broadcast array, whose pixels share their memory; the C API refuses such strides."""
    copy = ctypes.create_string_buffer(memoryview(array).tobytes())
    strides = _dlpack.row_major(found.shape, BYTES[sample])
    return Memory(copy, ctypes.addressof(copy), found.shape, strides, sample, True)


def memory_of(array, name: str) -> Memory:
    """The samples of any array on the CPU; a broadcast array is copied. `name` stands for it in messages.

    Raises InvalidArgument for other devices (by their name), for integers and float64, and for objects that are no
    arrays.
    """
    device = _dlpack.device_of(array)
    if device:
        raise errors.InvalidArgument(f"{name} lies in the memory of {device}; move it to the CPU first")
    if isinstance(array, Array) or (hasattr(array, "__array_interface__") and not hasattr(array, "__dlpack__")):
        return _of_interface(array, name)
    try:
        found = Buffer(array)
    except (TypeError, BufferError, ValueError):
        if hasattr(array, "__array_interface__"):
            return _of_interface(array, name)
        if not hasattr(array, "__dlpack__"):
            raise errors.InvalidArgument(
                f"{name} is {type(array).__name__}; an array is needed (buffer, __array_interface__ or DLPack)"
            ) from None
        tensor = _dlpack.Imported(array)
        return Memory((array, tensor), tensor.address, tensor.shape, tensor.strides, _sample(tensor.type, name), False)
    sample = _sample(found.format, name)
    if any(stride == 0 and length > 1 for stride, length in zip(found.strides, found.shape)):
        return _packed(array, found, sample)
    return Memory((array, found), found.address, found.shape, found.strides, sample, found.readonly)


class Array:
    """Packed float32 that petzval made: shape (height, width, channels) or (height, width).

    numpy.asarray(array), torch.from_dlpack(array) and memoryview(array.data) share its memory.
    """

    shape: tuple[int, ...]

    def __init__(self, shape: tuple[int, ...]) -> None:
        count = 1
        for length in shape:
            count *= length
        self.shape = tuple(shape)
        self._floats = (ctypes.c_float * count)()

    @property
    def address(self) -> int:
        """Of the first sample."""
        return ctypes.addressof(self._floats)

    @property
    def data(self) -> memoryview:
        """The samples, in the array's shape."""
        return memoryview(self._floats).cast("B").cast("f", self.shape)

    @property
    def __array_interface__(self) -> dict:
        order = "<" if sys.byteorder == "little" else ">"
        return {"version": 3, "shape": self.shape, "typestr": order + "f4", "data": (self.address, False)}

    def __dlpack__(self, *, stream=None, **_):
        return _dlpack.capsule_of(self._floats, self.address, self.shape)

    def __dlpack_device__(self) -> tuple[int, int]:
        return (_dlpack.HOST, 0)

    def rows(self, first: int, last: int) -> "Array":
        """A copy of the rows first…last - 1."""
        row = 4
        for length in self.shape[1:]:
            row *= length
        part = Array((last - first, *self.shape[1:]))
        ctypes.memmove(part.address, self.address + first * row, (last - first) * row)
        return part

    def __getitem__(self, index):
        return self.data[index]

    def __repr__(self) -> str:
        return f"petzval.Array{self.shape}"


def like(given, array: Array):
    """The array as an object of the library that `given` came from: numpy, torch, else itself."""
    module = type(given).__module__.partition(".")[0]
    if module == "numpy":
        return sys.modules["numpy"].asarray(array)
    if module == "torch":
        return sys.modules["torch"].from_dlpack(array)
    return array
