"""Geometry of a route: straight lines and arcs from a start around the Car to an end."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, Optional, Sequence, Tuple

from mtr_core.se2 import Pose2, wrap_angle

from ..inputs import Point
from .circles import Circle, tangent

# A larger arc is a loop, which no quick route has.
MAX_ARC_RAD = math.radians(250.0)


class TurnPolygon:
    """Polygon around whose corners a route turns.

    Attributes:
        corners: counterclockwise.
        radius: of the turns in m.
    """

    def __init__(self, corners: Sequence[Point], radius: float):
        self.corners, self.radius = tuple(corners), radius
        self._middle = Pose2(sum(x for x, _ in corners) / len(corners), sum(y for _, y in corners) / len(corners), 0.0)
        self._supports: Dict[Tuple[Circle, int], Optional[int]] = {}

    def support(self, circle: Circle, side: int) -> Optional[int]:
        """Return the corner of the tangent from the circle that has the whole ring to its left (1) or right (-1)."""
        key = (circle, side)
        if key not in self._supports:
            self._supports[key] = self._support(circle, side)
        return self._supports[key]

    def _support(self, circle: Circle, side: int) -> Optional[int]:
        towards = math.atan2(self._middle.y - circle.y, self._middle.x - circle.x)
        best, found = math.inf, None
        for index, (x, y) in enumerate(self.corners):
            joined = tangent(circle, Circle(x, y, side * self.radius))
            if joined is None:
                return None
            offset = side * wrap_angle(joined[0] - towards)
            if offset < best:
                best, found = offset, index
        return found


@dataclass(frozen=True)
class Leg:
    """A turn on a circle, then a straight line."""

    radius: float
    turn: float
    line: float

    @property
    def arc(self) -> float:
        """Length of the turn."""
        return abs(self.radius * self.turn)


@dataclass(frozen=True)
class Route:
    """Legs; the first turns out of the start, the last, without a line, into the end. Radius 0: turn on the spot."""

    legs: Tuple[Leg, ...]
    points: Tuple[Point, ...]  # ends of the straight lines


def route_along(circles: Sequence[Circle], first_heading: float, last_heading: float) -> Optional[Route]:
    """Return the route that turns on each circle; None if two circles cannot be joined, or if the route has a loop."""
    heading, legs, points = first_heading, [], []
    for circle, following in zip(circles, circles[1:]):
        joined = tangent(circle, following)
        if joined is None:
            return None
        direction, line = joined
        legs.append(Leg(circle.radius, circle.turn(heading, direction), line))
        points += [circle.point(direction), following.point(direction)]
        heading = direction
    legs.append(Leg(circles[-1].radius, circles[-1].turn(heading, last_heading), 0.0))
    if any(abs(leg.turn) > MAX_ARC_RAD for leg in legs) or any(abs(leg.turn) > math.pi for leg in legs[1:-1]):
        return None
    return Route(tuple(legs), tuple(points))


def around(first: Circle, last: Circle, ring: TurnPolygon, side: int) -> Optional[List[Circle]]:
    """Return the circles of a route with the ring to its left (side 1) or right (-1), including first and last."""
    begin = ring.support(first, side)
    back = ring.support(Circle(last.x, last.y, -last.radius), -side)
    if begin is None or back is None:
        return None
    count = len(ring.corners)
    steps = (side * (back - begin)) % count
    corners = [ring.corners[(begin + side * step) % count] for step in range(steps + 1)]
    return [first, *(Circle(x, y, side * ring.radius) for x, y in corners), last]


def moved(pose: Pose2, way: float) -> Pose2:
    """Return the pose moved along its own heading."""
    return pose @ Pose2(way, 0.0, 0.0)


def facing(pose: Pose2, sign: int) -> Pose2:
    """Convert between the robot's pose and the pose in its direction of travel."""
    return pose if sign > 0 else Pose2(pose.x, pose.y, wrap_angle(pose.heading + math.pi))
