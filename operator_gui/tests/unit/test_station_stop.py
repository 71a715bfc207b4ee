"""The Operator's stop leaves at once, whatever the thread of the links waits for, and passes every other order."""
# SPDX-License-Identifier: Apache-2.0
import threading

import pytest

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.ports import LinkStatistics, LockState, RobotLink
from mtr_operator.domain.requests import DesiredState, Press, Waypoint
from mtr_operator.domain.robot_status import Mode, MotionSource, RobotStatus
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.conversions import decode_command
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.station.connection import Connection, LinkOpener
from mtr_operator.station.events import LinksOpened, RobotSnapshot
from mtr_operator.station.links.idle_loop import CalibrationRequest, CarRequest
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.mailbox import Mailbox
from mtr_operator.station.motion import ORDER_PATIENCE_S, Motion
from mtr_operator.station.readiness import Phase, readiness_of

LIMIT_S = 30.0
GO = DesiredState(waypoint=Waypoint(1, Pose(2.0, 0.0, 0.0)), press=Press(1, (2,), 0.5, 0.2))


class WaitingRobot(RobotLink):
    """Says nothing while `is_waiting` is set: next_status then returns when it is cleared, and not before."""

    def __init__(self):
        self.statistics, self.sent, self.waits = LinkStatistics(), [], threading.Event()
        self.answers = threading.Event()
        self.answers.set()
        self._id = 0

    def connect(self):
        pass

    def next_status(self, timeout_s):
        if not self.answers.is_set():
            self.waits.set()
            assert self.answers.wait(LIMIT_S)
        self._id += 1
        return RobotStatus(self._id, 1, self._id / 10)

    def send(self, desired):
        self.sent.append(desired)

    def close(self):
        pass


class Opener(LinkOpener):
    """Hands out one robot and no Car."""

    def __init__(self, robot):
        self._robot = robot

    def robot(self, choice):
        return self._robot

    def car(self, choice):
        return AbsentCarLink()


@pytest.fixture
def robot():
    return WaitingRobot()


@pytest.fixture
def worker(robot):
    opened = threading.Event()
    box = Mailbox(opened.set)
    made = Worker(Connection(), Opener(robot), box)
    made.start()
    while not any(isinstance(event, LinksOpened) for event in box.take().events):
        assert opened.wait(LIMIT_S)
        opened.clear()
    yield made
    robot.answers.set()
    assert made.close(LIMIT_S)


def keep_waiting(robot):
    """The robot falls silent; returns when the thread of the links waits for it."""
    robot.answers.clear()
    assert robot.waits.wait(LIMIT_S)


def wait_until(condition):
    """Let the thread of the links work until the condition holds."""
    for _ in range(round(LIMIT_S / 0.01)):
        if condition():
            return
        threading.Event().wait(0.01)
    raise AssertionError("the condition did not come true")


def test_stop_has_left_when_it_returns_although_the_robot_is_silent__A4(worker, robot):
    keep_waiting(robot)
    worker.stop()
    assert robot.sent[-1].stop


def test_mapping_that_was_ordered_before_a_stop_is_not_begun_after_it__A1(worker, robot):
    keep_waiting(robot)
    worker.request_car(CarRequest.MAP)
    worker.stop()
    robot.answers.set()
    count = len(robot.sent)
    wait_until(lambda: len(robot.sent) > count + 20)
    assert all(desired.stop for desired in robot.sent[count:])
    assert all(desired.map_car_id == 0 for desired in robot.sent)


def test_order_after_a_stop_is_obeyed_and_what_was_stopped_is_withdrawn__A1(worker, robot):
    worker.request_car(CarRequest.MAP)
    wait_until(lambda: robot.sent and robot.sent[-1].map_car_id == 1)
    worker.stop()
    worker.calibrate(CalibrationRequest(0.8, (), 1.0, 0.3))
    wait_until(lambda: robot.sent[-1].key_height_m == 0.8)
    assert not robot.sent[-1].stop and robot.sent[-1].map_car_id == 0
    worker.request_car(CarRequest.MAP)
    wait_until(lambda: robot.sent[-1].map_car_id == 2)
    assert not robot.sent[-1].stop


def test_while_a_stop_is_in_force_everything_that_leaves_is_one(robot):
    order = StopOrder()
    link = WatchedRobotLink(robot, order)
    link.connect()
    link.send(GO)
    order.give()
    link.send(GO)
    assert [desired.stop for desired in robot.sent] == [False, True, True]
    assert robot.sent[1].press is None and robot.sent[1].waypoint == GO.waypoint
    assert order.lift(order.ticket)
    link.send(GO)
    assert robot.sent[-1] == GO


def test_order_of_before_a_stop_does_not_lift_it():
    order = StopOrder()
    ticket = order.ticket
    order.give()
    assert not order.lift(ticket) and order.is_in_force
    assert order.lift(order.ticket) and not order.is_in_force


def test_stop_without_a_session_or_with_a_broken_one_is_no_error_and_in_force(robot):
    order = StopOrder()
    order.give()

    def refuse(_desired):
        raise ConnectionFailed("The robot is not connected.")
    order.attach(refuse)
    order.give()
    assert order.is_in_force


def test_stop_from_another_thread_arrives_at_a_robot_that_has_fallen_silent__A4():
    order = StopOrder()
    with ConnectionServer() as server:
        link = WatchedRobotLink(ZmqRobotLink("127.0.0.1", server.subscriber_port, server.publisher_port), order)
        link.connect()
        while not server.command_socket.poll(50):
            link.send(DesiredState())
        while server.command_socket.poll(50):
            before = decode_command(server.command_socket.recv())
        listener = threading.Thread(target=link.next_status, args=(2.0,))
        listener.start()
        order.give()
        assert server.command_socket.poll(LIMIT_S * 1000)
        command = decode_command(server.command_socket.recv())
        assert command.stop and command.id > before.id
        listener.join()
        link.close()


def status(**changes):
    mode = changes.pop("mode", Mode.FOLLOWING_WAYPOINT)
    return RobotStatus(1, 1, 0.1, mode=mode, key_height_m=1.0, battery_percent=80, **changes)


@pytest.mark.parametrize(("changes", "may_move"), [
    ({}, False), ({"speed_mps": -0.1}, True), ({"yaw_rate_radps": 0.1}, True), ({"speed_mps": 0.01}, False),
    ({"motion_source": MotionSource.MANUAL}, True), ({"motion_source": MotionSource.LOCKED}, False),
    ({"mode": Mode.MAPPING_CAR}, False), ({"mode": Mode.MAPPING_CAR, "speed_mps": 0.1}, True),
    ({"mode": Mode.STARTING}, False)])
def test_robot_may_move_by_what_it_reports(changes, may_move):
    motion = Motion()
    motion.learn(status(**changes), 10.0)
    assert motion.is_possible(10.0) is may_move


def test_order_counts_before_the_robot_shows_it_and_no_longer_than_its_patience():
    motion = Motion()
    motion.learn(status(), 10.0)
    motion.order(10.0)
    assert motion.is_possible(10.0 + 0.9 * ORDER_PATIENCE_S)
    assert not motion.is_possible(10.0 + 1.1 * ORDER_PATIENCE_S)


def test_stopped_robot_that_still_calls_itself_mapping_may_not_move_once_it_stands():
    motion = Motion()
    motion.order(10.0)
    motion.learn(status(mode=Mode.MAPPING_CAR, speed_mps=0.5), 11.0)
    motion.stop()
    assert motion.is_possible(11.0)
    motion.learn(status(mode=Mode.MAPPING_CAR), 12.0)
    assert not motion.is_possible(12.0)


@pytest.mark.parametrize("mode", [Mode.MAPPING_CAR, Mode.CHECKING_CAR])
def test_robot_that_was_ordered_round_the_car_may_move_until_it_has_finished(mode):
    motion = Motion()
    motion.order(10.0)
    motion.learn(status(mode=mode), 100.0)
    assert motion.goes_round(mode) and motion.is_possible(100.0)
    motion.learn(status(), 101.0)
    assert not motion.is_possible(101.0)


def test_robot_left_mapping_by_a_former_application_does_not_hinder_a_test():
    motion, robot = Motion(), status(mode=Mode.MAPPING_CAR, simulated=True)
    motion.learn(robot, 10.0)
    snapshot = RobotSnapshot(robot, LockState.LOCKED, "")
    assert readiness_of(snapshot, 0.0, Phase.IDLE, motion).can_start


def test_key_that_is_lifted_or_pressed_counts_as_motion():
    motion = Motion()
    motion.order(0.0)
    motion.learn(status(), 10.0)
    assert not motion.is_possible(10.0)
    motion.learn(RobotStatus(2, 1, 0.2, key_height_m=1.02), 11.0)
    assert motion.is_possible(11.1)
    motion.learn(RobotStatus(3, 1, 0.3, key_height_m=1.02, pressed_buttons=(1,)), 20.0)
    assert motion.is_possible(20.1)
