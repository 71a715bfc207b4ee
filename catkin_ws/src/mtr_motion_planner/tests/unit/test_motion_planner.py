"""The motion planner with a simulated robot: it arrives precisely and never touches the Car."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from motion_simulation import SimulatedRobot, car_at

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result

AROUND = [(4.0, 0.0, 180.0), (4.0, -3.0, 140.0), (0.0, -4.0, 90.0), (-5.0, -2.0, 20.0), (-4.0, 0.0, 0.0),
          (-1.0, 3.0, -90.0), (3.0, 3.0, -135.0), (1.5, -1.6, 90.0), (-3.1, 0.3, 0.0)]

# Limit of drive control: 1.0 m/s2 in 40 ms.
MAX_STEP_MPS = 0.04 + 1e-6


def assert_stands_at_goal(robot):
    miss = robot.miss()
    assert abs(miss.x) <= 0.02
    assert abs(miss.y) <= 0.03
    assert abs(math.degrees(miss.heading)) <= 1.0


@pytest.mark.parametrize("goal", AROUND)
@pytest.mark.parametrize("start", [(4.0, 2.6, -147.0), (-4.0, -2.5, 90.0), (0.0, 1.65, -90.0)])
def test_goal_on_any_side_is_reached_without_touching_the_car(start, goal):
    robot = SimulatedRobot(Pose2(start[0], start[1], math.radians(start[2])))
    robot.go(1, *goal)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.10
    assert_stands_at_goal(robot)
    assert robot.largest_step() <= MAX_STEP_MPS or robot.ticks < 2


@pytest.mark.parametrize("car_pose", [Pose2(7.0, -3.0, 2.0), Pose2(-2.0, 5.0, -0.7)])
def test_car_elsewhere_in_map_is_avoided(car_pose):
    car = car_at(car_pose)
    robot = SimulatedRobot(car_pose @ Pose2(3.5, 0.2, 3.1), car)
    robot.go(1, -3.5, 0.0, 0.0)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.10
    assert_stands_at_goal(robot)


@pytest.mark.parametrize("speed", [0.2, 0.5, 1.0])
def test_approach_along_axis_keeps_within_2_cm_and_retreat_too(speed):
    robot = SimulatedRobot(Pose2(0.5, -6.0, math.radians(90.0)))
    robot.max_speed = speed
    robot.go(1, 0.5, -1.65, 90.0, Direction.FORWARD)
    assert robot.run().result == Result.REACHED
    assert_stands_at_goal(robot)
    robot.go(2, 0.5, -5.0, 90.0, Direction.BACKWARD)
    assert robot.run().result == Result.REACHED
    assert_stands_at_goal(robot)
    assert max(abs(pose.x - 0.5) for pose in robot.poses) <= 0.02
    assert all(output.linear_mps <= 0.02 for output in robot.outputs[-50:])
    assert robot.outputs[-1].replans == 0


@pytest.mark.parametrize("offset", [0.10, -0.10])
def test_offset_from_axis_is_taken_out_on_the_way(offset):
    robot = SimulatedRobot(Pose2(offset, -6.0, math.radians(93.0)))
    robot.go(1, 0.0, -1.65, 90.0, Direction.FORWARD)
    assert robot.run().result == Result.REACHED
    assert_stands_at_goal(robot)
    assert max(abs(pose.x) for pose in robot.poses if pose.y > -4.0) <= 0.02


def test_unlock_in_mid_approach_reverses_without_a_jump():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -1.65, 90.0, Direction.FORWARD)
    robot.run_for(5.0)
    assert robot.speed > 0.45
    robot.go(2, 0.0, -5.0, 90.0, Direction.BACKWARD)
    assert robot.tick().goal_id.waypoint_id == 2
    assert robot.run().result == Result.REACHED
    assert_stands_at_goal(robot)
    assert robot.largest_step() <= MAX_STEP_MPS
    assert max(abs(pose.x) for pose in robot.poses) <= 0.02


def test_goal_farther_on_the_same_axis_is_entered_without_a_stop():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -4.0, 90.0)
    robot.run_for(2.5)
    robot.go(2, 0.0, -2.0, 90.0)
    robot.run_for(2.0)
    assert min(output.linear_mps for output in robot.outputs[-50:]) > 0.4


@pytest.mark.parametrize("after_s", [1.0, 3.0, 6.0, 9.0])
def test_goal_replaced_on_a_route_is_reached_without_touching_the_car(after_s):
    robot = SimulatedRobot(Pose2(4.0, 2.6, math.radians(-147.0)))
    robot.go(1, -4.0, -1.0, 0.0)
    robot.run_for(after_s)
    robot.go(2, 3.5, -0.5, 170.0)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.10
    assert robot.largest_step() <= MAX_STEP_MPS
    assert_stands_at_goal(robot)


def test_gentle_corners_are_driven_without_stopping():
    robot = SimulatedRobot(Pose2(4.0, 1.5, math.radians(180.0)))
    robot.go(1, -4.0, 1.5, 180.0)
    assert robot.run().result == Result.REACHED
    moving = [output.linear_mps for output in robot.outputs][60:-60]
    assert min(moving) > 0.3


def test_robot_too_close_to_turn_leaves_straight_backwards_first():
    robot = SimulatedRobot(Pose2(0.0, -1.28, math.radians(90.0)))
    robot.go(1, 4.0, 0.0, 180.0)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.09
    assert_stands_at_goal(robot)
    assert min(output.linear_mps for output in robot.outputs[:60]) < -0.1


def test_goal_close_to_the_car_is_entered_straight():
    robot = SimulatedRobot(Pose2(4.0, 2.6, math.radians(-147.0)))
    robot.go(1, -2.63, 0.0, 0.0, Direction.FORWARD)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.09
    assert_stands_at_goal(robot)


@pytest.mark.parametrize("goal, low", [((0.0, 0.0, 0.0), "0.10 m"), ((0.0, -1.2, 90.0), "0.28 m"),
                                       ((2.4, 0.0, 180.0), "0.10 m")])
def test_goal_in_the_keep_out_zone_is_refused_and_the_robot_stays(goal, low):
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0))
    robot.go(1, *goal)
    output = robot.run()
    assert (output.result, output.message.code) == (Result.REFUSED, "motion_planner.goal_too_close")
    assert low in output.message.text
    robot.run_for(1.0)
    assert robot.pose == Pose2(4.0, 2.6, 0.0)


def test_goal_parallel_to_the_side_without_room_to_turn_is_refused():
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0), car_at(outline=((9, .9), (-9, .9), (-9, -.9), (9, -.9))))
    robot.pose = Pose2(0.0, 3.0, 0.0)
    robot.go(1, 0.0, 1.23, 0.0)
    output = robot.run()
    assert output.result == Result.REFUSED
    assert "straight" in output.message.text


def test_goal_id_zero_brakes_within_the_limit_and_becomes_idle():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -1.65, 90.0)
    robot.run_for(4.0)
    robot.go(0, 0.0, 0.0, 0.0)
    assert robot.tick().active
    output = robot.run_for(2.0)
    assert output.result == Result.IDLE
    assert not output.active
    assert output.linear_mps == 0.0
    assert robot.largest_step() <= MAX_STEP_MPS


def test_held_robot_is_reported_blocked_and_goes_on_when_released():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)), held=True)
    robot.go(1, 0.0, -3.0, 90.0)
    assert robot.run_for(4.0).result == Result.BLOCKED
    assert abs(robot.outputs[-1].linear_mps) <= 0.30
    robot.held = False
    assert robot.run().result == Result.REACHED


def test_reached_goal_holds_and_is_approached_again_after_the_robot_was_moved():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -4.0, 90.0)
    robot.run()
    assert all(o.result == Result.REACHED and o.linear_mps == 0.0 for o in [robot.tick() for _ in range(50)])
    robot.pose = Pose2(0.0, -5.0, math.radians(90.0))
    assert robot.tick().result == Result.PENDING
    assert robot.run().result == Result.REACHED


def test_plan_is_published_once_and_not_each_tick():
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0))
    robot.go(1, -4.0, 0.0, 0.0)
    robot.run()
    assert 1 <= sum(output.path is not None for output in robot.outputs) <= 2


def test_goal_in_frame_car_before_the_car_is_located_is_refused():
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0), car_at(located=False))
    robot.go(1, 3.0, 0.0, 0.0)
    assert robot.run().result == Result.REFUSED


def test_goal_in_map_before_the_car_is_located_avoids_the_prior_outline():
    robot = SimulatedRobot(Pose2(4.0, 2.6, 0.0), car_at(located=False))
    robot.go(1, -4.0, -2.6, 0.0, in_car=False)
    assert robot.run().result == Result.REACHED
    assert robot.least_clearance > 0.10


def test_path_planned_anew_to_a_goal_under_way_is_counted():  # B5
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.go(1, 0.0, -1.65, 90.0, Direction.FORWARD)
    robot.run_for(3.0)
    assert robot.outputs[-1].replans == 0
    robot.pose = robot.pose @ Pose2(0.0, 1.0, 0.0)
    assert robot.run().replans >= 1
