"""Heights of the Remote key above ground as heights of its lift above the lower stop."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass

from mtr_description.mounts import KeyMount

from . import problems
from .calibration import RequestRefused

# Rounding of a height that was sent as a 32-bit float.
HEIGHT_ROUNDING_M = 1e-3


@dataclass(frozen=True)
class KeyLift:
    """The lift that carries the key.

    Attributes:
        key: where the key hangs, as the URDF has it.
    """

    key: KeyMount

    def key_height_m(self, lift_height_m: float) -> float:
        """Height of the key above ground."""
        return self.key.min_height_m + lift_height_m

    def height_m(self, key_height_m: float) -> float:
        """Height of the lift for a height of the key; NaN asks to hold still. Raises RequestRefused."""
        if math.isnan(key_height_m):
            return math.nan
        low, high = self.key.min_height_m, self.key.max_height_m
        if not low - HEIGHT_ROUNDING_M <= key_height_m <= high + HEIGHT_ROUNDING_M:
            raise RequestRefused(problems.KEY_HEIGHT(value=key_height_m, low=low, high=high))
        return self.within_travel_m(key_height_m - low)

    def within_travel_m(self, height_m: float) -> float:
        """The height of the lift nearest to that one."""
        return min(max(height_m, 0.0), self.key.lift_travel_m)
