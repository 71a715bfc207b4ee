"""TCP connection to a device that reports the phone's distance; nothing is sent on it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import socket

from .line_feed import READ_S, Source, SourceLost

_OPEN_S = 5.0
_CHUNK = 4096


class TcpSource(Source):
    """TCP client. host: loopback, or any address that the person enters."""

    def __init__(self, host: str, port: int):
        self.name = f"TCP {host}:{port}"
        self._address = (host, port)
        self._socket: socket.socket | None = None

    def open(self) -> None:
        """See Source."""
        try:
            self._socket = socket.create_connection(self._address, timeout=_OPEN_S)
            self._socket.settimeout(READ_S)
        except socket.timeout:
            raise SourceLost(f"nobody has answered for {_OPEN_S:g} s") from None
        except (OSError, UnicodeError) as error:
            raise SourceLost(_text(error)) from None

    def read(self) -> bytes:
        """See Source."""
        if self._socket is None:
            raise SourceLost("it is not connected")
        try:
            data = self._socket.recv(_CHUNK)
        except socket.timeout:
            return b""
        except OSError as error:
            raise SourceLost(_text(error)) from None
        if not data:
            raise SourceLost("the other side has closed the connection")
        return data

    def close(self) -> None:
        """See Source."""
        opened, self._socket = self._socket, None
        if opened is not None:
            opened.close()


def _text(error: Exception) -> str:
    """Return the error as the system describes it, which begins with a capital letter."""
    text = str(getattr(error, "strerror", None) or error).rstrip(".")
    return f"{text[:1].lower()}{text[1:]}"
