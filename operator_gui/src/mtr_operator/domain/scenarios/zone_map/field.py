"""The field around the Car from the results of zones, and what it says of a zone and of the map's outlines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from ...actions.distance import distance_to_outline
from ...estimation.field.prior import FieldPrior
from ...estimation.field.zone_search import ZoneSearch
from ...estimation.interval import SIGMAS_OF_LEVEL, FloatArray
from ...geometry.ray import Ray
from ...robot_status import CarDimensions
from .parameters import ZoneMapParameters
from .result import ZoneMapResult
from .zones import Zone, areas_m2, row, rows

_FINE_M = 0.05


def search_in(zone: Zone, parameters: ZoneMapParameters, car: CarDimensions,
              results: Sequence[ZoneMapResult]) -> ZoneSearch:
    """Search that knows what was pressed in the other zones."""
    search = ZoneSearch(prior_of(parameters), rows(zone, car), areas_m2(zone, parameters))
    recall(search, [result for result in results if result.zone != zone.number and not result.is_silent], car)
    return search


def prior_of(parameters: ZoneMapParameters) -> FieldPrior:
    """What is taken of the field in the map before it is measured."""
    return FieldPrior(parameters.half_wavelength_m, parameters.minimum_distance_m, parameters.maximum_distance_m)


def recall(search: ZoneSearch, results: Sequence[ZoneMapResult], car: CarDimensions) -> None:
    """Take the presses of zones."""
    centre = Ray(0.0, 0.0, 1.0, 0.0)
    for result in results:
        for places, worked in ((result.worked, True), (result.failed, False)):
            for x, y in places:
                radius_m = math.hypot(x, y)
                ray = Ray(0.0, 0.0, x / radius_m, y / radius_m) if radius_m > 0.0 else centre
                gap_m = distance_to_outline(ray, radius_m, car)
                search.recall(np.array([x, y, result.height_m, gap_m]), worked)


def boundaries(search: ZoneSearch, ray: Ray, height_m: float, parameters: ZoneMapParameters,
               car: CarDimensions) -> tuple[float | None, float | None, float | None]:
    """Distance on a ray at which half of the presses work, and the ends of its 95 % interval.

    None: nearer than the nearest place, or for the upper end and the distance farther than the farthest one.
    """
    distances_m = np.arange(parameters.minimum_distance_m, parameters.maximum_distance_m + _FINE_M / 2.0, _FINE_M)
    places = np.array([row(ray, float(distance_m), height_m, car) for distance_m in distances_m])
    sure, middle, possible = (search.boundary(places, distances_m, sigmas)
                              for sigmas in (SIGMAS_OF_LEVEL, 0.0, -SIGMAS_OF_LEVEL))
    last_m = float(distances_m[-1])
    if math.isnan(possible):
        return None, None, parameters.minimum_distance_m
    return (None if math.isnan(middle) or middle >= last_m else middle, None if math.isnan(sure) else sure,
            None if possible >= last_m else possible)


def ends_on(search: ZoneSearch, ray: Ray, parameters: ZoneMapParameters,
            car: CarDimensions) -> tuple[float, float, float]:
    """Distances that are covered for sure at every height, probably at every height, and possibly at any; the
    nearest place where there is none, the farthest where there is no end."""
    found = [boundaries(search, ray, height_m, parameters, car) for height_m in parameters.heights_m]
    low_m, far_m = parameters.minimum_distance_m, parameters.maximum_distance_m
    return (min(low_m if sure is None else sure for _, sure, _ in found),
            min(_or(middle, low_m if sure is None else far_m) for middle, sure, _ in found),
            max(far_m if possible is None else possible for _, _, possible in found))


def _or(value: float | None, otherwise: float) -> float:
    return otherwise if value is None else value


def place_array(ray: Ray, distance_m: float, height_m: float, car: CarDimensions) -> FloatArray:
    """One place as the field takes it."""
    return np.array(row(ray, distance_m, height_m, car))
