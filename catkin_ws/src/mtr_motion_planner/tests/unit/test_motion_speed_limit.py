"""The robot never exceeds its speed limit, even if it was slowed externally and lags behind its reference."""
# SPDX-License-Identifier: Apache-2.0
import math
import random

import pytest
from motion_simulation import EXPECTED_SLIP, PERIOD_S, SimulatedRobot

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.following.tracking import Tracking, Velocity, tracked
from mtr_motion_planner.timing.trajectory import Reference

LIMITS_MPS = [0.1, 0.2, 0.3, 0.5, 0.7, 1.0]
TOLERANCE_MPS = 0.02
RUN_S = 8.0
WAYS = {"axis": ((0.0, -6.0, 90.0), (0.0, -1.65, 90.0, Direction.FORWARD)),
        "backwards": ((0.0, -2.0, 90.0), (0.0, -6.0, 90.0, Direction.BACKWARD)),
        "way round": ((4.0, 2.6, -147.0), (-4.0, -1.0, 0.0, Direction.ANY))}


def slow_downs(seed, base_mps):
    """Yield the cap of the base's speed at each tick: alternately none, and a random share of the limit."""
    dice = random.Random(seed)
    while True:
        for cap, duration_s in ((math.inf, dice.uniform(0.2, 2.0)),
                                (dice.choice((0.0, 0.2, 0.5, 0.8)) * base_mps, dice.uniform(0.1, 1.5))):
            for _ in range(round(duration_s / PERIOD_S)):
                yield cap


def driven(way, limit_mps, caps):
    """Return the robot after a drive with these caps, which end after a while so that it arrives."""
    (x, y, heading_deg), goal = WAYS[way]
    robot = SimulatedRobot(Pose2(x, y, math.radians(heading_deg)))
    robot.max_speed = limit_mps
    robot.go(1, *goal)
    for _, robot.speed_cap in zip(range(round(RUN_S / PERIOD_S)), caps):
        robot.tick()
    robot.speed_cap = math.inf
    robot.run(limit_s=240.0)
    return robot


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("limit_mps", LIMITS_MPS)
@pytest.mark.parametrize("way", WAYS)
def test_robot_that_was_slowed_does_not_catch_up_beyond_its_limit(way, limit_mps, seed):
    robot = driven(way, limit_mps, slow_downs(seed, min(limit_mps, 0.7)))
    assert robot.fastest_mps <= limit_mps + TOLERANCE_MPS
    assert max(abs(output.linear_mps) for output in robot.outputs) <= limit_mps + TOLERANCE_MPS
    assert robot.outputs[-1].result == Result.REACHED
    assert robot.least_clearance > 0.10


@pytest.mark.parametrize("limit_mps", LIMITS_MPS)
def test_lag_of_a_robot_at_its_limit_is_taken_out_by_the_reference(limit_mps):
    (x, y, heading_deg), goal = WAYS["axis"]
    robot = SimulatedRobot(Pose2(x, y, math.radians(heading_deg)))
    robot.max_speed = limit_mps
    robot.go(1, *goal)
    robot.run_for(2.0)
    robot.speed_cap = 0.7 * min(limit_mps, 0.7)
    robot.run_for(0.6)
    robot.speed_cap = math.inf
    robot.run_for(3.0)
    follower = robot.planner.follower
    assert follower is not None
    lag_m = follower.reference().pose.distance_to(robot.pose @ EXPECTED_SLIP.base_from_centre)
    assert lag_m < 0.01 + PERIOD_S * limit_mps


def test_pose_that_jumps_back_does_not_push_the_robot_beyond_its_limit():
    robot = SimulatedRobot(Pose2(0.0, -6.0, math.radians(90.0)))
    robot.max_speed = 0.3
    robot.go(1, 0.0, -1.65, 90.0, Direction.FORWARD)
    robot.run_for(4.0)
    robot.pose = robot.pose @ Pose2(-0.07, 0.0, 0.0)
    robot.run_for(3.0)
    assert robot.fastest_mps <= 0.3 + TOLERANCE_MPS
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("angular_radps", [0.0, 0.5])
@pytest.mark.parametrize("limit_mps", [0.05, 0.1, 0.15])
def test_correction_at_rest_and_in_a_turn_on_the_spot_keeps_a_small_limit(limit_mps, angular_radps):
    reference = Reference(Pose2(0.0, 0.0, 0.0), 0.0, angular_radps, 0.0)
    tracking = tracked(reference, reference, Pose2(-0.09, 0.0, 0.0), limit_mps)
    assert tracking.velocity.linear_mps == pytest.approx(limit_mps)


def test_robot_that_is_to_become_slower_is_not_braked_harder_than_planned():
    braking = Reference(Pose2(0.0, 0.0, 0.0), 0.5, 0.0, 0.0)
    assert tracked(braking, braking, Pose2(0.0, 0.0, 0.0), 0.2) == Tracking(Velocity(0.5, 0.0))
    assert tracked(braking, braking, Pose2(-0.05, 0.0, 0.0), 0.2).velocity.linear_mps == pytest.approx(0.5)
