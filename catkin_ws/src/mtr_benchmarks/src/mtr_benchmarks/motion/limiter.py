"""Applies drive control's limits between planner and wheels, for runs without obstacles and LiDARs."""
# SPDX-License-Identifier: Apache-2.0
from typing import Tuple

import mtr_drive_control_core

Velocity = Tuple[float, float]

PERIOD_S = 0.02
KEY_HEIGHT_M = 1.0


class Limiter:
    """Drive control's own VelocityLimiter with its default parameters.

    Attributes:
        sent: last sent velocity.
    """

    def __init__(self) -> None:
        self._limiter = mtr_drive_control_core.VelocityLimiter(KEY_HEIGHT_M, PERIOD_S)
        self.sent: Velocity = (0.0, 0.0)

    def follow(self, wanted: Velocity) -> Velocity:
        """Return the next velocity towards the wanted one."""
        self.sent = self._limiter.follow(*wanted)
        return self.sent
