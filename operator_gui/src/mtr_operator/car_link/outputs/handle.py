"""Output that pulls the Car's handle: a message on its bus to an actuator at the handle."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from mtr_operator.domain.assistance import OUTPUT, HandlePort

from .declared import DeclaredOutput
from .switch import OutputSwitch


class BusHandle(HandlePort):
    """Handle actuator on the bus. send, refusal: see OutputSwitch."""

    by = OUTPUT

    def __init__(self, output: DeclaredOutput, send: Callable[[can.Message], threading.Event],
                 refusal: Callable[[], str] = lambda: ""):
        self._switch = OutputSwitch(output, send, refusal)

    def request(self, distance_m: float) -> None:
        self._switch.switch(True)

    def is_taken(self) -> bool:
        return self._switch.is_active and self._switch.is_done()

    def release(self) -> None:
        if self._switch.is_active:
            self._switch.switch(False)

    def reopened(self) -> None:
        """See OutputSwitch."""
        self._switch.reopened()
