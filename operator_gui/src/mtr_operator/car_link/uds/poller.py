"""Polls the Car's lock state periodically."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Callable

import can

from ..can_frame import CanFrame
from .declared import UdsPoll
from .transport import AnsweredValues

# Sums of periods are not exact.
_EARLY_S = 1e-6


class StatePoller:
    """Periodic requests. send: passes a frame to the adapter. Times are of the laptop's monotonic clock."""

    def __init__(self, poll: UdsPoll, send: Callable[[can.Message], object]):
        self._poll = poll
        self._send = send
        self._values = AnsweredValues(poll.addresses, poll.data_identifier)
        self._asked_s = -math.inf

    def tick(self, now_s: float) -> None:
        """Send a request when it is due."""
        if now_s < self._asked_s + self._poll.every_s - _EARLY_S:
            return
        # The period is kept, unless the adapter was lost meanwhile.
        is_even = now_s < self._asked_s + 2.0 * self._poll.every_s
        self._asked_s = self._asked_s + self._poll.every_s if is_even else now_s
        self._values.ask()
        self._flush()

    def frame(self, frame: CanFrame) -> None:
        """Process a frame: an answer in several frames needs flow control."""
        self._values.frame(frame.can_id, frame.is_extended, frame.data)
        self._flush()

    def _flush(self) -> None:
        addresses = self._poll.addresses
        while self._values.outgoing:
            self._send(can.Message(arbitration_id=addresses.request_id, is_extended_id=addresses.is_extended,
                                   data=self._values.outgoing.popleft()))
