"""The robot's end of the link: two bound ZeroMQ sockets whose memory nobody outside can fill."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple

import zmq

from mtr_core.errors import RobotError

from .command_codec import MAX_MESSAGE_BYTES

# Whole messages that wait per connection. Parts of an unfinished one are not counted by ZeroMQ: see `rebind`.
RECEIVE_QUEUE = 10
SEND_QUEUE = 100
MESSAGES_PER_TURN = 100
# A peer that vanished without closing is noticed by ZeroMQ's own heartbeats.
HEARTBEAT_MS = 1000
HEARTBEAT_TIMEOUT_MS = 5000
LINGER_MS = 200


class LinkError(RobotError):
    """The ports of the link cannot be opened."""


class Ports(NamedTuple):
    """Where the link listens."""

    address: str
    status_port: int
    command_port: int


class LinkServer:
    """Publishes Status on one port and receives Commands on the other."""

    def __init__(self, ports: Ports) -> None:
        self._ports = ports
        self._open()

    def bind(self) -> None:
        """Listen on both ports of the address, or raise LinkError with a sentence."""
        address, status_port, command_port = self._ports
        for socket, port, name in ((self._publisher, status_port, "status_port"),
                                   (self._subscriber, command_port, "command_port")):
            try:
                socket.bind(f"tcp://{address}:{port}")
            except zmq.ZMQError as error:
                self.close()
                raise LinkError(f"The link cannot listen on {address} port {port} ({name}): "
                                f"{error.strerror}.") from None

    def rebind(self) -> None:
        """Cut off everybody and listen anew: what strangers have left in ZeroMQ's memory goes with their connections.

        Applications connect again by themselves.
        """
        self._context.destroy(0)
        self._open()
        self.bind()

    def publish(self, status: bytes) -> None:
        """Send one Status to every application that listens."""
        self._publisher.send(status)

    def receive(self, timeout_s: float = 0.0) -> List[bytes]:
        """Messages that have arrived, in order; waits up to timeout_s for the first one."""
        if not self._subscriber.poll(math.ceil(1000.0 * max(timeout_s, 0.0))):
            return []
        messages: List[bytes] = []
        while len(messages) < MESSAGES_PER_TURN:
            try:
                frames = self._subscriber.recv_multipart(zmq.NOBLOCK)
            except zmq.Again:
                break
            # A message of several frames is none of ours; joined, it is counted as undecodable or oversized.
            messages.append(frames[0] if len(frames) == 1 else b"\xff".join([b"", *frames]))
        return messages

    def close(self) -> None:
        """Release both ports."""
        self._context.destroy(LINGER_MS)

    def _open(self) -> None:
        self._context = zmq.Context()
        self._publisher = self._socket(zmq.PUB)
        self._publisher.setsockopt(zmq.SNDHWM, SEND_QUEUE)
        # libzmq 4.3.4 aborts (stream_engine_base.cpp, "!_io_error") when a peer goes whose subscriptions have filled
        # the queue, so the queue has no end; the memory of the process is bounded instead, see memory.py.
        self._publisher.setsockopt(zmq.RCVHWM, 0)
        self._subscriber = self._socket(zmq.SUB)
        self._subscriber.setsockopt(zmq.RCVHWM, RECEIVE_QUEUE)
        self._subscriber.setsockopt(zmq.SUBSCRIBE, b"")

    def _socket(self, kind: int) -> "zmq.Socket[bytes]":
        socket = self._context.socket(kind)
        # Beyond it ZeroMQ cuts the connection; on the port of Status it bounds a subscription.
        socket.setsockopt(zmq.MAXMSGSIZE, MAX_MESSAGE_BYTES)
        socket.setsockopt(zmq.HEARTBEAT_IVL, HEARTBEAT_MS)
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, HEARTBEAT_TIMEOUT_MS)
        return socket
