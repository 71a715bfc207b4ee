"""The link to a Car before a CAN adapter is chosen."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.ports import CarEvent, CarLink, LockState, RobotStatus

NO_ADAPTER = "No CAN adapter is chosen."


class NoCarLink(CarLink):
    """Knows nothing of the Car and says so."""

    def connect(self) -> None:
        """See CarLink."""

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        """See CarLink."""
        return []

    @property
    def lock_state(self) -> LockState:
        """See CarLink."""
        return LockState.UNKNOWN

    @property
    def problem(self) -> str:
        """See CarLink."""
        return NO_ADAPTER

    def close(self) -> None:
        """See CarLink."""
