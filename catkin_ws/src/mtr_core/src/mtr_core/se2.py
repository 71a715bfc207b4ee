"""Rigid motions of the plane.

A transform is named `target_from_source`: it converts coordinates in source to coordinates in target. Units are metres,
and radians counterclockwise.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Tuple


def wrap_angle(angle: float) -> float:
    """Return the same direction within (-pi, pi]."""
    wrapped = math.remainder(angle, 2.0 * math.pi)
    return math.pi if wrapped == -math.pi else wrapped


@dataclass(frozen=True)
class Pose2:
    """Pose, or transform, in the plane: x and y in m, heading in rad."""

    x: float
    y: float
    heading: float

    def __matmul__(self, other: "Pose2") -> "Pose2":
        """Compose two transforms: a_from_b @ b_from_c == a_from_c."""
        x, y = self.apply(other.x, other.y)
        return Pose2(x, y, wrap_angle(self.heading + other.heading))

    def apply(self, x: float, y: float) -> Tuple[float, float]:
        """Return the coordinates in target of the point (x, y) in source."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return self.x + cos * x - sin * y, self.y + sin * x + cos * y

    def inverse(self) -> "Pose2":
        """Return source_from_target."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return Pose2(-cos * self.x - sin * self.y, sin * self.x - cos * self.y, wrap_angle(-self.heading))

    def distance_to(self, other: "Pose2") -> float:
        """Return the distance of the origins in m."""
        return math.hypot(other.x - self.x, other.y - self.y)

    def is_finite(self) -> bool:
        """Return True if no component is NaN or infinite."""
        return all(map(math.isfinite, (self.x, self.y, self.heading)))


def heading_of(z: float, w: float) -> float:
    """Return the heading in rad of a unit quaternion that rotates about z alone."""
    return 2.0 * math.atan2(z, w)
