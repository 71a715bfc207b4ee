"""Conversion of ROS messages to the observation, and of the decision to ROS messages."""
# SPDX-License-Identifier: Apache-2.0
import genpy
import pytest

from mtr_core.conversions import waypoint_message
from mtr_core.problems import Problem
from mtr_core.requests import CAR_LOCATOR, Goal, GoalId, GoalReport, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check, Result, State
from mtr_msgs.msg import CarCheck, CarEstimate, DesiredState, LocalizedPose, MotionStatus, PeripheralsState
from mtr_msgs.msg import Problem as ProblemMessage
from mtr_state_machine.conversions import lock_message, mode_message, observation
from mtr_state_machine.core import Decision
from mtr_state_machine.observation import Part

LOST = Problem("state_machine.lost", "Lost.")
AGES_S = {part: 0.02 for part in Part}
OPERATORS = Waypoint(4, "application/3", "car", Pose2(1.0, 2.0, 3.0), 1)
LOCATORS = Waypoint(2, CAR_LOCATOR, "map", Pose2(5.0, 6.0, 0.0))


def stamped(message):
    message.header.stamp = genpy.Time(10, 0)
    return message


def test_restarts_of_the_board_are_seen():
    state = stamped(PeripheralsState(alive=True, firmware_resets=2))
    assert observation({Part.PERIPHERALS: state}, None, AGES_S, 10.02).firmware_resets == 2


def test_messages_become_an_observation():
    seen = observation({
        Part.DISPATCHER: stamped(DesiredState(session_id=3, link_alive=True, waypoint=waypoint_message(OPERATORS),
                                              max_speed_mps=0.6, map_car_id=7, check_car_id=6)),
        Part.CAR_LOCATOR: stamped(CarEstimate(state=1, next_waypoint=waypoint_message(LOCATORS), map_car_id=7)),
        Part.MOTION_PLANNER: stamped(MotionStatus(requester=CAR_LOCATOR, goal_id=2, goal_attempt=8, result=4,
                                                  message="Blocked.")),
        Part.LOCALIZATION: stamped(LocalizedPose(valid=True, map_revision=3)),
        Part.PERIPHERALS: None}, CarCheck(id=6, state=CarCheck.FAILED, message="Moved."), AGES_S, 10.02)
    assert (seen.check.id, seen.check.state, seen.check.message.text) == (6, Check.FAILED, "Moved.")
    assert (seen.map_revision, seen.desired.check_car_id, seen.firmware_resets) == (3, 6, 0)
    assert (seen.desired.session_id, seen.desired.link_alive, seen.desired.stop) == (3, True, False)
    assert seen.desired.waypoint == OPERATORS and seen.desired.map_car_id == 7
    assert seen.car.state is CarState.COLLECTING and seen.car.next_waypoint == LOCATORS
    assert seen.motion == GoalReport(GoalId(CAR_LOCATOR, 2, 8), Result.BLOCKED, Problem(text="Blocked."))
    assert seen.age_s[Part.DISPATCHER] == 0.02 and Part.PERIPHERALS not in seen.age_s
    assert not seen.part_problem(Part.LOCALIZATION, 0.5)


def test_without_a_message_nothing_is_wanted():
    desired = observation({}, None, AGES_S, 10.02).desired
    assert desired.stop and not desired.link_alive and not desired.waypoint.id


def test_lost_localization_and_silent_firmware_are_complaints():
    lost = LocalizedPose(message="No IMU.", problems=[ProblemMessage(code="localization.no_imu", text="No IMU.")])
    seen = observation({Part.LOCALIZATION: stamped(lost), Part.PERIPHERALS: stamped(PeripheralsState())}, None,
                       AGES_S, 10.02)
    problem = seen.part_problem(Part.LOCALIZATION, 0.5)
    assert problem.text == "Localization is lost. No IMU."
    assert problem.cause == Problem("localization.no_imu", "No IMU.")
    assert "firmware" in seen.part_problem(Part.PERIPHERALS, 0.5).text


@pytest.mark.parametrize("message, lost", [(LocalizedPose(mode=LocalizedPose.LOST), True), (LocalizedPose(), False),
                                           (LocalizedPose(valid=True, mode=LocalizedPose.LOST), False)])
def test_lost_position_is_told_from_a_localization_without_a_sensor(message, lost):
    assert observation({Part.LOCALIZATION: stamped(message)}, None, AGES_S, 10.02).is_position_lost is lost


def test_localization_that_says_nothing_is_lost_without_a_cause():
    seen = observation({Part.LOCALIZATION: stamped(LocalizedPose())}, None, AGES_S, 10.02)
    assert seen.part_problem(Part.LOCALIZATION, 0.5).text == "Localization is lost."


def test_decision_becomes_mode_and_lock():
    decision = Decision(State.FAULT, Goal(LOCATORS, 3), 0.7, False, 4, 5, 6, Result.REFUSED,
                        LOST, LOST, 8)
    mode, lock = mode_message(decision, genpy.Time(9)), lock_message(decision, genpy.Time(9))
    assert (mode.mode, mode.goal, mode.goal_attempt) == (mode.FAULT, waypoint_message(LOCATORS), 3)
    assert (mode.max_speed_mps, mode.mapping, mode.map_car_id, mode.session_id) == (0.7, False, 4, 5)
    assert (mode.waypoint_id, mode.waypoint_result, mode.message, mode.check_car_id) == (6, 3, "Lost.", 8)
    assert (lock.owner, lock.engaged, lock.reason) == ("state_machine", True, "Lost.")
    assert [problem.code for problem in (*mode.problems, *lock.problems)] == [LOST.code, LOST.code]
