"""The Operator's stop: it is sent in the calling thread, and no motion command is sent after it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import threading
from dataclasses import replace
from typing import Callable

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.requests import DesiredState


class StopOrder:
    """Stop order, thread-safe; one per application over all sessions.

    While it is in force each sent desired state is a stop. An order of the Operator lifts it, unless a stop was given
    after that order.
    """

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._count = 0
        self._is_in_force = self._enters_service = False
        self._send: Callable[[DesiredState], None] | None = None
        self._newest = DesiredState()

    @property
    def is_in_force(self) -> bool:
        """True from a stop to the next order."""
        return self._is_in_force

    @property
    def ticket(self) -> int:
        """Return the ticket of an order that is given now, for lift()."""
        return self._count

    def give(self, *, enters_service: bool = False) -> None:
        """Send a stop now, from any thread, even if the link's own thread is waiting. Without a session there is no
        recipient, and the robot is stopped. enters_service: it also orders service mode until that is active."""
        with self._lock, contextlib.suppress(OperatorError):
            self._count += 1
            self._is_in_force = True
            self._enters_service = self._enters_service or enters_service
            if self._send is not None:
                self._send(self._stopped(self._newest))

    def entered_service(self) -> None:
        """Record that service mode is active: a stop that remains in force does not order it again."""
        with self._lock:
            self._enters_service = False

    def lift(self, ticket: int) -> bool:
        """Execute the order with this ticket; return False if a later stop forbids it."""
        with self._lock:
            self._is_in_force = ticket != self._count
            self._enters_service = self._enters_service and self._is_in_force
            return not self._is_in_force

    def withdraw(self) -> None:
        """Record that the stop has no recipient; it stays in force for each order that was given before it, see
        lift()."""
        with self._lock:
            self._is_in_force = self._enters_service = False

    def attach(self, send: Callable[[DesiredState], None]) -> None:
        """Start a session whose desired states are sent by this function."""
        with self._lock:
            self._send, self._newest = send, DesiredState()

    def detach(self) -> None:
        """End the session."""
        with self._lock:
            self._send = None

    def pass_on(self, send: Callable[[DesiredState], None], desired: DesiredState) -> None:
        """Send a desired state, as a stop while one is in force."""
        with self._lock:
            self._newest = desired
            send(self._stopped(desired) if self._is_in_force else desired)

    def _stopped(self, desired: DesiredState) -> DesiredState:
        return replace(desired, stop=True, press=None, enters_service=self._enters_service)
