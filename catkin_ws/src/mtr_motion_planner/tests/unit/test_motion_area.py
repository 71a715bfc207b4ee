"""The Operator's test area in the planner: no path leaves it, neither in map nor in the Car's frame."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest
from motion_simulation import FOOTPRINT, PARAMETERS, SimulatedRobot, car_at
from shapely.geometry import Polygon

from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.conversions import area_from
from mtr_motion_planner.inputs import NO_AREA, DrawnArea
from mtr_motion_planner.parameters import Margins
from mtr_msgs.msg import TestArea as AreaMessage

# The area leaves no room for a path on the Car's left.
CORNERS = ((-7.0, -7.0), (7.0, -7.0), (7.0, 1.55), (-7.0, 1.55))
# Drive control's distance from the border for a pose without uncertainty.
GAP_M = 0.05


def footprint_at(pose):
    front, rear, width = FOOTPRINT.front_m, FOOTPRINT.rear_m, FOOTPRINT.half_width_m
    return Polygon([pose.apply(x, y) for x, y in ((front, width), (-rear, width), (-rear, -width), (front, -width))])


def robot_at(x, y, heading_deg, *, corners=CORNERS, car=None, parameters=PARAMETERS):
    robot = SimulatedRobot(Pose2(x, y, math.radians(heading_deg)), car, parameters=parameters)
    robot.area = DrawnArea(corners)
    return robot


def test_path_around_the_car_keeps_what_drive_control_keeps():
    robot = robot_at(4.0, 1.0, 180.0)
    robot.go(1, -4.0, 1.0, 180.0)
    assert robot.run().result == Result.REACHED
    inner = Polygon(CORNERS).buffer(-GAP_M)
    assert all(inner.contains(footprint_at(pose)) for pose in robot.poses[::5])
    assert min(pose.y for pose in robot.poses) < -1.0


def test_area_is_in_map_wherever_the_car_stands():
    car_pose = Pose2(10.0, -4.0, 2.0)
    corners = tuple(car_pose.apply(x, y) for x, y in CORNERS)
    start = car_pose @ Pose2(4.0, 0.0, 0.0)
    robot = SimulatedRobot(start, car_at(pose=car_pose))
    robot.area = DrawnArea(corners)
    robot.go(1, 3.0, 3.0, 0.0)
    assert robot.planner_says(Result.REFUSED, "test area")
    robot.go(2, 4.0, -3.0, 0.0)
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("in_car", [True, False])
def test_goal_and_robot_outside_are_refused(in_car):
    robot = robot_at(4.0, 0.0, 0.0)
    robot.go(1, 3.0, 3.0, 0.0, in_car=in_car)
    assert robot.planner_says(Result.REFUSED, "test area")
    robot = robot_at(0.0, 4.0, 0.0)
    robot.go(1, 4.0, 0.0, 0.0, in_car=in_car)
    assert robot.planner_says(Result.REFUSED, "outside")


def test_uncertain_position_needs_more_room():
    goal = (4.0, 1.0, 0.0)
    certain = robot_at(4.0, -3.0, 90.0)
    certain.go(1, *goal)
    assert certain.run().result == Result.REACHED
    uncertain = robot_at(4.0, -3.0, 90.0)
    uncertain.position_sigma_m = 0.2
    uncertain.go(1, *goal)
    assert uncertain.planner_says(Result.REFUSED, "test area")


def test_area_that_is_drawn_on_the_way_makes_another_plan():
    robot = robot_at(4.0, -1.5, 180.0, corners=())
    robot.go(1, -4.0, -1.5, 180.0)
    for _ in range(40):
        robot.tick()
    before = robot.outputs[-1].replans
    robot.area = DrawnArea(((-7.0, -7.0), (7.0, -7.0), (7.0, 7.0), (-7.0, 7.0)))
    assert robot.run().result == Result.REACHED
    assert robot.outputs[-1].replans == before + 1


def test_parameter_and_drawn_area_hold_together():
    left = Margins(geofence_xy=(-7.0, -1.8, 7.0, -1.8, 7.0, 7.0, -7.0, 7.0))
    robot = robot_at(4.0, 0.0, 0.0, parameters=dataclasses.replace(PARAMETERS, margins=left))
    for goal_id, y in ((1, 3.0), (2, -3.0)):
        robot.go(goal_id, 4.0, y, 0.0)
        assert robot.planner_says(Result.REFUSED, "test area")


def test_area_of_a_message():
    corners = ((1.0, 4.0), (2.0, 5.0), (3.0, 6.0))
    assert area_from(AreaMessage(x=[1.0, 2.0, 3.0], y=[4.0, 5.0, 6.0])) == DrawnArea(corners)
    assert area_from(AreaMessage()) == NO_AREA
