"""ZeroMQ sockets of the link, checked for a ZeroMQ peer of the right kind on the other end."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import zmq
from zmq.utils.monitor import recv_monitor_message

from mtr_operator.domain.errors import ConnectionFailed

if TYPE_CHECKING:
    # Generic in their stubs only.
    Socket = zmq.Socket[bytes]
    Context = zmq.Context[zmq.Socket[bytes]]

# A message between the link's own limit (64 KiB) and this one is received, counted and ignored; beyond it ZeroMQ drops
# the connection, so that nobody can fill the memory.
_MAX_BYTES = 1024 * 1024
_HEARTBEAT_MS = 1000
_HEARTBEAT_TIMEOUT_MS = 3000
_RECONNECT_MS = 100
_MAX_RECONNECT_MS = 1000

_HANDSHAKE_EVENTS = (zmq.EVENT_HANDSHAKE_SUCCEEDED | zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL
                     | zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL | zmq.EVENT_HANDSHAKE_FAILED_AUTH
                     # libzmq 4.3.4 says no more than this of a peer of the wrong socket type.
                     | zmq.EVENT_DISCONNECTED)


@dataclass(frozen=True)
class LinkSockets:
    """The two connected sockets."""

    context: Context
    subscriber: Socket
    publisher: Socket


def connect(ip: str, subscriber_port: int, publisher_port: int, timeout_s: float) -> LinkSockets:
    """Both sockets, or ConnectionFailed."""
    context = zmq.Context()
    try:
        return LinkSockets(context, subscribe(context, ip, subscriber_port, timeout_s),
                           publish(context, ip, publisher_port, timeout_s))
    except BaseException:
        context.destroy(linger=0)
        raise


def subscribe(context: Context, ip: str, port: int, timeout_s: float) -> Socket:
    """SUB socket connected to the robot's Status, or ConnectionFailed."""
    socket = _socket(context, zmq.SUB)
    socket.setsockopt(zmq.SUBSCRIBE, b"")
    return _connect(socket, ip, port, timeout_s, "subscriber")


def publish(context: Context, ip: str, port: int, timeout_s: float) -> Socket:
    """PUB socket connected to the robot's Command port, or ConnectionFailed."""
    socket = _socket(context, zmq.PUB)
    # Nothing is queued while the link is down: an old Command must not arrive later.
    socket.setsockopt(zmq.IMMEDIATE, 1)
    return _connect(socket, ip, port, timeout_s, "publisher")


def _socket(context: Context, kind: int) -> Socket:
    socket = context.socket(kind)
    for option, value in ((zmq.LINGER, 0), (zmq.MAXMSGSIZE, _MAX_BYTES), (zmq.HEARTBEAT_IVL, _HEARTBEAT_MS),
                          (zmq.HEARTBEAT_TIMEOUT, _HEARTBEAT_TIMEOUT_MS), (zmq.RECONNECT_IVL, _RECONNECT_MS),
                          (zmq.RECONNECT_IVL_MAX, _MAX_RECONNECT_MS)):
        socket.setsockopt(option, value)
    return socket


def _connect(socket: Socket, ip: str, port: int, timeout_s: float, name: str) -> Socket:
    monitor = socket.get_monitor_socket(_HANDSHAKE_EVENTS)
    try:
        socket.connect(f"tcp://{ip}:{port}")
        good = _handshake_succeeds(monitor, timeout_s)
    finally:
        socket.disable_monitor()
        monitor.close(0)
    if not good:
        socket.close(0)
        raise ConnectionFailed(f"The {name} port {port} is open, but not the robot's; subscriber and publisher port "
                               "may be swapped, or another program listens there.")
    return socket


def _handshake_succeeds(monitor: Socket, timeout_s: float) -> bool:
    deadline = time.monotonic() + timeout_s
    while monitor.poll(max(0, math.ceil((deadline - time.monotonic()) * 1000))):
        event: Any = recv_monitor_message(monitor)["event"]
        return bool(event == zmq.EVENT_HANDSHAKE_SUCCEEDED)
    return False
