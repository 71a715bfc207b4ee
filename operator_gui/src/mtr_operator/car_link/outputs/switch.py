"""Output that is switched through an adapter, which may fail and recover."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from mtr_operator.domain.errors import RobotFailed

from .declared import DeclaredOutput


class OutputSwitch:
    """Switch that restores idle outputs after adapter failures, but never activates an output late.

    send: passes a frame to the adapter; the returned event is set when the frame has left. refusal: reason why no
    output may be activated now, empty if one may.
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
        """Start switching without waiting. RobotFailed if the output must not be activated now."""
        refusal = self._refusal() if is_active else ""
        if refusal:
            raise RobotFailed(refusal)
        with self._lock:
            self.is_active = is_active
            self._left = self._send(self._output.frame(is_active))

    def is_done(self) -> bool:
        """True if the frame of the last switch() has left."""
        with self._lock:
            return self._left is not None and self._left.is_set()

    def reopened(self) -> None:
        """Handle that the adapter recovered from a failure: deactivate outputs whose deactivation failed, as they are
        still active.

        A failed activation is not repeated, because it would be unexpected by then.
        """
        with self._lock:
            if self._left is not None and not self._left.is_set() and not self.is_active:
                self._left = self._send(self._output.frame(False))
