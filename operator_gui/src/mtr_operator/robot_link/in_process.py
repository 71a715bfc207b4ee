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
    """A robot whose time passes when somebody asks for its next Status."""

    def next_status(self) -> bytes:
        """Let time pass until the next Status, with what was taken since the one before; its bytes."""

    def take(self, command: bytes) -> None:
        """A Command."""


class InProcessRobotLink(ZmqRobotLink):
    """The same session as over sockets; nobody waits, and time passes in next_status alone."""

    def __init__(self, robot: SteppedRobot):
        super().__init__("127.0.0.1")
        self._robot = robot

    def connect(self) -> None:
        socket = cast("Socket", _Wire(self._robot))
        self._sockets = LinkSockets(cast("Context", socket), socket, socket)


class _Wire:
    """What the link asks of its sockets and their context."""

    def __init__(self, robot: SteppedRobot):
        self._robot = robot
        self._waiting: list[bytes] = []

    def poll(self, timeout_ms: int) -> bool:
        """The next Status is there as soon as somebody waits for it."""
        self._waiting.append(self._robot.next_status())
        return True

    def recv_multipart(self, flags: int) -> list[bytes]:
        """A Status, if one waits."""
        if not self._waiting:
            raise zmq.Again
        return [self._waiting.pop(0)]

    def send(self, command: bytes) -> None:
        """A Command to the robot."""
        self._robot.take(command)

    def close(self, linger: Any = None) -> None:
        """Nothing is open."""

    def term(self) -> None:
        """Nothing is open."""
