"""Both ports of the link, plain and encrypted: bytes of a raw TCP connection at the robot's own sockets."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import itertools
import pathlib
import random
import socket
import struct
from typing import Any, Callable, List, NamedTuple, Tuple

import zmq
from spoiling import spoilt_bytes

from mtr_dispatcher.access.curve import Curve
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_dispatcher.memory import resident_mib
from mtr_proto.keys import KeyPair

LIMIT_S = 5.0
# The honest peer is asked whether it still hears and is heard after so many cases.
CASES_A_LOOK = 100
MAX_GROWTH_MIB = 200.0
GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\0") + bytes(32)
CURVE_GREETING = GREETING.replace(b"NULL\0", b"CURVE")


def command(name: bytes, body: bytes) -> bytes:
    """A ZMTP command (rfc.zeromq.org/spec/23)."""
    content = bytes([len(name)]) + name + body
    return b"\x04" + bytes([len(content)]) + content if len(content) < 256 else \
        b"\x06" + struct.pack("!Q", len(content)) + content


def ready(kind: bytes) -> bytes:
    """READY of a socket of a kind."""
    return command(b"READY", b"\x0bSocket-Type" + struct.pack("!I", len(kind)) + kind
                   + b"\x08Identity" + struct.pack("!I", 0))


def message(data: bytes, flags: int = 0) -> bytes:
    """A frame; flags 1: more follow."""
    return bytes([flags, len(data)]) + data if len(data) < 256 else \
        bytes([flags | 2]) + struct.pack("!Q", len(data)) + data


PIECES = (GREETING, CURVE_GREETING, ready(b"PUB"), ready(b"SUB"), ready(b"ROUTER"), message(b"order"), message(b"", 1),
          message(bytes(300)), message(b"\x01topic"), message(b"\x00topic"), command(b"SUBSCRIBE", b"x"),
          command(b"CANCEL", b"x"), command(b"PING", b"\0\x10ctx"), command(b"PONG", b"ctx"),
          command(b"ERROR", b"\x03bad"), command(b"HELLO", bytes(194)), command(b"INITIATE", bytes(257)),
          command(b"MESSAGE", bytes(33)),
          b"\x06" + struct.pack("!Q", 2 ** 62), b"\x01\x00" * 500)


class Link(NamedTuple):
    """A robot's link, and what an honest peer has of it."""

    server: LinkServer
    ports: Tuple[int, int]
    honest: Any
    is_encrypted: bool


def prepare(_: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border."""
    context = zmq.Context()
    links, sources, before_mib = [_link(context, False), _link(context, True)], itertools.count(1), [0.0]

    def case(chance: random.Random) -> Tuple[str, str]:
        number, link = next(sources), chance.choice(links)
        # An address that was cut off has to wait; somebody with a whole network has more of them.
        source = f"127.{1 + number % 254}.{1 + number // 254 % 254}.{1 + number // 64516 % 254}"
        with contextlib.suppress(OSError), socket.socket() as peer:
            peer.bind((source, 0))
            peer.settimeout(LIMIT_S)
            peer.connect(("127.0.0.1", chance.choice(link.ports)))
            peer.sendall(conversation(chance))
        found = [each.data for each in link.server.receive(0.001)]
        if link.is_encrypted and found != []:
            return "taken", f"{found[0][:50]!r} of a peer without a key"
        link.server.cut_off()
        if number == CASES_A_LOOK:
            before_mib[0] = resident_mib()
        return "sent", "" if number % CASES_A_LOOK else look(links, before_mib[0])
    return case


def conversation(chance: random.Random) -> bytes:
    """Bytes of a peer that begins well, half of the time, and goes on badly."""
    begun = chance.choice((b"", GREETING + ready(b"PUB"), GREETING + ready(b"SUB"), CURVE_GREETING))
    data = begun + b"".join(chance.choice(PIECES) for _ in range(chance.randint(1, 8)))
    if chance.random() < 0.5:
        return begun + (spoilt_bytes(chance, data[len(begun):], PIECES) or b"\0")
    return spoilt_bytes(chance, data, PIECES)


def look(links: List[Link], before_mib: float) -> str:
    """What is wrong with the links now; empty when an honest peer hears, and memory is as it was."""
    for link in links:
        heard = False
        for _ in range(int(LIMIT_S / 0.02)):
            link.server.receive(0.0)
            link.server.publish(b"status")
            if link.honest.poll(20):
                heard = link.honest.recv() == b"status"
                break
        if not heard:
            return f"an honest peer hears nothing any more, encrypted: {link.is_encrypted}"
        while link.honest.poll(0):
            link.honest.recv()
    grown_mib = resident_mib() - before_mib
    return f"{grown_mib:.0f} MiB more than at the beginning" if before_mib and grown_mib > MAX_GROWTH_MIB else ""


def _link(context: Any, is_encrypted: bool) -> Link:
    keys, own = KeyPair(*zmq.curve_keypair()), KeyPair(*zmq.curve_keypair())
    with socket.socket() as one, socket.socket() as two:
        for each in (one, two):
            each.bind(("127.0.0.1", 0))
        ports = one.getsockname()[1], two.getsockname()[1]
    curve = Curve(keys, lambda key: key == own.public.decode("ascii")) if is_encrypted else None
    server = LinkServer(Ports("127.0.0.1", *ports), curve)
    server.bind()
    honest = context.socket(zmq.SUB)
    honest.setsockopt(zmq.SUBSCRIBE, b"status")
    honest.setsockopt(zmq.LINGER, 0)
    if is_encrypted:
        honest.curve_publickey, honest.curve_secretkey, honest.curve_serverkey = *own, keys.public
    honest.connect(f"tcp://127.0.0.1:{ports[0]}")
    return Link(server, ports, honest, is_encrypted)
