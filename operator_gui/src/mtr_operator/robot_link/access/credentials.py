"""With which keys a robot is tried, and when the link may do without."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import ipaddress
from dataclasses import dataclass

from mtr_operator.domain.errors import ConnectionFailed
from mtr_proto.keys import KeyPair

from .key_chain import CONTROLLER, KeyChain


@dataclass(frozen=True)
class Credentials:
    """What encrypts one connection. own: this laptop's pair. robot_key: whose end it has to be, Z85. role: its own."""

    own: KeyPair
    robot_key: bytes
    role: str = CONTROLLER


def is_loopback(ip: str) -> bool:
    """True when the link does not leave this computer."""
    return ipaddress.ip_address(ip).is_loopback


def ways_to(host: str, ip: str, is_unencrypted: bool, chain: KeyChain) -> tuple[Credentials | None, ...]:
    """What to try one after the other; None is a connection without encryption.

    Raises ConnectionFailed when there is none: a robot elsewhere has to be paired, unless the person has asked for no
    encryption. A robot that was paired is never tried without.
    """
    if is_unencrypted:
        return (None,)
    robots = chain.robots_at(host)
    paired: list[Credentials | None] = []
    if robots:
        own = chain.own_keys()
        paired = [Credentials(own, robot.key.encode("ascii"), robot.role) for robot in robots]
    if is_loopback(ip):
        return (*paired, None)
    if not paired:
        raise ConnectionFailed(f"This laptop is not paired with the robot at {host}; have the robot show a code, and "
                               "type it here, or say mtr-operator pair.")
    return tuple(paired)
