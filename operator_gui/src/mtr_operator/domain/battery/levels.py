"""Levels of the charge. The robot itself stops on hold below its own parameter `empty_battery`, 5 %."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

# Charge in percent below which the Operator is warned; the robot's own notice begins below 20 %.
LOW_BATTERY_PERCENT = 25
# Charge in percent below which no test starts, and a running test lowers the key, returns and pauses.
CRITICAL_BATTERY_PERCENT = 10


def is_low(percent: int | None) -> bool:
    """Return True for a known charge that requires a warning."""
    return percent is not None and percent < LOW_BATTERY_PERCENT


def is_critical(percent: int | None) -> bool:
    """Return True for a known charge that forbids measurements."""
    return percent is not None and percent < CRITICAL_BATTERY_PERCENT
