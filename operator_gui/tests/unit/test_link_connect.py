"""Connect parameters of the link: the 27 combinations of which one succeeds, and what the others say."""
# SPDX-License-Identifier: Apache-2.0
import itertools
import socket
import time

import pytest

from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, OperatorError
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.conversions import decode_command, status_message_from
from mtr_operator.robot_link.server import ConnectionServer

HOSTS = ("127.0.0.1", "127.0.0.2", "256.0.0.1")
# Subscriber port relative to the good one, publisher port likewise; None stands for -1.
SUBSCRIBER_SHIFTS = (0, -1, None)
PUBLISHER_SHIFTS = (0, 1, None)
COMBINATIONS = list(itertools.product(HOSTS, SUBSCRIBER_SHIFTS, PUBLISHER_SHIFTS))
GOOD = COMBINATIONS[0]
# Two probes and two handshakes of 2 s each is the most that can be waited for.
LIMIT_S = 10.0


@pytest.fixture(scope="module", name="server")
def server_fixture():
    """Server whose lower and upper neighbour ports are held by sockets that do not listen."""
    for _ in range(100):
        with ConnectionServer() as server, socket.socket() as below, socket.socket() as above:
            try:
                below.bind(("127.0.0.1", server.subscriber_port - 1))
                above.bind(("127.0.0.1", server.publisher_port + 1))
            except OSError:
                continue
            yield server
            return
    pytest.fail("no free neighbouring ports")


def connected(server, host, subscriber_shift, publisher_shift):
    """A link to the good ports, shifted."""
    subscriber = -1 if subscriber_shift is None else server.subscriber_port + subscriber_shift
    publisher = -1 if publisher_shift is None else server.publisher_port + publisher_shift
    link = ZmqRobotLink(host, subscriber, publisher)
    link.connect()
    return link


def test_good_parameters_connect(server):
    link = connected(server, *GOOD)
    until_s = time.monotonic() + LIMIT_S
    # What is sent before the other side's subscription has come into force is lost.
    while (status := link.next_status(0.01)) is None:
        assert time.monotonic() < until_s
        server.status_socket.send(status_message_from(RobotStatus(7, 1, 0.1)).SerializeToString())
    while not server.command_socket.poll(10):
        assert time.monotonic() < until_s
        link.send(DesiredState())
    command = decode_command(server.command_socket.recv())
    link.close()
    assert (status.id, command.session_id, command.seen_status_id) == (7, link.session_id, 7)


@pytest.mark.timeout(LIMIT_S)
@pytest.mark.parametrize(("host", "subscriber_shift", "publisher_shift"), COMBINATIONS[1:])
def test_other_parameters_fail_with_a_sentence_in_time(server, host, subscriber_shift, publisher_shift):
    started = time.monotonic()
    with pytest.raises((ConnectionFailed, InvalidParameter), match=r"\.$"):
        connected(server, host, subscriber_shift, publisher_shift)
    assert time.monotonic() - started < LIMIT_S


def test_swapped_ports_are_noticed(server):
    link = ZmqRobotLink("127.0.0.1", server.publisher_port, server.subscriber_port)
    with pytest.raises(ConnectionFailed, match="swapped"):
        link.connect()


def test_a_port_of_another_program_is_noticed(server):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        link = ZmqRobotLink("127.0.0.1", server.subscriber_port, other.getsockname()[1], connect_timeout_s=0.3)
        with pytest.raises(ConnectionFailed, match="publisher port"):
            link.connect()


def test_unknown_host_name_is_named():
    with pytest.raises(ConnectionFailed, match="robot.invalid"):
        ZmqRobotLink("robot.invalid").connect()


@pytest.mark.parametrize(("host", "subscriber", "publisher", "words"), [
    ("", 3334, 3333, "''"), ("256.0.0.1", 3334, 3333, "256.0.0.1"), ("1.2.3", 3334, 3333, "1.2.3"),
    ("a b", 3334, 3333, "'a b'"), ("-x", 3334, 3333, "'-x'"), ("localhost", 0, 3333, "subscriber port is 0"),
    ("localhost", 3334, 65536, "publisher port is 65536; allowed is a whole number from 1 to 65535"),
    ("localhost", "3334", 3333, "subscriber port is 3334"), ("localhost", 3333, 3333, "both 3333")])
def test_invalid_parameter_is_named_with_what_is_allowed(host, subscriber, publisher, words):
    with pytest.raises(InvalidParameter) as raised:
        ZmqRobotLink(host, subscriber, publisher)
    assert words in str(raised.value)


def test_link_that_is_not_connected_says_so():
    link = ZmqRobotLink("127.0.0.1")
    with pytest.raises(OperatorError, match="not connected"):
        link.next_status(0.0)
    link.close()


def test_busy_port_is_named(server):
    with pytest.raises(ConnectionFailed, match=str(server.subscriber_port)):
        ConnectionServer(server.subscriber_port, 0).open()
