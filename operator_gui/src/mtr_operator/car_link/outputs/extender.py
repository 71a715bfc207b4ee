"""The output that switches an extender: a message on the Car's bus that a switch in its supply listens to."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from mtr_operator.domain.assistance import OUTPUT, ExtenderPort

from ..handle import HandleOutput


class BusExtender(ExtenderPort):
    """send: gives a frame to the adapter; the event that it returns is set when the frame has left."""

    by = OUTPUT

    def __init__(self, output: HandleOutput, send: Callable[[can.Message], threading.Event]):
        self._output = output
        self._send = send
        self._left: threading.Event | None = None
        self._is_on = False

    def switch(self, is_on: bool) -> None:
        """See ExtenderPort."""
        self._is_on = is_on
        self._left = self._send(self._output.frame(is_on))

    def is_switched(self) -> bool:
        """See ExtenderPort."""
        return self._left is not None and self._left.is_set()

    def release(self) -> None:
        """See ExtenderPort."""
        self._left = None

    def close(self) -> None:
        """Leave no extender on behind; safe to call twice."""
        if self._is_on:
            self.switch(False)
