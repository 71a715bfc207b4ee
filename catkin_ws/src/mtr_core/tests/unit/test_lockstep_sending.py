"""The publishing thread sends by itself and never waits for a subscriber."""
# SPDX-License-Identifier: Apache-2.0
import socket
import struct
import threading
import time
from types import SimpleNamespace

import pytest
from rospy.exceptions import TransportTerminated
from rospy.impl.tcpros_base import TCPROSTransport, TCPROSTransportProtocol

from mtr_core.lockstep.sending import SendingConnection, send_directly

LIMIT_S = 10.0
KEPT = 10


class Link:
    """rospy's transport on one end of a socket pair; the test reads the other end."""

    def __init__(self):
        near, self.far = socket.socketpair()
        # A small buffer is filled by few messages.
        near.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4096)
        near.setblocking(True)
        self.far.settimeout(LIMIT_S)
        self.transport = TCPROSTransport(TCPROSTransportProtocol("/topic", None), "/topic")
        self.transport.socket = near
        self.connection = SendingConnection(self.transport, KEPT)

    def numbers(self, until):
        """Return the numbers of the messages that arrive, up to this number."""
        found, data = [], b""
        while not found or found[-1] != until:
            data += self.far.recv(65536)
            while len(data) >= 4 and len(data) >= 4 + struct.unpack("<I", data[:4])[0]:
                (size,) = struct.unpack("<I", data[:4])
                found.append(int(data[4:4 + size].decode().rstrip(".")))
                data = data[4 + size:]
        return found


@pytest.fixture
def link():
    known = Link()
    yield known
    known.far.close()
    known.transport.close()


def message(number, size=1000):
    """Return a message as serialized by rospy: length and content."""
    content = str(number).encode().ljust(size, b".")
    return struct.pack("<I", len(content)) + content


def test_message_that_the_system_takes_is_sent_by_the_caller_alone(link):
    before = threading.active_count()
    for number in range(100):
        link.connection.write_data(message(number, 20))
        assert link.numbers(number) == [number]
    assert threading.active_count() == before
    assert (link.transport.stat_num_msg, link.transport.stat_bytes) == (100, 2400)


def test_subscriber_that_does_not_read_blocks_nobody_and_then_gets_whole_messages_the_newest_among_them(link):
    begun_s = time.monotonic()
    for number in range(1000):
        link.connection.write_data(message(number))
    assert time.monotonic() - begun_s < LIMIT_S
    found = link.numbers(999)
    assert found == sorted(set(found)) and found[-KEPT:] == list(range(1000 - KEPT, 1000))
    assert len(found) < 100
    # The queued messages were sent, and the caller sends directly again.
    deadline_s = time.monotonic() + LIMIT_S
    while link.connection._is_behind and time.monotonic() < deadline_s:
        time.sleep(0.01)
    before = threading.active_count()
    link.connection.write_data(message(1000, 20))
    assert link.numbers(1000) == [1000] and threading.active_count() == before


def test_connection_that_its_subscriber_has_closed_is_terminated_and_forgotten(link):
    forgotten = []
    link.transport.set_cleanup_callback(forgotten.append)
    link.far.close()
    with pytest.raises(TransportTerminated):
        link.connection.write_data(message(1))
    assert forgotten == [link.transport]
    with pytest.raises(TransportTerminated):
        link.connection.write_data(message(2))


def test_subscriber_that_goes_while_messages_wait_for_it_is_forgotten(link):
    forgotten = threading.Event()
    link.transport.set_cleanup_callback(lambda _: forgotten.set())
    for number in range(100):
        link.connection.write_data(message(number))
    link.far.close()
    assert forgotten.wait(LIMIT_S)


def test_publisher_has_such_connections_and_no_queue_of_rospys():
    added = []
    topic = SimpleNamespace(queue_size=KEPT, add_connection=added.append)
    topic.set_queue_size = lambda size: setattr(topic, "queue_size", size)
    send_directly(SimpleNamespace(impl=topic), KEPT)
    topic.add_connection(SimpleNamespace(endpoint_id="/node"))
    assert topic.queue_size is None and isinstance(added[0], SendingConnection) and added[0].endpoint_id == "/node"
