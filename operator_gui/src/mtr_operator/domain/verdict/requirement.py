"""One entry of a limits file: what a distance has to be, on which lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..geometry.ray import Ray

# Sides and corners clockwise from the Car's front, each the middle of an eighth of the circle.
SIDES = ("front", "front_right", "right", "rear_right", "rear", "rear_left", "left", "front_left")
_FULL_DEG = 360.0
_SIDE_DEG = _FULL_DEG / len(SIDES)
# A radial of 45 degrees lies at 45 degrees, whatever the rounding of radians says.
_ROUNDING_DEG = 1e-6


def clockwise_deg(ray: Ray) -> float:
    """Direction of a line in degrees clockwise from the Car's front, from 0 to below 360."""
    return round(math.degrees(-math.atan2(ray.direction_y, ray.direction_x)), 6) % _FULL_DEG


def side_of(ray: Ray) -> str:
    """The side or corner of the Car to which a line leads away."""
    return SIDES[round(clockwise_deg(ray) / _SIDE_DEG) % len(SIDES)]


@dataclass(frozen=True)
class Requirement:
    """What has to be true of a distance on the lines that it names.

    Attributes:
        name: for a person.
        what: which distance of a line, of the scenario's distance_words.
        at_least_m, at_most_m: the limit; one of them is None.
        share_percent: the limit is for the distance at which this share of the attempts works.
        sides: of the Car, as in SIDES; empty for all.
        angles_deg: from and to, clockwise from the Car's front, ends included, through 0 when from is larger; None
            for all.
    """

    name: str
    what: str
    at_least_m: float | None
    at_most_m: float | None
    share_percent: int = 50
    sides: tuple[str, ...] = ()
    angles_deg: tuple[float, float] | None = None

    @property
    def limit_m(self) -> float:
        """The one of both limits that there is."""
        limit_m = self.at_least_m if self.at_least_m is not None else self.at_most_m
        if limit_m is None:
            raise ValueError(f"{self.name} has no limit")
        return limit_m

    @property
    def text(self) -> str:
        """Such as "unlock at least 1.2 m for 50 % of the attempts"."""
        bound = "at least" if self.at_least_m is not None else "at most"
        return f"{self.what} {bound} {self.limit_m:g} m for {self.share_percent} % of the attempts"

    def names(self, ray: Ray) -> bool:
        """True for a line that it is about."""
        return (not self.sides or side_of(ray) in self.sides) and self._has_angle(clockwise_deg(ray))

    def _has_angle(self, angle_deg: float) -> bool:
        if self.angles_deg is None:
            return True
        first, last = self.angles_deg
        width_deg = _FULL_DEG if last - first >= _FULL_DEG else (last - first) % _FULL_DEG
        beyond_deg = (angle_deg - first + _ROUNDING_DEG) % _FULL_DEG
        return beyond_deg <= width_deg + 2.0 * _ROUNDING_DEG
