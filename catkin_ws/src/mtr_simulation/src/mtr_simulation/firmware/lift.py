"""Lift of the Remote key: moves to a height with a trapezoidal speed profile."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional

HEIGHT_LIMIT_M = 1.2  # stroke of the lift
SPEED_LIMIT_MPS = 0.15
ACCELERATION_MPS2 = 0.3
_ROUNDING_M = 1e-6  # heights arrive as float32


class Lift:
    """Ideal lift, stepped in time.

    Attributes:
        height_m: above the lower stop.
        speed_mps: positive upwards.
    """

    def __init__(self) -> None:
        self.height_m = 0.0
        self.speed_mps = 0.0
        self._target_m: Optional[float] = None

    def order(self, height_m: float) -> bool:
        """Set the target height; NaN: stop. Return False without a change if it is out of range."""
        if math.isnan(height_m):
            self._target_m = None
            return True
        if not -_ROUNDING_M <= height_m <= HEIGHT_LIMIT_M + _ROUNDING_M:
            return False
        self._target_m = max(0.0, min(HEIGHT_LIMIT_M, height_m))
        return True

    def step(self, dt_s: float) -> None:
        """Advance by dt_s."""
        change = ACCELERATION_MPS2 * dt_s
        wanted = self._wanted_speed(change, dt_s)
        self.speed_mps += max(-change, min(change, wanted - self.speed_mps))
        self.height_m = max(0.0, min(HEIGHT_LIMIT_M, self.height_m + self.speed_mps * dt_s))

    def _wanted_speed(self, change: float, dt_s: float) -> float:
        """Return the highest speed from which steps of -change end exactly at the target."""
        if self._target_m is None:
            return 0.0
        error = self._target_m - self.height_m
        braking = math.sqrt(0.25 * change * change + 2.0 * ACCELERATION_MPS2 * abs(error)) - 0.5 * change
        return math.copysign(min(SPEED_LIMIT_MPS, braking, abs(error) / dt_s), error)
