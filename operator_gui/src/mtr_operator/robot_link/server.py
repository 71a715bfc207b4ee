"""The two bound ports of a robot, without a robot behind them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TYPE_CHECKING

import zmq

from mtr_operator.domain.errors import ConnectionFailed

if TYPE_CHECKING:
    from .sockets import Context, Socket

LOOPBACK = "127.0.0.1"


class ConnectionServer:
    """Binds Status (PUB) and Command (SUB) ports; a context manager. Port 0 lets the system choose.

    Attributes:
        subscriber_port: where the Operator subscribes; publisher_port: where the Operator publishes.
    """

    def __init__(self, subscriber_port: int = 0, publisher_port: int = 0, bind_address: str = LOOPBACK):
        self.subscriber_port = subscriber_port
        self.publisher_port = publisher_port
        self._bind_address = bind_address
        self._context: Context | None = None
        self._status_socket: Socket | None = None
        self._command_socket: Socket | None = None

    @property
    def status_socket(self) -> Socket:
        """PUB socket of Status; available after open()."""
        return _opened(self._status_socket)

    @property
    def command_socket(self) -> Socket:
        """SUB socket of Command; available after open()."""
        return _opened(self._command_socket)

    def open(self) -> None:
        """Bind both ports, or raise ConnectionFailed naming the busy one."""
        self._context = zmq.Context()
        self._status_socket = self._context.socket(zmq.PUB)
        self._command_socket = self._context.socket(zmq.SUB)
        self.command_socket.setsockopt(zmq.SUBSCRIBE, b"")
        self.subscriber_port = self._bind(self.status_socket, self.subscriber_port)
        self.publisher_port = self._bind(self.command_socket, self.publisher_port)

    def close(self) -> None:
        """Release both ports; safe to call twice."""
        if self._context is not None:
            self._context.destroy(linger=0)
            self._context = None

    def __enter__(self) -> ConnectionServer:
        self.open()
        return self

    def __exit__(self, *_error: object) -> None:
        self.close()

    def _bind(self, socket: Socket, port: int) -> int:
        socket.setsockopt(zmq.LINGER, 0)
        try:
            socket.bind(f"tcp://{self._bind_address}:{port or '*'}")
        except zmq.ZMQError as error:
            self.close()
            raise ConnectionFailed(f"Cannot listen on port {port} of {self._bind_address}: {error.strerror}.") from None
        return int(socket.getsockopt_string(zmq.LAST_ENDPOINT).rsplit(":", 1)[1])


def _opened(socket: Socket | None) -> Socket:
    if socket is None:
        raise ConnectionFailed("The ports are not open.")
    return socket
