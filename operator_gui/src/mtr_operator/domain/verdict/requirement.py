"""Entry of a limits file: a limit for a distance, and its lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..geometry.ray import Ray

# Keys of a limits file with a limit, and their units; the keys of distances are first.
AT_LEAST_M, AT_MOST_M, AT_LEAST_S, AT_MOST_S = "at_least_m", "at_most_m", "at_least_s", "at_most_s"
AT_MOST_ERROR_M, AT_MOST_PERCENT = "at_most_error_m", "at_most_percent"
UNITS = {AT_LEAST_M: "m", AT_MOST_M: "m", AT_LEAST_S: "s", AT_MOST_S: "s", AT_MOST_ERROR_M: "m", AT_MOST_PERCENT: "%"}
OF_DISTANCES = (AT_LEAST_M, AT_MOST_M)
_AT_LEAST = (AT_LEAST_M, AT_LEAST_S)
# Sides and corners clockwise from the Car's front, each at the centre of an eighth of the circle.
SIDES = ("front", "front_right", "right", "rear_right", "rear", "rear_left", "left", "front_left")
_FULL_DEG = 360.0
_SIDE_DEG = _FULL_DEG / len(SIDES)
# Tolerance for rounded radians: a radial of 45 degrees must lie at 45 degrees.
_ROUNDING_DEG = 1e-6


def clockwise_deg(ray: Ray) -> float:
    """Return the direction of a line in degrees clockwise from the Car's front, from 0 to below 360."""
    return round(math.degrees(-math.atan2(ray.direction_y, ray.direction_x)), 6) % _FULL_DEG


def side_of(ray: Ray) -> str:
    """Return the side or corner of the Car in the direction of a line."""
    return SIDES[round(clockwise_deg(ray) / _SIDE_DEG) % len(SIDES)]


@dataclass(frozen=True)
class Requirement:
    """Requirement on a distance, or on another quantity, on certain lines.

    Attributes:
        name: for a person.
        what: distance of a line, from the scenario's distance_words, or the word of a quantity.
        at_least_m, at_most_m, at_least_s, at_most_s, at_most_error_m, at_most_percent: the limit; all but one are None.
        share_percent: the limit is for the distance at which this share of the attempts works.
        sides: of the Car, as in SIDES; empty for all.
        angles_deg: from and to, clockwise from the Car's front, ends included, through 0 if from is larger; None for
            all.
    """

    name: str
    what: str
    at_least_m: float | None
    at_most_m: float | None
    share_percent: int = 50
    sides: tuple[str, ...] = ()
    angles_deg: tuple[float, float] | None = None
    at_least_s: float | None = None
    at_most_s: float | None = None
    at_most_error_m: float | None = None
    at_most_percent: float | None = None

    @property
    def key(self) -> str:
        """Key of the limit."""
        return next(key for key in UNITS if getattr(self, key) is not None)

    @property
    def limit(self) -> float:
        """Limit, in its unit."""
        return float(getattr(self, self.key))

    @property
    def unit(self) -> str:
        """Unit of the limit."""
        return UNITS[self.key]

    @property
    def is_at_least(self) -> bool:
        """False for an upper limit."""
        return self.key in _AT_LEAST

    @property
    def is_of_distance(self) -> bool:
        """False for another quantity, which has no share of attempts."""
        return self.key in OF_DISTANCES

    @property
    def text(self) -> str:
        """Return a text such as "unlock at least 1.2 m for 50 % of the attempts", or "sleep_time at most 120 s"."""
        bound = "at least" if self.is_at_least else "at most"
        share = f" for {self.share_percent} % of the attempts" if self.is_of_distance else ""
        return f"{self.what} {bound} {self.limit:g} {self.unit}{share}"

    def names(self, ray: Ray) -> bool:
        """Return True for a line of this requirement."""
        return (not self.sides or side_of(ray) in self.sides) and self._has_angle(clockwise_deg(ray))

    def _has_angle(self, angle_deg: float) -> bool:
        if self.angles_deg is None:
            return True
        first, last = self.angles_deg
        width_deg = _FULL_DEG if last - first >= _FULL_DEG else (last - first) % _FULL_DEG
        beyond_deg = (angle_deg - first + _ROUNDING_DEG) % _FULL_DEG
        return beyond_deg <= width_deg + 2.0 * _ROUNDING_DEG
