"""Service mode without a window: enter it, or release it for the Operator and wait for the robot's side."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from typing import Callable

from ..errors import LinkLost, RobotFailed
from ..ports import RobotLink
from ..requests import DesiredState
from ..robot_status import RobotStatus, ServiceState

# Wall time of one wait for a Status.
LOOK_S = 0.1
# Wall time limit for the robot's answer and reaction.
LIMIT_S = 10.0
# Wall time limit of the wait for the robot's side, equal to the validity of a release there.
RELEASE_LIMIT_S = 300.0
# The first Statuses may precede the end of another application's session.
FOREIGN_S = 2.0
RELEASED = "Released for the Operator. On the robot: rosrun mtr_dispatcher service_mode release"
NOT_RELEASED = "The robot was not released on its own side in time; service mode remains active."


class ServiceOrder:
    """One order over a connected link. look: called at each Status; may raise to interrupt."""

    def __init__(self, link: RobotLink, look: Callable[[], None] = lambda: None,
                 clock: Callable[[], float] = time.monotonic):
        self._link, self._look, self._clock = link, look, clock

    def state(self) -> ServiceState:
        """Return the reported state; RobotFailed for a robot without service mode."""
        service = self._status().service
        if service is None:
            raise RobotFailed("The robot's software is too old for service mode; update it, or switch the robot off "
                              "for work on it.")
        return service

    def enter(self) -> ServiceState:
        """Disable wheels, lift and servos; return when the robot reports it."""
        self.state()
        until_s = self._clock() + LIMIT_S
        while self._clock() < until_s:
            self._link.send(DesiredState(stop=True, enters_service=True))
            service = self._status().service
            if service is not None and service.is_active:
                return service
        raise RobotFailed("The robot did not enter service mode; switch it off before you work on it.")

    def leave(self, say: Callable[[str], None]) -> None:
        """Release it for the Operator, and return when it has ended. say: shows the reason of the wait."""
        agreement_id, is_told = self.state().agreement_id, False
        begun_s = self._clock()
        while self._clock() < begun_s + RELEASE_LIMIT_S:
            self._link.send(DesiredState(stop=True, leave_service_id=agreement_id))
            status = self._status()
            if status.service is None or not status.is_in_service:
                return
            if status.controlled_by_other and self._clock() >= begun_s + FOREIGN_S:
                raise RobotFailed("Another application controls the robot: release service mode there.")
            if status.service.agreement_id != agreement_id:
                break
            if not is_told and not math.isnan(status.service.operator_agrees_s):
                is_told = True
                say(RELEASED)
        raise RobotFailed(NOT_RELEASED)

    def _status(self) -> RobotStatus:
        until_s = self._clock() + LIMIT_S
        while self._clock() < until_s:
            self._look()
            status = self._link.next_status(LOOK_S)
            if status is not None:
                return status
        raise LinkLost(f"The robot has not answered for {LIMIT_S:g} s.")
