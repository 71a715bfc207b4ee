"""The bound of the test area for footprint and stopping distance; poses are of the turn centre."""
# SPDX-License-Identifier: Apache-2.0
import functools
from typing import Sequence

import numpy as np
from shapely.geometry import JOIN_STYLE, MultiPoint, Polygon
from shapely.prepared import prep

from mtr_core.arrays import FloatArray
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2

from ..inputs import Point
from ..limits import MotionLimits
from .robot_outline import RobotOutline


def corners_of(numbers: Sequence[float]) -> Sequence[Point]:
    """Return points from x, y, x, y, ...; ConfigurationError if the polygon is invalid."""
    corners = tuple(zip(numbers[::2], numbers[1::2]))
    if corners and not Polygon(corners).is_valid:
        raise ConfigurationError("Parameter geofence_xy crosses itself; allowed is a simple polygon.")
    return corners


def bound_of(corners: Sequence[Point], margin_m: float = 0.0) -> Polygon:
    """Return the area inside these corners, at least the margin away from the border."""
    polygon = Polygon(corners)
    return polygon.buffer(-margin_m, join_style=JOIN_STYLE.mitre) if margin_m else polygon


class Fence:
    """The intersection of areas in the frame of the plan."""

    def __init__(self, bounds: Sequence[Polygon], robot: RobotOutline, limits: MotionLimits):
        self._area = prep(functools.reduce(lambda one, other: one.intersection(other), bounds))
        self._robot, self._limits = robot, limits

    def holds(self, poses: FloatArray, speeds: FloatArray) -> bool:
        """Return True if the robot may have these poses (rows of x, y, heading) at these signed speeds in m/s."""
        ahead, back, aside = self._robot.front_m, -self._robot.rear_m, self._robot.half_width_m
        reach = speeds * np.abs(speeds) / (2.0 * self._limits.acceleration_mps2)
        cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        points = []
        for x, y in ((ahead, aside), (ahead, -aside), (back, aside), (back, -aside)):
            along = x + np.where(reach * x > 0.0, reach, 0.0)
            points.append(np.column_stack((poses[:, 0] + cos * along - sin * y, poses[:, 1] + sin * along + cos * y)))
        return self._area.contains(MultiPoint(np.concatenate(points)))

    def holds_pose(self, pose: Pose2) -> bool:
        """Return True if the robot may stop at the pose."""
        return self.holds(np.array([[pose.x, pose.y, pose.heading]]), np.zeros(1))
