"""Requests: identity, matching of reports, and round trip through ROS messages."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_core.conversions import (
    desired_state_from,
    desired_state_message,
    goal_from,
    goal_report_from,
    waypoint_from,
    waypoint_message,
)
from mtr_core.problems import Problem
from mtr_core.requests import (
    CAR_LOCATOR,
    NO_GOAL,
    NO_GOAL_ID,
    NO_WAYPOINT,
    DesiredState,
    Goal,
    GoalId,
    GoalReport,
    Press,
    Waypoint,
    application,
)
from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_msgs.msg import MotionStatus, RobotMode

WAYPOINT = Waypoint(3, CAR_LOCATOR, "map", Pose2(1.0, 2.0, 0.5), Direction.BACKWARD)
GOAL = Goal(WAYPOINT, 7)


def test_applications_of_two_sessions_are_two_requesters():
    assert application(5) != application(6)


def test_goal_is_known_by_requester_id_and_attempt():
    assert GOAL.id == GoalId(CAR_LOCATOR, 3, 7)
    assert Goal(replace(WAYPOINT, id=0), 7).id == NO_GOAL.id == NO_GOAL_ID


@pytest.mark.parametrize("other", [Goal(WAYPOINT, 8), Goal(replace(WAYPOINT, id=4), 7),
                                   Goal(replace(WAYPOINT, requester="rviz"), 7), NO_GOAL])
def test_report_on_another_goal_is_not_about_this_one(other):
    report = GoalReport(GOAL.id, Result.REACHED)
    assert report.is_about(GOAL) and not report.is_about(other)


def test_report_on_no_goal_is_about_none():
    assert not GoalReport().is_about(NO_GOAL)


@pytest.mark.parametrize("waypoint", [WAYPOINT, NO_WAYPOINT])
def test_waypoint_survives_as_a_message(waypoint):
    assert waypoint_from(waypoint_message(waypoint)) == waypoint


def test_goal_and_its_report_survive_as_messages():
    assert goal_from(RobotMode(goal=waypoint_message(WAYPOINT), goal_attempt=7)) == GOAL
    message = MotionStatus(requester=CAR_LOCATOR, goal_id=3, goal_attempt=7, result=4, message="Blocked.")
    assert goal_report_from(message) == GoalReport(GOAL.id, Result.BLOCKED, Problem(text="Blocked."))
    assert goal_report_from(None) == GoalReport()


def test_desired_state_survives_as_a_message():
    desired = DesiredState(5, 6, True, False, WAYPOINT, 0.7, 1.2, Press(4, 5, (1, 2), 0.5, 0.25), 3, 7)
    assert desired_state_from(desired_state_message(desired)) == desired
