"""The robot's end of the link: two bound ZeroMQ sockets whose memory peers cannot fill."""
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

# Complete messages that wait per connection. ZeroMQ does not count parts of an unfinished one: see peer_limits.py.
RECEIVE_QUEUE = 10
SEND_QUEUE = 100
MESSAGES_PER_TURN = 100
# ZeroMQ's heartbeats detect a peer that vanished without closing.
HEARTBEAT_MS = 1000
HEARTBEAT_TIMEOUT_MS = 5000
LINGER_MS = 200
# A peer that does not complete its handshake within this time loses the connection.
HANDSHAKE_MS = 2000
# Bound of the kernel's buffer of unread bytes per connection, which otherwise grows up to 6 MB.
RECEIVE_BUFFER_BYTES = 64 * 1024
# Time after which a Python thread yields to waiting ones, s. Three threads serve connecting strangers. During a flood
# of connections a Command reached the dispatcher within 1.0 ms (p90; p99 3.5 ms) at the default of 5 ms. With this
# value it needs 0.3 ms (1.3 ms), as without the flood.
THREAD_TURN_S = 0.0005
NO_CONNECTION = -1


class LinkError(RobotError):
    """The ports of the link cannot be opened."""


class Ports(NamedTuple):
    """Address and ports on which the link listens."""

    address: str
    status_port: int
    command_port: int


class Received(NamedTuple):
    """One message. key: public key (Z85) of its sender from ZeroMQ's User-Id; empty on a link that is not encrypted."""

    data: bytes
    key: str = ""


class LinkServer:
    """Publishes Status on one port and receives Commands on the other; with a curve, only to and from paired keys."""

    def __init__(self, ports: Ports, curve: Optional[Curve] = None) -> None:
        self._ports, self._curve = ports, curve
        self._authenticator: Optional[Any] = None
        self._watches: List[ConnectionWatch] = []
        self._open()

    def bind(self) -> None:
        """Listen on both ports of the address; raises LinkError with a sentence."""
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
        """Cut off all connections and listen again, which frees the memory that strangers have filled in ZeroMQ.

        Applications reconnect by themselves.
        """
        self._destroy(0)
        self._open()
        self.bind()

    def publish(self, status: bytes) -> None:
        """Send one Status to every connected application."""
        self._publisher.send(status)

    def cut_off(self) -> Counter[str]:
        """Return the connections refused or cut off since the last call, counted by cause."""
        return sum((watch.counted() for watch in self._watches), Counter())

    def receive(self, timeout_s: float = 0.0) -> List[Received]:
        """Return the messages that have arrived, in order; wait up to timeout_s for the first one."""
        if not self._subscriber.poll(math.ceil(1000.0 * max(timeout_s, 0.0))):
            return []
        messages: List[Received] = []
        while len(messages) < MESSAGES_PER_TURN:
            try:
                frames = self._subscriber.recv_multipart(zmq.NOBLOCK, copy=False)
            except zmq.Again:
                break
            # The link has only single-frame messages; joined with a mark, others are counted as undecodable or
            # oversized.
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
            # The authenticator starts before the sockets, so that no early connection is refused.
            self._authenticator = authenticator(self._context, self._curve)
        self._publisher = self._socket(zmq.PUB)
        self._publisher.setsockopt(zmq.SNDHWM, SEND_QUEUE)
        # libzmq 4.3.4 aborts (stream_engine_base.cpp, "!_io_error") when a peer disconnects whose subscriptions have
        # filled the queue. So the queue is unlimited, and the memory of the process is bounded instead: see memory.py.
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
        # A larger message costs the connection; on the Status port this bounds a subscription.
        socket.setsockopt(zmq.MAXMSGSIZE, MAX_MESSAGE_BYTES)
        socket.setsockopt(zmq.RCVBUF, RECEIVE_BUFFER_BYTES)
        socket.setsockopt(zmq.HEARTBEAT_IVL, HEARTBEAT_MS)
        socket.setsockopt(zmq.HEARTBEAT_TIMEOUT, HEARTBEAT_TIMEOUT_MS)
        socket.setsockopt(zmq.HANDSHAKE_IVL, HANDSHAKE_MS)
        if self._curve is not None:
            encrypt(socket, self._curve)
        return socket


def _connection_of(frame: Any) -> int:
    """Return the number of the connection that brought a frame, or NO_CONNECTION for ZMTP 1 or 2.

    Messages of such a peer are not counted as delivered, so it is soon cut off; applications use ZMTP 3.
    """
    try:
        return int(frame.get(zmq.SRCFD))
    except zmq.ZMQError:
        return NO_CONNECTION
