"""Service mode of a virtual robot, which needs no release on site."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import SERVICE_CODE, Notification, Problem, ServiceState

_ERROR = 3
_RELEASE_S = 60.0
_CAUSE = Problem("dispatcher.service_by_operator", (), "The Operator has entered it.")
_TEXT = ("The robot is in service mode: wheels, lift and servos are disabled until the robot and the Operator both "
         f"release it. {_CAUSE.text}")
_PROBLEMS = (Problem("dispatcher.service_mode", (), _TEXT), _CAUSE)


class VirtualService:
    """Service mode. Attributes: is_active: the robot rejects all orders to move."""

    def __init__(self) -> None:
        self.is_active = False
        self._id = 0

    def take(self, desired: DesiredState) -> None:
        """Enter service mode, or leave it if the Operator releases this entry."""
        if desired.enters_service:
            self._id += not self.is_active
            self.is_active = True
        elif self.is_active and desired.leave_service_id == self._id:
            self.is_active = False

    @property
    def state(self) -> ServiceState:
        """Return the reported state."""
        if not self.is_active:
            return ServiceState()
        return ServiceState(True, self._id, _RELEASE_S, math.nan, _PROBLEMS)

    @property
    def notifications(self) -> tuple[Notification, ...]:
        """Return the state as notifications."""
        return (Notification(SERVICE_CODE, _ERROR, _TEXT, _PROBLEMS),) if self.is_active else ()
