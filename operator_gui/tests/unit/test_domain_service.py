"""Service mode in the application: ordered at any time, shown, and no test begins or continues in it. Hazard H23"""
# SPDX-License-Identifier: Apache-2.0
import io
import itertools
import math
from dataclasses import replace

import pytest

from mtr_operator.cli.entry import main
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.errors import LinkLost, RobotFailed
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import DesiredState, Press, Waypoint
from mtr_operator.domain.robot_status import (
    SERVICE_CODE,
    Notification,
    Problem,
    RobotStatus,
    ServiceState,
    WaypointResult,
)
from mtr_operator.domain.supervision.service_order import NOT_RELEASED, ServiceOrder
from mtr_operator.robot_link.virtual.robot import VirtualRobot
from mtr_operator.station.checks.check_texts import check_advice
from mtr_operator.station.checks.finding import Finding, State
from mtr_operator.station.checks.robot_checks import condition
from mtr_operator.station.links.idle_loop import IdleLoop
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink

TEXT = "The robot is in service mode."
PROBLEMS = (Problem("dispatcher.service_mode", (), TEXT),)
ACTIVE = ServiceState(True, 7, problems=PROBLEMS)
NOTICE = Notification(SERVICE_CODE, 3, TEXT, PROBLEMS)


class ServicedRobot:
    """Follows the orders as the robot's dispatcher does; its side is released from Status `released_at` on."""

    def __init__(self, released_at=math.inf):
        self.service, self.released_at, self.is_foreign = ServiceState(), released_at, False
        self.sent, self.number, self.is_silent = [], 0, False
        self.now_s = 0.0

    def clock(self):
        return self.now_s

    def next_status(self, timeout_s):
        self.now_s += timeout_s
        self.number += 1
        if self.is_silent:
            return None
        return RobotStatus(self.number, 1, self.now_s, service=self.service, controlled_by_other=self.is_foreign)

    def send(self, desired):
        self.sent.append(desired)
        if self.service is None:
            return
        if desired.enters_service and not self.service.is_active:
            self.service = ACTIVE
        elif desired.leave_service_id == self.service.agreement_id and desired.leave_service_id:
            self.service = (ServiceState() if self.number >= self.released_at
                            else replace(self.service, operator_agrees_s=60.0))


@pytest.fixture
def robot():
    return ServicedRobot()


def order(robot):
    return ServiceOrder(robot, clock=robot.clock)


def test_entry_returns_when_the_robot_reports_it(robot):
    assert order(robot).enter() == ACTIVE and order(robot).enter().text == TEXT
    assert all(each.stop and each.enters_service for each in robot.sent)


def test_robot_that_does_not_follow_is_said_to_be_switched_off(robot):
    robot.send = robot.sent.append
    with pytest.raises(RobotFailed, match="switch it off before you work"):
        order(robot).enter()
    assert robot.now_s < 25.0


@pytest.mark.parametrize("what", ["enter", "state", "leave"])
def test_robot_of_before_and_a_silent_one_are_a_sentence(robot, what):
    robot.service = None
    call = {"enter": lambda: order(robot).enter(), "state": lambda: order(robot).state(),
            "leave": lambda: order(robot).leave([].append)}[what]
    with pytest.raises(RobotFailed, match="too old for service mode"):
        call()
    robot.is_silent = True
    with pytest.raises(LinkLost, match="not answered for 10 s"):
        call()


def test_release_waits_for_the_side_of_the_robot_and_says_so_once():
    robot, said = ServicedRobot(released_at=30), []
    order(robot).enter()
    order(robot).leave(said.append)
    assert robot.number >= 30 and len(said) == 1 and "rosrun mtr_dispatcher service_mode release" in said[0]
    assert {each.leave_service_id for each in robot.sent} == {0, 7}


def test_release_that_expires_leaves_service_mode_active(robot):
    order(robot).enter()

    def expire():
        if robot.number == 40:
            robot.service = replace(ACTIVE, agreement_id=8)
    with pytest.raises(RobotFailed, match=NOT_RELEASED):
        ServiceOrder(robot, expire, robot.clock).leave([].append)
    assert robot.service.is_active


def test_release_for_which_nothing_happens_ends_some_time(robot):
    order(robot).enter()
    with pytest.raises(RobotFailed, match=NOT_RELEASED):
        order(robot).leave([].append)
    assert robot.now_s < 310.0


def test_release_belongs_to_the_application_in_control(robot):
    order(robot).enter()
    robot.is_foreign = True
    with pytest.raises(RobotFailed, match="Another application controls"):
        order(robot).leave([].append)


@pytest.mark.parametrize("text, is_known", [("", False), ("\n", True)])
def test_command_line_enters_shows_and_leaves(monkeypatch, capsys, text, is_known):
    robot = ServicedRobot(released_at=1)
    robot.connect = robot.close = lambda: None
    monkeypatch.setattr("mtr_operator.cli.orders.service.robot_link", lambda options: robot)
    monkeypatch.setattr("sys.stdin", io.StringIO(text))
    assert main(["service", "show"]) == 0 and "not in service mode" in capsys.readouterr().out
    assert main(["service", "enter"]) == 0 and TEXT in capsys.readouterr().out
    assert main(["service", "show"]) == 0 and TEXT in capsys.readouterr().out
    status = main(["service", "leave"])
    out, err = capsys.readouterr()
    if is_known:
        assert status == 0 and "Service mode has ended" in out and not robot.service.is_active
    else:
        assert status and "remains active" in err and robot.service.is_active


# Tests

def test_no_test_begins_or_continues_in_service_mode(world, robot_link, car_link):
    loop = ControlLoop(robot_link, car_link)
    loop.step()
    world.spoil = lambda status: replace(status, service=ACTIVE, notifications=(NOTICE,))
    with pytest.raises(RobotFailed, match=TEXT):
        loop.step()
    world.spoil = lambda status: replace(status, service=ServiceState())
    loop.step()


def test_checklist_has_it_as_bad_and_says_what_to_do():
    items = [each for each in condition(RobotStatus(1, 1, 0.0, service=ACTIVE, notifications=(NOTICE,)))
             if each.finding is Finding.IN_SERVICE]
    assert [(each.state, each.said) for each in items] == [(State.BAD, TEXT)]
    assert "rosrun mtr_dispatcher service_mode release" in check_advice(items[0])


def test_its_sentences_are_translated_by_their_codes():
    assert PROBLEMS in list(RobotStatus(1, 1, 0.0, service=ACTIVE).problems())


# The window's links

@pytest.fixture
def stop():
    return StopOrder()


@pytest.fixture
def idle(robot_link, car_link, stop):
    link = WatchedRobotLink(robot_link, stop)
    link.connect()
    made = IdleLoop(link, car_link)
    made.step()
    return made


def test_entry_leaves_at_once_with_a_stop_and_until_the_robot_reports_it(idle, stop, world, robot_link):
    stop.give(enters_service=True)
    assert (robot_link.answers[-1][1].stop, robot_link.answers[-1][1].enters_service) == (True, True)
    for _ in range(5):
        idle.step()
        assert robot_link.answers[-1][1].enters_service
    world.spoil = lambda status: replace(status, service=ACTIVE)
    idle.step()
    assert robot_link.answers[-1][1].stop and not robot_link.answers[-1][1].enters_service


def test_stop_alone_enters_nothing_and_one_after_an_entry_keeps_it(idle, stop, robot_link):
    stop.give()
    assert not robot_link.answers[-1][1].enters_service
    stop.give(enters_service=True)
    stop.give()
    assert robot_link.answers[-1][1].enters_service


def test_order_that_lifts_the_stop_withdraws_the_entry(idle, stop, robot_link):
    stop.give(enters_service=True)
    assert stop.lift(stop.ticket)
    stop.give()
    assert not robot_link.answers[-1][1].enters_service


def test_release_claims_control_moves_nothing_and_is_forgotten_when_it_is_over(idle, world, robot_link):
    world.spoil = lambda status: replace(status, service=ACTIVE)
    idle.leave_service(7)
    idle.step()
    idle.step()
    sent = robot_link.answers[-1][1]
    assert idle.claims and sent.leave_service_id == 7 and sent.stop and not idle.has_order
    world.spoil = lambda status: replace(status, service=replace(ACTIVE, agreement_id=8))
    idle.step()
    assert robot_link.answers[-1][1].leave_service_id == 0


# The substitute

def test_virtual_robot_moves_nothing_in_service_mode_and_leaves_it_by_its_own_number():
    robot = VirtualRobot(1)
    wants = DesiredState(waypoint=Waypoint(1, Pose(5.0, 0.0, 0.0)), key_height_m=1.0,
                         press=Press(1, (1,), 1.0, 0.1), map_car_id=1)
    for number in itertools.count(1):
        robot.take(3, number, replace(wants, press=None))
        robot.step()
        if robot.status().waypoint_result is WaypointResult.PENDING and robot.is_driving and number > 60:
            break
    robot.take(3, number + 1, replace(wants, enters_service=True))
    before = robot.pose, robot.key_height_m
    for _ in range(50):
        robot.take(3, number + 2, wants)
        robot.step()
    status = robot.status()
    assert (robot.pose, robot.key_height_m) == before and status.is_in_service and not status.pressed_buttons
    assert [each.code for each in status.notifications] == [SERVICE_CODE]
    robot.take(3, number + 3, replace(wants, leave_service_id=status.service.agreement_id + 1))
    assert robot.status().is_in_service
    robot.take(3, number + 4, replace(wants, leave_service_id=status.service.agreement_id))
    assert not robot.status().is_in_service


def test_interrupt_ends_the_wait(robot):
    def interrupt():
        raise Cancelled("Interrupted.")
    with pytest.raises(Cancelled):
        ServiceOrder(robot, interrupt, robot.clock).enter()
