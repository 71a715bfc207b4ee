"""What the protocol shows of a digital key: the error at each place in colours, and where nothing was told."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...geometry.radials import radials_around
from ...results.line_result import LineStatus
from ...results.picture import Picture, PointRole, PointSet, Stretch
from ...robot_status import CarDimensions
from ..zone_map.zones import from_outline
from .parameters import DigitalKeyParameters
from .places import places_around
from .result import DigitalKeyResult


def picture_of(parameters: DigitalKeyParameters, car: CarDimensions, results: Sequence[DigitalKeyResult]) -> Picture:
    """Places that could not be reached or read are told from those at which the phone told nothing."""
    planned = {place.number: place.ray.point(place.distance_m) for place in places_around(parameters, car)}
    at = {each.number: planned[each.number] if each.x_m is None or each.y_m is None else (each.x_m, each.y_m)
          for each in results}
    measured = [(each, each.error_m) for each in results if each.error_m is not None]
    silent = tuple(at[each.number] for each in results if each.is_unanswered)
    invalid = tuple(at[each.number] for each in results
                    if each.status is LineStatus.INVALID and not each.is_unanswered)
    rays = [from_outline(radial.ray, car) for radial in radials_around(parameters.angle_between_radials_rad)]
    stretches = tuple(Stretch(ray.point(parameters.minimum_distance_m), ray.point(parameters.maximum_distance_m), "")
                      for ray in rays) if results else ()
    return Picture(stretches, (
        PointSet("Error", PointRole.FIRST, tuple(at[each.number] for each, _ in measured),
                 errors_m=tuple(error_m for _, error_m in measured)),
        PointSet("No answer", PointRole.FAILED, silent),
        PointSet("Invalid", PointRole.INVALID, invalid)))
