"""Converts heights of the Remote key above ground to heights of its lift above the lower stop."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_description.mounts import KeyMount

from . import problems
from .calibration import RequestRefused

# Rounding of a height that was transmitted as a 32-bit float.
HEIGHT_ROUNDING_M = 1e-3


@dataclass(frozen=True)
class KeyLift:
    """The lift that carries the key.

    Attributes:
        key: mounting of the key from the URDF.
    """

    key: KeyMount

    def key_height_m(self, lift_height_m: float) -> float:
        """Return the height of the key above ground, m."""
        return self.key.min_height_m + lift_height_m

    def height_m(self, key_height_m: float) -> float:
        """Return the lift's height for a height of the key; NaN means hold still. Raises RequestRefused."""
        if math.isnan(key_height_m):
            return math.nan
        low, high = self.key.min_height_m, self.key.max_height_m
        if not low - HEIGHT_ROUNDING_M <= key_height_m <= high + HEIGHT_ROUNDING_M:
            raise RequestRefused(problems.KEY_HEIGHT(value=key_height_m, low=low, high=high))
        return self.within_travel_m(key_height_m - low)

    def within_travel_m(self, height_m: float) -> float:
        """Return the nearest height within the lift's travel."""
        return min(max(height_m, 0.0), self.key.lift_travel_m)
