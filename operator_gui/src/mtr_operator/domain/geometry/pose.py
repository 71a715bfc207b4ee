"""Rigid motions of the plane; metres, radians counterclockwise. A transform reads target_from_source."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Tuple

Point = Tuple[float, float]


def wrap_angle(angle: float) -> float:
    """Return the same direction within [-pi, pi]."""
    return math.remainder(angle, 2.0 * math.pi)


@dataclass(frozen=True)
class Pose:
    """Pose of a frame in another one."""

    x: float
    y: float
    heading: float

    def apply(self, point: Point) -> Point:
        """Return the coordinates in target of a point in source."""
        dx, dy = self.rotate(point)
        return self.x + dx, self.y + dy

    def to_source(self, point: Point) -> Point:
        """Return the coordinates in source of a point in target."""
        dx, dy = point[0] - self.x, point[1] - self.y
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return cos * dx + sin * dy, cos * dy - sin * dx

    def rotate(self, vector: Point) -> Point:
        """Return the components in target of a vector in source."""
        cos, sin = math.cos(self.heading), math.sin(self.heading)
        return cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]
