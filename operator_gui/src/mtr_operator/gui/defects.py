"""A defect of the application: what is measured is kept, it is said, and the window stays.

Without this PyQt ends the process at the first exception in a slot, with the robot under way.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import sys
import threading
from types import TracebackType
from typing import Any, Callable

from PyQt5.QtCore import QObject, pyqtSignal

# One that returns with each picture is said once in so many.
_SAID_OF = 1000
_MAX_SHOWN = 200


class Defects(QObject):
    """Takes the exceptions that nobody has caught, of all threads, from install() to remove().

    Signals: found(text), in the thread of the window.
    """

    found = pyqtSignal(str)

    def __init__(self) -> None:
        super().__init__()
        self._counts: dict[str, int] = {}
        self._former: tuple[Callable[..., Any], Callable[..., Any]] | None = None

    def install(self) -> None:
        """Begin."""
        self._former = sys.excepthook, threading.excepthook
        sys.excepthook = self._take
        threading.excepthook = lambda arguments: self._take(
            arguments.exc_type, arguments.exc_value, arguments.exc_traceback)

    def remove(self) -> None:
        """End; safe to call twice."""
        if self._former is not None:
            sys.excepthook, threading.excepthook = self._former
            self._former = None

    def _take(self, kind: type[BaseException], error: BaseException | None, trace: TracebackType | None) -> None:
        text = f"The application has a defect: {kind.__name__}: {str(error)[:_MAX_SHOWN]}"
        count = self._counts[text] = self._counts.get(text, 0) + 1
        if count % _SAID_OF != 1:
            return
        if self._former is not None:
            self._former[0](kind, error, trace)
        if not issubclass(kind, (KeyboardInterrupt, SystemExit)):
            # Of another thread it is queued.
            self.found.emit(text)
