"""By which time it is waited for the robot: its own, as if nobody set its clock meanwhile."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..robot_status import RobotStatus

# Within it a pose may be older or newer beside its Status than that of the Status before.
_SLACK_S = 0.5


class WaitingTime:
    """Fed with every Status. A robot of before, which does not tell its steady clock, waits by the one that is set."""

    def __init__(self) -> None:
        self._before: RobotStatus | None = None
        self._set_s = 0.0

    def learn(self, status: RobotStatus) -> None:
        """A Status has come. Another start of the robot may be another start of its steady clock."""
        before, self._before = self._before, status
        if before is None or before.robot_session_id != status.robot_session_id:
            return
        # By the stamps that are waited by: a pose of before the clock was set may come after it.
        set_s = (status.stamp_s - before.stamp_s) - (status.steady_s - before.steady_s)
        if abs(set_s) > _SLACK_S:
            self._set_s += set_s

    def at(self, stamp_s: float) -> float:
        """At the newest Status's stamp."""
        return stamp_s - self._set_s
