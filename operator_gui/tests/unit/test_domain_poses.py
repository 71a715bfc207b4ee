"""Poses that are remembered, and distances on a ray."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.actions.distance import Distance, distance_to_outline, position_sigma, recorded_values
from mtr_operator.domain.actions.pose_history import PoseHistory, PoseSample, PoseUnknown
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.robot_status import (
    CarDimensions,
    RobotStatus,
)

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)


def status(stamp_s=1.0, **changes):
    """A Status of a robot that knows where it is."""
    return replace(RobotStatus(1, 1, stamp_s, x=3.0, y=0.0, heading=0.0, pose_valid=True, position_sigma_m=0.03,
                               heading_sigma_rad=0.01), **changes)


def test_poses_are_remembered_for_a_minute():
    poses = PoseHistory()
    for index in range(701):
        poses.add(status(1.0 + index / 10))
    with pytest.raises(PoseUnknown, match=r"No poses .* 10\.900 s"):
        poses.at(10.9)
    assert poses.at(11.15).stamp_s == 11.15


def test_a_pose_older_than_the_newest_is_not_remembered():
    poses = PoseHistory()
    for stamp_s, x in ((1.0, 3.0), (1.2, 3.2), (1.1, 9.0)):
        poses.add(status(stamp_s, x=x))
    assert poses.at(1.1).pose.x == pytest.approx(3.1)


def test_a_pose_between_two_has_the_worse_accuracy_and_the_mean_speed():
    poses = PoseHistory()
    poses.add(status(1.0, speed_mps=0.2, position_sigma_m=0.05, heading_sigma_rad=0.01))
    poses.add(status(1.5, speed_mps=0.4, position_sigma_m=0.03, heading_sigma_rad=0.02, x=4.0))
    sample = poses.at(1.25)
    assert (sample.pose.x, sample.speed_mps) == pytest.approx((3.5, 0.3))
    assert (sample.position_sigma_m, sample.heading_sigma_rad) == (0.05, 0.02)


@pytest.mark.parametrize("sigmas_m", [(0.08, 0.004), (0.004, 0.08)])
def test_a_pose_near_one_of_two_is_hardly_surer_than_that_one_along_a_ray(sigmas_m):
    poses = PoseHistory()
    for stamp_s, sigma_m in zip((1.0, 1.1), sigmas_m):
        poses.add(status(stamp_s, variance_x_m2=sigma_m ** 2, variance_y_m2=sigma_m ** 2, covariance_xy_m2=0.0))
    near_first, near_second = (position_sigma(Ray(0.0, 0.0, 0.6, 0.8), poses.at(stamp_s)) for stamp_s in (1.002, 1.098))
    assert near_first >= 0.98 * sigmas_m[0] and near_second >= 0.98 * sigmas_m[1]


@pytest.mark.parametrize("sigmas", [(0.05, math.nan), (math.nan, 0.05)])
def test_a_pose_beside_one_that_does_not_say_its_sigma_does_not_say_it_either(sigmas):
    poses = PoseHistory()
    for stamp_s, sigma in zip((1.0, 1.1), sigmas):
        poses.add(status(stamp_s, position_sigma_m=sigma, heading_sigma_rad=sigma))
    assert math.isnan(poses.at(1.05).position_sigma_m) and math.isnan(poses.at(1.05).heading_sigma_rad)


def test_a_pose_beside_one_that_does_not_say_its_covariance_counts_in_its_worst_direction():
    poses = PoseHistory()
    poses.add(status(1.0, variance_x_m2=1e-6, variance_y_m2=1e-6, covariance_xy_m2=0.0))
    poses.add(status(1.1))
    assert position_sigma(Ray(0.0, 0.0, 1.0, 0.0), poses.at(1.05)) == 0.03


@pytest.mark.parametrize("covariance, sigma_m", [
    ((0.04, 0.01, 0.01), math.sqrt(0.36 * 0.04 + 0.64 * 0.01 + 2 * 0.48 * 0.01)),
    ((0.04, 0.01, math.nan), 0.03), ((0.0, 0.0, -0.01), 0.0)])
def test_position_counts_along_the_ray_or_in_its_worst_direction(covariance, sigma_m):
    sample = PoseSample(1.0, Pose(3.0, 0.0, 0.0), 0.0, 0.03, 0.01, 0.25, 0.0, covariance)
    assert position_sigma(Ray(0.0, 0.0, 0.6, 0.8), sample) == pytest.approx(sigma_m)


@pytest.mark.parametrize("ray, distance_m, gap_m", [
    (Ray(0.0, 0.0, 1.0, 0.0), 3.25, 1.0), (Ray(0.0, 0.0, 0.0, -1.0), 1.9, 1.0), (Ray(0.0, 0.0, -1.0, 0.0), 2.0, 0.0),
    (Ray(2.25, 0.9, 0.6, 0.8), 5.0, 5.0)])
def test_distance_to_the_outline_is_that_of_the_nearest_side_or_corner(ray, distance_m, gap_m):
    assert distance_to_outline(ray, distance_m, CAR) == pytest.approx(gap_m)


def test_distances_are_recorded_to_micrometres_and_microseconds():
    assert recorded_values(Distance(1.23456789, 0.01234567, 12.3456789)) == (1.234568, 0.012346, 12.345679)
    assert recorded_values(Distance(1.0, math.nan, 2.0)) == (1.0, None, 2.0)
    assert recorded_values(None) == (None, None, None)
