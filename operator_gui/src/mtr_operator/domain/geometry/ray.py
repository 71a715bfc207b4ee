"""A ray away from the Car on which the Remote key is carried."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from .pose import Point, Pose, wrap_angle


@dataclass(frozen=True)
class Ray:
    """Origin at the Car and unit direction away from it, in the Car coordinate system, in m."""

    origin_x: float
    origin_y: float
    direction_x: float
    direction_y: float

    @property
    def begins_in_centre(self) -> bool:
        """True if the origin is the Car's centre instead of a point of its outline."""
        return (self.origin_x, self.origin_y) == (0.0, 0.0)

    def point(self, distance_m: float) -> Point:
        """Return the point at a distance from the origin."""
        return self.origin_x + distance_m * self.direction_x, self.origin_y + distance_m * self.direction_y

    def distance_of(self, point: Point) -> float:
        """Return the component of a point's distance from the origin along the ray."""
        return (point[0] - self.origin_x) * self.direction_x + (point[1] - self.origin_y) * self.direction_y

    def offset_of(self, point: Point) -> float:
        """Return the distance of a point from the ray, positive to the left of its direction."""
        return (point[1] - self.origin_y) * self.direction_x - (point[0] - self.origin_x) * self.direction_y

    @property
    def heading(self) -> float:
        """Heading of a robot on the ray that faces the Car."""
        return wrap_angle(math.atan2(self.direction_y, self.direction_x) + math.pi)

    def base_pose(self, distance_m: float, key_in_base: Point) -> Pose:
        """Return the pose of base_link, facing the Car, that brings the Remote key to a distance on the ray."""
        x, y = self.point(distance_m)
        dx, dy = Pose(0.0, 0.0, self.heading).rotate(key_in_base)
        return Pose(x - dx, y - dy, self.heading)
