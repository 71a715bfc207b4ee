"""Time base for waiting on the robot: its clock without later steps."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..robot_status import RobotStatus

# Tolerance for the age of a pose relative to its Status, which differs between Statuses.
_SLACK_S = 0.5


class WaitingTime:
    """Time base, updated with every Status. An older robot without a steady clock uses its clock including steps."""

    def __init__(self) -> None:
        self._before: RobotStatus | None = None
        self._set_s = 0.0

    def learn(self, status: RobotStatus) -> None:
        """Add a Status. A restarted robot may have a restarted steady clock."""
        before, self._before = self._before, status
        if before is None or before.robot_session_id != status.robot_session_id:
            return
        # The comparison uses the stamps of the poses: a pose from before the step may arrive after it.
        set_s = (status.stamp_s - before.stamp_s) - (status.steady_s - before.steady_s)
        if abs(set_s) > _SLACK_S:
            self._set_s += set_s

    def at(self, stamp_s: float) -> float:
        """Return the time at the newest Status's stamp."""
        return stamp_s - self._set_s
