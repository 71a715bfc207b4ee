"""What people see of the Car locator in rviz, as plain shapes in map."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from dataclasses import dataclass
from typing import Iterator, List, Sequence, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from .estimate import Estimate
from .surfels import Surfels

Point = Tuple[float, float]
Colour = Tuple[float, float, float, float]

GREEN: Colour = (0.1, 0.8, 0.2, 1.0)
ORANGE: Colour = (1.0, 0.6, 0.0, 1.0)
FAINT_GREEN: Colour = (0.1, 0.8, 0.2, 0.35)
CYAN: Colour = (0.0, 0.8, 0.9, 1.0)
VIOLET: Colour = (0.7, 0.3, 1.0, 0.9)
LINE_M, THIN_M, PLACE_M = 0.04, 0.015, 0.15
# Uncertainty is shown as 95 % of a normal distribution.
BAND_SIGMAS = 2.0
ELLIPSE_CORNERS = 24


class Kind(enum.Enum):
    """How the points of a shape are drawn."""

    LOOP = "loop"            # closed line
    SEGMENTS = "segments"    # a line for each pair of points
    ARROW = "arrow"          # from the first point to the second
    DOTS = "dots"


@dataclass(frozen=True)
class Shape:
    """One marker; points in map, size_m is the width of a line or of a dot."""

    name: str
    kind: Kind
    colour: Colour
    size_m: float
    points: Tuple[Point, ...]


def shapes_of(estimate: Estimate) -> List[Shape]:
    """Outline with its uncertainty, front, surfels and places."""
    shapes = [*_outline(estimate), *_front(estimate)]
    if estimate.places:
        shapes.append(Shape("places", Kind.DOTS, VIOLET, PLACE_M, tuple((at.x, at.y) for at in estimate.places)))
    if estimate.fit:
        shapes += [*_band(estimate), _surfels(estimate.rectangle.pose, estimate.fit.surfels), _ellipse(estimate)]
    return shapes


def _outline(estimate: Estimate) -> Iterator[Shape]:
    if estimate.outline:
        colour = GREEN if estimate.state == CarState.LOCATED else ORANGE
        yield Shape("outline", Kind.LOOP, colour, LINE_M, _in_map(estimate.rectangle.pose, estimate.outline))


def _front(estimate: Estimate) -> Iterator[Shape]:
    car = estimate.rectangle
    if car.length > 0.0:
        colour = GREEN if estimate.state == CarState.LOCATED else ORANGE
        points = _in_map(car.pose, [(0.0, 0.0), (0.5 * car.length, 0.0)])
        yield Shape("front", Kind.ARROW, colour, LINE_M, points)


def _band(estimate: Estimate) -> Iterator[Shape]:
    """Outlines of a Car that is larger, and smaller, by 2 sigma of its dimensions and of its centre."""
    car = estimate.rectangle
    x = BAND_SIGMAS * math.hypot(estimate.sigmas[0], 0.5 * estimate.length_sigma)
    y = BAND_SIGMAS * math.hypot(estimate.sigmas[1], 0.5 * estimate.width_sigma)
    for name, sign in (("outer", 1.0), ("inner", -1.0)):
        along, across = 1.0 + sign * x / (0.5 * car.length), 1.0 + sign * y / (0.5 * car.width)
        points = [(along * a, across * b) for a, b in estimate.outline]
        yield Shape(name, Kind.LOOP, FAINT_GREEN, THIN_M, _in_map(car.pose, points))


def _surfels(car: Pose2, surfels: Surfels) -> Shape:
    ends = surfels.ends()
    half = len(ends) // 2
    points = [tuple(point) for pair in zip(ends[:half], ends[half:]) for point in pair]
    return Shape("surfels", Kind.SEGMENTS, CYAN, THIN_M, _in_map(car, points))


def _ellipse(estimate: Estimate) -> Shape:
    """95 % of the Car's centre."""
    x, y, _ = (BAND_SIGMAS * sigma for sigma in estimate.sigmas)
    angles = [2.0 * math.pi * corner / ELLIPSE_CORNERS for corner in range(ELLIPSE_CORNERS)]
    points = [(x * math.cos(angle), y * math.sin(angle)) for angle in angles]
    return Shape("centre", Kind.LOOP, GREEN, THIN_M, _in_map(estimate.rectangle.pose, points))


def _in_map(car: Pose2, points: Sequence[Point]) -> Tuple[Point, ...]:
    return tuple(car.apply(x, y) for x, y in points)
