"""Plain TCP test of a port with a time limit, so that a wrong address is a visible error."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import socket
import statistics
import threading
import time

from mtr_operator.domain.errors import ConnectionFailed

from .address import RobotAddress

_ROUND_TRIPS = 5


def probe(address: RobotAddress, timeout_s: float) -> str:
    """Try both ports for at most timeout_s each; return the IPv4 address, or raise ConnectionFailed."""
    ip = resolve(address.host, timeout_s)
    for name, port in (("subscriber", address.subscriber_port), ("publisher", address.publisher_port)):
        _try_port(f"{name} port {port} of {address.host}", ip, port, timeout_s)
    return ip


def round_trip_s(address: RobotAddress, timeout_s: float) -> float:
    """Return the median time of opening a connection, one round trip of the network; or raise ConnectionFailed."""
    ip, port, taken_s = resolve(address.host, timeout_s), address.subscriber_port, []
    for _ in range(_ROUND_TRIPS):
        begun_s = time.monotonic()
        _try_port(f"subscriber port {port} of {address.host}", ip, port, timeout_s)
        taken_s.append(time.monotonic() - begun_s)
    return statistics.median(taken_s)


def resolve(host: str, timeout_s: float) -> str:
    """Return the IPv4 address of a host; a thread limits the time, because the system's name look-up has no limit."""
    found: list[str] = []

    def look_up() -> None:
        with contextlib.suppress(OSError, UnicodeError):
            found.append(socket.getaddrinfo(host, None, socket.AF_INET, socket.SOCK_STREAM)[0][4][0])

    thread = threading.Thread(target=look_up, name="robot-name-look-up", daemon=True)
    thread.start()
    thread.join(timeout_s)
    if not found:
        raise ConnectionFailed(f"No host of the name {host} is known; check the robot's address.")
    return found[0]


def _try_port(what: str, ip: str, port: int, timeout_s: float) -> None:
    try:
        socket.create_connection((ip, port), timeout=timeout_s).close()
    except socket.timeout:
        raise ConnectionFailed(f"No answer from {what} within {timeout_s:g} s; check the address, the Wi-Fi and that "
                               "the robot is on.") from None
    except ConnectionRefusedError:
        raise ConnectionFailed(f"Nothing listens on {what}; check the port and that the robot's software runs.") \
            from None
    except OSError as error:
        raise ConnectionFailed(f"Cannot reach {what}: {error.strerror or error}.") from None
