"""Oriented circles and the straight lines that join them.

The signed radius of a circle gives the direction: positive for a left turn, negative for a right turn, 0 for a
point.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.se2 import Pose2, wrap_angle

TURN = 2.0 * math.pi
# A turn that is longer than 360 degrees only by rounding counts as no turn.
ROUNDING_RAD = 1e-6


@dataclass(frozen=True)
class Circle:
    """Centre and signed radius in m."""

    x: float
    y: float
    radius: float

    def point(self, direction: float) -> Tuple[float, float]:
        """Return the robot's position on the circle at a direction of travel."""
        return self.x + self.radius * math.sin(direction), self.y - self.radius * math.cos(direction)

    def turn(self, before: float, after: float) -> float:
        """Return the signed angle of the turn on the circle between two directions of travel."""
        if self.radius == 0.0:
            return wrap_angle(after - before)
        sign = math.copysign(1.0, self.radius)
        angle = math.fmod(sign * (after - before), TURN)
        angle = angle + TURN if angle < 0.0 else angle
        return 0.0 if angle > TURN - ROUNDING_RAD else sign * angle


def circle_through(pose: Pose2, radius: float) -> Circle:
    """Return the circle of this radius on which a robot at the pose drives."""
    return Circle(pose.x - radius * math.sin(pose.heading), pose.y + radius * math.cos(pose.heading), radius)


def tangent(first: Circle, second: Circle) -> Optional[Tuple[float, float]]:
    """Return direction and length of the straight line from one circle to the next, or None."""
    dx, dy = second.x - first.x, second.y - first.y
    distance, offset = math.hypot(dx, dy), second.radius - first.radius
    if distance < abs(offset) or distance < 1e-9:
        return None
    direction = math.atan2(dy, dx) - math.asin(offset / distance)
    return direction, math.sqrt(distance * distance - offset * offset)
