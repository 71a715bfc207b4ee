"""The link to a Car whose bus nobody asks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from .ports import CarEvent, CarLink, LockState
from .robot_status import RobotStatus

NO_ADAPTER = "No CAN adapter is chosen."


class AbsentCarLink(CarLink):
    """For requests that need the robot alone, and before an adapter is chosen; problem says why nothing is known."""

    def __init__(self, problem: str = NO_ADAPTER):
        self._problem = problem

    def connect(self) -> None:
        pass

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink; nothing happens."""
        return []

    @property
    def lock_state(self) -> LockState:
        return LockState.UNKNOWN

    @property
    def problem(self) -> str:
        return self._problem

    def close(self) -> None:
        pass
