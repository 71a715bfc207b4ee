"""What a protocol shows, as plain shapes in the Car coordinate system: drawn by report, and by any other view."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Iterator, Sequence

from ..geometry.pose import Point
from ..geometry.ray import Ray
from .figure import Figure
from .line_result import Ends, MeasuredDistance


class PointRole(enum.Enum):
    """Role of a set of points; a view gives each role its colour and marker."""

    FIRST = "first"                    # unlocked, pressed with success, half of the presses work
    SECOND = "second"                  # locked, nearly all presses work
    FIRST_FAILED = "first failed"
    SECOND_FAILED = "second failed"
    FAILED = "failed"                  # where there is only one area
    INVALID = "invalid"
    UNKNOWN = "unknown"                # a guess: nobody knows where


@dataclass(frozen=True)
class Stretch:
    """A straight piece on which the key was carried, with a label at its far end."""

    start: Point
    end: Point
    label: str


@dataclass(frozen=True)
class PointSet:
    """Points with the same meaning.

    is_outline: they enclose an area, in this order; None stands for a line without a point, where the outline is not
    known. bars: 1 sigma to both sides of the points, where it is known and no interval is. intervals: ends of the 95 %
    interval of each point, where both are known. brackets: two places each, between which a border lies that nobody has
    looked for any closer. figures: what is written beside each point, None for nothing; empty where nothing is.
    errors_m: of each point, told by its colour instead of the role's; empty where the points have none.
    """

    label: str
    role: PointRole
    points: tuple[Point | None, ...]
    is_outline: bool = False
    bars: tuple[tuple[Point, Point], ...] = ()
    intervals: tuple[tuple[Point, Point], ...] = ()
    brackets: tuple[tuple[Point, Point], ...] = ()
    figures: tuple[Figure | None, ...] = ()
    errors_m: tuple[float, ...] = ()

    @property
    def known(self) -> tuple[Point, ...]:
        """The points that there are."""
        return tuple(point for point in self.points if point is not None)

    def pieces(self) -> Iterator[tuple[Point, Point, bool]]:
        """Pieces of the closed outline, and whether no unknown point lies between their ends."""
        places = [(index, point) for index, point in enumerate(self.points) if point is not None]
        for (index, point), (after, next_point) in zip(places, places[1:] + places[:1]):
            yield point, next_point, (after - index) % len(self.points) == 1


@dataclass(frozen=True)
class Picture:
    """Everything on the protocol beside the Car."""

    stretches: tuple[Stretch, ...]
    point_sets: tuple[PointSet, ...]


def bars_along(measured: Sequence[tuple[Ray, MeasuredDistance]]) -> tuple[tuple[Point, Point], ...]:
    """Ends of 1 sigma to both sides of each measured point along its ray, unless it has an interval."""
    known = [(ray, distance.distance_m, distance.uncertainty_m) for ray, distance in measured
             if distance.low_m is None or distance.high_m is None]
    return tuple((ray.point(middle_m - sigma_m), ray.point(middle_m + sigma_m)) for ray, middle_m, sigma_m in known
                 if middle_m is not None and sigma_m is not None)


def intervals_along(measured: Sequence[tuple[Ray, MeasuredDistance]]) -> tuple[tuple[Point, Point], ...]:
    """Ends of the interval of each measured point along its ray: the one by which a limit is judged, if that is known
    at both ends, else the 95 % interval."""
    return tuple((ray.point(low_m), ray.point(high_m)) for ray, distance in measured
                 for low_m, high_m in (_drawn_ends(distance),)
                 if distance.distance_m is not None and low_m is not None and high_m is not None)


def _drawn_ends(distance: MeasuredDistance) -> Ends:
    judged = distance.look_m
    return (distance.low_m, distance.high_m) if judged is None or None in judged else judged
