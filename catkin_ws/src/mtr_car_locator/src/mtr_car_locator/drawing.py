"""Markers of the Car locator for rviz, as plain shapes in map."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from dataclasses import dataclass
from typing import Iterator, List, Sequence, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import CarState

from .estimate import Estimate
from .rectangle import Point
from .surfels import Surfels

Colour = Tuple[float, float, float, float]

GREEN: Colour = (0.1, 0.8, 0.2, 1.0)
ORANGE: Colour = (1.0, 0.6, 0.0, 1.0)
FAINT_GREEN: Colour = (0.1, 0.8, 0.2, 0.35)
CYAN: Colour = (0.0, 0.8, 0.9, 1.0)
VIOLET: Colour = (0.7, 0.3, 1.0, 0.9)
LINE_M, THIN_M, PLACE_M = 0.04, 0.015, 0.15
# Uncertainty is drawn as 95 % of a normal distribution.
BAND_SIGMAS = 2.0
ELLIPSE_CORNERS = 24


class MarkerKind(enum.Enum):
    """Drawing style of the points of a shape."""

    LOOP = "loop"            # closed line
    SEGMENTS = "segments"    # one line per pair of points
    ARROW = "arrow"          # from the first point to the second one
    DOTS = "dots"


@dataclass(frozen=True)
class MarkerShape:
    """One marker; points in map, size_m is the width of a line or of a dot."""

    name: str
    kind: MarkerKind
    colour: Colour
    size_m: float
    points: Tuple[Point, ...]


def shapes_of(estimate: Estimate) -> List[MarkerShape]:
    """Return outline with its uncertainty, front, surfels and places."""
    shapes = [*_outline(estimate), *_front(estimate)]
    if estimate.places:
        places = tuple((at.x, at.y) for at in estimate.places)
        shapes.append(MarkerShape("places", MarkerKind.DOTS, VIOLET, PLACE_M, places))
    if estimate.fit:
        shapes += [*_band(estimate), _surfels(estimate.rectangle.pose, estimate.fit.surfels), _ellipse(estimate)]
    return shapes


def _outline(estimate: Estimate) -> Iterator[MarkerShape]:
    if estimate.outline:
        colour = GREEN if estimate.state == CarState.LOCATED else ORANGE
        points = _in_map(estimate.rectangle.pose, estimate.outline)
        yield MarkerShape("outline", MarkerKind.LOOP, colour, LINE_M, points)


def _front(estimate: Estimate) -> Iterator[MarkerShape]:
    car = estimate.rectangle
    if car.length > 0.0:
        colour = GREEN if estimate.state == CarState.LOCATED else ORANGE
        points = _in_map(car.pose, [(0.0, 0.0), (0.5 * car.length, 0.0)])
        yield MarkerShape("front", MarkerKind.ARROW, colour, LINE_M, points)


def _band(estimate: Estimate) -> Iterator[MarkerShape]:
    """Yield outlines of a Car that is larger and smaller by 2 sigma of its dimensions and of its centre."""
    car = estimate.rectangle
    x = BAND_SIGMAS * math.hypot(estimate.sigmas[0], 0.5 * estimate.length_sigma)
    y = BAND_SIGMAS * math.hypot(estimate.sigmas[1], 0.5 * estimate.width_sigma)
    for name, sign in (("outer", 1.0), ("inner", -1.0)):
        along, across = 1.0 + sign * x / (0.5 * car.length), 1.0 + sign * y / (0.5 * car.width)
        points = [(along * a, across * b) for a, b in estimate.outline]
        yield MarkerShape(name, MarkerKind.LOOP, FAINT_GREEN, THIN_M, _in_map(car.pose, points))


def _surfels(car: Pose2, surfels: Surfels) -> MarkerShape:
    ends = surfels.ends()
    half = len(ends) // 2
    points = [tuple(point) for pair in zip(ends[:half], ends[half:]) for point in pair]
    return MarkerShape("surfels", MarkerKind.SEGMENTS, CYAN, THIN_M, _in_map(car, points))


def _ellipse(estimate: Estimate) -> MarkerShape:
    """Return the 95 % ellipse of the Car's centre."""
    x, y, _ = (BAND_SIGMAS * sigma for sigma in estimate.sigmas)
    angles = [2.0 * math.pi * corner / ELLIPSE_CORNERS for corner in range(ELLIPSE_CORNERS)]
    points = [(x * math.cos(angle), y * math.sin(angle)) for angle in angles]
    return MarkerShape("centre", MarkerKind.LOOP, GREEN, THIN_M, _in_map(estimate.rectangle.pose, points))


def _in_map(car: Pose2, points: Sequence[Point]) -> Tuple[Point, ...]:
    return tuple(car.apply(x, y) for x, y in points)
