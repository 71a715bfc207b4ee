"""Keys of this laptop, paired robots, and with what a robot is tried; pairing against the contract's robot side."""
# SPDX-License-Identifier: Apache-2.0
import errno
import os
import socket
import threading

import pytest
import zmq

from mtr_operator.cli.entry import main
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter
from mtr_operator.domain.results.session_record import controller_record
from mtr_operator.robot_link.access.credentials import ways_to
from mtr_operator.robot_link.access.key_chain import CONTROLLER, OWN_KEYS, ROBOTS, VIEWER, KeyChain, PairedRobot
from mtr_operator.robot_link.access.pairing import default_name, pair
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.station.connection import Connection, RobotChoice
from mtr_operator.station.settings import Settings
from mtr_proto.keys import KeyPair, LinkKeyError, fingerprint, own_key_pair
from mtr_proto.pairing import (
    HELLO_BYTES,
    PROOF_BYTES,
    PairingError,
    RobotSide,
    WrongCode,
    code_of,
    new_code,
    plain_name,
)

ROBOT = KeyPair(*zmq.curve_keypair())
ROBOT_KEY = ROBOT.public.decode()
HOST, LAN_IP = "robot.example", "10.42.0.1"
LIMIT_S = 5.0


def paired(host=HOST, role=CONTROLLER, key=ROBOT_KEY):
    return PairedRobot(host, key, role, "2026-11-23")


@pytest.fixture
def chain(tmp_path):
    return KeyChain(tmp_path / "link")


def test_own_keys_are_made_once_and_are_for_their_owner_alone(chain, tmp_path):
    assert chain.own_keys() == chain.own_keys()
    assert (tmp_path / "link" / OWN_KEYS).stat().st_mode & 0o777 == 0o600
    os.chmod(tmp_path / "link" / OWN_KEYS, 0o640)
    with pytest.raises(ConnectionFailed, match="chmod 600"):
        chain.own_keys()


def test_paired_robots_are_kept_newest_first_and_forgotten(chain, tmp_path):
    other = paired(key="0" * 40)
    for robot in (paired(), other, paired("elsewhere"), paired()):
        chain.keep(robot)
    assert chain.robots() == (paired(), paired("elsewhere"), other)
    assert chain.robots_at(HOST) == (paired(), other)
    assert (tmp_path / "link" / ROBOTS).stat().st_mode & 0o777 == 0o600
    assert chain.forget(HOST) == 2 and chain.forget(HOST) == 0 and chain.robots() == (paired("elsewhere"),)


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"format": "mtr-operator robots", "version": 1, "robots": [{}]}',
                                     '{"format": "mtr-operator robots", "version": 1, "robots": [{"host": "a", '
                                     '"key": "short", "role": "controller", "date": ""}]}'])
def test_damaged_list_of_robots_is_a_sentence(chain, tmp_path, content):
    chain.own_keys()
    (tmp_path / "link" / ROBOTS).write_text(content, encoding="utf-8")
    with pytest.raises(ConnectionFailed, match="damaged"):
        chain.robots()


@pytest.mark.skipif(os.name != "posix", reason="Windows knows no such rights")
@pytest.mark.parametrize(("name", "rights", "mended"), [(ROBOTS, 0o666, "600"), (ROBOTS, 0o620, "600"),
                                                        ("", 0o777, "700"), ("", 0o770, "700")])
def test_list_of_robots_that_others_can_write_is_not_used(chain, tmp_path, name, rights, mended):
    chain.keep(paired())
    path = tmp_path / "link" / name
    os.chmod(path, rights)
    for act in (chain.robots, lambda: chain.keep(paired()), lambda: ways_to(HOST, LAN_IP, False, chain)):
        with pytest.raises(ConnectionFailed, match=rf"^Others may write {path}; say chmod {mended} {path}\.$"):
            act()
    os.chmod(path, int(mended, 8))
    assert chain.robots() == (paired(),)


def test_list_of_robots_that_cannot_be_read_now_is_not_called_damaged(chain, tmp_path, monkeypatch):
    chain.keep(paired())

    def none_left(*_arguments, **_options):
        raise OSError(errno.EMFILE, os.strerror(errno.EMFILE))
    monkeypatch.setattr("builtins.open", none_left)
    with pytest.raises(ConnectionFailed, match="robots.json cannot be read: Too many open files"):
        chain.robots()


def test_robot_elsewhere_has_to_be_paired(chain):
    with pytest.raises(ConnectionFailed, match="not paired with the robot at robot.example"):
        ways_to(HOST, LAN_IP, False, chain)
    chain.keep(paired())
    (way,) = ways_to(HOST, LAN_IP, False, chain)
    assert way.robot_key == ROBOT.public and way.own == chain.own_keys()


def test_encryption_is_given_up_only_by_the_person_or_within_this_computer(chain):
    chain.keep(paired())
    assert ways_to(HOST, LAN_IP, True, chain) == (None,)
    assert [way is None for way in ways_to(HOST, "127.0.0.1", False, chain)] == [False, True]
    assert ways_to("localhost", "127.0.0.1", False, chain) == (None,)


def test_doing_without_encryption_is_not_remembered():
    chosen = Connection(RobotChoice(LAN_IP, is_unencrypted=True))
    assert not Settings().with_connection(chosen).connection.robot.is_unencrypted


class Robot:
    """The robot's end of one pairing, in a thread."""

    def __init__(self, code, role=CONTROLLER):
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.hello = None
        threading.Thread(target=self._run, args=(code, role), daemon=True).start()

    def _run(self, code, role):
        with self.listener, self.listener.accept()[0] as connection:
            side = RobotSide(code, ROBOT.public)
            self.hello, answer = side.answer(self._received(connection, HELLO_BYTES))
            connection.sendall(answer)
            try:
                connection.sendall(side.welcome(self._received(connection, PROOF_BYTES), role))
            except WrongCode:
                return

    @staticmethod
    def _received(connection, length):
        data = b""
        while len(data) < length:
            data += connection.recv(length - len(data))
        return data


@pytest.mark.parametrize("role", [CONTROLLER, VIEWER])
def test_typed_code_pairs_and_the_robot_is_remembered(chain, role):
    robot = Robot("012345", role)
    found = pair("127.0.0.1", " 012-345 ", "Jana", robot.port, chain)
    assert (found.key, found.role) == (ROBOT.public.decode(), role) and chain.robots() == (found,)
    assert (robot.hello.name, robot.hello.public_key) == ("Jana", chain.own_keys().public.decode())


def test_wrong_code_is_a_sentence_and_nothing_is_remembered(chain):
    with pytest.raises(ConnectionFailed, match="The code is wrong"):
        pair("127.0.0.1", "111111", "Jana", Robot("222222").port, chain)
    assert chain.robots() == ()


def test_robot_that_does_not_pair_is_a_sentence(chain):
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))
        with pytest.raises(ConnectionFailed, match="have it show a code first"):
            pair("127.0.0.1", "111111", "Jana", closed.getsockname()[1], chain)


@pytest.mark.parametrize(("host", "code"), [("127.0.0.1", "12345"), ("127.0.0.1", "abcdef"), ("127.0.0.1", ""),
                                            ("300.1.1.1", "123456")])
def test_code_or_address_that_cannot_be_right_is_not_tried(chain, host, code):
    with pytest.raises(InvalidParameter):
        pair(host, code, chain=chain)


def test_codes_are_six_digits_and_names_one_line():
    assert all(code_of(new_code()) for _ in range(100))
    assert plain_name("a\nb\0\x1b[31m  c") == "a b [31m c" and plain_name(" \n") == "unnamed"
    assert len(plain_name("ř" * 100).encode("utf-8")) <= 64 and default_name()
    with pytest.raises(PairingError, match="6 digits"):
        code_of("1234567")


def test_key_that_is_made_twice_at_once_is_one(tmp_path):
    path, made = tmp_path / "station.key", []

    def make():
        # Another program was faster.
        if not made:
            made.append(True)
            own_key_pair(path, zmq.curve_keypair)
        return zmq.curve_keypair()
    first = own_key_pair(path, make)
    assert own_key_pair(path, zmq.curve_keypair) == first and len(list(tmp_path.iterdir())) == 1
    with pytest.raises(LinkKeyError, match="cannot be made"):
        own_key_pair(path / "below" / "x", zmq.curve_keypair)


@pytest.mark.parametrize(("ip", "is_exposed"), [("127.0.0.1", False), (LAN_IP, True)])
def test_link_without_encryption_says_whether_others_reach_it(chain, monkeypatch, ip, is_exposed):
    with ConnectionServer() as server:
        link = ZmqRobotLink("127.0.0.1", server.subscriber_port, server.publisher_port, chain=chain,
                            is_unencrypted=True)
        assert not link.is_exposed
        link.connect()
        monkeypatch.setattr(link, "_ip", ip)
        assert not link.is_secret and link.is_exposed is is_exposed
        link.close()
        assert not link.is_exposed


def test_record_names_the_owner_only_where_a_key_vouches():
    assert controller_record("") == {}
    assert controller_record("Jana") == {"link": "encrypted", "robot controlled with the key of": "Jana"}


def test_commands_pair_list_and_forget(capsys):
    robot = Robot("654321")
    assert main(["pair", "127.0.0.1", "--port", str(robot.port), "--code", "654 321", "--name", "Jana"]) == 0
    assert fingerprint(ROBOT.public.decode()) in capsys.readouterr().out
    assert main(["keys"]) == 0
    assert "127.0.0.1  controller" in capsys.readouterr().out
    assert main(["keys", "--forget", "127.0.0.1"]) == 0 and main(["keys", "--forget", "127.0.0.1"]) == 2
    assert "No robot at 127.0.0.1 is paired" in capsys.readouterr().err
    assert main(["pair", "127.0.0.1", "--code", "1"]) == 2
