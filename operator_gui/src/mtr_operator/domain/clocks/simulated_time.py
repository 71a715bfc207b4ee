"""Detects a simulated robot clock, which has no time of day."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..robot_status import RobotStatus

# In simulation, clock and steady clock are equal, except for rounding in their messages.
_SAME_CLOCK_S = 1e-6
# 1 January 2001, s since 1970. A simulation counts from near zero, and no robot with this software is older. It is used
# only for older robots without a steady clock; a robot with one that lost its date is recognized by the two clocks.
_FIRST_DATE_S = 978_307_200.0


def is_simulated_robot(status: RobotStatus) -> bool:
    """Return True only for a robot whose Status shows a simulation; all others count as real."""
    return status.simulated or status.waits_for_answer or abs(status.sent_s - status.steady_s) <= _SAME_CLOCK_S


def is_simulated(status: RobotStatus) -> bool:
    """Return True if the clock of this Status is simulated."""
    if math.isnan(status.steady_s):
        return status.sent_s < _FIRST_DATE_S
    return abs(status.sent_s - status.steady_s) <= _SAME_CLOCK_S
