"""Places around the Car at which the phone's distance is read, and what it is compared with there."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Callable

from ...actions.distance import Distance, distance_to_outline
from ...actions.trouble import LineInvalid
from ...geometry.outline import NO_ERROR, OriginError, origin_error
from ...geometry.pose import Point
from ...geometry.radials import radials_around
from ...geometry.ray import Ray
from ...robot_status import CarDimensions
from ...verdict.requirement import side_of
from ..zone_map.zones import from_outline
from .parameters import ANCHOR, DigitalKeyParameters

# Distance of the Remote key on a ray at an instant of robot time, with the error of the ray's origin.
KeyDistance = Callable[[Ray, float, OriginError], Distance]
# The lift tells its height by counted steps; what the mast bends is in the calibration record.
_HEIGHT_SIGMA_M = 0.01
_NEAREST_M = 1e-6


@dataclass(frozen=True)
class MapPlace:
    """Number counts from 1; side of the Car; distance_m on a ray that begins at the Car's outline."""

    number: int
    side: str
    ray: Ray
    distance_m: float


def places_around(parameters: DigitalKeyParameters, car: CarDimensions) -> list[MapPlace]:
    """Clockwise from the front, inwards on one radial and outwards on the next, so that ways are short."""
    places: list[MapPlace] = []
    outwards = parameters.distances_m
    for radial in radials_around(parameters.angle_between_radials_rad):
        ray = from_outline(radial.ray, car)
        outwards = outwards[::-1]
        places += [MapPlace(0, side_of(ray), ray, distance_m) for distance_m in outwards
                   if distance_to_outline(ray, distance_m, car) >= parameters.clearance_m]
    return [replace(place, number=number) for number, place in enumerate(places, start=1)]


def key_point(ray: Ray, made: Distance) -> Point:
    """Where the key was, from its distance on a ray and that beside it."""
    x, y = ray.point(made.distance_m)
    return x - made.lateral_m * ray.direction_y, y + made.lateral_m * ray.direction_x


def reference_of(made: Distance, ray: Ray, parameters: DigitalKeyParameters, car: CarDimensions,
                 key_distance: KeyDistance) -> Distance:
    """The robot's distance of the phone from the reference at the same instant, with 1 sigma.

    made: on the place's ray. LineInvalid when the phone is at the reference itself, where there is no direction.
    """
    point = key_point(ray, made)
    if parameters.reference == ANCHOR:
        to_key = _ray((parameters.anchor_x_m, parameters.anchor_y_m), point)
        return _aslant(key_distance(to_key, made.robot_time_s, NO_ERROR), parameters)
    to_key = _ray(_nearest_of_outline(point, car), point)
    return key_distance(to_key, made.robot_time_s, origin_error(to_key, car))


def _aslant(flat: Distance, parameters: DigitalKeyParameters) -> Distance:
    """With the difference in height."""
    rise_m = flat.key_height_m - parameters.anchor_height_m
    straight_m = math.hypot(flat.distance_m, rise_m)
    sigma_m = math.hypot(flat.distance_m * flat.uncertainty_m, rise_m * _HEIGHT_SIGMA_M) / straight_m
    return replace(flat, distance_m=straight_m, uncertainty_m=sigma_m)


def _ray(start: Point, end: Point) -> Ray:
    length_m = math.dist(start, end)
    if length_m < _NEAREST_M:
        raise LineInvalid("The phone is at the reference itself.")
    return Ray(*start, (end[0] - start[0]) / length_m, (end[1] - start[1]) / length_m)


def _nearest_of_outline(point: Point, car: CarDimensions) -> Point:
    half_length, half_width = car.length / 2.0, car.width / 2.0
    return min(max(point[0], -half_length), half_length), min(max(point[1], -half_width), half_width)
