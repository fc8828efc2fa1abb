"""libpetzval.so, loaded once, with the prototypes of its functions."""
from __future__ import annotations

import ctypes
import functools
import json
import os
import pathlib

from . import _declared, errors

NUMBERS = (ctypes.c_double, ctypes.c_float, ctypes.c_int, ctypes.c_int32, ctypes.c_uint32, ctypes.c_uint64)
SONAME, FILES_SONAME = "libpetzval.so.0", "libpetzval-files.so.0"


def _path(soname: str, variable: str) -> str:
    """The path in an environment variable, else the library inside this package, else the system's."""
    asked = os.environ.get(variable)
    if asked:
        return asked
    own = pathlib.Path(__file__).parent / soname
    return str(own) if own.exists() else soname


def _loaded(path: str, prototypes: dict) -> ctypes.CDLL:
    loaded = ctypes.CDLL(path)
    for name, (result, arguments) in prototypes.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """The loaded library. Raises OSError with the reason where it cannot be loaded."""
    return _loaded(_path(SONAME, "PETZVAL_LIBRARY"), _declared.PROTOTYPES)


@functools.lru_cache(maxsize=None)
def files_library() -> ctypes.CDLL:
    """libpetzval-files.so, which the wheel does not hold. Raises Unsupported where it cannot be loaded."""
    try:
        return _loaded(_path(FILES_SONAME, "PETZVAL_FILES_LIBRARY"), _declared.FILES_PROTOTYPES)
    except OSError as why:
        raise errors.Unsupported(f"files need libpetzval-files.so (PETZVAL_FILES_LIBRARY names it): {why}") from None


def call_files(name: str, *arguments):
    """As call(), of libpetzval-files.so."""
    status = getattr(files_library(), name)(*arguments)
    if status:
        text = files_library().petzval_files_error_text().decode("utf-8", "replace")
        raise errors.BY_STATUS.get(status, errors.Internal)(text)


def call(name: str, *arguments):
    """Calls a function that returns a status. Raises the error of that status, with the library's sentence."""
    status = getattr(library(), name)(*arguments)
    if status:
        text = library().petzval_error_text().decode("utf-8", "replace")
        raise errors.BY_STATUS.get(status, errors.Internal)(text)


def made(handle_type, name: str, *arguments):
    """A handle that a function leaves behind its last argument."""
    handle = ctypes.POINTER(handle_type)()
    call(name, *arguments, ctypes.byref(handle))
    return handle


def text_of(name: str, *arguments) -> str:
    """JSON that a function leaves as a petzval_text, as it is written."""
    text = made(_declared.petzval_text, name, *arguments)
    try:
        return library().petzval_text_json(text).decode()
    finally:
        library().petzval_text_close(text)


def json_of(name: str, *arguments):
    """The same, read: infinity is inf, unknown numbers are None."""
    return json.loads(text_of(name, *arguments))


def names(function: str) -> list[str]:
    """All names that an indexed function gives."""
    found: list[str] = []
    while True:
        name = getattr(library(), function)(len(found))
        if name is None:
            return found
        found.append(name.decode())


def struct(struct_type, **members):
    """A struct of the API with its size set, everything else 0. Raises InvalidArgument for what is not a number."""
    value = struct_type()
    types = dict(struct_type._fields_)
    for name, member in members.items():
        try:
            setattr(value, name, member)
        except TypeError:
            if types[name] not in NUMBERS:
                raise
            raise errors.InvalidArgument(f"{name} is {type(member).__name__}; a number is needed") from None
    if struct_type._fields_[0][0] == "size":
        value.size = ctypes.sizeof(struct_type)
    return value
