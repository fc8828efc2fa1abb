"""Errors of petzval: one class per status of the C API, each also a usual Python error."""


class Error(Exception):
    """Base of all errors. Its text is one sentence that names the field and the accepted values."""

    status = "unknown"


class InvalidArgument(Error, ValueError):
    """An argument, or a field of a look, is wrong or missing."""

    status = "invalid_argument"


class InvalidFile(Error, ValueError):
    """A file is missing, damaged or of another kind."""

    status = "invalid_file"


class Unsupported(Error, NotImplementedError):
    """Understood, but this build, engine or device cannot do it."""

    status = "unsupported"


class OutputFailed(Error, OSError):
    """A file could not be written."""

    status = "output_failed"


class OutOfMemory(Error, MemoryError):
    """More memory than the machine has or than the session may take."""

    status = "out_of_memory"


class Cancelled(Error):
    """A callback asked to stop."""

    status = "cancelled"


class ReadFailed(Error, OSError):
    """The system failed to read a file; another try may succeed."""

    status = "read_failed"


class Internal(Error, RuntimeError):
    """A fault of petzval."""

    status = "internal"


def of_type(value, types, name: str, needed: str):
    """The value. Raises InvalidArgument, which names it, if it is of another type."""
    if not isinstance(value, types):
        raise InvalidArgument(f"{name} is {type(value).__name__}; {needed} is needed")
    return value


BY_STATUS = {1: InvalidArgument, 2: InvalidFile, 3: Unsupported, 4: OutputFailed, 5: OutOfMemory, 6: Cancelled,
             7: Internal, 8: ReadFailed}
