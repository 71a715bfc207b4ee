"""Drive control between planner and wheels, tick by tick as in lock-step: its limits, and one tick of delay."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Tuple

Velocity = Tuple[float, float]

# Defaults of mtr_drive_control/parameters.hpp.
MAX_LINEAR_MPS, MAX_ANGULAR_RADPS = 1.5, 1.5
ACCELERATION_MPS2, DECELERATION_MPS2, ANGULAR_RADPS2 = 1.0, 1.5, 2.0
LATERAL_MPS2 = 1.0
PERIOD_S = 0.02


class Limiter:
    """The same limits as drive control's VelocityLimiter.

    Attributes:
        sent: velocity sent last.
        clipped: ticks at which the limits changed what was wanted.
    """

    def __init__(self) -> None:
        self.sent: Velocity = (0.0, 0.0)
        self.clipped = 0

    def follow(self, wanted: Velocity) -> Velocity:
        """Next velocity on the way to the wanted one."""
        linear, angular = _within(wanted)
        now = self.sent[0]
        up, down = (ACCELERATION_MPS2, ACCELERATION_MPS2)
        if now > 0.0:
            down = DECELERATION_MPS2
        elif now < 0.0:
            up = DECELERATION_MPS2
        linear = max(now - down * PERIOD_S, min(now + up * PERIOD_S, linear))
        if linear * now < 0.0:
            linear = 0.0
        angular = max(self.sent[1] - ANGULAR_RADPS2 * PERIOD_S, min(self.sent[1] + ANGULAR_RADPS2 * PERIOD_S, angular))
        lateral = abs(linear * angular)
        if lateral > LATERAL_MPS2:
            angular *= LATERAL_MPS2 / lateral
        self.sent = (linear, angular)
        return self.sent


def _within(wanted: Velocity) -> Velocity:
    linear, angular = wanted
    factor = min(1.0, MAX_LINEAR_MPS / max(abs(linear), 1e-9), MAX_ANGULAR_RADPS / max(abs(angular), 1e-9))
    lateral = abs(linear * angular)
    if lateral > LATERAL_MPS2:
        factor = min(factor, math.sqrt(LATERAL_MPS2 / lateral))
    return linear * factor, angular * factor
