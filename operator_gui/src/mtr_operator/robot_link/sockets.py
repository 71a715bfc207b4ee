"""ZeroMQ sockets of the link, checked for a ZeroMQ peer of the right kind on the other end."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Tuple

import zmq
from zmq.utils.monitor import recv_monitor_message

from mtr_operator.domain.errors import ConnectionFailed

from .access.credentials import Credentials
from .address import RobotAddress

if TYPE_CHECKING:
    # These types are generic only in their stubs.
    Socket = zmq.Socket[bytes]
    Context = zmq.Context[zmq.Socket[bytes]]


# IPv4 address and port.
Place = Tuple[str, int]
# A message between the link's own limit (64 KiB) and this one is received, counted and ignored; beyond it ZeroMQ drops
# the connection, which bounds the memory.
_MAX_BYTES = 1024 * 1024
_HEARTBEAT_MS = 1000
_HEARTBEAT_TIMEOUT_MS = 3000
_RECONNECT_MS = 100
_MAX_RECONNECT_MS = 1000

_HANDSHAKE_EVENTS = (zmq.EVENT_HANDSHAKE_SUCCEEDED | zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL
                     | zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL | zmq.EVENT_HANDSHAKE_FAILED_AUTH
                     # For a peer of the wrong socket type, libzmq 4.3.4 reports only this event.
                     | zmq.EVENT_DISCONNECTED)


class KeyRefused(ConnectionFailed):
    """The robot is correct, but does not accept this laptop's key."""


@dataclass(frozen=True)
class LinkSockets:
    """The two connected sockets. credentials: keys of their encryption, None without encryption."""

    context: Context
    subscriber: Socket
    publisher: Socket
    credentials: Credentials | None = None


def connect(address: RobotAddress, ip: str, timeout_s: float, credentials: Credentials | None = None) -> LinkSockets:
    """Return both sockets, or raise ConnectionFailed."""
    context = zmq.Context()
    try:
        return LinkSockets(context, subscribe(context, (ip, address.subscriber_port), timeout_s, credentials),
                           publish(context, (ip, address.publisher_port), timeout_s, credentials), credentials)
    except BaseException:
        context.destroy(linger=0)
        raise


def subscribe(context: Context, place: Place, timeout_s: float, credentials: Credentials | None = None) -> Socket:
    """Return a SUB socket connected to the robot's Status, or raise ConnectionFailed."""
    socket = _socket(context, zmq.SUB, credentials)
    socket.setsockopt(zmq.SUBSCRIBE, b"")
    return _connect(socket, place, timeout_s, "subscriber")


def publish(context: Context, place: Place, timeout_s: float, credentials: Credentials | None = None) -> Socket:
    """Return a PUB socket connected to the robot's Command port, or raise ConnectionFailed."""
    socket = _socket(context, zmq.PUB, credentials)
    # While the link is down nothing is queued: an old Command must not arrive later.
    socket.setsockopt(zmq.IMMEDIATE, 1)
    return _connect(socket, place, timeout_s, "publisher")


def _socket(context: Context, kind: int, credentials: Credentials | None) -> Socket:
    socket = context.socket(kind)
    if credentials is not None:
        socket.setsockopt(zmq.CURVE_PUBLICKEY, credentials.own.public)
        socket.setsockopt(zmq.CURVE_SECRETKEY, credentials.own.secret)
        socket.setsockopt(zmq.CURVE_SERVERKEY, credentials.robot_key)
    for option, value in ((zmq.LINGER, 0), (zmq.MAXMSGSIZE, _MAX_BYTES), (zmq.HEARTBEAT_IVL, _HEARTBEAT_MS),
                          (zmq.HEARTBEAT_TIMEOUT, _HEARTBEAT_TIMEOUT_MS), (zmq.RECONNECT_IVL, _RECONNECT_MS),
                          (zmq.RECONNECT_IVL_MAX, _MAX_RECONNECT_MS)):
        socket.setsockopt(option, value)
    return socket


def _connect(socket: Socket, place: Place, timeout_s: float, name: str) -> Socket:
    ip, port = place
    is_secret = bool(socket.getsockopt(zmq.MECHANISM) == zmq.CURVE)
    monitor = socket.get_monitor_socket(_HANDSHAKE_EVENTS)
    try:
        socket.connect(f"tcp://{ip}:{port}")
        event = _handshake(monitor, timeout_s)
    finally:
        socket.disable_monitor()
        monitor.close(0)
    if event == zmq.EVENT_HANDSHAKE_SUCCEEDED:
        return socket
    socket.close(0)
    if event == zmq.EVENT_HANDSHAKE_FAILED_AUTH:
        raise KeyRefused("The robot does not know this laptop's key, or it was revoked; pair them again.")
    if is_secret:
        raise ConnectionFailed(f"On the {name} port {port} is not the robot that was paired: it may be another one, "
                               "its link may not be encrypted, or the ports may be swapped.")
    raise ConnectionFailed(f"The {name} port {port} is open, but not the robot's; subscriber and publisher port "
                           "may be swapped, the robot's link may be encrypted, or another program listens there.")


def _handshake(monitor: Socket, timeout_s: float) -> int:
    """Return the final ZeroMQ event of the handshake; 0 if it did not end in time."""
    deadline = time.monotonic() + timeout_s
    while monitor.poll(max(0, math.ceil((deadline - time.monotonic()) * 1000))):
        event: Any = recv_monitor_message(monitor)["event"]
        return int(event)
    return 0
