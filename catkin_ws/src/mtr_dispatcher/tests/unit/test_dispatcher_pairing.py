"""The socket of pairing on the loopback interface: a laptop with the code is paired, and nothing else is possible."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import socket
import threading
import time

import pytest
import zmq

from mtr_dispatcher.access import command_line
from mtr_dispatcher.access.authorised_keys import Role
from mtr_dispatcher.access.command_line import DONE, ERROR, NOT_PAIRED
from mtr_dispatcher.access.key_folder import KeyFolder
from mtr_dispatcher.access.pairing_server import CONNECTION_S, Clock, Offer, PairingFailed, PairingServer
from mtr_dispatcher.access.pairing_window import (
    DEFAULT_SECONDS,
    FIRST_PAUSE_S,
    MAX_TRIES,
    PairingLimits,
    PairingWindow,
)
from mtr_proto.keys import KeyPair
from mtr_proto.pairing import ANSWER_BYTES, HELLO_BYTES, WELCOME_BYTES, LaptopSide, Paired, PairingError, WrongCode

# rosdep has no key for it (setup/README.md), so a robot with only the declared dependencies may lack it.
pytest.importorskip("spake2")

LIMIT_S = 5.0
CODE, OTHER_CODE = "123456", "654321"
LAPTOP = KeyPair(*zmq.curve_keypair())


class Robot:
    """A pairing that runs in a thread, on a clock that advances only by waiting."""

    def __init__(self, keep=lambda hello: None, role=Role.CONTROLLER, *, now_s=0.0, begins=True):
        self.keys, self.said, self.waited, self.now_s = KeyPair(*zmq.curve_keypair()), [], [], now_s
        self.server = PairingServer(Offer(CODE, self.keys, role), keep, self.said.append,
                                    Clock(lambda: self.now_s, self.wait))
        self.port = self.server.listen("127.0.0.1", 0)
        self.window = PairingWindow(PairingLimits(), 0.0)
        self.result = None
        self.thread = threading.Thread(target=self.run, daemon=True)
        if begins:
            self.thread.start()

    def wait(self, pause_s):
        self.waited.append(pause_s)
        self.now_s += pause_s

    def run(self):
        self.result = self.server.run(self.window)

    def ended(self):
        """Return the result of the pairing."""
        self.thread.join(LIMIT_S)
        assert not self.thread.is_alive()
        return self.result


def received(connection, length):
    data = b""
    while len(data) < length:
        part = connection.recv(length - len(data))
        if not part:
            raise PairingError("closed")
        data += part
    return data


def waiting(port):
    """Return a laptop's connection, which the robot may not have accepted yet."""
    return socket.create_connection(("127.0.0.1", port), timeout=LIMIT_S)


def try_code(port, code):
    """Connect a laptop and try a code."""
    with waiting(port) as connection:
        return try_code_on(connection, code)


def try_code_on(connection, code):
    """Try a code on an open connection."""
    side = LaptopSide(code, LAPTOP.public, "Jana's laptop")
    connection.sendall(side.hello())
    connection.sendall(side.proof(received(connection, ANSWER_BYTES)))
    return side.welcomed(received(connection, WELCOME_BYTES))


@pytest.mark.parametrize("role", list(Role))
def test_right_code_gives_each_side_the_others_key(role):
    kept = []
    robot = Robot(kept.append, role)
    assert try_code(robot.port, CODE) == Paired(robot.keys.public.decode(), role.value)
    assert robot.ended() == kept[0] and kept[0].public_key == LAPTOP.public.decode()
    assert kept[0].name == "Jana's laptop" and robot.window.paired


def test_wrong_codes_are_counted_slowed_and_end_the_pairing():
    robot = Robot(pytest.fail)
    for _ in range(MAX_TRIES):
        with pytest.raises((PairingError, OSError)):
            try_code(robot.port, OTHER_CODE)
    assert robot.ended() is None and robot.window.tries == MAX_TRIES
    assert [each for each in robot.waited if each] == [2.0, 4.0]
    assert sum("Wrong code" in line for line in robot.said) == MAX_TRIES
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.1", robot.port), timeout=LIMIT_S)


def test_who_waited_in_line_when_the_window_closed_is_not_paired():
    kept = []
    robot = Robot(kept.append, now_s=DEFAULT_SECONDS - FIRST_PAUSE_S + 0.1, begins=False)
    with waiting(robot.port) as first, waiting(robot.port) as second:
        robot.thread.start()
        for connection, code in ((first, OTHER_CODE), (second, CODE)):
            with pytest.raises((PairingError, OSError)):
                try_code_on(connection, code)
    assert robot.ended() is None and not kept and robot.window.tries == 1
    assert "nobody was paired" in robot.window.why_closed()


def test_who_says_nothing_keeps_the_window_open_no_longer():
    server = PairingServer(Offer(CODE, LAPTOP, Role.VIEWER), print, print)
    port, now_s = server.listen("127.0.0.1", 0), time.monotonic()
    with waiting(port):
        assert server.run(PairingWindow(PairingLimits(), now_s - DEFAULT_SECONDS + 0.3)) is None
    assert time.monotonic() - now_s < CONNECTION_S / 2.0


def test_who_breaks_off_after_the_answer_has_had_a_try():
    robot = Robot(pytest.fail)
    for _ in range(MAX_TRIES):
        with socket.create_connection(("127.0.0.1", robot.port), timeout=LIMIT_S) as connection:
            connection.sendall(LaptopSide(OTHER_CODE, LAPTOP.public, "x").hello())
            received(connection, ANSWER_BYTES)
    assert robot.ended() is None and robot.window.tries == MAX_TRIES


@pytest.mark.parametrize("data", [b"", b"GET / HTTP/1.1\r\n\r\n", bytes(HELLO_BYTES), b"MTRPAIR1" + b"\xff" * 500,
                                  b"\xff\0\0\0\0\0\0\0\x01\x7f\x03\0CURVE" + bytes(60)])
def test_other_bytes_are_no_try_and_the_person_is_still_paired(data):
    robot = Robot()
    with socket.create_connection(("127.0.0.1", robot.port), timeout=LIMIT_S) as connection:
        connection.sendall(data)
        if len(data) < HELLO_BYTES:
            # With more bytes the robot closes by itself, perhaps earlier than this.
            connection.shutdown(socket.SHUT_WR)
        with contextlib.suppress(ConnectionResetError):
            assert connection.recv(1) == b""
    try_code(robot.port, CODE)
    assert robot.ended() and robot.window.strange == 1 and robot.window.tries == 1


def test_man_in_the_middle_who_puts_in_his_own_key_is_found_by_both():
    robot = Robot(pytest.fail)
    mallory, _ = zmq.curve_keypair()
    side = LaptopSide(CODE, LAPTOP.public, "Jana")
    with socket.create_connection(("127.0.0.1", robot.port), timeout=LIMIT_S) as connection:
        connection.sendall(side.hello().replace(LAPTOP.public, mallory))
        answer = received(connection, ANSWER_BYTES)
        connection.sendall(side.proof(answer.replace(robot.keys.public, mallory)))
        with pytest.raises((PairingError, OSError)):
            received(connection, WELCOME_BYTES)
    with pytest.raises(WrongCode):
        side.welcomed(bytes(WELCOME_BYTES))
    for _ in range(MAX_TRIES - 1):
        with pytest.raises((PairingError, OSError)):
            try_code(robot.port, OTHER_CODE)
    assert robot.ended() is None


def test_reflected_messages_pair_nobody():
    side = LaptopSide(CODE, LAPTOP.public, "Jana")
    own = side.hello()[8:8 + ANSWER_BYTES]
    with pytest.raises(PairingError):
        side.proof(own)


def test_busy_port_is_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        with pytest.raises(PairingFailed, match=f"127.0.0.1 port {port}"):
            PairingServer(Offer(CODE, LAPTOP, Role.VIEWER), print, print).listen("127.0.0.1", port)


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


def test_command_shows_a_code_and_keeps_whom_it_pairs(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(command_line, "new_code", lambda: CODE)
    port, codes = free_port(), []
    arguments = ["--keys", str(tmp_path), "--port", str(port), "--role", "viewer", "--name", "Eva's tablet"]
    listening = threading.Event()
    say = command_line._say

    def heard(line):
        say(line)
        listening.set()
    monkeypatch.setattr(command_line, "_say", heard)
    thread = threading.Thread(target=lambda: codes.append(command_line.pair(arguments)), daemon=True)
    thread.start()
    assert listening.wait(LIMIT_S)
    assert try_code(port, CODE).role == "viewer"
    thread.join(LIMIT_S)
    assert codes == [DONE]
    (entry,) = KeyFolder(tmp_path).authorised().entries
    assert (entry.name, entry.role, entry.key) == ("Eva's tablet", Role.VIEWER, LAPTOP.public.decode())
    assert "123 456" in capsys.readouterr().out


def test_command_says_why_it_cannot_begin_or_nobody_came(tmp_path, monkeypatch, capsys):
    assert command_line.pair(["--keys", str(tmp_path), "--seconds", "1"]) == ERROR
    assert "allowed is 10 to 600 s" in capsys.readouterr().err
    monkeypatch.setattr(command_line.PairingServer, "run", lambda _self, _window: None)
    assert command_line.pair(["--keys", str(tmp_path), "--port", str(free_port())]) == NOT_PAIRED
    assert "nobody was paired" in capsys.readouterr().err
