"""Goals from rviz, and markers for rviz."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from geometry_msgs.msg import PoseStamped
from motion_simulation import OUTLINE, PARAMETERS, SimulatedRobot
from shapely.geometry import Polygon
from std_msgs.msg import Header

from mtr_core.conversions import goal_report_from, waypoint_message
from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, NO_GOAL_ID, Goal, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.conversions import desired_from, markers_message, nav_goal_from, path_message, status_message
from mtr_motion_planner.inputs import DesiredMotion
from mtr_motion_planner.nav_goal import NavGoals
from mtr_motion_planner.outputs import PlannerOutput
from mtr_motion_planner.picture import picture_of
from mtr_msgs.msg import MotionStatus, RobotMode

PLACE = Pose2(3.0, -2.0, 1.0)
FREE = DesiredMotion(1.0, NO_GOAL, 0.8, follows_waypoints=True)


def test_goal_from_rviz_is_taken_at_its_own_speed_while_nobody_wants_anything():
    goals = NavGoals(0.4)
    goals.take(PLACE, in_car_frame=False)
    order = goals.joined(FREE)
    assert (order.goal.waypoint.pose, order.goal.waypoint.frame, order.max_speed_mps) == (PLACE, "map", 0.4)
    assert goals.joined(FREE).goal.id == order.goal.id
    goals.take(PLACE, in_car_frame=False)
    assert goals.joined(FREE).goal.id not in (order.goal.id, NO_GOAL_ID)


def test_operators_goal_goes_first_and_ends_the_one_from_rviz():
    goals = NavGoals(0.4)
    goals.take(PLACE, in_car_frame=True)
    operators = DesiredMotion(1.0, Goal(Waypoint(7, "application/5", "car", PLACE), 1), 0.8, follows_waypoints=True)
    assert goals.joined(operators) == operators
    assert "Operator" in goals.refusal()
    assert goals.joined(FREE) == FREE
    assert goals.refusal() == ""


def test_goal_from_rviz_moves_nothing_in_another_state():
    goals = NavGoals(0.4)
    goals.take(PLACE, in_car_frame=True)
    starting = DesiredMotion(1.0, NO_GOAL, 0.8, follows_waypoints=False)
    assert goals.joined(starting) == starting
    assert "not ready" in goals.refusal()
    assert goals.joined(None) is None
    assert goals.refusal() == ""


def test_goal_from_rviz_moves_no_robot_that_is_held():
    def wanted_id():
        return goals.joined(desired_from(mode, 1.0)).goal.waypoint.id
    goals, mode = NavGoals(0.4), RobotMode(mode=RobotMode.FOLLOWING_WAYPOINT, max_speed_mps=0.8)
    goals.take(PLACE, in_car_frame=True)
    assert wanted_id() == 1
    mode.hold_id = 3
    assert wanted_id() == 0 and "held" in goals.refusal()
    mode.hold_id = 0
    assert wanted_id() == 0, "released, it does not set off by itself"


def test_goal_from_rviz_in_an_unknown_frame_is_none():
    message = PoseStamped()
    message.header.frame_id = "odom"
    assert nav_goal_from(message) is None
    message.header.frame_id = "car"
    message.pose.position.x, message.pose.orientation.z, message.pose.orientation.w = 2.0, math.sin(0.5), math.cos(0.5)
    pose, in_car_frame = nav_goal_from(message)
    assert (pose.x, round(pose.heading, 6), in_car_frame) == (2.0, 1.0, True)


def test_picture_shows_zone_way_and_goal_in_the_frame_of_the_plan():
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0))
    assert picture_of(robot.planner, PARAMETERS) is None
    robot.go(1, -4.0, 0.0, 0.0)
    output = robot.run_for(1.0)
    picture = picture_of(robot.planner, PARAMETERS)
    markers = {marker.ns: marker for marker in markers_message(picture, None).markers}
    assert set(markers) == {"keep out", "trajectory", "goal", "reference"}
    assert {marker.header.frame_id for marker in markers.values()} == {"car"}
    assert len(markers["trajectory"].points) == len(markers["trajectory"].colors) > 10
    assert abs(markers["goal"].points[0].x + 4.0) < 1e-6
    assert Polygon(picture.keep_out).exterior.distance(Polygon(OUTLINE)) == pytest.approx(0.10, abs=1e-3)
    path = next(each.path for each in robot.outputs if each.path)
    assert path_message(path, None).header.frame_id == "car"
    assert output.goal_id.waypoint_id == 1


def test_goal_of_the_state_machine_is_echoed_in_the_status():
    waypoint = Waypoint(3, "car_locator", "map", Pose2(1.0, 2.0, 0.5), 1)
    goal = desired_from(RobotMode(goal=waypoint_message(waypoint), goal_attempt=6), 1.0).goal
    assert goal == Goal(waypoint, 6)
    why = Problem("motion_planner.why", "Why.")
    status = status_message(PlannerOutput(0.1, 0.2, True, goal.id, Result.BLOCKED, 1.5, why), Header())
    assert (status.requester, status.goal_id, status.goal_attempt) == ("car_locator", 3, 6)
    assert (status.result, status.remaining_m, status.message) == (MotionStatus.BLOCKED, 1.5, why.text)
    assert [problem.code for problem in status.problems] == [why.code]
    assert goal_report_from(status).is_about(goal)
