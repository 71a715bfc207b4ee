"""What a test does at a critical charge: it lowers the key, returns to its start place and ends there."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..errors import RobotFailed
from ..geometry.heights import LOWEST_KEY_M
from ..geometry.pose import Pose


class Retreat:
    """Start place of a run, and the way back to it.

    The place is relative to the Car, like every pose: it stays valid when the Car is mapped again.
    """

    def __init__(self, robot: Robot):
        self._robot = robot
        self._start: Pose | None = None

    def begin(self) -> None:
        """Remember where the robot is now; ignored while its position is unknown."""
        status = self._robot.status
        if status.pose_valid and all(map(math.isfinite, (status.x, status.y, status.heading))):
            self._start = Pose(status.x, status.y, status.heading)

    def run(self) -> None:
        """Lower the key at standstill, then return; a robot that cannot do one of both stays where it is.

        Raises what ends any other action: a lost link, or the Operator's stop.
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
