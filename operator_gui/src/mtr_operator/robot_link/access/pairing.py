"""Pairs this laptop with a robot that shows a code: the laptop's end of mtr_proto.pairing."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import datetime
import getpass
import socket
import time

from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter
from mtr_proto.pairing import ANSWER_BYTES, PORT, WELCOME_BYTES, LaptopSide, PairingError, WrongCode, code_of

from ..address import RobotAddress
from ..probe import resolve
from .key_chain import KeyChain, PairedRobot

# Time limit of one attempt; the robot delays the next attempt by some seconds.
TIMEOUT_S = 15.0


def default_name() -> str:
    """Return this laptop's name for the robot: person and computer."""
    try:
        person = getpass.getuser()
    except (OSError, KeyError, ImportError):
        person = "operator"
    return f"{person}@{socket.gethostname()}"


def pair(host: str, typed_code: str, name: str = "", port: int = PORT, chain: KeyChain | None = None) -> PairedRobot:
    """Pair with the robot at this address, and store it.

    Raises:
        InvalidParameter: address or code is invalid.
        ConnectionFailed: the robot is not in pairing mode, or has a different code.
    """
    RobotAddress(host)
    try:
        code = code_of(typed_code)
    except PairingError as error:
        raise InvalidParameter(str(error)) from None
    chain = chain or KeyChain()
    try:
        side = LaptopSide(code, chain.own_keys().public, name or default_name())
        robot = side.welcomed(_conversation(host, port, side))
    except WrongCode as error:
        raise ConnectionFailed(str(error)) from None
    except PairingError as error:
        raise ConnectionFailed(str(error)) from None
    found = PairedRobot(host, robot.robot_key, robot.role, datetime.date.today().isoformat())
    chain.keep(found)
    return found


def _conversation(host: str, port: int, side: LaptopSide) -> bytes:
    """Run the message exchange and return the robot's last message."""
    ip = resolve(host, TIMEOUT_S)
    end_s = time.monotonic() + TIMEOUT_S
    try:
        with socket.create_connection((ip, port), timeout=TIMEOUT_S) as connection:
            connection.sendall(side.hello())
            answer = _received(connection, ANSWER_BYTES, end_s)
            if not answer:
                raise ConnectionFailed(f"The robot at {host} does not pair now; have it show a new code.")
            connection.sendall(side.proof(answer))
            welcome = _received(connection, WELCOME_BYTES, end_s)
            if not welcome:
                raise ConnectionFailed("The code is wrong; the robot allows a few tries, each a little later.")
            return welcome
    except OSError:
        raise ConnectionFailed(f"The robot at {host} does not pair on port {port}; have it show a code first "
                               "(rosrun mtr_dispatcher pair).") from None


def _received(connection: socket.socket, length: int, end_s: float) -> bytes:
    """Return this number of bytes; empty if the robot closes the connection or exceeds the time limit."""
    data = b""
    while len(data) < length:
        connection.settimeout(max(end_s - time.monotonic(), 0.001))
        try:
            part = connection.recv(length - len(data))
        except OSError:
            return b""
        if not part:
            return b""
        data += part
    return data
