"""The link to a Car whose bus nobody asks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from .ports import CarEvent, CarLink, LockState, RobotStatus


class AbsentCarLink(CarLink):
    """For orders that need the robot alone."""

    def connect(self) -> None:
        """See CarLink."""

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink; nothing happens."""
        return []

    @property
    def lock_state(self) -> LockState:
        """See CarLink."""
        return LockState.UNKNOWN

    @property
    def problem(self) -> str:
        """See CarLink."""
        return "The Car's bus is not connected."

    def close(self) -> None:
        """See CarLink."""
