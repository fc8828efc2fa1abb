"""DLPack both ways: tensors of other libraries as addresses, and our arrays as capsules."""
from __future__ import annotations

import ctypes

DEVICES = {1: "the CPU", 2: "CUDA", 3: "CUDA's pinned host memory", 4: "OpenCL", 7: "Vulkan", 8: "Metal", 9: "VPI",
           10: "ROCm", 11: "ROCm's host memory", 13: "CUDA's managed memory", 14: "oneAPI", 15: "WebGPU",
           16: "Hexagon", 17: "MAIA"}
HOST = 1
FLOAT, KINDS = 2, {0: "int", 1: "uint", 2: "float", 3: "opaque", 4: "bfloat", 5: "complex", 6: "bool"}


class _Tensor(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("device_type", ctypes.c_int32), ("device_id", ctypes.c_int32),
                ("ndim", ctypes.c_int32), ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8),
                ("lanes", ctypes.c_uint16), ("shape", ctypes.POINTER(ctypes.c_int64)),
                ("strides", ctypes.POINTER(ctypes.c_int64)), ("byte_offset", ctypes.c_uint64)]


class _Managed(ctypes.Structure):
    pass


_Deleter = ctypes.CFUNCTYPE(None, ctypes.POINTER(_Managed))
_Managed._fields_ = [("tensor", _Tensor), ("context", ctypes.c_void_p), ("deleter", _Deleter)]

_pointer = ctypes.pythonapi.PyCapsule_GetPointer
_pointer.argtypes, _pointer.restype = [ctypes.py_object, ctypes.c_char_p], ctypes.c_void_p
_Destructor = ctypes.PYFUNCTYPE(None, ctypes.c_void_p)
_new = ctypes.pythonapi.PyCapsule_New
_new.argtypes, _new.restype = [ctypes.c_void_p, ctypes.c_char_p, _Destructor], ctypes.py_object
_is_valid = ctypes.PYFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_char_p)(
    ("PyCapsule_IsValid", ctypes.pythonapi))
_pointer_of = ctypes.PYFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p)(
    ("PyCapsule_GetPointer", ctypes.pythonapi))


def device_of(tensor) -> str | None:
    """The device that a tensor names, None for the CPU's memory and for objects without DLPack."""
    if not hasattr(tensor, "__dlpack_device__"):
        return None
    kind = int(tensor.__dlpack_device__()[0])
    return None if kind == HOST else DEVICES.get(kind, f"device type {kind}")


class Imported:
    """A CPU tensor: address, shape, strides in bytes, the name of its type. Holds the capsule, and so the memory."""

    def __init__(self, tensor) -> None:
        self._capsule = tensor.__dlpack__()
        found = _Managed.from_address(_pointer(self._capsule, b"dltensor")).tensor
        size = found.bits * found.lanes // 8
        self.shape: tuple[int, ...] = tuple(found.shape[i] for i in range(found.ndim))
        self.address: int = (found.data or 0) + found.byte_offset
        self.type = f"{KINDS.get(found.code, 'unknown')}{found.bits}"
        if found.strides:
            self.strides = tuple(found.strides[i] * size for i in range(found.ndim))
        else:
            self.strides = row_major(self.shape, size)


def row_major(shape: tuple[int, ...], item_bytes: int) -> tuple[int, ...]:
    """Strides in bytes of a packed array."""
    strides = [item_bytes]
    for length in reversed(shape[1:]):
        strides.insert(0, strides[0] * length)
    return tuple(strides)


_lent: dict[int, tuple] = {}  # what a consumer still reads, by the address of its _Managed


@_Deleter
def _delete(managed) -> None:
    _lent.pop(ctypes.addressof(managed.contents), None)


@_Destructor
def _destroy(capsule) -> None:
    if _is_valid(capsule, b"dltensor"):  # nobody took it
        _lent.pop(_pointer_of(capsule, b"dltensor"), None)


def capsule_of(owner, address: int, shape: tuple[int, ...]):
    """A capsule of packed float32 on the CPU. The owner lives as long as the consumer needs it."""
    lengths = (ctypes.c_int64 * len(shape))(*shape)
    strides = (ctypes.c_int64 * len(shape))(*(s // 4 for s in row_major(shape, 4)))
    managed = _Managed()
    managed.tensor = _Tensor(address, HOST, 0, len(shape), FLOAT, 32, 1, lengths, strides, 0)
    managed.deleter = _delete
    _lent[ctypes.addressof(managed)] = (managed, lengths, strides, owner)
    return _new(ctypes.addressof(managed), b"dltensor", _destroy)
