"""Service mode over the link: from a Command to the locks, and in each Status. Hazard H23"""
# SPDX-License-Identifier: Apache-2.0
import genpy
import pytest

from mtr_core.emergency_latch import EmergencyLatch
from mtr_dispatcher.access.gate import Sender
from mtr_dispatcher.conversions import desired_message, lock_message, service_lock_message, service_lock_messages
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.problems import SERVICE_AT_ROBOT, VIEWER_COMMAND
from mtr_dispatcher.session import CommandResult, is_same
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.emergency import EmergencyStop
from mtr_dispatcher.status.inputs import Inputs
from mtr_proto import robot_link_pb2 as link

SESSION, OTHER = 5, 6
STAMP = genpy.Time(1, 0)
ORDERS = {"waypoint": link.Waypoint(id=1, x=1.0, y=2.0, heading=0.0), "device_height_m": 1.0,
          "press": link.ButtonPress(id=1, buttons=[1], strength=1.0, duration_s=0.1), "map_car_id": 1}


class Robot:
    """A dispatcher whose applications answer each Status."""

    def __init__(self):
        self.core = Dispatcher(Parameters(), Identity(7, "1.2.3", 0.25, 0.0))
        self.now_s, self.numbers = 100.0, {}
        self.status()

    def status(self, stop=EmergencyStop.RELEASED):
        self.now_s += 0.1
        self.seen = link.Status.FromString(self.core.status(Inputs(self.now_s, steady_s=self.now_s,
                                                                   emergency_stop=stop)))
        return self.seen

    def send(self, session_id=SESSION, seen=None, sender=None, **content):
        seen = seen or self.seen
        self.numbers[session_id] = self.numbers.get(session_id, 0) + 1
        data = link.Command(session_id=session_id, id=self.numbers[session_id], seen_status_id=seen.id,
                            seen_robot_time_s=seen.sent_time_s, **content).SerializeToString()
        return self.core.receive(data, self.now_s, *([sender] if sender else []))[0]

    def agree_at_robot(self):
        return self.core.service.agree_at_robot(self.now_s)

    @property
    def is_active(self):
        return bool(self.core.desired(self.now_s).service)


@pytest.fixture
def robot():
    robot = Robot()
    assert robot.send(**ORDERS) is CommandResult.TAKEN and not robot.is_active
    return robot


def messages(robot):
    desired = robot.core.desired(robot.now_s)
    return desired_message(desired, STAMP, 0.5), service_lock_message(desired, STAMP), lock_message(desired, STAMP)


def test_operator_enters_it_and_every_order_waits_behind_a_lock(robot):
    before = robot.core.desired(robot.now_s)
    desired, service, own = messages(robot)
    assert not desired.stop and not own.engaged
    assert (service.owner, service.engaged, service.emergency) == ("service_mode", False, True)
    robot.send(enter_service=True, **ORDERS)
    desired, service, own = messages(robot)
    assert desired.stop and service.engaged and service.emergency and not own.engaged
    assert [each.code for each in service.problems] == ["dispatcher.service_mode", "dispatcher.service_by_operator"]
    assert not is_same(before, robot.core.desired(robot.now_s))


@pytest.mark.parametrize("silent_s", [0.1, 5.0])
def test_release_reaches_receivers_that_latch_a_stop_after_a_silence(robot, silent_s):
    robot.send(enter_service=True)
    latch, before = EmergencyLatch(0.5), robot.core.desired(robot.now_s)
    latch.take("service_mode", True, robot.now_s)
    robot.status()
    assert not robot.agree_at_robot()
    robot.send(leave_service_id=robot.seen.service_mode.id)
    robot.status()
    sent = service_lock_messages(before, robot.core.desired(robot.now_s), STAMP)
    assert [each.engaged for each in sent] == [True, False] and all(each.emergency for each in sent)
    for each in sent:
        latch.take(each.owner, each.engaged, robot.now_s + silent_s)
    assert "service_mode" not in latch
    later = robot.core.desired(robot.now_s)
    assert [each.engaged for each in service_lock_messages(later, later, STAMP)] == [False]
    assert [each.engaged for each in service_lock_messages(None, later, STAMP)] == [False]
    assert [each.engaged for each in service_lock_messages(before, before, STAMP)] == [True]


def test_status_shows_it_in_fields_and_in_one_notice(robot):
    assert not robot.status().service_mode.active and robot.seen.service_mode.id == 0
    robot.send(enter_service=True)
    shown = robot.status()
    assert shown.service_mode.active and shown.service_mode.id
    assert not shown.service_mode.HasField("robot_agrees_s") and not shown.service_mode.HasField("operator_agrees_s")
    assert [each.code for each in shown.service_mode.problems][0] == "dispatcher.service_mode"
    # No Command was refused: the robot follows it again after service mode.
    assert [each.code for each in shown.notifications if each.code in ("service_mode", "command_refused")] == [
        "service_mode"]


def test_both_agreements_over_the_link_end_it(robot):
    robot.send(enter_service=True)
    robot.status()
    confirmed = robot.core.confirmed(Inputs(robot.now_s))
    assert not robot.agree_at_robot() and robot.core.confirmed(Inputs(robot.now_s)) != confirmed
    assert 59.0 < robot.status().service_mode.robot_agrees_s <= 60.0
    robot.send(leave_service_id=robot.seen.service_mode.id)
    assert not robot.status().service_mode.active and not robot.is_active
    assert not messages(robot)[1].engaged and not messages(robot)[0].stop


@pytest.mark.parametrize("session_id, watches, result", [
    (OTHER, False, CommandResult.FOREIGN), (OTHER, True, CommandResult.WATCHED)])
def test_application_that_does_not_control_enters_it_and_cannot_release_it(robot, session_id, watches, result):
    assert robot.send(session_id, watches=watches, enter_service=True) is result and robot.is_active
    robot.status()
    assert not robot.agree_at_robot()
    robot.send()
    assert robot.send(session_id, watches=watches, leave_service_id=robot.seen.service_mode.id) is result
    assert robot.status().service_mode.active


def test_late_command_enters_it_and_does_not_release_it(robot):
    old = robot.seen
    robot.now_s += 2.0
    assert robot.send(seen=old, enter_service=True) is CommandResult.EXPIRED and robot.is_active
    old = robot.status()
    assert not robot.agree_at_robot()
    robot.now_s += 2.0
    assert robot.send(seen=old, leave_service_id=old.service_mode.id) is CommandResult.EXPIRED
    assert robot.status().service_mode.active


def test_refused_command_enters_it(robot):
    assert robot.send(enter_service=True, max_speed_mps=-1.0) is CommandResult.REFUSED and robot.is_active


def test_session_that_is_over_and_a_viewer_do_not_enter_it(robot):
    assert robot.send(end_session=True) is CommandResult.ENDED
    assert robot.send(enter_service=True) is CommandResult.OUTDATED and not robot.is_active
    viewer = Sender(key="k", name="Visitor", refusal=VIEWER_COMMAND(name="Visitor"))
    assert robot.send(OTHER, sender=viewer, enter_service=True) is CommandResult.FORBIDDEN and not robot.is_active


def test_goodbye_in_service_mode_withdraws_the_agreement_and_leaves_the_mode(robot):
    robot.send(enter_service=True)
    robot.status()
    robot.send(leave_service_id=robot.seen.service_mode.id)
    robot.status()
    assert robot.seen.service_mode.HasField("operator_agrees_s")
    robot.send(end_session=True)
    robot.status()
    assert not robot.agree_at_robot() and robot.status().service_mode.active
    assert not robot.seen.service_mode.HasField("operator_agrees_s")


def test_another_session_finds_the_robot_in_service_mode(robot):
    robot.send(enter_service=True)
    robot.send(end_session=True)
    assert robot.send(OTHER, **ORDERS) is CommandResult.TAKEN
    assert robot.status().service_mode.active and messages(robot)[0].stop and messages(robot)[1].engaged


def test_link_that_falls_silent_withdraws_the_agreement(robot):
    robot.send(enter_service=True)
    robot.status()
    robot.send(leave_service_id=robot.seen.service_mode.id)
    robot.now_s += 5.0
    robot.status()
    assert not robot.agree_at_robot() and robot.status().service_mode.active


def test_engaged_stop_keeps_the_robot_in_service_mode(robot):
    robot.send(enter_service=True)
    robot.status(EmergencyStop.ENGAGED)
    assert robot.agree_at_robot().code == "dispatcher.service_stop_engaged"
    robot.send(leave_service_id=robot.seen.service_mode.id)
    assert robot.status(EmergencyStop.ENGAGED).service_mode.active


def test_entry_at_the_robot_needs_no_application():
    robot = Robot()
    robot.core.service.enter(SERVICE_AT_ROBOT())
    assert robot.status().service_mode.active and messages(robot)[1].engaged
    assert robot.status().session_id == 0


def test_command_that_enters_and_releases_enters(robot):
    robot.send(enter_service=True)
    robot.status()
    assert not robot.agree_at_robot()
    robot.send(enter_service=True, leave_service_id=robot.seen.service_mode.id)
    assert robot.status().service_mode.active
