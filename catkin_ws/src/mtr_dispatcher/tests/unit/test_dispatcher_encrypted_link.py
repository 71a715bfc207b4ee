"""The encrypted link on the loopback interface: admission, accepted Commands, and attacks of strangers."""
# SPDX-License-Identifier: Apache-2.0
import socket

import pytest
import zmq
from link_peers import COMMANDS_PER_S, LIMIT_S, Peer, Robot

from mtr_dispatcher.access.authorised_keys import Role
from mtr_dispatcher.access.connection_watch import GONE, NOT_ENCRYPTED
from mtr_dispatcher.access.gate import MAX_CONNECTION_BURST
from mtr_dispatcher.command_codec import MAX_MESSAGE_BYTES
from mtr_proto.keys import KeyPair

# The greeting of ZMTP 3.0: signature, version, mechanism NULL, no server (rfc.zeromq.org/spec/23).
ZMTP_VERSION_BYTES = 11
PLAIN_GREETING = b"\xff" + bytes(8) + b"\x7f\x03\x00" + b"NULL".ljust(20, b"\0") + bytes(32)

@pytest.fixture
def context():
    made = zmq.Context()
    yield made
    made.destroy(0)


@pytest.fixture
def robot(tmp_path):
    made = Robot(tmp_path / "keys")
    yield made
    made.server.close()


def arrived(robot, peer, data=b"hello"):
    """Return the message of a peer as received by the robot."""
    found = robot.messages(data, lambda: peer.socket.send(data))
    return next(message for message in found if message.data == data)


def test_message_of_a_paired_key_names_its_owner(robot, context):
    keys = robot.pair("Jana")
    message = arrived(robot, Peer(context, robot, keys))
    sender = robot.gate.sender(message.key, 0.0)
    assert message.key == keys.public.decode() and sender.name == "Jana" and not sender.refusal


def test_unknown_key_is_refused_and_counted(robot, context):
    robot.pair()
    stranger = Peer(context, robot, zmq.curve_keypair())
    assert stranger.event == zmq.EVENT_HANDSHAKE_FAILED_AUTH
    assert robot.gate.refused == {"unknown key": 1}


def test_client_without_encryption_is_refused_and_counted(robot, context):
    assert not Peer(context, robot, None).is_in
    assert set(robot.failed()) <= {NOT_ENCRYPTED, GONE}


def test_plain_greeting_is_refused_and_counted(robot):
    """The plain connection stays open; ZeroMQ's own client may close it before the robot has read its greeting."""
    with socket.create_connection(("127.0.0.1", robot.ports[1])) as plain:
        plain.sendall(PLAIN_GREETING)
        assert robot.failed() == [NOT_ENCRYPTED]


def test_peer_that_goes_before_it_has_said_what_it_is_is_counted(robot):
    with socket.create_connection(("127.0.0.1", robot.ports[1])) as brief:
        brief.sendall(PLAIN_GREETING[:ZMTP_VERSION_BYTES])
    assert robot.failed() == [GONE]


def test_client_that_takes_another_robot_for_this_one_is_not_let_in(robot, context):
    keys = robot.pair()
    other, _ = zmq.curve_keypair()
    peer = context.socket(zmq.PUB)
    peer.setsockopt(zmq.LINGER, 0)
    peer.curve_publickey, peer.curve_secretkey, peer.curve_serverkey = *keys, other
    peer.connect(f"tcp://127.0.0.1:{robot.ports[1]}")
    assert NOT_ENCRYPTED in robot.failed()


def test_revoked_key_is_let_in_no_more_and_its_messages_count_for_nothing(robot, context):
    keys = robot.pair("Jana")
    peer = Peer(context, robot, keys)
    message = arrived(robot, peer)
    assert not robot.gate.has_lost_keys()
    robot.folder.change(lambda known: known.without("Jana"))
    assert robot.gate.has_lost_keys() and not robot.gate.has_lost_keys()
    assert robot.gate.sender(message.key, 0.0).refusal.code == "dispatcher.key_unknown"
    assert Peer(context, robot, keys).event == zmq.EVENT_HANDSHAKE_FAILED_AUTH


def test_others_come_back_when_a_key_was_revoked(robot, context):
    stays = Peer(context, robot, robot.pair("Jana"))
    robot.pair("Petr")
    robot.folder.change(lambda known: known.without("Petr"))
    robot.server.rebind()
    assert arrived(robot, stays).key


def test_viewer_sees_status_and_commands_nothing(robot, context):
    keys = robot.pair("Eva", Role.VIEWER)
    message = arrived(robot, Peer(context, robot, keys))
    refusal = robot.gate.sender(message.key, 0.0).refusal
    assert refusal.code == "dispatcher.viewer_command" and "Eva" in refusal.text
    viewer = context.socket(zmq.SUB)
    viewer.setsockopt(zmq.SUBSCRIBE, b"")
    viewer.curve_publickey, viewer.curve_secretkey, viewer.curve_serverkey = *keys, robot.keys.public
    viewer.connect(f"tcp://127.0.0.1:{robot.ports[0]}")
    for _ in range(int(LIMIT_S / 0.01)):
        robot.server.publish(b"status")
        if viewer.poll(10):
            break
    assert viewer.recv(zmq.NOBLOCK) == b"status"


def test_recorded_conversation_is_worth_nothing(robot, context):
    """A relay records the messages of a paired laptop; when they are replayed, the robot receives no message."""
    keys = robot.pair()
    with socket.create_server(("127.0.0.1", 0)) as relay:
        port = relay.getsockname()[1]
        laptop = context.socket(zmq.PUB)
        laptop.setsockopt(zmq.LINGER, 0)
        laptop.curve_publickey, laptop.curve_secretkey, laptop.curve_serverkey = *keys, robot.keys.public
        laptop.connect(f"tcp://127.0.0.1:{port}")
        near, _ = relay.accept()
        with near, socket.create_connection(("127.0.0.1", robot.ports[1])) as far:
            recorded = b""
            near.setblocking(False)
            far.setblocking(False)

            def pass_on():
                nonlocal recorded
                laptop.send(b"secret order")
                for source, target in ((near, far), (far, near)):
                    try:
                        data = source.recv(65536)
                    except BlockingIOError:
                        continue
                    target.sendall(data)
                    recorded += data if source is near else b""
            robot.messages(b"secret order", pass_on)
        laptop.close(0)
    assert b"secret order" not in recorded
    # Messages that are still in transit end with the old connections.
    robot.server.rebind()
    with socket.create_connection(("127.0.0.1", robot.ports[1]), timeout=LIMIT_S) as replay:
        replay.sendall(recorded)
        while replay.recv(65536):
            pass
    honest = Peer(context, robot, robot.pair("Petr"))
    found = robot.messages(b"end", lambda: honest.socket.send(b"end"))
    assert {message.data for message in found} == {b"end"}


def test_oversized_and_endless_messages_of_one_do_not_disturb_another(robot, context):
    hostile, honest = Peer(context, robot, robot.pair("Mallory")), Peer(context, robot, robot.pair("Jana"))
    hostile.socket.send(bytes(MAX_MESSAGE_BYTES + 1))
    for _ in range(200):
        hostile.socket.send_multipart([b"part"] * 100)
    jana = [message for message in robot.messages(b"order", lambda: honest.socket.send(b"order"))
            if message.data == b"order"]
    assert robot.gate.sender(jana[0].key, 0.0).name == "Jana"


def test_flood_of_one_key_is_dropped_beyond_its_rate_and_another_key_is_heard(robot, context):
    hostile, honest = Peer(context, robot, robot.pair("Mallory")), Peer(context, robot, robot.pair("Jana"))
    senders = {"Mallory": [], "Jana": []}
    while len(senders["Mallory"]) < 2 * COMMANDS_PER_S:
        for _ in range(50):
            hostile.socket.send(b"flood")
        honest.socket.send(b"order")
        for message in robot.server.receive(0.01):
            sender = robot.gate.sender(message.key, 0.0)
            senders[sender.name].append(sender)
    taken = [sender for sender in senders["Mallory"] if not sender.refusal]
    assert len(taken) == COMMANDS_PER_S
    assert senders["Jana"] and not any(sender.refusal for sender in senders["Jana"])


def test_subscriptions_of_a_paired_key_do_not_keep_status_from_another(robot, context):
    hostile, honest = (context.socket(zmq.SUB) for _ in range(2))
    for subscriber, name in ((hostile, "Mallory"), (honest, "Jana")):
        subscriber.curve_publickey, subscriber.curve_secretkey = robot.pair(name)
        subscriber.curve_serverkey = robot.keys.public
        subscriber.connect(f"tcp://127.0.0.1:{robot.ports[0]}")
    for number in range(20_000):
        hostile.setsockopt(zmq.SUBSCRIBE, b"x%d" % number)
    honest.setsockopt(zmq.SUBSCRIBE, b"")
    for _ in range(int(LIMIT_S / 0.01)):
        robot.server.publish(b"status")
        if honest.poll(10):
            break
    assert honest.recv(zmq.NOBLOCK) == b"status"


def test_strangers_who_say_nothing_do_not_keep_a_paired_laptop_out(robot, context):
    silent = [socket.create_connection(("127.0.0.1", robot.ports[1])) for _ in range(64)]
    try:
        assert arrived(robot, Peer(context, robot, robot.pair())).key
    finally:
        for connection in silent:
            connection.close()


def test_a_key_that_connects_too_often_has_to_wait(robot):
    key = robot.pair().public.decode()
    allowed = [robot.gate.admits(key) for _ in range(100)]
    assert sum(allowed) == MAX_CONNECTION_BURST and robot.gate.refused["too many connections"] == 100 - sum(allowed)


def test_secret_key_does_not_stand_in_texts():
    keys = KeyPair(*zmq.curve_keypair())
    assert keys.secret.decode() not in f"{keys} {keys!r}"
