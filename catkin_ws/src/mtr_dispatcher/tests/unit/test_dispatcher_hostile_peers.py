"""Peers that bring more than messages are cut off one by one; memory is bounded, and other peers are served. D1"""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import json
import os
import socket
import subprocess
import sys

import pytest
import zmq
from link_peers import free_ports

from mtr_dispatcher.access.connection_watch import TOO_MUCH, ConnectionWatch, _received_bytes
from mtr_dispatcher.access.peer_limits import (
    COMMAND_BURST_BYTES,
    TOO_MANY,
    TOO_SOON,
    Allowance,
    PeerLimits,
)
from mtr_dispatcher.link_server import LinkServer, Ports

# The link alone in its own process, which reports its memory at the end.
SERVE = """
import json, sys, select, time
from collections import Counter
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_dispatcher.memory import resident_mib
server = LinkServer(Ports("127.0.0.1", int(sys.argv[1]), int(sys.argv[2])))
server.bind()
before, peak, cut, heard = resident_mib(), 0.0, Counter(), 0
print("ready", flush=True)
end_s = time.monotonic() + float(sys.argv[3])
while not (heard and cut and select.select([sys.stdin], [], [], 0.0)[0]) and time.monotonic() < end_s:
    heard += sum(message.data == b"order" for message in server.receive(0.02))
    server.publish(b"status")
    cut += server.cut_off()
    peak = max(peak, resident_mib())
print(json.dumps({"grown_mib": peak - before, "cut": cut, "heard": heard}))
server.close()
"""
LIMIT_S = 20.0
# Bytes that a hostile peer sends if it is not stopped; without a limit ZeroMQ used 30 times as much (64 bytes a frame).
FLOOD_BYTES = 20_000_000
# Peers of other tests may reconnect for a while to reused ports of 127.0.0.1; a separate address excludes them.
OWN_ADDRESS = "127.7.1.1"
MAX_GROWTH_MIB = 64.0
GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\0") + bytes(32)
ENDLESS_PARTS = b"\x01\x00" * 32768


def ready(kind):
    """Return ZMTP's READY command for a kind of socket."""
    body = b"\x05READY\x0bSocket-Type" + len(kind).to_bytes(4, "big") + kind
    return b"\x04" + bytes([len(body)]) + body


class Served:
    """The process of the link."""

    def __init__(self):
        self.ports = free_ports()
        self._process = subprocess.Popen([sys.executable, "-c", SERVE, *map(str, (*self.ports, LIMIT_S))],
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self._process.stdout.readline() == "ready\n"

    def end(self, act):
        """Let it run until it has received an order and cut off a peer; return its report. act: called meanwhile."""
        self._process.stdin.write("\n")
        self._process.stdin.flush()
        while self._process.poll() is None:
            act()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(0.02)
        return json.loads(self._process.stdout.read())


@pytest.fixture
def served():
    link = Served()
    yield link
    with contextlib.suppress(Exception):
        link._process.kill()
    link._process.wait()


def greeted(port, kind, address="127.0.0.1"):
    """Return a raw connection after its handshake."""
    connection = socket.create_connection((address, port), timeout=LIMIT_S)
    connection.sendall(GREETING + ready(kind))
    answer = b""
    while b"READY" not in answer:
        received = connection.recv(4096)
        assert received, "The robot has closed the connection."
        answer += received
    return connection


def flood(connection, pieces):
    """Send until the robot cuts the connection or FLOOD_BYTES are sent; return the number of sent bytes."""
    sent = 0
    with connection, contextlib.suppress(ConnectionError):
        for piece in pieces:
            connection.sendall(piece)
            sent += len(piece)
            if sent > FLOOD_BYTES:
                break
    return sent


def subscriptions():
    """Yield subscriptions, all different."""
    for first in range(0, 1 << 24, 4096):
        yield b"".join(b"\x00\x06\x01x" + number.to_bytes(4, "big") for number in range(first, first + 4096))


@pytest.mark.parametrize("port, kind, pieces", [
    (1, b"PUB", (ENDLESS_PARTS for _ in iter(int, 1))), (0, b"SUB", subscriptions())], ids=["parts", "subscriptions"])
def test_peer_that_brings_more_than_messages_is_cut_off_and_memory_stays(served, port, kind, pieces):
    honest = zmq.Context.instance().socket(zmq.PUB)
    honest.setsockopt(zmq.LINGER, 0)
    honest.connect(f"tcp://127.0.0.1:{served.ports[1]}")
    sent = flood(greeted(served.ports[port], kind), pieces)
    seen = served.end(lambda: honest.send(b"order"))
    honest.close()
    assert sent < FLOOD_BYTES and seen["cut"] == {TOO_MUCH: 1}
    assert seen["heard"] > 0 and seen["grown_mib"] < MAX_GROWTH_MIB


def test_message_of_a_peer_with_an_old_protocol_is_received():
    """ZMTP 2.0 messages do not identify their connection; ZeroMQ accepts them on a link without keys."""
    ports = free_ports()
    server = LinkServer(Ports("127.0.0.1", *ports))
    server.bind()
    try:
        with socket.create_connection(("127.0.0.1", ports[1]), timeout=LIMIT_S) as old:
            old.sendall(b"\xff" + bytes(8) + b"\x7f\x01\x01" + b"\0\0" + b"\0\x05order")
            assert [message.data for message in server.receive(LIMIT_S)] == [b"order"]
    finally:
        server.close()


LIMITS = Allowance(burst_bytes=1000.0, bytes_per_s=10.0, connections=2, pause_s=5.0, overhead_bytes=2,
                   check_period_s=0.05)


def test_one_connection_too_many_is_cut_off_and_those_before_stay():
    context = zmq.Context()
    bound = context.socket(zmq.SUB)
    port = bound.bind_to_random_port(f"tcp://{OWN_ADDRESS}")
    watch = ConnectionWatch(bound, PeerLimits(LIMITS))
    try:
        first, second = (greeted(port, b"PUB", OWN_ADDRESS) for _ in range(LIMITS.connections))
        with first, second, socket.socket() as third:
            third.settimeout(LIMIT_S)
            # On a busy machine the connection is cut off before connect returns.
            with contextlib.suppress(ConnectionError):
                third.connect((OWN_ADDRESS, port))
                while third.recv(4096):
                    pass
            assert watch.counted()[TOO_MANY] == 1
            for stays in (first, second):
                stays.setblocking(False)
                with pytest.raises(BlockingIOError):
                    stays.recv(1)
    finally:
        watch.close()
        context.destroy(0)


def test_what_became_messages_is_not_counted_however_much_it_is():
    limits = PeerLimits(LIMITS)
    assert not limits.open(5, "a", 0.0)
    for turn in range(1, 100):
        limits.delivered(5, 1, 998)
        assert limits.excessive({5: 1000 * turn}, 0.01 * turn) == []
    assert limits.excessive({5: 99_000 + 1012}, 1.0) == [5]


def test_what_trickles_is_forgiven_and_nothing_in_advance():
    limits = PeerLimits(LIMITS)
    limits.open(5, "a", 0.0)
    assert limits.excessive({5: 0}, 1000.0) == []
    assert limits.excessive({5: 1011}, 1001.0) == [5]
    trickle = PeerLimits(LIMITS)
    trickle.open(5, "a", 0.0)
    assert not any(trickle.excessive({5: 9 * second}, float(second)) for second in range(1000))


def test_message_that_is_taken_before_it_is_counted_gives_no_credit_twice():
    limits = PeerLimits(LIMITS)
    limits.open(5, "a", 0.0)
    limits.delivered(5, 1, 498)
    assert limits.excessive({5: 0}, 0.0) == [] and limits.excessive({5: 500 + 1000}, 0.0) == []
    assert limits.excessive({5: 500 + 1001}, 0.0) == [5]


def test_connection_that_is_closed_makes_room_and_strangers_are_none_of_them():
    limits = PeerLimits(LIMITS)
    assert [limits.open(number, "a", 0.0) for number in (1, 2, 3)] == ["", "", TOO_MANY]
    limits.close(3)
    limits.close(1)
    assert not limits.open(1, "a", 0.0) and limits.excessive({7: 10 ** 9}, 0.0) == []


def test_address_that_was_cut_off_waits_before_it_opens_another_and_others_do_not():
    limits = PeerLimits(LIMITS)
    limits.open(1, "hostile", 0.0)
    assert limits.excessive({1: 10_000}, 1.0) == [1]
    limits.close(1)
    assert limits.open(2, "hostile", 1.1) == TOO_SOON
    limits.close(2)
    assert not limits.open(3, "honest", 1.1) and not limits.open(4, "hostile", 6.0)


def test_burst_of_commands_holds_every_message_that_the_link_takes():
    assert COMMAND_BURST_BYTES > 2 * 64 * 1024


def test_number_of_a_connection_that_a_file_has_by_now_brings_nothing_and_costs_no_descriptor():
    with open("/proc/self/statm", encoding="ascii") as file:
        before = len(os.listdir("/proc/self/fd"))
        assert [_received_bytes(file.fileno(), ("127.0.0.1", 1)) for _ in range(10)] == [0] * 10
        assert len(os.listdir("/proc/self/fd")) == before
