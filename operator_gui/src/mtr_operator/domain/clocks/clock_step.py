"""Whether the robot's clock was set between two Statuses, told by its steady clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..robot_status import RobotStatus

# The two clocks are read one after the other; half of a frame of a fast CAN message, and 2.5 mm at 0.5 m/s.
MIN_STEP_S = 0.005


def clock_step_s(before: RobotStatus, status: RobotStatus) -> float:
    """By how much the robot's clock was set forward between the two; NaN when it does not tell its steady clock."""
    return (status.sent_s - before.sent_s) - (status.steady_s - before.steady_s)


def clock_was_set(before: RobotStatus, status: RobotStatus) -> bool:
    """True when the robot says that its clock was set between the two."""
    return abs(clock_step_s(before, status)) > MIN_STEP_S


def counts_clock_step(before: RobotStatus | None, status: RobotStatus) -> bool:
    """True when the robot has counted a step of its clock between the two: what was known by time is known no more."""
    return before is not None and before.interventions.clock_steps != status.interventions.clock_steps
