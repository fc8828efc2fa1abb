"""libpetzval.so, loaded once, with the prototypes of its functions."""
from __future__ import annotations

import ctypes
import functools
import json
import os
import pathlib

from . import _declared, errors

SONAME = "libpetzval.so.0"


def _path() -> str:
    """PETZVAL_LIBRARY, else the library inside this package, else the system's."""
    asked = os.environ.get("PETZVAL_LIBRARY")
    if asked:
        return asked
    own = pathlib.Path(__file__).parent / SONAME
    return str(own) if own.exists() else SONAME


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """The loaded library. Raises OSError with the reason where it cannot be loaded."""
    loaded = ctypes.CDLL(_path())
    for name, (result, arguments) in _declared.PROTOTYPES.items():
        function = getattr(loaded, name)
        function.restype, function.argtypes = result, arguments
    return loaded


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


def json_of(name: str, *arguments):
    """JSON that a function leaves as a petzval_text: infinity is inf, unknown numbers are None."""
    text = made(_declared.petzval_text, name, *arguments)
    try:
        return json.loads(library().petzval_text_json(text))
    finally:
        library().petzval_text_close(text)


def names(function: str) -> list[str]:
    """All names that an indexed function gives."""
    found: list[str] = []
    while True:
        name = getattr(library(), function)(len(found))
        if name is None:
            return found
        found.append(name.decode())


def struct(kind, **members):
    """A struct of the API with its size set, everything else 0."""
    value = kind(**members)
    if kind._fields_[0][0] == "size":
        value.size = ctypes.sizeof(kind)
    return value
