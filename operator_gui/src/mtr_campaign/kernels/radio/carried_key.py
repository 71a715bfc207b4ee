"""Key carried by the robot: time advances in ticks, and the key moves straight within a tick."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.robot_link.virtual.robot import VirtualRobot

from .errors import Point, RadioErrors

# Period of Status messages, as in the application.
TICK_S = 0.1
NS = 1_000_000_000


class CarriedKey:
    """True position of the key, in m in the true Car's frame.

    Attributes:
        robot: carrier of the key. time_ns, before_ns: now, and before the last ticks. heading: believed heading of the
            robot, in rad. line: position error of the robot on the current line, x and y in m.
    """

    def __init__(self, robot: VirtualRobot, errors: RadioErrors, key_x_m: float):
        self.robot = robot
        self.line = (0.0, 0.0)
        self.time_ns = self.before_ns = round(robot.time_s * NS)
        self._errors = errors
        self._key_x_m = key_x_m
        self.heading, self._here = self._now()
        self._before = self._here

    def go(self, ticks: int) -> None:
        """Advance the time."""
        self.before_ns, self._before = self.time_ns, self._here
        self.robot.step(ticks * TICK_S)
        self.time_ns = round(self.robot.time_s * NS)
        self.heading, self._here = self._now()

    def at(self, time_ns: int) -> Point:
        """Return the position at a time within the last ticks."""
        part = (time_ns - self.before_ns) / (self.time_ns - self.before_ns)
        (x, y, z), (to_x, to_y, to_z) = self._before, self._here
        return x + part * (to_x - x), y + part * (to_y - y), z + part * (to_z - z)

    @property
    def velocity_mps(self) -> Point:
        """Mean velocity during the last ticks."""
        (x, y, z), (to_x, to_y, to_z) = self._before, self._here
        gone_s = (self.time_ns - self.before_ns) / NS
        return (to_x - x) / gone_s, (to_y - y) / gone_s, (to_z - z) / gone_s

    def _now(self) -> tuple[float, Point]:
        pose = self.robot.pose
        return pose.heading, self._errors.true_key(pose, self._key_x_m, self.robot.key_height_m, self.line)
