"""The report of the robot's preflight between the Statuses that carry it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from ..robot_status import PreflightReport, RobotStatus


class KeptPreflight:
    """Attributes: report: the newest one of the robot that is connected, None while it has told nothing of it."""

    def __init__(self) -> None:
        self.report: PreflightReport | None = None
        self._robot_session_id = 0

    def learn(self, status: RobotStatus) -> None:
        """Take what a Status says; another start of the robot begins anew."""
        if status.robot_session_id != self._robot_session_id:
            self._robot_session_id, self.report = status.robot_session_id, None
        if status.preflight is not None:
            self.report = status.preflight
