"""Detection of a lasting critical charge, reported once."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..errors import BatteryCritical
from ..robot_status import RobotStatus
from .levels import CRITICAL_BATTERY_PERCENT, is_critical

# Load steps and corrupt messages are shorter.
CRITICAL_FOR_S = 10.0
# The recovery of a battery when the robot stops is smaller.
RECHARGED_PERCENT = 5


class BatteryWatch:
    """Reports a critical charge once; a charged battery may become critical again."""

    def __init__(self) -> None:
        self._since_s: float | None = None
        self._is_reported = False

    def check(self, status: RobotStatus, now_s: float) -> None:
        """Raise BatteryCritical once, unless another application has the robot. now_s: of a clock that is never set."""
        if not status.controlled_by_other and self.is_due(status.battery_percent, now_s):
            raise BatteryCritical("The robot's battery is critical; charge the robot, then continue.")

    def is_due(self, percent: int | None, now_s: float) -> bool:
        """Return True at the first call at which the charge has been critical for CRITICAL_FOR_S.

        An unknown charge does not reset it: a critical battery without reports is still critical.
        """
        if percent is not None and not is_critical(percent):
            self._since_s = None
            self._is_reported = self._is_reported and percent < CRITICAL_BATTERY_PERCENT + RECHARGED_PERCENT
        elif percent is not None and self._since_s is None:
            self._since_s = now_s
        if self._is_reported or self._since_s is None or now_s - self._since_s < CRITICAL_FOR_S:
            return False
        self._is_reported = True
        return True
