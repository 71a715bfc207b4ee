"""Levels of the charge. The robot itself goes on hold below its own parameter `empty_battery`, 5 %."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

# Charge in percent below which the Operator is warned; the robot's own notice begins below 20 %.
LOW_BATTERY_PERCENT = 25
# Charge in percent below which no test begins, and a test that runs lowers the key, returns and pauses.
CRITICAL_BATTERY_PERCENT = 10


def is_low(percent: int | None) -> bool:
    """True for a known charge that the Operator is warned of."""
    return percent is not None and percent < LOW_BATTERY_PERCENT


def is_critical(percent: int | None) -> bool:
    """True for a known charge with which nothing is measured."""
    return percent is not None and percent < CRITICAL_BATTERY_PERCENT
