"""The robot slows down with an uncertain position, and is not slowed at the usual uncertainty."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from motion_simulation import SimulatedRobot

from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.following.pose_speed import STEP_MPS, PoseSpeed, speed_within
from mtr_motion_planner.limits import MotionLimits
from mtr_motion_planner.parameters import MotionParameters

PARAMETERS = MotionParameters()
LIMITS, MARGIN_M, CREEP_MPS = PARAMETERS.limits, PARAMETERS.pose_margin_m, PARAMETERS.creep_mps
LIMIT_SETS = st.builds(MotionLimits, acceleration_mps2=st.floats(0.05, 3.0), jerk_mps3=st.floats(0.5, 50.0))


@given(limits=LIMIT_SETS, room_m=st.floats(0.0, 3.0))
def test_robot_stops_within_the_room_and_uses_it(limits, room_m):
    assert limits.stopping_distance(speed_within(limits, room_m)) == pytest.approx(room_m, abs=1e-9)


@pytest.mark.parametrize("room_m", [0.0, -0.1, -5.0])
def test_without_room_there_is_no_speed(room_m):
    assert speed_within(LIMITS, room_m) == 0.0


@given(limits=LIMIT_SETS, margin_m=st.floats(0.1, 2.0), sigmas=st.lists(st.floats(0.0, 2.0), min_size=1, max_size=20))
def test_stopping_distance_and_two_sigma_stay_in_the_margin_whatever_came_before(limits, margin_m, sigmas):
    speed = PoseSpeed(limits, margin_m, CREEP_MPS)
    for sigma_m in sigmas:
        limit_mps = speed.limit(sigma_m)
        assert limit_mps == CREEP_MPS or limits.stopping_distance(limit_mps) + 2.0 * sigma_m <= margin_m + 1e-6


@pytest.mark.parametrize("sigma_m", [0.0, 0.02, 0.03, 0.05])
def test_usual_uncertainty_slows_nothing(sigma_m):
    assert PoseSpeed(LIMITS, MARGIN_M, CREEP_MPS).limit(sigma_m) >= LIMITS.max_linear_mps - STEP_MPS + 1e-9
    assert speed_within(LIMITS, MARGIN_M - 2.0 * sigma_m) > LIMITS.max_linear_mps


@pytest.mark.parametrize(("sigma_m", "limit_mps"), [(0.1, 0.6), (0.2, 0.3), (0.24, 0.1), (0.25, 0.1), (1.0, 0.1)])
def test_limit_falls_with_the_uncertainty_down_to_a_creep(sigma_m, limit_mps):
    assert PoseSpeed(LIMITS, MARGIN_M, CREEP_MPS).limit(sigma_m) == pytest.approx(limit_mps)


def test_limit_falls_at_once_and_rises_by_two_steps():
    speed = PoseSpeed(LIMITS, MARGIN_M, CREEP_MPS)
    low_mps = speed.limit(0.2)
    noisy = [speed.limit(sigma_m) for sigma_m in (0.195, 0.2, 0.19, 0.2)]
    assert noisy == [low_mps] * 4
    assert speed.limit(0.21) < low_mps
    assert speed.limit(0.15) > low_mps + 2.0 * STEP_MPS - 1e-9


def sigma_of(speed_mps):
    """Return the largest 1 sigma at which the robot may drive at this speed."""
    return 0.5 * (MARGIN_M - LIMITS.stopping_distance(speed_mps))


def test_limit_is_the_speed_itself_on_a_step_and_rises_by_two_steps_or_not_at_all():
    speed = PoseSpeed(LIMITS, MARGIN_M, CREEP_MPS)
    limits_mps = [speed.limit(sigma_of(wanted_mps)) for wanted_mps in (0.3, 0.35, 0.399, 0.4, 0.35, 0.45)]
    assert limits_mps == pytest.approx([0.3, 0.3, 0.3, 0.4, 0.35, 0.45])


def driving(sigma_m):
    robot = SimulatedRobot(Pose2(0.0, -8.0, math.radians(90.0)))
    robot.position_sigma_m = sigma_m
    robot.go(1, 0.0, -2.0, 90.0)
    return robot


def test_robot_drives_as_slowly_as_its_position_is_uncertain():
    robot = driving(0.004)
    robot.run_for(2.5)
    assert robot.outputs[-1].linear_mps > 0.45
    robot.position_sigma_m = 0.2
    robot.run_for(1.5)
    assert max(output.linear_mps for output in robot.outputs[-20:]) == pytest.approx(0.3, abs=0.02)
    robot.position_sigma_m = 0.004
    assert robot.run_for(2.0).linear_mps == pytest.approx(0.5, abs=0.02)


def test_uncertainty_of_the_heading_counts_at_the_key():
    robot = driving(0.004)
    robot.run_for(2.5)
    robot.heading_sigma = math.radians(40.0)
    robot.run_for(1.5)
    assert 0.0 < robot.outputs[-1].linear_mps < 0.35


def test_noise_of_the_usual_uncertainty_changes_no_velocity():
    steady, noisy = driving(0.02), driving(0.02)
    for tick in range(150):
        noisy.position_sigma_m = 0.02 if tick % 2 else 0.025
        assert noisy.tick() == steady.tick()


def test_robot_whose_position_is_uncertain_arrives_all_the_same():
    robot = driving(0.1)
    assert robot.run().result == Result.REACHED
