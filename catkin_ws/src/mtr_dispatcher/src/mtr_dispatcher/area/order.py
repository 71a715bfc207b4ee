"""A requested test area, and the checks that reject it."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple

from mtr_core.errors import ConfigurationError
from mtr_core.problems import NO_PROBLEM, Problem

from .. import problems
from .polygons import Point, area_m2, is_simple

MIN_CORNERS, MAX_CORNERS = 3, 64
# A test area is some ten metres across; a corner beyond this distance is a mistake of units or sign.
MAX_CORNER_M = 100.0
# The robot alone needs 0.3 m2, a path around the smallest car 25 m2; 1 ha is a whole site.
SMALLEST_M2, LARGEST_M2 = 4.0, 10_000.0
# Two corners at the same place are a double click.
SHORTEST_EDGE_M = 0.01


@dataclass(frozen=True)
class AreaOrder:
    """A test area as sent by an application: x and y in m in map; without corners it withdraws the area.

    Attributes:
        id: unique within the session; a new id is a new area.
        origin_id: origin of map that the robot reported when the area was drawn.
    """

    id: int = 0
    origin_id: int = 0
    x: Tuple[float, ...] = ()
    y: Tuple[float, ...] = ()


def order_problem(order: Optional[AreaOrder]) -> Problem:
    """Return why the area is refused; no problem if it is acceptable or withdraws the area."""
    if order is None:
        return NO_PROBLEM
    if order.id == 0:
        return problems.AREA_WITHOUT_ID()
    if len(order.x) != len(order.y):
        return problems.AREA_NOT_PAIRS(id=order.id, x_count=len(order.x), y_count=len(order.y))
    return corners_problem(order.id, tuple(zip(order.x, order.y))) if order.x else NO_PROBLEM


def corners_problem(area_id: int, corners: Sequence[Point]) -> Problem:
    if not MIN_CORNERS <= len(corners) <= MAX_CORNERS:
        return problems.AREA_CORNERS(id=area_id, count=len(corners), low=MIN_CORNERS, high=MAX_CORNERS)
    for value in (value for corner in corners for value in corner):
        # NaN is out of any range.
        if not abs(value) <= MAX_CORNER_M:
            return problems.AREA_COORDINATE(id=area_id, value=value, high=MAX_CORNER_M)
    if min(math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(corners, [*corners[1:], corners[0]])) < SHORTEST_EDGE_M:
        return problems.AREA_EDGE(id=area_id, low=SHORTEST_EDGE_M)
    if not is_simple(corners):
        return problems.AREA_CROSSED(id=area_id)
    size = area_m2(corners)
    if not SMALLEST_M2 <= size <= LARGEST_M2:
        return problems.AREA_SIZE(id=area_id, value=size, low=SMALLEST_M2, high=LARGEST_M2)
    return NO_PROBLEM


def corners_from(numbers: Sequence[float]) -> Tuple[Point, ...]:
    """Return the corners of a launch file's x, y, x, y, ...; ConfigurationError if they are not an acceptable area."""
    corners = tuple((float(x), float(y)) for x, y in zip(numbers[::2], numbers[1::2]))
    if len(numbers) % 2:
        raise ConfigurationError(f"Parameter test_area_xy has {len(numbers)} numbers; it must list x and y of each "
                                 "corner.")
    problem = corners_problem(0, corners) if corners else NO_PROBLEM
    if problem:
        raise ConfigurationError(f"Parameter test_area_xy: {problem.text}")
    return corners
