"""Distances from a polygon."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from .pose import Point


def distance_to_polygon(point: Point, corners: Sequence[Point]) -> float:
    """Return the shortest distance in m from a convex polygon with counterclockwise corners; 0 inside and on it."""
    edges = list(zip(corners, [*corners[1:], *corners[:1]]))
    if all(_is_left(point, start, end) for start, end in edges):
        return 0.0
    return min(_to_edge(point, start, end) for start, end in edges)


def _is_left(point: Point, start: Point, end: Point) -> bool:
    return (end[0] - start[0]) * (point[1] - start[1]) >= (end[1] - start[1]) * (point[0] - start[0])


def _to_edge(point: Point, start: Point, end: Point) -> float:
    along_x, along_y = end[0] - start[0], end[1] - start[1]
    squared = along_x ** 2 + along_y ** 2
    share = ((point[0] - start[0]) * along_x + (point[1] - start[1]) * along_y) / squared if squared else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.dist(point, (start[0] + share * along_x, start[1] + share * along_y))
