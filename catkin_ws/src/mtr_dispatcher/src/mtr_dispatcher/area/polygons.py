"""Polygons in the plane: area, and self-intersection of the border."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import Iterable, Sequence, Tuple

Point = Tuple[float, float]


def area_m2(corners: Sequence[Point]) -> float:
    """Return the area of a simple polygon of either orientation, m2."""
    return 0.5 * abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in _edges(corners)))


def is_simple(corners: Sequence[Point]) -> bool:
    """Return True for at least 3 corners whose edges have a length and meet only at common corners."""
    edges = list(_edges(corners))
    if len(edges) < 3 or any(a == b for a, b in edges):
        return False
    last = len(edges) - 1
    for (i, one), (j, other) in itertools.combinations(enumerate(edges), 2):
        if j == i + 1:
            common_is_all = not _is_spike(one, other)
        elif (i, j) == (0, last):
            common_is_all = not _is_spike(other, one)
        else:
            common_is_all = not _meet(one, other)
        if not common_is_all:
            return False
    return True


def _edges(corners: Sequence[Point]) -> Iterable[Tuple[Point, Point]]:
    return zip(corners, [*corners[1:], *corners[:1]])


def _turn(a: Point, b: Point, c: Point) -> float:
    """Return a positive number for a turn to the left at b, a negative one to the right, 0 for none."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_spike(one: Tuple[Point, Point], other: Tuple[Point, Point]) -> bool:
    """Return True if an edge goes back along the previous one."""
    (a, b), (_, c) = one, other
    back = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])
    return _turn(a, b, c) == 0.0 and back < 0.0


def _meet(one: Tuple[Point, Point], other: Tuple[Point, Point]) -> bool:
    a, b = one
    c, d = other
    turns = _turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b)
    if turns[0] * turns[1] < 0.0 and turns[2] * turns[3] < 0.0:
        return True
    ends = ((turns[0], a, b, c), (turns[1], a, b, d), (turns[2], c, d, a), (turns[3], c, d, b))
    return any(turn == 0.0 and _is_within(start, end, point) for turn, start, end, point in ends)


def _is_within(start: Point, end: Point, point: Point) -> bool:
    return (min(start[0], end[0]) <= point[0] <= max(start[0], end[0])
            and min(start[1], end[1]) <= point[1] <= max(start[1], end[1]))
