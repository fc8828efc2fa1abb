"""Addresses behind Python's buffer protocol, for strided and read-only buffers too."""
from __future__ import annotations

import ctypes


class _PyBuffer(ctypes.Structure):  # Py_buffer of the C API of Python 3
    _fields_ = [("buf", ctypes.c_void_p), ("obj", ctypes.c_void_p), ("len", ctypes.c_ssize_t),
                ("itemsize", ctypes.c_ssize_t), ("readonly", ctypes.c_int), ("ndim", ctypes.c_int),
                ("format", ctypes.c_char_p), ("shape", ctypes.POINTER(ctypes.c_ssize_t)),
                ("strides", ctypes.POINTER(ctypes.c_ssize_t)), ("suboffsets", ctypes.POINTER(ctypes.c_ssize_t)),
                ("internal", ctypes.c_void_p)]


_get = ctypes.pythonapi.PyObject_GetBuffer
_get.argtypes, _get.restype = [ctypes.py_object, ctypes.POINTER(_PyBuffer), ctypes.c_int], ctypes.c_int
_release = ctypes.pythonapi.PyBuffer_Release
_release.argtypes, _release.restype = [ctypes.POINTER(_PyBuffer)], None
_STRIDED_WITH_FORMAT = 0x0018 | 0x0004  # PyBUF_STRIDES | PyBUF_FORMAT


class Buffer:
    """A borrowed buffer: address, shape, strides in bytes, format. It is given back when this object ends."""

    def __init__(self, exporter) -> None:
        self._buffer = _PyBuffer()
        self._held = False
        _get(exporter, ctypes.byref(self._buffer), _STRIDED_WITH_FORMAT)  # raises what the exporter raises
        self._held = True
        b = self._buffer
        self.address: int = b.buf or 0
        self.format: str = (b.format or b"B").decode().lstrip("@=<")
        self.shape: tuple[int, ...] = tuple(b.shape[i] for i in range(b.ndim))
        self.strides: tuple[int, ...] = tuple(b.strides[i] for i in range(b.ndim))
        self.readonly: bool = bool(b.readonly)

    def __del__(self) -> None:
        if self._held:
            self._held = False
            _release(ctypes.byref(self._buffer))
