"""Without a rear LiDAR the robot drives straight ahead before it turns over ground that was not seen recently."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
import math

import pytest
from motion_simulation import PARAMETERS, PERIOD_S, SimulatedRobot

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.following.ground_behind import MEMORY_S, NEEDED_M

ONE_LIDAR = dataclasses.replace(PARAMETERS, rear_lidar=False, longest_reverse_m=1.0)
START = Pose2(0.0, 3.0, 0.0)
REST_S = MEMORY_S + 1.0


def straight_m(robot, begun):
    """Return the commanded distance straight ahead from an output on, before the first turn or reverse, m."""
    way_m = 0.0
    for output in robot.outputs[begun:]:
        if output.angular_radps != 0.0 or output.linear_mps < 0.0:
            break
        way_m += output.linear_mps * PERIOD_S
    return way_m


@pytest.fixture(name="robot")
def robot_fixture():
    return SimulatedRobot(START, parameters=ONE_LIDAR)


@pytest.mark.parametrize("x, y, heading_deg", [(-3.0, 3.0, 180.0), (3.0, 4.5, 90.0), (0.0, 3.0, 90.0), (0.5, 5.0, 0.0)])
def test_first_goal_begins_with_a_way_straight_ahead(robot, x, y, heading_deg):
    robot.go(1, x, y, heading_deg)
    assert robot.run().result == Result.REACHED
    assert straight_m(robot, 0) >= NEEDED_M


def test_goal_straight_ahead_is_driven_to_at_once(robot):
    robot.go(1, 3.0, 3.0, 0.0)
    assert robot.run().result == Result.REACHED
    assert robot.pose.x == pytest.approx(3.0, abs=0.02)


def test_robot_with_a_rear_lidar_turns_at_once():
    robot = SimulatedRobot(START)
    robot.go(1, 0.0, 3.0, 90.0)
    assert robot.run().result == Result.REACHED
    assert straight_m(robot, 0) < 0.05


def test_ground_that_was_seen_is_turned_on_until_it_is_forgotten(robot):
    robot.go(1, 3.0, 3.0, 0.0)
    robot.run()
    for rest_s, fewest_m in ((1.0, 0.0), (REST_S, NEEDED_M)):
        robot.run_for(rest_s)
        begun = len(robot.outputs)
        robot.go(robot.goal.waypoint.id + 1, robot.pose.x, robot.pose.y, math.degrees(robot.pose.heading) + 90.0)
        assert robot.run().result == Result.REACHED
        assert (straight_m(robot, begun) >= NEEDED_M) == (fewest_m > 0.0)


def test_robot_that_cannot_go_ahead_is_sent_on_its_way_and_touches_nothing():
    robot = SimulatedRobot(Pose2(0.0, 1.35, -math.pi / 2.0), parameters=ONE_LIDAR)
    robot.go(1, 0.0, 3.0, -90.0, Direction.BACKWARD)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.1


def test_long_way_to_a_goal_straight_behind_is_not_driven_backwards(robot):
    robot.go(1, -4.0, 3.0, 0.0)
    assert robot.run().result == Result.REACHED
    backwards_m = sum(max(0.0, -output.linear_mps) * PERIOD_S for output in robot.outputs)
    assert backwards_m <= 1.5
