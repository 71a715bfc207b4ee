"""What the protocol of Handle request shows: the border with its interval, and every decision."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...geometry.pose import Point
from ...results.figure import figure_of
from ...results.line_result import LineStatus
from ...results.picture import Picture, PointRole, PointSet, Stretch, bars_along, intervals_along
from ...robot_status import CarDimensions
from ..line_search.open_borders import open_borders
from .axis_trial import axes_of
from .parameters import HandleRequestParameters
from .result import HandleRequestResult


def picture_of(parameters: HandleRequestParameters, car: CarDimensions,
               results: Sequence[HandleRequestResult]) -> Picture:
    """Of all heights, one upon the other."""
    rays = {axis.number: axis.ray for axis in axes_of(parameters, car)}
    measured = [(rays[result.axis], result) for result in results]
    near_m, far_m = parameters.minimum_distance_m, parameters.maximum_distance_m
    stretches = tuple(Stretch(ray.point(near_m), ray.point(far_m), str(result.axis)) for ray, result in measured)

    def points(places: str) -> tuple[Point, ...]:
        return tuple(ray.point(place_m) for ray, result in measured for place_m in getattr(result, places))

    half = [(ray, result.distances[0]) for ray, result in measured]
    border = tuple(ray.point(distance.distance_m) for ray, distance in half if distance.distance_m is not None)
    invalid = tuple(ray.point(far_m) for ray, result in measured if result.status is LineStatus.INVALID)
    return Picture(stretches, (
        PointSet("Border: half of the requests inside", PointRole.FIRST, border, bars=bars_along(half),
                 intervals=intervals_along(half),
                 figures=tuple(figure_of(distance) for _, distance in half if distance.distance_m is not None)),
        PointSet("Inside", PointRole.SECOND, points("worked_at_m")),
        PointSet("Outside", PointRole.FAILED, points("failed_at_m")),
        *open_borders(measured, near_m, parameters.farthest_m),
        PointSet("Invalid", PointRole.INVALID, invalid)))
