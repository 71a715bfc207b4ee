"""Selection of the keys for a connection to a robot, and of the cases without encryption."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import ipaddress
from dataclasses import dataclass

from mtr_operator.domain.errors import ConnectionFailed
from mtr_proto.keys import KeyPair

from .key_chain import CONTROLLER, KeyChain


@dataclass(frozen=True)
class Credentials:
    """Keys of one encrypted connection. own: this laptop's pair. robot_key: expected key of the robot, Z85. role: its
    own."""

    own: KeyPair
    robot_key: bytes
    role: str = CONTROLLER


def is_loopback(ip: str) -> bool:
    """Return True if the link stays on this computer."""
    return ipaddress.ip_address(ip).is_loopback


def ways_to(host: str, ip: str, is_unencrypted: bool, chain: KeyChain) -> tuple[Credentials | None, ...]:
    """Return the credentials to try in this order; None is a connection without encryption.

    Raises ConnectionFailed without any: a remote robot must be paired, unless the person chose a connection without
    encryption. A paired robot is always encrypted.
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
