"""How long simulated time waits for the Operator's application."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Callable

from .session import ControlSession


class OperatorWait:
    """At each tick: begin, then ask is_over until it is.

    Attributes:
        operator_gone: an application in control that owed an answer for too long; nobody waits before its next Command.
    """

    def __init__(self, lost_after_wall_s: float, wall_clock: Callable[[], float] = time.monotonic):
        self._lost_after_wall_s, self._wall_clock = lost_after_wall_s, wall_clock
        self._patient_until = 0.0
        self.operator_gone = False

    def begin(self) -> None:
        """A Status has been published that wants an answer."""
        self._patient_until = self._wall_clock() + self._lost_after_wall_s

    def received(self) -> None:
        """The application in control has sent a Command."""
        self.operator_gone = False
        self.begin()

    def is_over(self, session: ControlSession, status_id: int) -> bool:
        """True when the tick goes on: the Status is answered, or the application in control is gone.

        Without an application in control time stands still until one comes.
        """
        if session.answered_status_id >= status_id:
            return True
        if session.session_id and self._wall_clock() >= self._patient_until:
            self.operator_gone = True
        return bool(session.session_id) and self.operator_gone
