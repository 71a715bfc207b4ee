"""ZeroMQ sockets of the link, checked for a ZeroMQ peer of the right kind on the other end."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time

import zmq
from zmq.utils.monitor import recv_monitor_message

from mtr_operator.domain.errors import ConnectionFailed

# A message between the link's own limit (64 KiB) and this one is received, counted and ignored; beyond it ZeroMQ drops
# the connection, so that nobody can fill the memory.
_MAX_BYTES = 1024 * 1024
_HEARTBEAT_MS = 1000
_HEARTBEAT_TIMEOUT_MS = 3000
_RECONNECT_MS = 100
_RECONNECT_MAXIMUM_MS = 1000

_HANDSHAKE_EVENTS = (zmq.EVENT_HANDSHAKE_SUCCEEDED | zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL
                     | zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL | zmq.EVENT_HANDSHAKE_FAILED_AUTH
                     # libzmq 4.3.4 says no more than this of a peer of the wrong socket type.
                     | zmq.EVENT_DISCONNECTED)


def subscribe(context: zmq.Context, ip: str, port: int, timeout_s: float) -> zmq.Socket:
    """SUB socket connected to the robot's Status, or ConnectionFailed."""
    socket = _socket(context, zmq.SUB)
    socket.setsockopt(zmq.SUBSCRIBE, b"")
    return _connect(socket, ip, port, timeout_s, "subscriber")


def publish(context: zmq.Context, ip: str, port: int, timeout_s: float) -> zmq.Socket:
    """PUB socket connected to the robot's Command port, or ConnectionFailed."""
    socket = _socket(context, zmq.PUB)
    # Nothing is queued while the link is down: an old Command must not arrive later.
    socket.setsockopt(zmq.IMMEDIATE, 1)
    return _connect(socket, ip, port, timeout_s, "publisher")


def _socket(context: zmq.Context, kind: int) -> zmq.Socket:
    socket = context.socket(kind)
    for option, value in ((zmq.LINGER, 0), (zmq.MAXMSGSIZE, _MAX_BYTES), (zmq.HEARTBEAT_IVL, _HEARTBEAT_MS),
                          (zmq.HEARTBEAT_TIMEOUT, _HEARTBEAT_TIMEOUT_MS), (zmq.RECONNECT_IVL, _RECONNECT_MS),
                          (zmq.RECONNECT_IVL_MAX, _RECONNECT_MAXIMUM_MS)):
        socket.setsockopt(option, value)
    return socket


def _connect(socket: zmq.Socket, ip: str, port: int, timeout_s: float, name: str) -> zmq.Socket:
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


def _handshake_succeeds(monitor: zmq.Socket, timeout_s: float) -> bool:
    deadline = time.monotonic() + timeout_s
    while monitor.poll(max(0, math.ceil((deadline - time.monotonic()) * 1000))):
        return recv_monitor_message(monitor)["event"] == zmq.EVENT_HANDSHAKE_SUCCEEDED
    return False
