"""Turns that overlap with the drive between them are quicker, end at the goal and respect every limit."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from motion_simulation import PARAMETERS, ROBOT, SimulatedRobot, car_at

from mtr_core.se2 import Pose2, wrap_angle
from mtr_core.states import Direction, Result
from mtr_motion_planner.geometry.keep_out import KeepOut
from mtr_motion_planner.limits import rest_to_rest_time
from mtr_motion_planner.search.options import Target
from mtr_motion_planner.search.planning import Planning
from mtr_motion_planner.timing.blend import Blend
from mtr_motion_planner.timing.plan import Moving
from mtr_motion_planner.timing.speeds import SAMPLE_S

LIMITS = PARAMETERS.limits
START = Pose2(0.0, -6.0, 0.0)
# No goal is straight ahead of the start; each needs a turn at the start, at the end or at both.
ENDS = (Pose2(1.5, -3.0, 1.1), Pose2(0.0, -3.0, 0.0), Pose2(3.0, -4.0, 2.0), Pose2(-0.5, -4.8, 0.3))


def planned(end, speed=0.7):
    keep_out = KeepOut(car_at().outline, ROBOT, PARAMETERS.margins)
    return Planning(keep_out, None, PARAMETERS, speed).plan(Moving(START), Target(end, Direction.ANY))


def one_after_the_other(end, speed=0.7):
    """Return the time of turn, straight drive and turn, forwards or backwards."""
    towards = math.atan2(end.y - START.y, end.x - START.x)
    drive = rest_to_rest_time(START.distance_to(end), speed, LIMITS.acceleration_mps2, LIMITS.ramp_s)
    turns = ((wrap_angle(way - START.heading), wrap_angle(end.heading - way)) for way in (towards, towards + math.pi))
    return drive + min(LIMITS.turn_time(first) + LIMITS.turn_time(last) for first, last in turns)


@pytest.mark.parametrize("end", ENDS)
def test_blended_plan_is_quicker_than_turning_on_the_spot_by_a_second(end):
    assert planned(end).duration_s < one_after_the_other(end) - 1.0


@pytest.mark.parametrize("end", ENDS)
def test_blended_plan_ends_at_its_goal_at_rest(end):
    last = planned(end).parts[-1].trajectory
    x, y, heading = last.poses[-1]
    assert math.hypot(x - end.x, y - end.y) < 0.002
    assert abs(wrap_angle(heading - end.heading)) < 0.002
    assert abs(last.linear[-1]) < 0.02 and abs(last.angular[-1]) < 0.03


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("speed", [0.3, 1.0])
def test_blended_plan_keeps_speed_yaw_rate_and_accelerations(end, speed):
    for part in planned(end, speed).parts:
        linear, angular = part.trajectory.linear, part.trajectory.angular
        assert np.abs(linear).max() <= speed + 1e-6
        assert np.abs(angular).max() <= 1.03 * LIMITS.max_angular_radps
        assert np.abs(linear * angular).max() <= 1.03 * LIMITS.lateral_acceleration_mps2
        assert np.abs(np.diff(linear)).max() <= 1.03 * SAMPLE_S * LIMITS.acceleration_mps2


def test_blend_around_the_car_follows_its_drive_once_the_first_turn_is_done():
    start, end = Pose2(4.0, -2.0, 2.6), Pose2(-3.5, 1.0, -1.2)
    keep_out = KeepOut(car_at().outline, ROBOT, PARAMETERS.margins)
    part, = Planning(keep_out, None, PARAMETERS, 0.7).plan(Moving(start), Target(end, Direction.ANY)).parts
    curve, poses = part.motion.drive.curve, part.trajectory.poses
    assert math.hypot(curve.x[0] - start.x, curve.y[0] - start.y) > 0.05
    for x, y, _ in poses[round(3.0 / SAMPLE_S):-round(3.0 / SAMPLE_S):10]:
        assert np.hypot(curve.x - x, curve.y - y).min() < 0.5 * curve.step_m + 0.002


def test_robot_held_in_a_blend_is_reported_blocked_and_goes_on_when_released():
    robot = SimulatedRobot(Pose2(0.0, -6.0, 0.0), held=True)
    robot.go(1, 1.5, -3.0, 60.0)
    assert robot.run_for(4.0).result == Result.BLOCKED
    robot.held = False
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("after_s", [0.4, 1.2, 2.0])
def test_robot_held_in_the_middle_of_a_blend_reaches_its_goal(after_s):
    robot = SimulatedRobot(Pose2(0.0, -6.0, 0.0))
    robot.go(1, 1.5, -3.0, 60.0)
    robot.run_for(after_s)
    robot.held = True
    robot.run_for(2.0)
    robot.held = False
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("after_s", [0.4, 1.2, 2.0])
def test_speed_limit_lowered_in_a_blend_is_kept_after_braking(after_s):
    robot = SimulatedRobot(Pose2(0.0, -6.0, 0.0))
    robot.max_speed = 0.8
    robot.go(1, 1.5, -2.0, 60.0)
    robot.run_for(after_s)
    robot.max_speed = 0.2
    robot.run_for(1.2)
    robot.outputs.clear()
    assert robot.run().result == Result.REACHED
    assert max(abs(output.linear_mps) for output in robot.outputs) < 0.25


@pytest.mark.parametrize("after_s", [0.4, 1.2, 2.0])
def test_goal_replaced_in_a_blend_is_reached_without_a_jump(after_s):
    robot = SimulatedRobot(Pose2(0.0, -6.0, 0.0))
    robot.go(1, 1.5, -3.0, 60.0)
    robot.run_for(after_s)
    robot.go(2, -2.0, -4.0, 120.0)
    assert robot.run().result == Result.REACHED
    assert robot.largest_step() <= 0.04 + 1e-6


@pytest.mark.parametrize("end", [Pose2(4.0, -6.0, -2.6), Pose2(5.0, -6.0, 2.8), Pose2(3.0, -6.3, 2.5)])
def test_plan_with_a_blend_at_its_end_goes_on_from_the_present_speed(end):
    keep_out = KeepOut(car_at().outline, ROBOT, PARAMETERS.margins)
    plan = Planning(keep_out, None, PARAMETERS, 0.7).plan(Moving(START, 0.5), Target(end, Direction.ANY))
    assert isinstance(plan.parts[0].motion, Blend)
    assert plan.parts[0].trajectory.linear[:3] == pytest.approx(0.5, abs=0.05)
