"""In-process CAN port: frames of the simulated Car go directly to the application."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Callable

from mtr_simulation.car.can_port import CanPort, SentFrame


def _nobody(can_id: int, data: bytes, time_ns: int) -> None:
    """Discard frames before the application is connected."""


class DirectPort(CanPort):
    """Attributes: receiver: callback with identifier, data and time in ns of each frame."""

    def __init__(self) -> None:
        self.receiver: Callable[[int, bytes, int], None] = _nobody
        self._sent: list[SentFrame] = []

    def poll(self) -> None:
        """See CanPort."""

    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """See CanPort."""
        self.receiver(can_id, data, time_ns)

    def take(self, can_id: int, data: bytes) -> None:
        """Accept a frame of the application."""
        self._sent.append(SentFrame(can_id, data))

    def taken(self) -> list[SentFrame]:
        """See CanPort."""
        taken, self._sent = self._sent, []
        return taken
