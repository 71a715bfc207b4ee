"""In lock-step a tick processes the answer to its Status, and leaves later messages to the next tick."""
# SPDX-License-Identifier: Apache-2.0
import collections

import pytest

from mtr_dispatcher import node as node_module
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.link_server import Received
from mtr_dispatcher.node import DispatcherNode
from mtr_dispatcher.operator_wait import OperatorWait, Unread
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.problems import STOPPED_BY_OPERATOR
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link

SESSION = 5
FIRST_NS, PERIOD_NS = 100_000_000_000, 100_000_000


class Wire:
    """An application's link with given Commands; each poll returns all arrived messages, like the real one."""

    def __init__(self):
        self.sent, self.looks = [], 0
        self._numbers = iter(range(1, 100))

    def send(self, seen_status_id, seen_s, **content):
        """Send a Command."""
        command = link.Command(session_id=SESSION, id=next(self._numbers), seen_status_id=seen_status_id,
                               seen_robot_time_s=seen_s, **content)
        self.sent.append(Received(command.SerializeToString(), ""))

    def receive(self, timeout_s):
        """Return the arrived messages."""
        self.looks += 1
        assert self.looks < 20, "it waits for an answer that has come"
        came, self.sent = self.sent, []
        return came

    def cut_off(self):
        """Return no connections."""
        return collections.Counter()


@pytest.fixture
def wire():
    return Wire()


@pytest.fixture
def node(wire, monkeypatch):
    """A node without topics, whose time is the time of the tick."""
    monkeypatch.setattr(node_module.clock, "steady_at", lambda time_ns: time_ns)
    monkeypatch.setattr(node_module.rospy, "is_shutdown", lambda: False)
    monkeypatch.setattr(node_module.rospy, "loginfo", lambda *_: None)
    made = object.__new__(DispatcherNode)
    made._core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
    made._wait, made._gate, made._server, made._cut_off = OperatorWait(5.0), None, wire, collections.Counter()
    made._logged, made._unread = node_module.Rates(5.0, 50.0), Unread(wire.receive)
    return made


def tick(node, number, send):
    """Run one tick, in which `send` answers the Status; return the desired state after it."""
    tick_ns = FIRST_NS + number * PERIOD_NS
    time_s = tick_ns * 1e-9
    node._core.status(Inputs(time_s, steady_s=time_s))
    send(node._core.status_id, time_s)
    node._await_answer(tick_ns)
    return node._core.desired(time_s).stop_reason


def test_stop_of_an_application_that_heard_nothing_while_this_process_stood_does_not_stop_the_robot(node, wire):
    def answer_and_then_stop(status_id, time_s):
        # The application received no Status for one second of wall time, because its answer was not processed.
        wire.send(status_id, time_s, max_speed_mps=0.4)
        wire.send(status_id, time_s, max_speed_mps=0.4, stop=True)

    def answer(status_id, time_s):
        wire.send(status_id, time_s, max_speed_mps=0.4)

    assert not tick(node, 0, answer)
    assert not tick(node, 1, answer_and_then_stop)
    assert not tick(node, 2, answer)
    assert node._core.session.command.id == 4 and not node._unread.come(0.0)


def test_answer_that_stops_does(node, wire):
    assert tick(node, 0, lambda status_id, time_s: wire.send(status_id, time_s, stop=True)) == STOPPED_BY_OPERATOR()


def test_what_came_before_the_answer_is_taken_with_it(node, wire):
    def late_stop_and_answer(status_id, time_s):
        wire.send(status_id - 1, time_s - 0.1, stop=True)
        wire.send(status_id, time_s, max_speed_mps=0.4)

    tick(node, 0, wire.send)
    assert not tick(node, 1, late_stop_and_answer)
    assert node._core.session.command.id == 3 and not node._unread.come(0.0)


def test_all_is_taken_where_nothing_is_enough():
    unread = Unread(lambda timeout_s: [1, 2, 3])
    assert unread.come(0.0) and list(unread.until(lambda: False)) == [1, 2, 3]


def test_what_is_left_comes_before_what_follows():
    batches = iter([[1, 2, 3], [4]])
    unread = Unread(lambda timeout_s: next(batches))
    assert unread.come(0.0) and list(unread.until(lambda: True)) == []
    assert unread.come(0.0) and list(unread.until(lambda: False)) == [1, 2, 3]
    assert unread.come(0.0) and list(unread.until(lambda: False)) == [4]
