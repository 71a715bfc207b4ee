"""Address of the robot: host and the two ports, validated once."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import ipaddress
import re
from dataclasses import dataclass

from mtr_operator.domain.errors import InvalidParameter

SUBSCRIBER_PORT = 3334
PUBLISHER_PORT = 3333
MIN_PORT = 1
MAX_PORT = 65535

# RFC 1123: labels of letters, digits and inner hyphens.
_HOST_NAME = re.compile(r"(?=.{1,253}$)[A-Za-z0-9]([A-Za-z0-9-]{0,61}[A-Za-z0-9])?"
                        r"(\.[A-Za-z0-9]([A-Za-z0-9-]{0,61}[A-Za-z0-9])?)*")
_LOOKS_NUMERIC = re.compile(r"[0-9.]+")


@dataclass(frozen=True)
class RobotAddress:
    """Host and ports of the robot; the ports are named from the Operator's side."""

    host: str
    subscriber_port: int = SUBSCRIBER_PORT
    publisher_port: int = PUBLISHER_PORT

    def __post_init__(self) -> None:
        _check_host(self.host)
        _check_port("subscriber port", self.subscriber_port)
        _check_port("publisher port", self.publisher_port)
        if self.subscriber_port == self.publisher_port:
            raise InvalidParameter(f"Subscriber port and publisher port are both {self.subscriber_port}; "
                                   "the robot uses two different ones.")


def _check_host(host: str) -> None:
    if not isinstance(host, str) or not host:
        raise InvalidParameter(f"Robot address is {host!r}; allowed is an IPv4 address or a host name.")
    if _LOOKS_NUMERIC.fullmatch(host):
        try:
            ipaddress.IPv4Address(host)
        except ValueError:
            raise InvalidParameter(f"Robot address is {host}; an IPv4 address is four numbers from 0 to 255 "
                                   "with dots between them.") from None
    elif not _HOST_NAME.fullmatch(host):
        raise InvalidParameter(f"Robot address is {host!r}; allowed is an IPv4 address or a host name.")


def _check_port(name: str, port: int) -> None:
    whole = isinstance(port, int) and not isinstance(port, bool)
    if not whole or not MIN_PORT <= port <= MAX_PORT:
        raise InvalidParameter(f"The {name} is {port}; allowed is a whole number from {MIN_PORT} to {MAX_PORT}.")
