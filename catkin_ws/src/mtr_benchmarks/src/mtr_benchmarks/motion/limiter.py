"""Drive control's limits between planner and wheels, for runs in which nothing is in the way and no LiDAR looks."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import mtr_drive_control_core

Velocity = Tuple[float, float]

PERIOD_S = 0.02
KEY_HEIGHT_M = 1.0


class Limiter:
    """Drive control's own VelocityLimiter with its default parameters.

    Attributes:
        sent: velocity sent last.
    """

    def __init__(self) -> None:
        self._limiter = mtr_drive_control_core.VelocityLimiter(KEY_HEIGHT_M, PERIOD_S)
        self.sent: Velocity = (0.0, 0.0)

    def follow(self, wanted: Velocity) -> Velocity:
        """Next velocity on the way to the wanted one."""
        self.sent = self._limiter.follow(*wanted)
        return self.sent
