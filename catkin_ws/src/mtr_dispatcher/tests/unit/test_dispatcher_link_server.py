"""The sockets of the link on the loopback interface."""
# SPDX-License-Identifier: Apache-2.0
import socket
import sys
import time

import pytest
import zmq

from mtr_core.errors import ConfigurationError
from mtr_dispatcher.command_codec import MAX_MESSAGE_BYTES
from mtr_dispatcher.link_server import THREAD_TURN_S, LinkError, LinkServer, Ports
from mtr_dispatcher.parameters import Parameters

RECEIVE_LIMIT_S = 5.0
BEFORE = b"before"
# Default of sys.getswitchinterval.
PYTHONS_OWN_S = 0.005


def free_ports():
    with socket.socket() as one, socket.socket() as two:
        one.bind(("127.0.0.1", 0))
        two.bind(("127.0.0.1", 0))
        return one.getsockname()[1], two.getsockname()[1]


@pytest.fixture
def link():
    ports = free_ports()
    server, context = LinkServer(Ports("127.0.0.1", *ports)), zmq.Context()
    server.bind()
    sender = context.socket(zmq.PUB)
    sender.connect(f"tcp://127.0.0.1:{ports[1]}")
    deadline = time.monotonic() + RECEIVE_LIMIT_S
    # A message that is sent before the robot's subscription arrives is dropped.
    while not server.receive(0.01) and time.monotonic() < deadline:
        sender.send(BEFORE)
    yield server, sender
    server.close()
    context.destroy(0)


def sent(link, *frames):
    server, sender = link
    sender.send_multipart(frames)
    messages = []
    deadline = time.monotonic() + RECEIVE_LIMIT_S
    while not messages and time.monotonic() < deadline:
        messages = [message.data for message in server.receive(RECEIVE_LIMIT_S) if message.data != BEFORE]
    return messages


def test_message_arrives(link):
    assert sent(link, b"hello") == [b"hello"]


def test_threads_of_the_link_take_shorter_turns_than_pythons_own():
    chosen_s = sys.getswitchinterval()
    sys.setswitchinterval(PYTHONS_OWN_S)
    try:
        LinkServer(Ports("127.0.0.1", *free_ports())).close()
        assert sys.getswitchinterval() == pytest.approx(THREAD_TURN_S, rel=0.01) and THREAD_TURN_S < PYTHONS_OWN_S
    finally:
        sys.setswitchinterval(chosen_s)


def test_largest_message_arrives(link):
    assert sent(link, bytes(MAX_MESSAGE_BYTES)) == [bytes(MAX_MESSAGE_BYTES)]


def test_sender_of_an_oversized_message_is_cut_off(link):  # D1
    server, sender = link
    sender.send(bytes(MAX_MESSAGE_BYTES + 1))
    deadline, received = time.monotonic() + RECEIVE_LIMIT_S, []
    while b"again" not in received and time.monotonic() < deadline:
        sender.send(b"again")
        received += [message.data for message in server.receive(0.01)]
    assert set(received) <= {BEFORE, b"again"} and b"again" in received


def test_link_that_cuts_everybody_off_is_found_again(link):  # D1
    server, sender = link
    server.rebind()
    deadline, received = time.monotonic() + RECEIVE_LIMIT_S, []
    while not received and time.monotonic() < deadline:
        sender.send(b"again")
        received = [message.data for message in server.receive(0.01)]
    assert b"again" in received


def test_message_of_several_frames_is_no_command(link):
    assert sent(link, b"one", b"two")[0].startswith(b"\xff")


def test_nothing_is_received_when_nothing_is_sent(link):
    assert {message.data for message in link[0].receive(0.0)} <= {BEFORE}


def test_busy_port_is_a_sentence():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        busy = other.getsockname()[1]
        server = LinkServer(Ports("127.0.0.1", free_ports()[0], busy))
        with pytest.raises(LinkError, match=f"port {busy} \\(command_port\\)"):
            server.bind()


@pytest.mark.parametrize("bad", [{"status_port": 0}, {"command_port": 65536}, {"status_port": 3333},
                                 {"link_timeout_s": 0.0}, {"default_speed_mps": 3.0},
                                 {"allow_unencrypted": True, "encrypt_on_loopback": True}])
def test_parameter_out_of_range_is_a_sentence(bad):
    with pytest.raises(ConfigurationError, match=next(iter(bad))):
        Parameters(**bad)
