"""Scripted Operator's end of the link: answers every Status."""
# SPDX-License-Identifier: Apache-2.0
import secrets
import threading
from typing import Any, Callable

import zmq

from mtr_proto import robot_link_pb2 as link

POLL_MS = 50


class OperatorLink:
    """Answers from its own thread, so that a test can let time pass.

    Attributes:
        status: newest Status.
    """

    def __init__(self, status_port: int, command_port: int, on_status: Callable[[], None] = lambda: None):
        """on_status: called from the thread for each Status."""
        self.status = link.Status()
        self._command = link.Command(session_id=secrets.randbits(63) | 1, id=1)
        self._lock, self._on_status = threading.Lock(), on_status
        self._stopped = threading.Event()
        context = zmq.Context.instance()
        self._statuses, self._commands = context.socket(zmq.SUB), context.socket(zmq.PUB)
        self._statuses.setsockopt(zmq.SUBSCRIBE, b"")
        self._statuses.connect(f"tcp://127.0.0.1:{status_port}")
        self._commands.connect(f"tcp://127.0.0.1:{command_port}")
        self._thread = threading.Thread(target=self._answer_all)
        self._thread.start()

    def order(self, **content: Any) -> None:
        """Set the content of the Commands that answer the following Statuses."""
        with self._lock:
            self._command = link.Command(session_id=self._command.session_id, id=self._command.id + 1, **content)

    def send(self, **content: Any) -> None:
        """Set the content of the Commands and send one immediately."""
        self.order(**content)
        self._answer(self.status)

    def close(self) -> None:
        """Stop answering and close the sockets."""
        self._stopped.set()
        self._thread.join()
        self._statuses.close(0)
        self._commands.close(0)

    def _answer_all(self) -> None:
        while not self._stopped.is_set():
            if self._statuses.poll(POLL_MS):
                self._answer(link.Status.FromString(self._statuses.recv()))
                self._on_status()

    def _answer(self, status: link.Status) -> None:
        with self._lock:
            self._command.seen_status_id, self._command.seen_robot_time_s = status.id, status.sent_time_s
            self.status = status
            # A ZeroMQ socket must not be used by two threads at once.
            self._commands.send(self._command.SerializeToString())
