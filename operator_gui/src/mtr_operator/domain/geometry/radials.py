"""Radials of the Key press scenario; only here its clockwise angles are converted to counterclockwise headings."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from .ray import Ray

# Tolerance for rounded radians: a full circle of 45 degree steps must have 8 radials.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Radial:
    """One measurement: number counts from 1, the angle grows clockwise from the Car's front."""

    number: int
    clockwise_rad: float
    ray: Ray

    @property
    def clockwise_deg(self) -> float:
        """Angle in degrees, as shown to people."""
        return round(math.degrees(self.clockwise_rad), 6)


def radials_around(spacing_rad: float) -> list[Radial]:
    """Return radials at multiples of the spacing below a full circle, clockwise from the front."""
    count = math.ceil(2.0 * math.pi / spacing_rad - _ROUNDING)
    return [Radial(step + 1, step * spacing_rad, _ray(step * spacing_rad)) for step in range(count)]


def _ray(clockwise_rad: float) -> Ray:
    counterclockwise_rad = -clockwise_rad
    return Ray(0.0, 0.0, math.cos(counterclockwise_rad), math.sin(counterclockwise_rad))
