"""Peers of an encrypted link on the loopback interface, for tests: paired ones and strangers."""
# SPDX-License-Identifier: Apache-2.0
import socket
import time

import zmq
from zmq.utils.monitor import recv_monitor_message

from mtr_dispatcher.access.authorised_keys import Entry, Role
from mtr_dispatcher.access.curve import Curve
from mtr_dispatcher.access.gate import Gate
from mtr_dispatcher.access.key_folder import KeyFolder
from mtr_dispatcher.link_server import LinkServer, Ports
from mtr_proto.keys import KeyPair

LIMIT_S = 5.0
COMMANDS_PER_S = 500
END = (zmq.EVENT_HANDSHAKE_SUCCEEDED | zmq.EVENT_HANDSHAKE_FAILED_AUTH | zmq.EVENT_HANDSHAKE_FAILED_PROTOCOL
       | zmq.EVENT_HANDSHAKE_FAILED_NO_DETAIL)


def free_ports():
    with socket.socket() as one, socket.socket() as two:
        one.bind(("127.0.0.1", 0))
        two.bind(("127.0.0.1", 0))
        return one.getsockname()[1], two.getsockname()[1]


class Robot:
    """A link server with a key folder and its gate."""

    def __init__(self, folder):
        self.folder = KeyFolder(folder)
        self.gate = Gate(self.folder.authorised, COMMANDS_PER_S, lambda: 0.0)
        self.ports = free_ports()
        self.keys = self.folder.own_keys()
        self.server = LinkServer(Ports("127.0.0.1", *self.ports), Curve(self.keys, self.gate.admits))
        self.server.bind()

    def pair(self, name="Jana", role=Role.CONTROLLER):
        """Return a new key pair that the robot accepts."""
        keys = KeyPair(*zmq.curve_keypair())
        self.folder.change(lambda known: known.with_entry(Entry(name, role, "2026-11-23", keys.public.decode())))
        return keys

    def messages(self, wanted, act=lambda: None):
        """Return the messages until one of them is wanted; `act` is called before each poll."""
        found, end_s = [], time.monotonic() + LIMIT_S
        while not any(message.data == wanted for message in found):
            assert time.monotonic() < end_s, f"{wanted} has not arrived"
            act()
            found += self.server.receive(0.01)
        return found

    def failed(self, number=1):
        """Return the causes of failed handshakes, at least `number` of them."""
        words, end_s = [], time.monotonic() + LIMIT_S
        while len(words) < number:
            assert time.monotonic() < end_s, f"only {words} failed"
            self.server.receive(0.01)
            words += self.server.cut_off().elements()
        return words


class Peer:
    """A peer that publishes on the Command port. keys: None for no encryption."""

    def __init__(self, context, robot, keys, robot_key=None):
        self.socket = context.socket(zmq.PUB)
        self.socket.setsockopt(zmq.LINGER, 0)
        if keys is not None:
            self.socket.curve_publickey, self.socket.curve_secretkey = keys
            self.socket.curve_serverkey = robot_key or robot.keys.public
        monitor = self.socket.get_monitor_socket(END)
        self.socket.connect(f"tcp://127.0.0.1:{robot.ports[1]}")
        assert monitor.poll(1000 * LIMIT_S), "no handshake has ended"
        self.event = recv_monitor_message(monitor)["event"]
        self.socket.disable_monitor()
        monitor.close(0)

    @property
    def is_in(self):
        """True if the robot has admitted the peer."""
        return self.event == zmq.EVENT_HANDSHAKE_SUCCEEDED
