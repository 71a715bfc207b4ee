"""Distinction between motion of the Car and errors, and uncertainty of the frame afterwards."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_simulation import Scene, World, car_with_bumpers

from mtr_car_locator.poses import RobotPose
from mtr_car_locator.scan import RangeBias, Returns
from mtr_car_locator.watch.comparison import CarReference, Evidence
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check

CAR = car_with_bumpers()
# A stationary robot observes every 10 s, and two observations must agree.
LOOKED_AGAIN_S = 15.0


@pytest.mark.parametrize("front_m, rear_m", [(0.02, 0.0), (0.0, 0.02), (0.02, 0.02), (-0.02, 0.02)])
def test_range_bias_is_no_motion_of_the_car(front_m, rear_m):
    world = World(Scene(CAR, range_bias=RangeBias(front_m, rear_m), pose_sigma_m=0.002))
    world.run()
    report = world.check(3).check
    assert report.state is Check.PASSED and report.difference_m < 0.005
    # Each LiDAR in turn sees the Car's front only.
    for heading in (math.pi, 0.0):
        world.pose = world.car @ Pose2(4.0, 0.3, heading)
        world.stand(0.5)
        assert world.stand(LOOKED_AGAIN_S).revision == 1
    assert world.error()[0] < 0.005


def look_from(world, distance_m, *, heading_off_rad):
    """Place the robot at the Car's front left, with an exact position and a wrong heading."""
    bearing = math.radians(25.0)
    world.pose = world.car @ Pose2(distance_m * math.cos(bearing), distance_m * math.sin(bearing), math.pi + bearing)
    world.scene.drift_time_s = 1e9
    world.drift = np.array([0.0, 0.0, heading_off_rad])
    world.stand(0.5)
    return world.stand(LOOKED_AGAIN_S)


@pytest.mark.parametrize("distance_m, sigmas", [(7.5, 2.0), (7.5, -2.0), (4.0, 2.0)])
def test_heading_of_the_robot_is_no_motion_of_the_car(world, distance_m, sigmas):
    """With 2 mrad at 7.5 m, an unmoved Car seems to be 15 mm off."""
    world.scene.pose_sigma_m = 0.004
    after = look_from(world, distance_m, heading_off_rad=sigmas * 0.5 * world.scene.pose_sigma_m)
    assert after.revision == 1 and world.error()[0] < 0.005


def test_motion_of_the_car_is_seen_from_afar_by_a_robot_whose_heading_is_right(world):
    world.scene.pose_sigma_m = 0.004
    world.place_car(world.car @ Pose2(0.0, 0.09, 0.0), CAR)
    after = look_from(world, 7.5, heading_off_rad=0.0)
    assert after.revision == 2


def front_seen(located, robot, bias_sigma_m=0.0):
    """Return evidence of exact returns of the Car's front, from the front LiDAR of a robot ahead of it."""
    fit = located.newest.fit
    points = fit.surfels.samples()[0]
    front = points[(points[:, 0] > 2.0) & (np.abs(points[:, 1]) < 0.6)]
    pose = fit.rectangle.pose
    in_map = [np.array([pose.apply(x, y) for x, y in rows]) for rows in (front.repeat(4, axis=0), [(30.0, 0.0)])]
    seen = Returns(in_map[0], in_map[1][0], 0.0, robot.pose)
    return CarReference(fit.surfels, bias_sigma_m).compare([seen], pose, robot)


def test_errors_of_the_robots_pose_that_go_together_count_together(located):
    """Scan matching with the Car leaves an error that rotates the robot about the Car, without a shift of the Car."""
    car = located.newest.rectangle.pose
    robot = car @ Pose2(10.0, 0.0, math.pi)
    across = np.array([car.y - robot.y, robot.x - car.x, 1.0])
    free, alone, together = (front_seen(located, RobotPose(0.0, robot, covariance=tuple(covariance.ravel())))
                             for covariance in (np.zeros((3, 3)), np.diag([0.0, 0.0, 4e-6]),
                                                4e-6 * np.outer(across, across)))
    assert math.sqrt((alone.covariance - free.covariance)[1, 1]) == pytest.approx(0.02, rel=1e-6)
    assert math.sqrt((together.covariance - free.covariance)[2, 2]) == pytest.approx(0.002, rel=1e-6)
    assert (together.covariance - free.covariance)[:2, :2] == pytest.approx(np.zeros((2, 2)), abs=1e-12)


def test_what_is_left_of_a_range_bias_is_in_the_covariance_along_the_rays(located):
    robot = RobotPose(0.0, located.newest.rectangle.pose)
    free, unsure = (front_seen(located, robot, sigma_m) for sigma_m in (0.0, 0.005))
    along, across = np.sqrt(np.diag(unsure.covariance - free.covariance)[:2])
    assert along == pytest.approx(0.005, rel=0.1) and across < 0.002


@pytest.mark.parametrize("seed", range(4))
def test_a_corrected_frame_is_as_unsure_as_the_robot_that_saw_the_car(world, seed):
    world.scene.pose_sigma_m, world.scene.drift_time_s = 0.01, 1e9
    world.drift = np.random.default_rng(seed).normal(0.0, (0.01, 0.01, 0.005))
    world.place_car(world.car @ Pose2(0.07, 0.0, 0.0), CAR)
    after = world.stand(LOOKED_AGAIN_S)
    assert (after.state, after.revision) == (CarState.LOCATED, 2)
    assert min(after.sigmas[:2]) >= 0.005 and after.sigmas[2] >= 0.005
    error = world.car.inverse() @ after.rectangle.pose
    assert np.all(np.abs((error.x, error.y, error.heading)) < 4.0 * np.array(after.sigmas))


def test_what_was_not_seen_of_a_moved_car_is_not_sure(world):
    """The middle of a side contains almost no information about the Car's position along it."""
    world.scene.pose_sigma_m = 0.002
    world.pose = world.car @ Pose2(0.0, 2.5, -0.5 * math.pi)
    world.place_car(world.car @ Pose2(0.03, 0.04, 0.0), CAR)
    world.stand(0.5)
    after = world.stand(LOOKED_AGAIN_S)
    assert after.revision == 2 and after.sigmas[0] > 2.0 * after.sigmas[1]
    assert abs((world.car.inverse() @ after.rectangle.pose).x) < 4.0 * after.sigmas[0]


@pytest.mark.parametrize("seed", range(10))
def test_sigmas_taken_for_independent_say_in_no_direction_less_than_the_covariance(seed):
    mixed = np.random.default_rng(seed).normal(0.0, (0.01, 0.02, 0.005), (3, 3))
    evidence = Evidence(np.diag((1e4, 1e4, 1e6)), np.zeros(3), {}, 100, mixed.T @ mixed)
    beyond = np.diag(np.square(evidence.pose_sigmas)) - evidence.covariance
    assert np.linalg.eigvalsh(beyond).min() > -1e-12
    alone = Evidence(np.diag((1e4, 1e4, 1e6)), np.zeros(3), {}, 100, np.zeros((3, 3)))
    assert alone.pose_sigmas == pytest.approx(np.sqrt(np.diag(alone.covariance)))
