"""Routes of the virtual robot around the Car, and positions along them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Tuple

Point = Tuple[float, float]


@dataclass(frozen=True)
class Box:
    """Keep-out rectangle around the origin; half length along x and half width along y, in m."""

    half_length: float
    half_width: float

    def contains(self, point: Point) -> bool:
        """Return True strictly inside."""
        return abs(point[0]) < self.half_length and abs(point[1]) < self.half_width

    def crosses(self, start: Point, goal: Point) -> bool:
        """Return True if the straight path passes through the inside (slab method)."""
        enter, leave = 0.0, 1.0
        for begin, end, half in ((start[0], goal[0], self.half_length), (start[1], goal[1], self.half_width)):
            delta = end - begin
            if abs(delta) < 1e-9:
                if abs(begin) >= half:
                    return False
                continue
            first, second = sorted(((-half - begin) / delta, (half - begin) / delta))
            enter, leave = max(enter, first), min(leave, second)
        return leave - enter > 1e-9

    def corners(self) -> list[Point]:
        """Return the four corners, counterclockwise."""
        return [(self.half_length, self.half_width), (-self.half_length, self.half_width),
                (-self.half_length, -self.half_width), (self.half_length, -self.half_width)]


def route(start: Point, goal: Point, box: Box) -> list[Point]:
    """Return the points from start to goal, goal included: straight, or around the box on the shorter side."""
    if box.contains(start) or not box.crosses(start, goal):
        return [goal]
    ways = [_around(start, goal, box, turn) for turn in (1, -1)]
    return min(ways, key=lambda way: _length([start, *way]))


def _around(start: Point, goal: Point, box: Box, turn: int) -> list[Point]:
    corners = box.corners()[::turn]
    ahead = [turn * (math.atan2(y, x) - math.atan2(start[1], start[0])) % (2.0 * math.pi) for x, y in corners]
    ordered = [corner for _, corner in sorted(zip(ahead, corners))]
    way: list[Point] = []
    here = start
    for corner in ordered:
        if not box.crosses(here, goal):
            break
        # A corner that can be skipped is a detour.
        if len(way) > 1 and not box.crosses(way[-2], corner):
            way.pop()
        way.append(corner)
        here = corner
    return [*way, goal]


def _length(points: list[Point]) -> float:
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def advance(here: Point, way: list[Point], distance_m: float) -> tuple[Point, list[Point]]:
    """Return the position after distance_m along the path, and the rest of the path."""
    while way:
        step_m = math.dist(here, way[0])
        if step_m > distance_m:
            part = distance_m / step_m
            return (here[0] + part * (way[0][0] - here[0]), here[1] + part * (way[0][1] - here[1])), way
        distance_m -= step_m
        here, way = way[0], way[1:]
    return here, way
