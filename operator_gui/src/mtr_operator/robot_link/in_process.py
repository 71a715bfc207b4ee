"""Link to a robot that is simulated in this process: the bytes of the wire without the wire."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, cast

import zmq

from .client import ZmqRobotLink
from .sockets import LinkSockets

if TYPE_CHECKING:
    from .sockets import Context, Socket


class SteppedRobot(Protocol):
    """Robot whose time advances only when its next Status is requested."""

    def next_status(self) -> bytes:
        """Advance the time to the next Status, with the Commands since the previous one; return its bytes."""

    def take(self, command: bytes) -> None:
        """Receive a Command."""


class InProcessRobotLink(ZmqRobotLink):
    """Session as over sockets, but without waiting; time advances only in next_status."""

    def __init__(self, robot: SteppedRobot):
        super().__init__("127.0.0.1")
        self._robot = robot

    def connect(self) -> None:
        socket = cast("Socket", _Wire(self._robot))
        self._sockets = LinkSockets(cast("Context", socket), socket, socket)


class _Wire:
    """Substitute of the sockets and their context, as far as the link uses them."""

    def __init__(self, robot: SteppedRobot):
        self._robot = robot
        self._waiting: list[bytes] = []

    def poll(self, timeout_ms: int) -> bool:
        """Produce the next Status; it is available at once."""
        self._waiting.append(self._robot.next_status())
        return True

    def recv_multipart(self, flags: int) -> list[bytes]:
        """Return a Status, if one is queued."""
        if not self._waiting:
            raise zmq.Again
        return [self._waiting.pop(0)]

    def send(self, command: bytes) -> None:
        """Send a Command to the robot."""
        self._robot.take(command)

    def close(self, linger: Any = None) -> None:
        """Do nothing, because nothing is open."""

    def term(self) -> None:
        """Do nothing, because nothing is open."""
