"""Pose of the robot in the Car coordinate system, with its uncertainty."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Sequence

from mtr_core.se2 import Pose2

Covariance = Sequence[float]  # row-major 3x3 of x, y, heading


class UncertainPose(NamedTuple):
    """A pose in map and its covariance in map."""

    pose: Pose2
    covariance: Covariance


class CarPose(NamedTuple):
    """Pose of base_link in the Car coordinate system, with the covariance of its position there.

    Attributes:
        position_sigma_m: 1 sigma in the worst direction.
    """

    pose: Pose2
    variance_x_m2: float
    variance_y_m2: float
    covariance_xy_m2: float
    position_sigma_m: float
    heading_sigma_rad: float


def base_in_car(base: UncertainPose, car: UncertainPose) -> CarPose:
    """Return the pose of base_link in car from both poses in map.

    Their errors are independent: the Car's covariance contains only the error of its fit. The drift of the drive around
    the Car is in the robot's covariance, which grows from the start on.
    """
    car_from_base = car.pose.inverse() @ base.pose
    # An error of the Car's heading moves the robot perpendicularly to the line from the Car's centre.
    lever_x, lever_y = base.pose.y - car.pose.y, car.pose.x - base.pose.x
    p, q = base.covariance, car.covariance
    var_x = p[0] + q[0] + lever_x * lever_x * q[8] - 2.0 * lever_x * q[2]
    var_y = p[4] + q[4] + lever_y * lever_y * q[8] - 2.0 * lever_y * q[5]
    cov_xy = p[1] + q[1] + lever_x * lever_y * q[8] - lever_x * q[5] - lever_y * q[2]
    cos, sin = math.cos(car.pose.heading), math.sin(car.pose.heading)
    return CarPose(car_from_base,
                   cos * cos * var_x + sin * sin * var_y + 2.0 * cos * sin * cov_xy,
                   sin * sin * var_x + cos * cos * var_y - 2.0 * cos * sin * cov_xy,
                   cos * sin * (var_y - var_x) + (cos * cos - sin * sin) * cov_xy,
                   _largest_sigma(var_x, var_y, cov_xy), _root(p[8] + q[8]))


def _largest_sigma(var_x: float, var_y: float, cov_xy: float) -> float:
    return _root(0.5 * (var_x + var_y) + math.hypot(0.5 * (var_x - var_y), cov_xy))


def _root(variance: float) -> float:
    return math.sqrt(variance) if variance > 0.0 else 0.0
