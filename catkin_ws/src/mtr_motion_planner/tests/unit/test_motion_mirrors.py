"""Mirrors are invisible to LiDARs: the key keeps a distance from the Car's sides that includes them."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from motion_simulation import OUTLINE, PARAMETERS, ROBOT, SimulatedRobot, car_at

from mtr_core.se2 import Pose2
from mtr_core.states import Direction, Result
from mtr_motion_planner.following.tracking import Velocity
from mtr_motion_planner.following.watch import is_heading_into
from mtr_motion_planner.geometry.keep_out import KeepOut, rows_of
from mtr_motion_planner.inputs import RobotState

SIDE_M = 0.9
# Mirrors of the simulated Car, see car_body.py of mtr_simulation; a mirror may protrude by 0.25 m.
MIRROR_X_M, MIRROR_OUT_M = 0.75, 0.18
MAX_MIRROR_OUT_M = 0.25
# Distances of the key's front and of the key from base_link, see the URDF.
KEY_FRONT_M, KEY_M = 0.27, 0.25
CAR_POSES = [Pose2(0.0, 0.0, 0.0), Pose2(7.0, -3.0, 2.0)]


def facing_left_side(gap_m, x=MIRROR_X_M, key_m=KEY_FRONT_M):
    """Return x, y, heading in degrees of base_link with the key at this gap from the Car's left side."""
    return x, SIDE_M + gap_m + key_m, -90.0


def gaps_beside(robot):
    """Return the gaps between the key's front and the Car's sides at all poses next to a side."""
    fronts = [robot.car.pose.inverse() @ pose @ Pose2(KEY_FRONT_M, 0.0, 0.0) for pose in robot.poses]
    return [abs(front.y) - SIDE_M for front in fronts if abs(front.x) < 2.25]


@pytest.mark.parametrize("car_pose", CAR_POSES)
def test_goal_with_the_key_where_a_mirror_may_be_is_refused(car_pose):
    robot = SimulatedRobot(car_pose @ Pose2(MIRROR_X_M, 3.0, math.radians(-90.0)), car_at(car_pose))
    robot.go(1, 0.75, 1.28, -90.0, Direction.FORWARD)
    output = robot.run()
    assert (output.result, output.message.code) == (Result.REFUSED, "motion_planner.goal_too_close")
    assert "0.11 m to the Car" in output.message.text and "0.27 m" in output.message.text


@pytest.mark.parametrize("car_pose", CAR_POSES)
@pytest.mark.parametrize("gap_m", [0.5, 0.3])  # minimum_distance_m and clearance_m of the application's scenarios
def test_key_is_brought_as_close_to_the_side_as_the_scenarios_want_by_default(car_pose, gap_m):
    robot = SimulatedRobot(car_pose @ Pose2(MIRROR_X_M, 4.0, math.radians(-90.0)), car_at(car_pose))
    robot.go(1, *facing_left_side(gap_m, key_m=KEY_M), Direction.FORWARD)
    assert robot.run().result == Result.REACHED
    assert min(gaps_beside(robot)) > MAX_MIRROR_OUT_M


def test_key_may_come_closer_to_the_cars_ends():
    robot = SimulatedRobot(Pose2(5.0, 0.0, math.radians(180.0)))
    robot.go(1, 2.25 + 0.12 + KEY_FRONT_M, 0.0, 180.0, Direction.FORWARD)
    assert robot.run().result == Result.REACHED


@pytest.mark.parametrize("start_deg, goal", [(-5.0, (0.75, 1.6, 180.0)), (175.0, (0.75, 1.6, 0.0))])
def test_turn_beside_the_car_keeps_the_key_away_from_the_mirror(start_deg, goal):
    robot = SimulatedRobot(Pose2(MIRROR_X_M, SIDE_M + 0.45, math.radians(start_deg)))
    robot.go(1, *goal)
    assert robot.run().result == Result.REACHED
    assert min(gaps_beside(robot)) > MAX_MIRROR_OUT_M


def test_key_that_is_too_close_is_taken_straight_out_of_there():
    robot = SimulatedRobot(Pose2(MIRROR_X_M, SIDE_M + 0.12 + KEY_FRONT_M, math.radians(-90.0)))
    robot.go(1, -3.5, 0.0, 0.0)
    assert robot.run().result == Result.REACHED
    assert min(gaps_beside(robot)) > 0.11
    assert all(abs(pose.x - MIRROR_X_M) < 0.03 for pose in robot.poses if abs(pose.x) < 2.25 and pose.y < SIDE_M + 0.5)


@pytest.mark.parametrize("pose, gap_m", [
    (Pose2(0.0, SIDE_M + 0.6, math.radians(-90.0)), 0.6 - ROBOT.front_m),
    (Pose2(0.0, -SIDE_M - 0.5, 0.0), 0.5),
    (Pose2(3.0, 2.0, math.radians(180.0)), math.inf)])
@pytest.mark.parametrize("car_pose", CAR_POSES)
def test_keys_gap_is_measured_across_the_car_in_any_frame(car_pose, pose, gap_m):
    outline = [car_pose.apply(x, y) for x, y in OUTLINE]
    keep_out = KeepOut(outline, ROBOT, PARAMETERS.margins, car_pose)
    room_m = keep_out.key_room(rows_of(car_pose @ pose))[0]
    assert room_m + PARAMETERS.margins.mirror_m == pytest.approx(gap_m, abs=0.002)


@pytest.mark.parametrize("gap_m, speed_mps, is_stopped", [
    (0.35, 0.3, False), (0.24, 0.3, True), (0.24, -0.3, False)])
def test_robot_that_drives_its_key_into_a_mirror_is_stopped(gap_m, speed_mps, is_stopped):
    keep_out = KeepOut(OUTLINE, ROBOT, PARAMETERS.margins)
    pose = Pose2(MIRROR_X_M, SIDE_M + gap_m + ROBOT.front_m, math.radians(-90.0))
    robot = RobotState(1.0, True, pose, speed_mps, 0.0, "", False)
    assert is_heading_into(keep_out, pose, robot, Velocity(speed_mps, 0.0), PARAMETERS) is is_stopped


def test_margin_is_beyond_the_mirrors_of_the_simulated_car():
    assert PARAMETERS.margins.mirror_m > MAX_MIRROR_OUT_M > MIRROR_OUT_M
    assert np.isclose(ROBOT.footprint.front_m, KEY_FRONT_M)
