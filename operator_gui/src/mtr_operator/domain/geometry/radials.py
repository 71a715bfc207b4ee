"""Radials of the Key press scenario; the one place where its clockwise angle meets counterclockwise headings."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from .ray import Ray

# A full circle of 45 degree steps has 8 radials, whatever the rounding of radians says.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Radial:
    """One measurement: number counts from 1, the angle grows clockwise from the Car's front."""

    number: int
    clockwise_rad: float
    ray: Ray

    @property
    def clockwise_deg(self) -> float:
        """The angle as a person reads it."""
        return round(math.degrees(self.clockwise_rad), 6)


def radials_around(spacing_rad: float) -> list[Radial]:
    """Radials at multiples of the spacing below a full circle, from the front clockwise."""
    count = math.ceil(2.0 * math.pi / spacing_rad - _ROUNDING)
    return [Radial(step + 1, step * spacing_rad, _ray(step * spacing_rad)) for step in range(count)]


def _ray(clockwise_rad: float) -> Ray:
    counterclockwise_rad = -clockwise_rad
    return Ray(0.0, 0.0, math.cos(counterclockwise_rad), math.sin(counterclockwise_rad))
