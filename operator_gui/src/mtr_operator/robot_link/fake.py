"""Fake robot in the same process: a virtual robot that answers at once, on its own clock."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import time
from typing import Callable

from mtr_operator.domain.errors import ConnectionFailed
from mtr_operator.domain.ports import LinkStatistics, RobotLink
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import RobotStatus

from .virtual.robot import DEFAULT_WORLD, STATUS_PERIOD_S, VirtualRobot, VirtualWorld

_SESSION_ID = 1


class FakeRobotLink(RobotLink):
    """Link to a virtual robot. Each next_status advances its time by 0.1 s; the result is deterministic for a seed.

    time_factor: virtual seconds per second of wall time, 0 for as fast as possible. robot: one that was used in an
    earlier session; session_id must then be a new one.
    """

    def __init__(self, seed: int = 1, time_factor: float = 0.0, world: VirtualWorld = DEFAULT_WORLD,
                 sleep: Callable[[float], None] = time.sleep, *, robot: VirtualRobot | None = None,
                 session_id: int = _SESSION_ID):
        self.statistics = LinkStatistics()
        self._robot = robot or VirtualRobot(seed, world)
        self._session_id = session_id
        self._pause_s = STATUS_PERIOD_S / time_factor if time_factor > 0 else 0.0
        self._sleep = sleep
        self._due_s = math.nan
        self._connected = False
        self._desired: DesiredState | None = None
        self._command_id = 0

    def connect(self) -> None:
        self._connected = True

    def next_status(self, timeout_s: float) -> RobotStatus | None:
        """See RobotLink; a Status is always available."""
        if not self._connected:
            raise ConnectionFailed("The robot is not connected.")
        if self._pause_s:
            self._pause()
        self._robot.step()
        self.statistics.received += 1
        return self._robot.status()

    def _pause(self) -> None:
        """Wait until the next Status is due; a late call is compensated, so that the clock keeps its average rate."""
        now_s = time.monotonic()
        self._due_s = self._pause_s + (now_s if math.isnan(self._due_s) else self._due_s)
        self._sleep(min(max(self._due_s - now_s, 0.0), self._pause_s))

    def send(self, desired: DesiredState) -> None:
        if not self._connected:
            raise ConnectionFailed("The robot is not connected.")
        if desired != self._desired:
            self._command_id += 1
            self._desired = desired
        self._robot.take(self._session_id, self._command_id, desired)

    def is_answered(self, status: RobotStatus) -> bool:
        return status.session_id == self._session_id and status.command_id == self._command_id

    def close(self) -> None:
        self._robot.halt()
        self._connected = False
