"""An idle application watches; an order of the Operator or a paused test claims the robot."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses

import pytest

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.ports import LinkStatistics, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import LINK_LOST_CODE, Notification, RobotStatus
from mtr_operator.station.links.idle_loop import (
    ABANDONED_S,
    FOREIGN_S,
    CalibrationRequest,
    CarRequest,
    IdleLoop,
)
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink

WATCHES = "watches"
STATUS_PERIOD_S = 0.1
MAX_FOREIGN_STATUSES = round(FOREIGN_S / STATUS_PERIOD_S)
MAX_ABANDONED_STATUSES = round(ABANDONED_S / STATUS_PERIOD_S)
FREE = RobotStatus(1, 1, 0.1)
FOREIGN = dataclasses.replace(FREE, session_id=7, controlled_by_other=True)
ABANDONED = dataclasses.replace(FOREIGN, notifications=(Notification(LINK_LOST_CODE, 3, "It is silent."),))


class Robot(RobotLink):
    """Says the same Status every 0.1 s; `answers` are desired states, and WATCHES for those that only watch."""

    def __init__(self):
        self.statistics, self.answers, self.status = LinkStatistics(), [], FREE
        self.periods = 0

    def connect(self):
        pass

    def next_status(self, timeout_s):
        self.periods += 1
        return self.status

    def send(self, desired):
        self.answers.append(desired)

    def watch(self):
        self.answers.append(WATCHES)

    def close(self):
        pass


@pytest.fixture
def robot():
    return Robot()


@pytest.fixture
def stop():
    return StopOrder()


@pytest.fixture
def held():
    """Newest hold that the Operator has released."""
    return [0]


def idle_loop(robot, stop, held=(0,), claims=False):
    link = WatchedRobotLink(robot, stop)
    link.connect()
    return IdleLoop(link, AbsentCarLink(), lambda _: held[0], claims=claims,
                    clock=lambda: round(robot.periods * STATUS_PERIOD_S, 6))


def answers(idle, robot, count=1):
    """What is answered to so many Statuses."""
    del robot.answers[:]
    snapshots = [idle.step() for _ in range(count)]
    assert len(robot.answers) == count
    return robot.answers, snapshots[-1]


def test_idle_application_only_watches(robot, stop):
    idle = idle_loop(robot, stop)
    assert answers(idle, robot, 3)[0] == [WATCHES] * 3
    robot.status = None
    assert answers(idle, robot)[0] == [WATCHES]
    assert not idle.claims


@pytest.mark.parametrize("order", [
    lambda idle: idle.request_car(CarRequest.MAP), lambda idle: idle.request_car(CarRequest.CHECK),
    lambda idle: idle.request_car(CarRequest.STOP),
    lambda idle: idle.calibrate(CalibrationRequest(0.8, (), 1.0, 0.3)),
    lambda idle: idle.calibrate(CalibrationRequest(None, (1,), 1.0, 0.3))])
def test_order_of_the_operator_claims_the_robot_and_keeps_it(robot, stop, order):
    idle = idle_loop(robot, stop)
    order(idle)
    sent = answers(idle, robot, 20)[0]
    assert WATCHES not in sent and sent[0] != DesiredState()


def test_released_hold_claims_the_robot_and_one_of_before_does_not(robot, stop, held):
    held[0] = 3
    idle = idle_loop(robot, stop, held)
    assert answers(idle, robot)[0] == [WATCHES]
    held[0] = 4
    assert answers(idle, robot, 2)[0] == [DesiredState(resume_hold_id=4)] * 2


def test_paused_test_keeps_the_robot(robot, stop):
    assert answers(idle_loop(robot, stop, claims=True), robot, 3)[0] == [DesiredState()] * 3


def test_stop_leaves_at_once_although_the_application_watches(robot, stop):
    idle = idle_loop(robot, stop)
    stop.give()
    assert robot.answers == [DesiredState(stop=True)]
    assert answers(idle, robot, 2)[0] == [DesiredState(stop=True)] * 2


@pytest.mark.parametrize("is_paused", [False, True])
def test_order_does_not_wait_for_the_end_of_the_application_that_controls_the_robot(robot, stop, is_paused):
    idle = idle_loop(robot, stop, claims=is_paused)
    robot.status = FOREIGN
    idle.request_car(CarRequest.MAP)
    stop.give()
    assert WATCHES not in answers(idle, robot, MAX_FOREIGN_STATUSES - 1)[0]
    assert answers(idle, robot, 2)[0] == [WATCHES] * 2
    robot.status = FREE
    assert answers(idle, robot, 2)[0] == [WATCHES] * 2
    assert not idle.claims and not idle.has_order


def test_order_is_tried_for_a_while_although_another_application_has_long_controlled_the_robot(robot, stop):
    idle = idle_loop(robot, stop)
    robot.status = FOREIGN
    answers(idle, robot, 3 * MAX_FOREIGN_STATUSES)
    idle.request_car(CarRequest.STOP)
    assert answers(idle, robot, MAX_FOREIGN_STATUSES - 1)[0] == [DesiredState(stop=True)] * (MAX_FOREIGN_STATUSES - 1)
    assert answers(idle, robot)[0] == [WATCHES]


def test_paused_test_survives_the_last_statuses_of_its_own_former_session(robot, stop):
    idle = idle_loop(robot, stop, claims=True)
    for status in [FOREIGN] * (MAX_FOREIGN_STATUSES - 1) + [FREE] + [FOREIGN] * (MAX_FOREIGN_STATUSES - 1):
        robot.status = status
        assert answers(idle, robot)[0] == [DesiredState()]


def test_robot_of_a_killed_application_is_free_for_the_next_order(robot, stop):
    idle = idle_loop(robot, stop)
    robot.status = ABANDONED
    sent, snapshot = answers(idle, robot, MAX_ABANDONED_STATUSES - 1)
    assert snapshot.status.controlled_by_other
    sent, snapshot = answers(idle, robot)
    assert sent == [WATCHES] and not snapshot.status.controlled_by_other
    idle.request_car(CarRequest.CHECK)
    assert WATCHES not in answers(idle, robot, MAX_ABANDONED_STATUSES)[0]


def test_application_that_was_silent_for_a_moment_keeps_the_robot(robot, stop):
    idle = idle_loop(robot, stop)
    for status in [ABANDONED] * (MAX_ABANDONED_STATUSES - 1) + [FOREIGN, ABANDONED]:
        robot.status = status
        assert answers(idle, robot)[1].status.controlled_by_other


def test_order_of_before_a_stop_is_not_carried_out_after_the_stop_was_withdrawn(robot, stop):
    ticket = stop.ticket
    stop.give()
    stop.withdraw()
    assert not stop.is_in_force
    assert not stop.lift(ticket) and stop.is_in_force
