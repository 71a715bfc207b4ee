"""Serial line of a device that reports the phone's distance; nothing is sent on it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import serial

from .line_feed import READ_S, Source, SourceLost

_CHUNK = 4096


class SerialSource(Source):
    """Serial line. device: such as /dev/ttyUSB0 or COM5."""

    def __init__(self, device: str, baud: int):
        self.name = f"serial line {device}, {baud} baud"
        self._device, self._baud = device, baud
        self._port: serial.Serial | None = None

    def open(self) -> None:
        """See Source."""
        try:
            self._port = serial.Serial(self._device, self._baud, timeout=READ_S)
        # pyserial passes on the system's exceptions for values that the system rejects.
        except (OSError, ValueError) as error:
            raise SourceLost(_text(error)) from None

    def read(self) -> bytes:
        """See Source."""
        if self._port is None:
            raise SourceLost("it is not open")
        try:
            return bytes(self._port.read(min(max(self._port.in_waiting, 1), _CHUNK)))
        # pyserial raises TypeError if the device is unplugged during a read.
        except (OSError, TypeError) as error:
            raise SourceLost(_text(error)) from None

    def close(self) -> None:
        """See Source."""
        port, self._port = self._port, None
        if port is not None:
            port.close()


def _text(error: Exception) -> str:
    """Return the error on one line."""
    return " ".join(str(error).split()).rstrip(".")
