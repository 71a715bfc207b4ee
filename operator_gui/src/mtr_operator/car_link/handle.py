"""The output that takes the Car's handle: a message on its bus that an actuator at the handle listens to."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any, Callable

import can
import cantools

from mtr_operator.domain.assistance import OUTPUT, HandlePort
from mtr_operator.domain.errors import ConnectionFailed


@dataclass(frozen=True, eq=False)
class HandleOutput:
    """The message of a profile's handle_request. taken, released: its data."""

    can_id: int
    is_extended: bool
    taken: bytes
    released: bytes

    def frame(self, is_taken: bool) -> can.Message:
        """As it is sent."""
        return can.Message(arbitration_id=self.can_id, is_extended_id=self.is_extended,
                           data=self.taken if is_taken else self.released)


def handle_output(message: Any, signal: str, taken: int, released: int) -> HandleOutput:
    """All other signals of the message are 0; ConnectionFailed when the signal has no such values."""
    return HandleOutput(message.frame_id, message.is_extended_frame, _data(message, signal, taken),
                        _data(message, signal, released))


def _data(message: Any, signal: str, value: int) -> bytes:
    values = {each.name: 0 for each in message.signals}
    try:
        return bytes(message.encode({**values, signal: value}, scaling=False, strict=False))
    except (cantools.database.EncodeError, ValueError, OverflowError):
        raise ConnectionFailed(f"Signal {signal} of message {message.name} cannot carry the value {value}.") from None


class BusHandle(HandlePort):
    """send: gives a frame to the adapter; the event that it returns is set when the frame has left."""

    by = OUTPUT

    def __init__(self, output: HandleOutput, send: Callable[[can.Message], threading.Event]):
        self._output = output
        self._send = send
        self._left: threading.Event | None = None

    def request(self, distance_m: float) -> None:
        """See HandlePort."""
        self._left = self._send(self._output.frame(True))

    def is_taken(self) -> bool:
        """See HandlePort."""
        return self._left is not None and self._left.is_set()

    def release(self) -> None:
        """See HandlePort."""
        if self._left is not None:
            self._left = None
            self._send(self._output.frame(False))
