"""Retreat of a test at a critical charge: it lowers the key, returns to its start position and ends there."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..errors import RobotFailed
from ..geometry.heights import LOWEST_KEY_M
from ..geometry.pose import Pose


class Retreat:
    """Start position of a run, and the return to it.

    The position is relative to the Car, like every pose: it stays valid when the Car is mapped again.
    """

    def __init__(self, robot: Robot):
        self._robot = robot
        self._start: Pose | None = None

    def begin(self) -> None:
        """Remember the current position; ignored while it is unknown."""
        status = self._robot.status
        if status.pose_valid and all(map(math.isfinite, (status.x, status.y, status.heading))):
            self._start = Pose(status.x, status.y, status.heading)

    def run(self) -> None:
        """Lower the key at standstill, then return; a robot that cannot do one of both stays at its position.

        Raises the errors that end other actions too: a lost link, or the Operator's stop.
        """
        robot = self._robot
        try:
            robot.say("the battery is critical: lower the key")
            robot.stand_and_lower_key(LOWEST_KEY_M)
            if self._start is None:
                robot.say("the robot stays here: its start place is not known")
                return
            robot.say("return to the start place")
            robot.drive_to(self._start)
            robot.wait_until_reached()
        except (RobotFailed, LineInvalid) as error:
            robot.say(f"the robot stays here: {error}")
