"""Shortest way around a convex zone."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, Sequence

from shapely.geometry import LineString, MultiPoint, Point
from shapely.ops import nearest_points

from mtr_core.se2 import Pose2

from .inputs import Point as XY
from .obstacle import CarObstacle


def length_of(points: Sequence[XY]) -> float:
    """Length of a polyline."""
    return sum(math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:]))


def route_between(start: Pose2, end: Pose2, obstacle: CarObstacle) -> List[XY]:
    """Polyline from start to end around the Car; both must lie where the robot may turn."""
    first, last = (start.x, start.y), (end.x, end.y)
    if obstacle.lets_pass([first, last]) and not obstacle.blocks_route([first, last]):
        return [first, last]
    entry, leave = _out_of(first, obstacle.route_zone), _out_of(last, obstacle.route_zone)
    around = [entry, leave] if not obstacle.blocks_route([entry, leave]) else _around(entry, leave, obstacle)
    points = [first, *around, last]
    return _without_detours([p for i, p in enumerate(points) if i == 0 or p != points[i - 1]], obstacle)


def _out_of(point: XY, zone) -> XY:
    """The point itself, or the nearest one on the zone's edge when it lies inside."""
    if not zone.contains(Point(point)):
        return point
    on_edge = nearest_points(zone.exterior, Point(point))[0]
    return on_edge.x, on_edge.y


def _around(start: XY, end: XY, obstacle: CarObstacle) -> List[XY]:
    """Shortest way between two points outside a convex zone whose connection crosses it.

    Both are corners of the common convex hull then, and the visibility graph has just two ways: the hull's two sides.
    """
    corners = list(obstacle.route_zone.exterior.coords)[:-1]
    hull = MultiPoint([*corners, start, end]).convex_hull
    ring = list(hull.exterior.coords)[:-1]
    i, j = _index_of(ring, start), _index_of(ring, end)
    ahead = [ring[(i + k) % len(ring)] for k in range((j - i) % len(ring) + 1)]
    back = [ring[(i - k) % len(ring)] for k in range((i - j) % len(ring) + 1)]
    shorter = min(ahead, back, key=length_of)
    return [start, *shorter[1:-1], end]


def _index_of(ring: Sequence[XY], point: XY) -> int:
    return min(range(len(ring)), key=lambda k: math.hypot(ring[k][0] - point[0], ring[k][1] - point[1]))


def _without_detours(points: List[XY], obstacle: CarObstacle) -> List[XY]:
    """Drop the second and the last but one point where the robot can as well go straight."""
    while len(points) > 2 and obstacle.lets_pass([points[0], points[2]]) and _is_near(points[0], points[1]):
        del points[1]
    while len(points) > 2 and obstacle.lets_pass([points[-3], points[-1]]) and _is_near(points[-2], points[-1]):
        del points[-2]
    return points


def _is_near(a: XY, b: XY, limit_m: float = 0.3) -> bool:
    return LineString([a, b]).length < limit_m
