"""Axes of the Autolock scenario: orthogonal to the Car's sides and diagonal from its corners."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..robot_status import CarDimensions
from .ray import Ray

_DIAGONAL = math.sqrt(0.5)


@dataclass(frozen=True)
class Axis:
    """One measurement: number counts from 1, side is a side ("left") or a corner ("front_left") of the Car."""

    number: int
    side: str
    ray: Ray


def axes_around(car: CarDimensions, spacing_m: float) -> list[Axis]:
    """Return all axes of all sides and corners, clockwise from the front side's left end: one round for the robot.

    A side has an axis at its centre, and axes at multiples of the spacing within the Car.
    """
    half_length, half_width = car.length / 2.0, car.width / 2.0
    across, along = _offsets(half_width, spacing_m), _offsets(half_length, spacing_m)
    places = [("front", Ray(half_length, -offset, 1.0, 0.0)) for offset in across]
    places.append(("front_right", _corner(half_length, -half_width)))
    places += [("right", Ray(-offset, -half_width, 0.0, -1.0)) for offset in along]
    places.append(("rear_right", _corner(-half_length, -half_width)))
    places += [("rear", Ray(-half_length, offset, -1.0, 0.0)) for offset in across]
    places.append(("rear_left", _corner(-half_length, half_width)))
    places += [("left", Ray(offset, half_width, 0.0, 1.0)) for offset in along]
    places.append(("front_left", _corner(half_length, half_width)))
    return [Axis(number, side, ray) for number, (side, ray) in enumerate(places, start=1)]


def _offsets(half_m: float, spacing_m: float) -> list[float]:
    steps = math.floor(half_m / spacing_m)
    return [step * spacing_m for step in range(-steps, steps + 1)]


def _corner(x: float, y: float) -> Ray:
    return Ray(x, y, math.copysign(_DIAGONAL, x), math.copysign(_DIAGONAL, y))
