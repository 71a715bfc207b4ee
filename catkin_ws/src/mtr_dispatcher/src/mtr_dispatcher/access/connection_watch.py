"""Watches the connections of a port in a thread: cuts off excessive senders and counts refused connections.

ZeroMQ bounds neither the parts of an unfinished message nor subscriptions, and it does not return to its caller while
it reads them. The kernel counts the received bytes of each connection (TCP_INFO). When a connection is shut down,
ZeroMQ drops everything that it brought.
"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import socket
import struct
import threading
import time
from typing import Any, Counter, Dict

import zmq
from zmq.utils.monitor import recv_monitor_message

from .peer_limits import PeerLimits

NOT_ENCRYPTED, GONE = "not encrypted for this robot", "gone before the end of the handshake"
TOO_MUCH = "more than messages"
# NOT_ENCRYPTED: the peer has no key, or the wrong key of the robot. The authenticator counts unknown keys of peers.
# GONE: the peer closed first, because it detected a protocol mismatch itself or only probed the port.
HANDSHAKE_FAILURES = {zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL: NOT_ENCRYPTED, zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL: GONE}
# ZeroMQ blocks all messages while about 2000 monitor events are pending (measured, 4.3.4).
EVENTS_PER_TURN = 500
# linux/tcp.h, struct tcp_info: tcpi_bytes_received.
_BYTES_RECEIVED = struct.Struct("=Q")
_BYTES_RECEIVED_AT = 128
_TCP_INFO_BYTES = 256
_NO_LINGERING = struct.pack("=ii", 1, 0)


class ConnectionWatch:
    """Watch of one bound socket; close it before the socket."""

    def __init__(self, monitored: Any, limits: PeerLimits):
        self._limits = limits
        self._peers: Dict[int, Any] = {}
        self._counted: Counter[str] = Counter()
        self._lock = threading.Lock()
        self._over = threading.Event()
        self._monitor = monitored.get_monitor_socket(
            sum((zmq.EVENT_ACCEPTED, zmq.EVENT_DISCONNECTED, *HANDSHAKE_FAILURES)))
        self._thread = threading.Thread(target=self._run, name="connections", daemon=True)
        self._thread.start()

    def counted(self) -> Counter[str]:
        """Return the connections that were refused or cut off since the last call, counted by cause."""
        with self._lock:
            counted, self._counted = self._counted, Counter()
        return counted

    def close(self) -> None:
        """End the thread."""
        self._over.set()
        self._thread.join()

    def _run(self) -> None:
        while not self._over.is_set():
            self._monitor.poll(round(1000.0 * self._limits.check_period_s))
            self._take_events()
            received = {number: _received_bytes(number, peer) for number, peer in self._peers.items()}
            for number in self._limits.excessive(received, time.monotonic()):
                self._cut_off(number, TOO_MUCH)

    def _take_events(self) -> None:
        for _ in range(EVENTS_PER_TURN):
            try:
                event = recv_monitor_message(self._monitor, zmq.NOBLOCK)
            except zmq.Again:
                return
            if event["event"] == zmq.EVENT_ACCEPTED:
                self._accept(event["value"])
            elif event["event"] == zmq.EVENT_DISCONNECTED:
                self._peers.pop(event["value"], None)
                self._limits.close(event["value"])
            else:
                self._count(HANDSHAKE_FAILURES[event["event"]])

    def _accept(self, number: int) -> None:
        with contextlib.suppress(OSError), _socket_of(number) as connection:
            self._peers[number] = connection.getpeername()
            why = self._limits.open(number, self._peers[number][0], time.monotonic())
            if why:
                self._cut_off(number, why)

    def _cut_off(self, number: int, why: str) -> None:
        # Count first, so that the count includes the connection as soon as the peer notices the cut.
        self._count(why)
        peer = self._peers.pop(number)
        self._limits.close(number)
        with contextlib.suppress(OSError), _socket_of(number) as connection:
            if connection.getpeername() == peer:
                # ZeroMQ reads the end of the stream and closes; without lingering the peer is reset at once, even while
                # it sends.
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _NO_LINGERING)
                connection.shutdown(socket.SHUT_RDWR)

    def _count(self, why: str) -> None:
        with self._lock:
            self._counted[why] += 1


def _socket_of(number: int) -> socket.socket:
    """Return a duplicate of ZeroMQ's connection; closing it leaves the original open. OSError for a file."""
    duplicate = os.dup(number)
    try:
        return socket.socket(fileno=duplicate)
    except OSError:
        # ZeroMQ has closed its descriptor, and the number now belongs to a file.
        os.close(duplicate)
        raise


def _received_bytes(number: int, peer: Any) -> int:
    """Return the bytes that a connection has received; 0 if its descriptor was reused, or without kernel support."""
    with contextlib.suppress(OSError), _socket_of(number) as connection:
        if connection.getpeername() == peer:
            told = connection.getsockopt(socket.IPPROTO_TCP, socket.TCP_INFO, _TCP_INFO_BYTES)
            if len(told) >= _BYTES_RECEIVED_AT + _BYTES_RECEIVED.size:
                return int(_BYTES_RECEIVED.unpack_from(told, _BYTES_RECEIVED_AT)[0])
    return 0
