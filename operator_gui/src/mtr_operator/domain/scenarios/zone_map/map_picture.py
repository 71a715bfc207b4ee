"""What the protocol shows of a zone map: presses, and the outlines of what is covered for sure, probably, possibly."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

import numpy as np

from ...estimation.field.zone_search import ZoneSearch
from ...geometry.radials import radials_around
from ...results.line_result import LineStatus
from ...results.picture import Picture, PointRole, PointSet, Stretch
from ...robot_status import CarDimensions
from .field import ends_on, prior_of, recall
from .parameters import ZoneMapParameters
from .result import ZoneMapResult
from .zones import from_outline, zones_around


def picture_of(parameters: ZoneMapParameters, car: CarDimensions, results: Sequence[ZoneMapResult]) -> Picture:
    """With several heights: what is covered at every one, and what may be at any."""
    middles = {zone.number: zone.ray for zone in zones_around(parameters, car)}
    stretches = tuple(Stretch(middles[result.zone].point(parameters.minimum_distance_m),
                              middles[result.zone].point(parameters.maximum_distance_m), str(result.zone))
                      for result in results)
    invalid = tuple(middles[result.zone].point(parameters.maximum_distance_m) for result in results
                    if result.status is LineStatus.INVALID)
    return Picture(stretches, (
        *_outlines(parameters, car, [result for result in results if result.status is not LineStatus.INVALID]),
        PointSet("Press worked", PointRole.FIRST, tuple(point for result in results for point in result.worked)),
        PointSet("Press failed", PointRole.FAILED, tuple(point for result in results for point in result.failed)),
        PointSet("Invalid", PointRole.INVALID, invalid)))


def _outlines(parameters: ZoneMapParameters, car: CarDimensions,
              results: Sequence[ZoneMapResult]) -> tuple[PointSet, ...]:
    """On each radial in a measured zone."""
    search = ZoneSearch(prior_of(parameters), np.zeros((0, 4)), np.zeros(0))
    recall(search, results, car)
    sides = {result.side for result in results}
    rays = [from_outline(radial.ray, car) for radial in radials_around(parameters.angle_between_radials_rad)]
    measured = [ray for zone in zones_around(parameters, car)[:8] if zone.side in sides
                for ray in rays if ray in {place.ray for place in zone.places}]
    ends = {ray: ends_on(search, ray, parameters, car) for ray in measured}
    points = [tuple(ray.point(ends[ray][index]) if ray in ends else None for ray in rays) for index in range(3)]
    return (PointSet("Covered for sure", PointRole.SECOND, points[0], is_outline=True),
            PointSet("Half of the presses work", PointRole.FIRST_FAILED, points[1], is_outline=True),
            PointSet("Covered perhaps", PointRole.SECOND_FAILED, points[2], is_outline=True))
