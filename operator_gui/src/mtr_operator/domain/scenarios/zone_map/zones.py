"""Zones around the Car and the places in them at which the button is pressed."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...actions.distance import distance_to_outline
from ...estimation.interval import FloatArray
from ...geometry.radials import radials_around
from ...geometry.ray import Ray
from ...robot_status import CarDimensions
from ...verdict.requirement import SIDES, side_of
from .parameters import ZoneMapParameters

# Smaller components of a direction are rounding.
_PARALLEL = 1e-9


@dataclass(frozen=True)
class Place:
    """On a ray that begins at the Car's outline."""

    ray: Ray
    distance_m: float


@dataclass(frozen=True)
class Zone:
    """A side or corner of the Car at a height: number counts from 1, ray is its middle."""

    number: int
    side: str
    height_m: float
    ray: Ray
    places: tuple[Place, ...]


def zones_around(parameters: ZoneMapParameters, car: CarDimensions) -> list[Zone]:
    """All zones, clockwise from the front, from the lowest height to the highest."""
    rays = [from_outline(radial.ray, car) for radial in radials_around(parameters.angle_between_radials_rad)]
    middles = {side_of(radial.ray): from_outline(radial.ray, car) for radial in radials_around(math.pi / 4.0)}
    zones: list[Zone] = []
    for height_m in parameters.heights_m:
        for side in SIDES:
            places = tuple(Place(ray, distance_m) for ray in rays if side_of(ray) == side
                           for distance_m in parameters.distances_m
                           if distance_to_outline(ray, distance_m, car) >= parameters.clearance_m)
            zones.append(Zone(len(zones) + 1, side, height_m, middles[side], places))
    return zones


def from_outline(radial: Ray, car: CarDimensions) -> Ray:
    """The part of a radial outside the Car's rectangle."""
    sizes = ((car.length, radial.direction_x), (car.width, radial.direction_y))
    along = [size / 2.0 / abs(part) for size, part in sizes if abs(part) > _PARALLEL]
    x, y = radial.point(min(along))
    return Ray(x, y, radial.direction_x, radial.direction_y)


def row(ray: Ray, distance_m: float, height_m: float, car: CarDimensions) -> tuple[float, float, float, float]:
    """A place as the field takes it: x, y, height, gap to the Car's outline."""
    x, y = ray.point(distance_m)
    return x, y, height_m, distance_to_outline(ray, distance_m, car)


def rows(zone: Zone, car: CarDimensions) -> FloatArray:
    """All places of a zone as the field takes them."""
    return np.array([row(place.ray, place.distance_m, zone.height_m, car) for place in zone.places])


def areas_m2(zone: Zone, parameters: ZoneMapParameters) -> FloatArray:
    """What each place of a zone stands for: a piece of a ring."""
    radii_m = np.array([math.hypot(*place.ray.point(place.distance_m)) for place in zone.places])
    return np.asarray(radii_m * parameters.angle_between_radials_rad * parameters.spacing_m)
