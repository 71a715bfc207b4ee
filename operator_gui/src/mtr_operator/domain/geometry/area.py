"""Corners of a test area: rules of the robot, text form, and an initial rectangle.

They are in the robot's start frame, in which it localizes itself: x ahead at the start, y to the left.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import math
from typing import Iterator, Sequence

from ..errors import InvalidParameter
from .pose import Point, Pose

MIN_CORNERS, MAX_CORNERS = 3, 64
MAX_CORNER_M = 100.0
SMALLEST_M2, LARGEST_M2 = 4.0, 10_000.0
SHORTEST_EDGE_M = 0.01


def check_corners(corners: Sequence[Point]) -> None:
    """Raise InvalidParameter with a sentence unless the robot accepts the area."""
    if not MIN_CORNERS <= len(corners) <= MAX_CORNERS:
        raise InvalidParameter(f"A test area has {len(corners)} corners; the number must be between {MIN_CORNERS} and "
                               f"{MAX_CORNERS}.")
    if not all(abs(value) <= MAX_CORNER_M for value in itertools.chain(*corners)):
        raise InvalidParameter(f"Corners of a test area must be within {MAX_CORNER_M:g} m of where the robot started.")
    if min(math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in edges(corners)) < SHORTEST_EDGE_M:
        raise InvalidParameter("Two neighbouring corners of the test area are at the same place.")
    if crosses_itself(corners):
        raise InvalidParameter("The border of the test area crosses itself.")
    size_m2 = area_m2(corners)
    if not SMALLEST_M2 <= size_m2 <= LARGEST_M2:
        raise InvalidParameter(f"The test area is {size_m2:.1f} m2 large; it must be between {SMALLEST_M2:g} and "
                               f"{LARGEST_M2:g} m2.")


def edges(corners: Sequence[Point]) -> Iterator[tuple[Point, Point]]:
    """Yield the edge from each corner to the next."""
    return zip(corners, [*corners[1:], *corners[:1]])


def area_m2(corners: Sequence[Point]) -> float:
    """Return the area of a simple polygon."""
    return 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges(corners)))


def crosses_itself(corners: Sequence[Point]) -> bool:
    """Return True if two edges meet at a point other than their common corner."""
    sides = list(edges(corners))
    last = len(sides) - 1
    for (i, one), (j, other) in itertools.combinations(enumerate(sides), 2):
        if j == i + 1:
            meets = _goes_back(one, other)
        elif (i, j) == (0, last):
            meets = _goes_back(other, one)
        else:
            meets = _meet(one, other)
        if meets:
            return True
    return False


def rectangle_around(pose: Pose, length_m: float, width_m: float) -> tuple[Point, ...]:
    """Return the corners of a rectangle around the robot, aligned with its heading."""
    x, y = 0.5 * length_m, 0.5 * width_m
    return tuple(pose.apply(corner) for corner in ((x, y), (-x, y), (-x, -y), (x, -y)))


def corners_text(corners: Sequence[Point]) -> str:
    """Return the corners as text for files and records: x y; x y; ..."""
    return "; ".join(f"{x:.2f} {y:.2f}" for x, y in corners)


def corners_from_text(text: str) -> tuple[Point, ...]:
    """Return the corners in a text of corners_text; InvalidParameter states a fault."""
    corners = []
    for part in filter(None, (part.strip() for part in text.split(";"))):
        numbers = part.replace(",", " ").split()
        try:
            x, y = map(float, numbers)
        except ValueError:
            raise InvalidParameter(f"Corner {part!r:.40} of the test area must be two numbers, x and y in m, such as "
                                   "4.0 -2.5.") from None
        corners.append((x, y))
    check_corners(corners)
    return tuple(corners)


def _turn(a: Point, b: Point, c: Point) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _goes_back(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    (a, b), (_, c) = one, other
    return _turn(a, b, c) == 0.0 and (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0


def _meet(one: tuple[Point, Point], other: tuple[Point, Point]) -> bool:
    (a, b), (c, d) = one, other
    turns = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if turns[0] * turns[1] < 0.0 and turns[2] * turns[3] < 0.0:
        return True
    return any(turn == 0.0 and min(start[0], end[0]) <= point[0] <= max(start[0], end[0])
               and min(start[1], end[1]) <= point[1] <= max(start[1], end[1])
               for turn, start, end, point in zip(turns, (a, a, c, c), (b, b, d, d), (c, d, a, b)))
