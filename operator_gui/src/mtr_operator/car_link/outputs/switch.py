"""An output that is switched through an adapter which may fail and come back."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from mtr_operator.domain.errors import RobotFailed

from .declared import DeclaredOutput


class OutputSwitch:
    """Keeps that an idle output is idle, however often the adapter fails; an active one it never makes late.

    send: gives a frame to the adapter; the event that it returns is set when the frame has left. refusal: why no output
    may be made active now, empty when one may.
    """

    def __init__(self, output: DeclaredOutput, send: Callable[[can.Message], threading.Event],
                 refusal: Callable[[], str] = lambda: ""):
        self._output = output
        self._send = send
        self._refusal = refusal
        self._left: threading.Event | None = None
        self._lock = threading.Lock()
        self.is_active = False

    def switch(self, is_active: bool) -> None:
        """Have it switched. Does not wait. RobotFailed when it must not be made active now."""
        refusal = self._refusal() if is_active else ""
        if refusal:
            raise RobotFailed(refusal)
        with self._lock:
            self.is_active = is_active
            self._left = self._send(self._output.frame(is_active))

    def is_done(self) -> bool:
        """True when the frame of the last switch() has left."""
        with self._lock:
            return self._left is not None and self._left.is_set()

    def reopened(self) -> None:
        """The adapter is back after a failure: make idle what could not be made idle meanwhile, for it is active still.

        What could not be made active is not made good: it would come when nobody expects it any more.
        """
        with self._lock:
            if self._left is not None and not self._left.is_set() and not self.is_active:
                self._left = self._send(self._output.frame(False))
