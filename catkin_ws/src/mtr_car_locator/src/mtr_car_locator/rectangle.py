"""The Car as a rectangle in map."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses
from dataclasses import dataclass
from typing import List, Tuple

from mtr_core.se2 import Pose2

from .parameters import LocatorParameters


@dataclass(frozen=True)
class Rectangle:
    """Pose of the Car's centre in map, x to its front, and its dimensions."""

    pose: Pose2
    length: float
    width: float

    def outline(self, margin_m: float = 0.0) -> List[Tuple[float, float]]:
        """Corners in the Car's own frame, counterclockwise, grown by the margin on each side."""
        x, y = 0.5 * self.length + margin_m, 0.5 * self.width + margin_m
        return [(x, y), (-x, y), (-x, -y), (x, -y)]

    def turned_by(self, angle_rad: float) -> "Rectangle":
        """Same centre and size, other heading."""
        return dataclasses.replace(self, pose=self.pose @ Pose2(0.0, 0.0, angle_rad))


def prior_from(robot: Pose2, parameters: LocatorParameters) -> Rectangle:
    """Where the Car should be when the robot stands at the starting place."""
    pose = robot @ parameters.car_from_start.inverse()
    return Rectangle(pose, parameters.expected_length_m, parameters.expected_width_m)
