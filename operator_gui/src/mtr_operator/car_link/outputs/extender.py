"""Output for an extender: a message on the Car's bus to a switch in its supply."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from mtr_operator.domain.assistance import OUTPUT, ExtenderPort

from .declared import DeclaredOutput
from .switch import OutputSwitch


class BusExtender(ExtenderPort):
    """Extender on the bus. send, refusal: see OutputSwitch."""

    by = OUTPUT

    def __init__(self, output: DeclaredOutput, send: Callable[[can.Message], threading.Event],
                 refusal: Callable[[], str] = lambda: ""):
        self._switch = OutputSwitch(output, send, refusal)
        self._is_asked = False

    def switch(self, is_on: bool) -> None:
        self._is_asked = True
        self._switch.switch(is_on)

    def is_switched(self) -> bool:
        return self._is_asked and self._switch.is_done()

    def release(self) -> None:
        self._is_asked = False

    def reopened(self) -> None:
        """See OutputSwitch."""
        self._switch.reopened()

    def close(self) -> None:
        """Switch the extender off if it is on; safe to call twice."""
        if self._switch.is_active:
            self._switch.switch(False)
