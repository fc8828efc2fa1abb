"""Calls into the library that Ctrl-C and the exceptions of callbacks end."""
from __future__ import annotations

import ctypes
import threading
from typing import Callable


class Interruptible:
    """One call. `stop` is the flag that the library reads; set, it cancels.

    In the main thread the library works in another thread, so that Python may handle signals meanwhile.
    """

    def __init__(self) -> None:
        self.stop = ctypes.c_int(0)
        self._raised: BaseException | None = None

    def guarded(self, function: Callable, refused) -> Callable:
        """A callback whose exceptions are kept for call(), and which returns `refused` then."""
        def callback(*arguments):
            try:
                return function(*arguments)
            except BaseException as raised:  # noqa: BLE001: raised again in call()
                self._keep(raised)
                return refused
        return callback

    def _keep(self, raised: BaseException) -> None:
        self._raised = self._raised or raised

    def call(self, body: Callable[[], None]) -> None:
        """Runs the body. Raises first what a callback or a signal raised, then the body's own error."""
        self.stop.value, self._raised = 0, None
        failure: list[BaseException] = []

        def caught() -> None:
            try:
                body()
            except BaseException as raised:  # noqa: BLE001: raised again below
                failure.append(raised)

        if threading.current_thread() is threading.main_thread():
            self._beside(caught)
        else:
            caught()
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if failure:
            raise failure[0]

    def _beside(self, body: Callable[[], None]) -> None:
        # No join(): where an exception interrupts it, Python 3.11 takes a running thread for a finished one.
        done = threading.Event()

        def finishing() -> None:
            try:
                body()
            finally:
                done.set()

        threading.Thread(target=finishing, name="petzval").start()
        while not done.is_set():
            try:
                done.wait(0.05)
            except BaseException as raised:  # noqa: BLE001: Ctrl-C, or what a signal handler raises
                self.stop.value = 1
                self._keep(raised)
