"""Relay in front of the link's two ports; applications that connect through it experience faults of a Wi-Fi."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import queue
import socket
import threading
import time
from typing import Callable, List, Optional, Tuple

from mtr_core.errors import RobotError

from ..parts import Kind
from ..schedule import Fault
from .frames import FrameCutter, FrameSpoiler

CHUNK_BYTES = 65536
BACKLOG = 16
# Capacity of the queue between reader and writer, pieces; when it is full, the sender is blocked.
QUEUED = 10000
Current = Callable[[], Optional[Fault]]
_END = b""


class RelayError(RobotError):
    """The relay cannot listen."""


class PortRelay:
    """Relay of one port of the link. to_robot, from_robot: return the current fault of each direction."""

    def __init__(self, listen: Tuple[str, int], robot: Tuple[str, int], to_robot: Current, from_robot: Current):
        self._robot, self._to_robot, self._from_robot = robot, to_robot, from_robot
        self._open: List[socket.socket] = []
        try:
            self._listener = socket.create_server(listen, backlog=BACKLOG)
        except OSError as error:
            raise RelayError(f"The relay of the link cannot listen on {listen[0]} port {listen[1]}: "
                             f"{error.strerror}.") from None
        threading.Thread(target=self._accept, name="relay", daemon=True).start()

    def close(self) -> None:
        """Close all connections."""
        for each in (self._listener, *self._open):
            _shut(each)

    def _accept(self) -> None:
        number = 0
        while True:
            try:
                near, _ = self._listener.accept()
            except OSError:
                return
            try:
                far = socket.create_connection(self._robot)
            except OSError:
                near.close()
                continue
            self._open = [each for each in self._open if each.fileno() >= 0] + [near, far]
            for source, target, current in ((near, far, self._to_robot), (far, near, self._from_robot)):
                number += 1
                _Direction(source, target, current, number).start()


class _Direction:
    """Relays one direction with a reader and a writer thread, so that delayed data does not block the reader."""

    def __init__(self, source: socket.socket, target: socket.socket, current: Current, seed: int):
        self._source, self._target, self._current = source, target, current
        self._cutter, self._spoiler = FrameCutter(), FrameSpoiler(seed)
        self._under_way: queue.Queue[Tuple[float, bytes]] = queue.Queue(QUEUED)

    def start(self) -> None:
        """Start both threads."""
        for work in (self._read, self._write):
            threading.Thread(target=work, name="relay", daemon=True).start()

    def _read(self) -> None:
        data = b"?"
        while data:
            try:
                data = self._source.recv(CHUNK_BYTES)
            except OSError:
                data = b""
            fault = self._current()
            due_s = time.monotonic() + (fault.amount if fault and fault.kind is Kind.SLOW else 0.0)
            for frame in self._cutter.feed(data):
                for piece in self._spoiler.passed(frame, fault):
                    self._under_way.put((due_s, piece))
        self._under_way.put((0.0, _END))

    def _write(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                due_s, piece = self._under_way.get()
                if piece == _END:
                    break
                time.sleep(max(due_s - time.monotonic(), 0.0))
                self._target.sendall(piece)
        _shut(self._source)
        _shut(self._target)


def _shut(connection: socket.socket) -> None:
    with contextlib.suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
    connection.close()
