"""Robot link that remembers the robot's destination, and gives the Operator's stop priority."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.ports import RobotLink
from mtr_operator.domain.requests import DesiredState, Waypoint
from mtr_operator.domain.robot_status import RobotStatus

from .stop_order import StopOrder


class WatchedRobotLink(RobotLink):
    """Forwards desired states; overrides them with a stop while one is in force.

    Attributes:
        waypoint: the newest one that was sent, None before.
    """

    def __init__(self, link: RobotLink, stop: StopOrder):
        self._link = link
        self._stop = stop
        self.statistics = link.statistics
        self.waypoint: Waypoint | None = None

    @property
    def is_secret(self) -> bool:
        """True when the link is encrypted."""
        return self._link.is_secret

    @property
    def is_exposed(self) -> bool:
        return self._link.is_exposed

    def connect(self) -> None:
        self._link.connect()
        self._stop.attach(self._link.send)

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        status = self._link.next_status(timeout_s)
        if status is not None and status.is_in_service:
            self._stop.entered_service()
        return status

    def send(self, desired: DesiredState) -> None:
        self.waypoint = desired.waypoint
        self._stop.pass_on(self._link.send, desired)

    def watch(self) -> None:
        """See RobotLink; a stop in force is sent instead."""
        self.waypoint = None
        self._stop.pass_on(self._watch_or_stop, DesiredState())

    def give_way(self) -> None:
        """Yield to another application, which a stop of this one does not affect."""
        self._stop.withdraw()

    def is_answered(self, status: RobotStatus) -> bool:
        return self._link.is_answered(status)

    def close(self) -> None:
        self._stop.detach()
        self._link.close()

    def _watch_or_stop(self, desired: DesiredState) -> None:
        if desired.stop:
            self._link.send(desired)
        else:
            self._link.watch()
