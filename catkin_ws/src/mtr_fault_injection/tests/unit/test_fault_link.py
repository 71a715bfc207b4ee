"""Relay of the link: lost, late, duplicate and reordered frames, in one direction only; plain and encrypted."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import socket
import time

import pytest
import zmq

from mtr_fault_injection.link.frames import GREETING_BYTES, Frame, FrameCutter, FrameSpoiler
from mtr_fault_injection.link.relay import PortRelay, RelayError
from mtr_fault_injection.link.second_operator import SecondOperator
from mtr_fault_injection.parts import Kind
from mtr_fault_injection.schedule import fault_of
from mtr_proto import robot_link_pb2 as link

LIMIT_S = 20.0
GREETING = bytes(GREETING_BYTES)
READY, SHORT, LONG = b"\x04\x05READY", b"\x00\x03abc", b"\x02" + (300).to_bytes(8, "big") + bytes(300)
ENCRYPTED = b"\x04\x0a\x07MESSAGE.."


def fault(kind, amount=0.0, part="link_statuses"):
    return fault_of(part, kind, 100.0, amount, 0.0)


@pytest.mark.parametrize("size", [1, 7, 1000])
def test_frames_are_cut_wherever_the_bytes_are(size):
    cutter, data = FrameCutter(), GREETING + READY + SHORT + LONG + ENCRYPTED
    frames = [frame for start in range(0, len(data), size) for frame in cutter.feed(data[start:start + size])]
    assert b"".join(frame.data for frame in frames) == data
    assert [frame.data for frame in frames[-4:]] == [READY, SHORT, LONG, ENCRYPTED]
    assert [frame.is_message for frame in frames[-4:]] == [False, True, True, True]
    assert not any(frame.is_message for frame in frames[:-4])


def test_first_bytes_of_a_greeting_are_not_held_back():
    assert FrameCutter().feed(b"\xff") == [Frame(b"\xff", False)]


def passed(kind, amount=0.0, count=6):
    """Return the bytes that arrive of `count` messages between two heartbeats."""
    spoiler, there = FrameSpoiler(1), fault(kind, amount)
    sent = [Frame(b"ping", False), *(Frame(b"%d" % number, True) for number in range(count)), Frame(b"ping", False)]
    return b"".join(piece for frame in sent for piece in spoiler.passed(frame, there))


def test_only_messages_are_lost_doubled_and_reordered():
    assert passed("double", count=2) == b"ping0011ping"
    assert passed("reorder") == b"ping103254ping"
    assert passed("reorder", count=3) == b"ping102ping"
    assert passed("lose", 1.0) == b"pingping"
    assert passed("off") == b""
    lost = passed("lose", 0.3, count=9)
    assert len(b"pingping") < len(lost) < len(b"pingping") + 9


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Line:
    """Publisher, relay with faults in one direction, and subscriber behind it."""

    def __init__(self, encrypted=False):
        self.context, self.fault = zmq.Context(), None
        self.publisher, self.subscriber = self.context.socket(zmq.PUB), self.context.socket(zmq.SUB)
        if encrypted:
            public, secret = zmq.curve_keypair()
            self.publisher.curve_server, self.publisher.curve_secretkey = True, secret
            self.subscriber.curve_publickey, self.subscriber.curve_secretkey = zmq.curve_keypair()
            self.subscriber.curve_serverkey = public
        port, relayed = free_port(), free_port()
        self.publisher.bind(f"tcp://127.0.0.1:{port}")
        self.relay = PortRelay(("127.0.0.1", relayed), ("127.0.0.1", port), lambda: None, lambda: self.fault)
        self.subscriber.setsockopt(zmq.SUBSCRIBE, b"")
        self.subscriber.connect(f"tcp://127.0.0.1:{relayed}")
        self.until(b"there", b"there")

    def until(self, wanted, sent):
        """Return the messages up to the wanted one, which is sent until it arrives."""
        found, end_s = [], time.monotonic() + LIMIT_S
        while not found or found[-1] != wanted:
            assert time.monotonic() < end_s, f"{wanted} has not arrived, only {found}"
            self.publisher.send(sent)
            if self.subscriber.poll(20):
                found.append(self.subscriber.recv())
        return found

    def taken(self):
        """Return the messages that arrived before a mark that is sent now."""
        return [each for each in self.until(b"mark", b"mark") if each not in (b"there", b"mark")]

    def send(self, *messages):
        for each in messages:
            self.publisher.send(each)

    def close(self):
        self.relay.close()
        self.context.destroy(0)


@pytest.fixture(params=[False, True], ids=["plain", "encrypted"])
def line(request):
    made = Line(request.param)
    yield made
    made.close()


def test_messages_are_lost_one_way_while_the_connection_stays(line):
    line.fault = fault("lose", 1.0)
    line.send(b"one", b"two")
    # The fault must last until the relay has read the messages.
    end_s = time.monotonic() + 0.2
    while time.monotonic() < end_s:
        assert not line.subscriber.poll(20) or line.subscriber.recv() == b"there"
    line.fault = None
    assert line.taken() == []


def test_messages_are_late_by_the_amount(line):
    line.taken()
    line.fault = fault("slow", 0.3)
    begun_s = time.monotonic()
    line.send(b"late")
    while line.subscriber.recv() != b"late":
        pass
    assert time.monotonic() - begun_s > 0.3


def test_what_comes_twice_is_heard_twice_where_it_is_not_encrypted():
    line = Line()
    with contextlib.closing(line):
        line.taken()
        line.fault = fault("double")
        line.send(b"again")
        heard = []
        while len(heard) < 2:
            assert line.subscriber.poll(1000 * LIMIT_S)
            message = line.subscriber.recv()
            heard += [message] if message == b"again" else []
        assert heard == [b"again", b"again"]


def test_port_that_is_taken_is_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as taken, pytest.raises(RelayError, match="relay of the link cannot"):
        PortRelay(taken.getsockname(), ("127.0.0.1", 1), lambda: None, lambda: None)


@pytest.mark.parametrize("kind", [Kind.CLAIM, Kind.GARBAGE])
def test_second_operator_answers_a_status_with_a_session_of_its_own_or_with_nonsense(kind):
    context = zmq.Context()
    statuses, commands = context.socket(zmq.PUB), context.socket(zmq.SUB)
    commands.setsockopt(zmq.SUBSCRIBE, b"")
    ports = [socket_.bind_to_random_port("tcp://127.0.0.1") for socket_ in (statuses, commands)]
    operator = SecondOperator(kind, "127.0.0.1", *ports, seed=1)
    try:
        end_s = time.monotonic() + LIMIT_S
        while not commands.poll(20):
            assert time.monotonic() < end_s
            statuses.send(link.Status(id=7, sent_time_s=3.0).SerializeToString())
        data = commands.recv()
        if kind is Kind.CLAIM:
            command = link.Command.FromString(data)
            assert command.seen_status_id == 7 and command.session_id and command.waypoint.x == 5.0
        else:
            assert len(data) < 300
    finally:
        operator.end()
        context.destroy(0)
