"""What somebody tries who has the whole source, a place in the robot's network and no key of a controller.

Each attack goes on until it is told to end, and counts what it has tried. The first group has no paired key at all; the
second has one that a person could have: a viewer's, or one that was revoked.
"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import itertools
import random
import secrets
import socket
import struct
import time
from typing import Callable, Counter, List, Optional

import zmq
from hostile_peer import PAUSE_S, Keys, Over, Peer, Target, give_orders

from mtr_proto.pairing import ANSWER_BYTES, HELLO_BYTES, PROOF_BYTES, LaptopSide, PairingError

CONNECTION_S = 2.0
# Who is let in has heard the robot subscribe by then, on a busy machine as well, and then orders for so long: s.
LET_IN_S, ORDERS_S = 0.25, 3.0
# The greeting of ZMTP 3.0 (rfc.zeromq.org/spec/23), and the lie that a frame of 2^62 bytes follows.
GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"CURVE".ljust(20, b"\0") + bytes(32)
PLAIN_GREETING = GREETING.replace(b"CURVE", b"NULL\0")
HUGE_FRAME = b"\x06" + struct.pack("!Q", 2 ** 62)
HALF_OPEN, PARTS, SUBSCRIPTIONS_AT_ONCE = 200, 200, 2000
LARGE_BYTES = 2 ** 20


def command_as(keys: Keys, robot_key: Optional[bytes] = None, pause_s: float = PAUSE_S) -> Callable[..., None]:
    """An attack: orders of an application with these keys, for a robot with that key."""
    def attack(target: Target, tries: Counter[str], over: Over) -> None:
        peer = Peer(target, keys, robot_key or target.robot_key)
        give_orders(peer, tries, over, pause_s)
        peer.close()
    return attack


def no_encryption(target: Target, tries: Counter[str], over: Over) -> None:
    """Speaks as a link within one computer does."""
    command_as(None)(target, tries, over)


def wrong_robot_key(target: Target, tries: Counter[str], over: Over) -> None:
    """Takes another robot for this one."""
    command_as(zmq.curve_keypair(), zmq.curve_keypair()[0])(target, tries, over)


def unknown_keys(target: Target, tries: Counter[str], over: Over) -> None:
    """A key after the other that nobody has paired."""
    while not over():
        peer = Peer(target, zmq.curve_keypair(), target.robot_key)
        tries["keys"] += 1
        if peer.is_let_in(LET_IN_S):
            tries["let in"] += 1
            give_orders(peer, tries, over, limit_s=ORDERS_S)
        peer.close()


def replay(target: Target, tries: Counter[str], over: Over) -> None:
    """What a paired controller has sent once, sent again on connections of one's own, to both ports."""
    assert target.recording
    for port in itertools.cycle((target.command_port, target.status_port)):
        if over():
            return
        with contextlib.suppress(OSError), connected(target, port) as connection:
            connection.sendall(target.recording)
            tries["replays"] += 1
            drained(connection, 0.2)
        time.sleep(PAUSE_S)


def connection_flood(target: Target, tries: Counter[str], over: Over) -> None:
    """Connects and is gone, as fast as it goes."""
    for port in itertools.cycle((target.command_port, target.status_port)):
        if over():
            return
        with contextlib.suppress(OSError), connected(target, port):
            tries["connections"] += 1


def half_open(target: Target, tries: Counter[str], over: Over) -> None:
    """Hundreds of connections at once that begin to greet and say no more."""
    chance = random.Random(1)
    held: List[socket.socket] = []
    while not over():
        for port in (target.command_port, target.status_port):
            with contextlib.suppress(OSError):
                held.append(connected(target, port))
                held[-1].sendall(GREETING[:chance.randrange(len(GREETING))])
                tries["connections"] += 1
        while len(held) > HALF_OPEN:
            held.pop(0).close()
        time.sleep(PAUSE_S)
    for each in held:
        each.close()


def garbage(target: Target, tries: Counter[str], over: Over) -> None:
    """Greetings of both kinds, then frames that are too long, endless, or nothing at all."""
    chance = random.Random(2)
    while not over():
        port = chance.choice((target.command_port, target.status_port))
        after = chance.choice((HUGE_FRAME + bytes(LARGE_BYTES), b"\x01\x00" * 32768, chance.randbytes(4096)
                               if hasattr(chance, "randbytes") else secrets.token_bytes(4096)))
        with contextlib.suppress(OSError), connected(target, port) as connection:
            connection.sendall(chance.choice((GREETING, PLAIN_GREETING, b"")) + after)
            tries["connections"] += 1
            drained(connection, 0.05)


def pairing_guesses(target: Target, tries: Counter[str], over: Over) -> None:
    """A code after the other, as long as anybody answers; and other bytes, and a hello that says no more."""
    for number in itertools.count():
        if over() or not target.pairing_port:
            return
        try:
            with connected(target, target.pairing_port) as connection:
                guess(connection, f"{number:06d}", number % 3, tries)
        except (OSError, PairingError):
            tries["refused"] += 1
            time.sleep(PAUSE_S)


def guess(connection: socket.socket, code: str, kind: int, tries: Counter[str]) -> None:
    """One try: a whole one, an own point that comes back, or bytes of the right length."""
    side = LaptopSide(code, zmq.curve_keypair()[0], "red team")
    hello = side.hello()
    connection.settimeout(10.0)
    connection.sendall(hello if kind != 2 else hello[:8] + secrets.token_bytes(HELLO_BYTES - 8))
    answer = exactly(connection, ANSWER_BYTES)
    tries["guesses"] += 1
    connection.sendall(side.proof(answer) if kind == 0 else bytes(PROOF_BYTES))
    exactly(connection, 33)
    tries["paired"] += 1


def ros_graph(target: Target, tries: Counter[str], over: Over) -> None:
    """Whatever listens there beside the link: a scan of all ports at the robot's other addresses."""
    for port in itertools.cycle(range(1024, 65536)):
        if over():
            return
        with socket.socket() as probe:
            probe.settimeout(CONNECTION_S)
            tries["ports"] += 1
            if probe.connect_ex((target.address, port)) == 0:
                tries[f"open {port}"] += 1


def viewer_commands(target: Target, tries: Counter[str], over: Over) -> None:
    """A viewer, who reads every session and hold in the Statuses, orders."""
    command_as(target.keys["viewer"])(target, tries, over)


def revoked_commands(target: Target, tries: Counter[str], over: Over) -> None:
    """Who could order yesterday."""
    command_as(target.keys["revoked"])(target, tries, over)


def controller_commands(target: Target, tries: Counter[str], over: Over) -> None:
    """No attack: the same orders of somebody who may. The others' prove something only where these move the robot."""
    command_as(target.keys["controller"])(target, tries, over)


def viewer_flood(target: Target, tries: Counter[str], over: Over) -> None:
    """Commands of a viewer, some thousand a second."""
    command_as(target.keys["viewer"], pause_s=0.0002)(target, tries, over)


def viewer_subscriptions(target: Target, tries: Counter[str], over: Over) -> None:
    """On the way to 10^9 subscriptions."""
    peer = Peer(target, target.keys["viewer"], target.robot_key)
    for first in itertools.count(0, SUBSCRIPTIONS_AT_ONCE):
        if over():
            peer.close()
            return
        for number in range(first, first + SUBSCRIPTIONS_AT_ONCE):
            peer.statuses.setsockopt(zmq.SUBSCRIBE, b"x%d" % number)
        tries["subscriptions"] += SUBSCRIPTIONS_AT_ONCE
        time.sleep(PAUSE_S)


def viewer_messages(target: Target, tries: Counter[str], over: Over) -> None:
    """Messages of hundreds of parts and of a megabyte, one after the other."""
    peer = Peer(target, target.keys["viewer"], target.robot_key)
    for kind in itertools.cycle((0, 1)):
        if over():
            peer.close()
            return
        peer.commands.send_multipart([b"part"] * PARTS if kind else [bytes(LARGE_BYTES)])
        tries["messages"] += 1
        time.sleep(PAUSE_S)


def connected(target: Target, port: int) -> socket.socket:
    """A connection of plain TCP."""
    return socket.create_connection((target.address, port), timeout=CONNECTION_S)


def drained(connection: socket.socket, limit_s: float) -> None:
    """Read until the robot closes or says nothing for a while."""
    connection.settimeout(limit_s)
    with contextlib.suppress(OSError):
        while connection.recv(65536):
            pass


def exactly(connection: socket.socket, length: int) -> bytes:
    """So many bytes; OSError when the robot closes before."""
    data = b""
    while len(data) < length:
        part = connection.recv(length - len(data))
        if not part:
            raise ConnectionResetError
        data += part
    return data


STRANGERS = (no_encryption, wrong_robot_key, unknown_keys, replay, connection_flood, half_open, garbage)
INSIDERS = (viewer_commands, revoked_commands, viewer_flood, viewer_subscriptions, viewer_messages)
ALL = {attack.__name__: attack for attack in (*STRANGERS, *INSIDERS, pairing_guesses, ros_graph, controller_commands)}
