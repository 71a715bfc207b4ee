"""Detects a step of the robot's clock between two Statuses by its steady clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..robot_status import RobotStatus

# The two clocks are read consecutively; the limit is half a frame of a fast CAN message, and 2.5 mm at 0.5 m/s.
MIN_STEP_S = 0.005


def clock_step_s(before: RobotStatus, status: RobotStatus) -> float:
    """Return the forward step of the robot's clock between the two Statuses; NaN without a steady clock."""
    return (status.sent_s - before.sent_s) - (status.steady_s - before.steady_s)


def clock_was_set(before: RobotStatus, status: RobotStatus) -> bool:
    """Return True if the robot's clocks show a step between the two Statuses."""
    return abs(clock_step_s(before, status)) > MIN_STEP_S


def counts_clock_step(before: RobotStatus | None, status: RobotStatus) -> bool:
    """Return True if the robot has counted a clock step between the two Statuses: times from before it are invalid."""
    return before is not None and before.interventions.clock_steps != status.interventions.clock_steps
