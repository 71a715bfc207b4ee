"""Link to a Car that is simulated in this process; its frames pass without an adapter."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from typing import Callable

import can

from ..bus import CanCarLink
from ..can_frame import CanFrame
from ..reader import CanReader

# The stamps restart each minute, as an adapter's stamps do.
_STAMP_MODULO_MS = 60_000
_MAX_STANDARD_ID = 0x7FF
_NS_PER_MS = 1_000_000


class _Direct(CanReader):
    """Reader without a thread: frames are received and sent immediately."""

    def start(self) -> None:
        """See CanReader."""

    def stop(self) -> None:
        """See CanReader."""

    def settled(self) -> Callable[[], bool]:
        """See CanReader: all frames have arrived, and waiting would block further ones."""
        return lambda: True

    def send(self, message: can.Message) -> threading.Event:
        """See CanReader."""
        assert isinstance(self._sink, InProcessCarLink)
        self._sink.to_car(message.arbitration_id, bytes(message.data))
        left = threading.Event()
        left.set()
        return left


class InProcessCarLink(CanCarLink):
    """Lock watch as behind an adapter that stamps its frames.

    profile: of the Car. clock: simulated time in s, replaces the laptop's. to_car: receives identifier and data of each
    frame to the Car.
    """

    READER = _Direct

    def __init__(self, profile: str, clock: Callable[[], float], to_car: Callable[[int, bytes], None]):
        super().__init__("virtual", "simulation", profile=profile, clock=clock, is_listening=False)
        self.to_car = to_car

    def received(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Receive a frame of the Car that was on the bus at this time."""
        stamp_ms = time_ns // _NS_PER_MS % _STAMP_MODULO_MS
        self.frame(CanFrame(can_id, can_id > _MAX_STANDARD_ID, data, self._clock(), stamp_ms))
