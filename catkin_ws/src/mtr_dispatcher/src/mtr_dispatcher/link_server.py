"""The robot's end of the link: two bound ZeroMQ sockets whose memory nobody outside can fill."""
# SPDX-License-Identifier: Apache-2.0
import math
import sys
from typing import Any, Counter, List, NamedTuple, Optional

import zmq

from mtr_core.errors import RobotError

from .access.connection_watch import ConnectionWatch
from .access.curve import Curve, authenticator, encrypt
from .access.peer_limits import PeerLimits, allowances
from .command_codec import MAX_MESSAGE_BYTES

# Whole messages that wait per connection. Parts of an unfinished one are not counted by ZeroMQ: see peer_limits.py.
RECEIVE_QUEUE = 10
SEND_QUEUE = 100
MESSAGES_PER_TURN = 100
# A peer that vanished without closing is noticed by ZeroMQ's own heartbeats.
HEARTBEAT_MS = 1000
HEARTBEAT_TIMEOUT_MS = 5000
LINGER_MS = 200
# Who has not said within it who he is loses the connection.
HANDSHAKE_MS = 2000
# Of what has arrived and was not taken yet the system keeps no more; else it takes up to 6 MB of a connection.
RECEIVE_BUFFER_BYTES = 64 * 1024
# How long a thread of Python keeps others waiting, s. Three of them serve strangers who connect: by the default of 5 ms
# a Command beside a flood of connections took 1.0 ms (p90; p99 3.5) to the dispatcher, and takes 0.3 (1.3) as without.
THREAD_TURN_S = 0.0005
NO_CONNECTION = -1


class LinkError(RobotError):
    """The ports of the link cannot be opened."""


class Ports(NamedTuple):
    """Where the link listens."""

    address: str
    status_port: int
    command_port: int


class Received(NamedTuple):
    """One message. key: public key (Z85) of who sent it, ZeroMQ's User-Id; empty on a link that is not encrypted."""

    data: bytes
    key: str = ""


class LinkServer:
    """Publishes Status on one port and receives Commands on the other; with curve to and from paired keys only."""

    def __init__(self, ports: Ports, curve: Optional[Curve] = None) -> None:
        self._ports, self._curve = ports, curve
        self._authenticator: Optional[Any] = None
        self._watches: List[ConnectionWatch] = []
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
        self._destroy(0)
        self._open()
        self.bind()

    def publish(self, status: bytes) -> None:
        """Send one Status to every application that listens."""
        self._publisher.send(status)

    def cut_off(self) -> Counter[str]:
        """Connections since the last call that spoke not as the link does, or too much, by what was wrong."""
        return sum((watch.counted() for watch in self._watches), Counter())

    def receive(self, timeout_s: float = 0.0) -> List[Received]:
        """Messages that have arrived, in order; waits up to timeout_s for the first one."""
        if not self._subscriber.poll(math.ceil(1000.0 * max(timeout_s, 0.0))):
            return []
        messages: List[Received] = []
        while len(messages) < MESSAGES_PER_TURN:
            try:
                frames = self._subscriber.recv_multipart(zmq.NOBLOCK, copy=False)
            except zmq.Again:
                break
            # A message of several frames is none of ours; joined, it is counted as undecodable or oversized.
            data = [frame.bytes for frame in frames]
            joined = data[0] if len(data) == 1 else b"\xff".join([b"", *data])
            messages.append(Received(joined, self._key_of(frames[0])))
            self._limits.delivered(_connection_of(frames[0]), len(frames), sum(map(len, data)))
        return messages

    def close(self) -> None:
        """Release both ports."""
        self._destroy(LINGER_MS)

    def _destroy(self, linger_ms: int) -> None:
        for watch in self._watches:
            watch.close()
        self._watches = []
        if self._authenticator is not None:
            self._authenticator.stop()
            self._authenticator = None
        self._context.destroy(linger_ms)

    def _key_of(self, frame: Any) -> str:
        return "" if self._curve is None else str(frame.get("User-Id"))

    def _open(self) -> None:
        sys.setswitchinterval(THREAD_TURN_S)
        self._context = zmq.Context()
        if self._curve is not None:
            # Before the sockets, so that nobody is turned away at the start.
            self._authenticator = authenticator(self._context, self._curve)
        self._publisher = self._socket(zmq.PUB)
        self._publisher.setsockopt(zmq.SNDHWM, SEND_QUEUE)
        # libzmq 4.3.4 aborts (stream_engine_base.cpp, "!_io_error") when a peer goes whose subscriptions have filled
        # the queue, so the queue has no end; the memory of the process is bounded instead, see memory.py.
        self._publisher.setsockopt(zmq.RCVHWM, 0)
        self._subscriber = self._socket(zmq.SUB)
        self._subscriber.setsockopt(zmq.RCVHWM, RECEIVE_QUEUE)
        self._subscriber.setsockopt(zmq.SUBSCRIBE, b"")
        of_status, of_commands = allowances(is_encrypted=self._curve is not None)
        self._limits = PeerLimits(of_commands)
        self._watches = [ConnectionWatch(self._publisher, PeerLimits(of_status)),
                         ConnectionWatch(self._subscriber, self._limits)]

    def _socket(self, kind: int) -> "zmq.Socket[bytes]":
        socket = self._context.socket(kind)
        # Beyond it ZeroMQ cuts the connection; on the port of Status it bounds a subscription.
        socket.setsockopt(zmq.MAXMSGSIZE, MAX_MESSAGE_BYTES)
        socket.setsockopt(zmq.RCVBUF, RECEIVE_BUFFER_BYTES)
        socket.setsockopt(zmq.HEARTBEAT_IVL, HEARTBEAT_MS)
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, HEARTBEAT_TIMEOUT_MS)
        socket.setsockopt(zmq.HANDSHAKE_IVL, HANDSHAKE_MS)
        if self._curve is not None:
            encrypt(socket, self._curve)
        return socket


def _connection_of(frame: Any) -> int:
    """Number of the connection that has brought a frame; none of them for a peer that speaks ZMTP 1 or 2.

    Such a peer's messages do not count as taken, so that it is soon cut off: no application is one.
    """
    try:
        return int(frame.get(zmq.SRCFD))
    except zmq.ZMQError:
        return NO_CONNECTION
