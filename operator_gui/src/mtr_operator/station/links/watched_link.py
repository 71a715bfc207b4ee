"""A robot link that remembers where it has sent the robot, for those who draw it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.ports import RobotLink
from mtr_operator.domain.requests import DesiredState, Waypoint
from mtr_operator.domain.robot_status import RobotStatus


class WatchedRobotLink(RobotLink):
    """Hands everything on.

    Attributes:
        waypoint: the newest one that was sent, None before.
    """

    def __init__(self, link: RobotLink):
        self._link = link
        self.statistics = link.statistics
        self.waypoint: Waypoint | None = None

    @property
    def is_secret(self) -> bool:
        """True when the link is encrypted."""
        return self._link.is_secret

    def connect(self) -> None:
        """See RobotLink."""
        self._link.connect()

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        """See RobotLink."""
        return self._link.next_status(timeout_s)

    def send(self, desired: DesiredState) -> None:
        """See RobotLink."""
        self.waypoint = desired.waypoint
        self._link.send(desired)

    def close(self) -> None:
        """See RobotLink."""
        self._link.close()
