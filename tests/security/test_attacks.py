"""The attacks would move a robot that lets them in: what a robot withstands proves nothing else."""
# SPDX-License-Identifier: Apache-2.0
import collections
import itertools
import threading
import time
from types import SimpleNamespace

import zmq
from attacks import unknown_keys
from hostile_peer import Target, orders

from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link

PERIOD_S = 0.02
# A Status is sent with every fifth Command.
OF_STATUS = 5


def moving_periods(prepare, count=500):
    """Periods in which a dispatcher that whoever will may command lets the robot move."""
    dispatcher, now_s, moving = Dispatcher(Parameters(), Identity(7, "x", 0.25, 0.0)), 1000.0, 0
    peer = SimpleNamespace(seen=link.Status(), look=lambda: None)
    prepare(dispatcher, now_s)
    for number, order in enumerate(itertools.islice(orders(peer), count)):
        dispatcher.receive(order.SerializeToString(), now_s)
        if number % OF_STATUS == 0:
            peer.seen = link.Status.FromString(dispatcher.status(Inputs(now_s, steady_s=now_s)))
        moving += not dispatcher.desired(now_s).stop_reason
        now_s += PERIOD_S
    return moving


def test_orders_move_a_robot_that_nobody_controls():
    assert moving_periods(lambda *_: None) > 400


def test_orders_move_a_robot_in_the_session_that_controls_it():
    def take_control(dispatcher, now_s):
        status = link.Status.FromString(dispatcher.status(Inputs(now_s, steady_s=now_s)))
        dispatcher.receive(link.Command(session_id=5, id=70, seen_status_id=status.id,
                                        seen_robot_time_s=status.sent_time_s).SerializeToString(), now_s)
    assert moving_periods(take_control) > 400


def heard(keys_of_robot, robot_key):
    """What the attack with unknown keys tries in a second, and how many Commands come of it."""
    tries, commands_heard = collections.Counter(), 0
    with zmq.Context() as context, context.socket(zmq.PUB) as statuses, context.socket(zmq.SUB) as commands:
        commands.setsockopt(zmq.SUBSCRIBE, b"")
        ports = []
        for each in (statuses, commands):
            if keys_of_robot:
                each.curve_server, (each.curve_publickey, each.curve_secretkey) = True, keys_of_robot
            ports.append(each.bind_to_random_port("tcp://127.0.0.1"))
        target, over = Target("127.0.0.1", *ports, 0, robot_key, {}, b""), threading.Event()
        attack = threading.Thread(target=unknown_keys, args=(target, tries, over.is_set))
        attack.start()
        end_s = time.monotonic() + 1.0
        # A socket subscribes while its owner looks at it.
        while time.monotonic() < end_s:
            if commands.poll(50):
                commands_heard += bool(commands.recv())
        over.set()
        attack.join()
    return tries, commands_heard


def test_orders_of_an_unknown_key_arrive_where_every_key_is_let_in():
    keys = zmq.curve_keypair()
    tries, commands_heard = heard(keys, keys[0])
    assert tries["let in"] and commands_heard > 5


def test_unknown_keys_go_on_where_none_is_let_in():
    tries, commands_heard = heard(None, zmq.curve_keypair()[0])
    assert tries["keys"] > 1 and not tries["let in"] and not commands_heard
