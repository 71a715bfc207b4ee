"""Whether the robot's clock is a simulated one, which tells no time of day."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..robot_status import RobotStatus

# In simulation clock and steady clock are one, to the rounding of their messages.
_SAME_CLOCK_S = 1e-6
# 1 January 2001, s since 1970. A simulation counts from near zero, and no robot of this software was built before. Only
# of a robot of before, which tells no steady clock: one that does and has forgotten the date is known by the two.
_FIRST_DATE_S = 978_307_200.0


def is_simulated_robot(status: RobotStatus) -> bool:
    """True only for a robot whose Status shows that it is a simulation; any other one counts as real."""
    return status.simulated or status.waits_for_answer or abs(status.sent_s - status.steady_s) <= _SAME_CLOCK_S


def is_simulated(status: RobotStatus) -> bool:
    """True when the clock that this Status was sent by is a simulated one."""
    if math.isnan(status.steady_s):
        return status.sent_s < _FIRST_DATE_S
    return abs(status.sent_s - status.steady_s) <= _SAME_CLOCK_S
