"""Drive control's limits between planner and wheels, for runs in which nothing is in the way and no LiDAR looks."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

import mtr_drive_control_core

Velocity = Tuple[float, float]

PERIOD_S = 0.02
KEY_HEIGHT_M = 1.0


class Limiter:
    """The same as drive control's VelocityLimiter, with its default parameters.

    Attributes:
        sent: velocity sent last.
    """

    def __init__(self) -> None:
        self._limits = mtr_drive_control_core.limits_at(KEY_HEIGHT_M)
        self.sent: Velocity = (0.0, 0.0)

    def follow(self, wanted: Velocity) -> Velocity:
        """Next velocity on the way to the wanted one."""
        linear, angular = self._within(wanted)
        linear = self._next_linear(linear)
        step = self._limits["angular_acceleration_radps2"] * PERIOD_S
        angular = max(self.sent[1] - step, min(self.sent[1] + step, angular))
        lateral, most = abs(linear * angular), self._limits["lateral_acceleration_mps2"]
        self.sent = (linear, angular * min(1.0, most / max(lateral, 1e-9)))
        return self.sent

    def _within(self, wanted: Velocity) -> Velocity:
        linear, angular = wanted
        most = self._limits["lateral_acceleration_mps2"]
        factor = min(1.0, self._limits["max_linear_mps"] / max(abs(linear), 1e-9),
                     self._limits["max_angular_radps"] / max(abs(angular), 1e-9),
                     math.sqrt(most / max(abs(linear * angular), 1e-9)))
        return linear * factor, angular * factor

    def _next_linear(self, wanted: float) -> float:
        """Faster by acceleration, slower by deceleration, and never through zero in one step."""
        now = self.sent[0]
        up = self._limits["linear_acceleration_mps2"] * PERIOD_S
        if now == 0.0:
            return max(-up, min(up, wanted))
        sign = math.copysign(1.0, now)
        slowest = max(0.0, abs(now) - self._limits["linear_deceleration_mps2"] * PERIOD_S)
        return sign * max(slowest, min(abs(now) + up, sign * wanted))
