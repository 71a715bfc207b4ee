"""Recent poses of the robot, interpolated at any time between them."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from collections import deque
from dataclasses import dataclass
from typing import Deque, Optional, Tuple

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle

# Localization publishes a pose every 20 ms; longer gaps are not interpolated.
MAX_GAP_S = 0.1
KEPT = 100
# An older pose is outdated: none has been valid since.
FRESH_S = 0.5
# Limits of a stationary robot.
STANDING_MPS, STANDING_RADPS = 0.01, 0.01


class PoseMode(enum.IntEnum):
    """Reference of localization, as in LocalizedPose."""

    DEAD_RECKONING = 0
    MAPPING = 1
    LOCALIZED = 2
    LOST = 3


@dataclass(frozen=True)
class RobotPose:
    """A valid pose of base_link in map.

    Attributes:
        map_revision: map that it is in; poses of different maps are unrelated.
        covariance: row-major 3x3 of x, y, heading in map.
    """

    time_s: float
    pose: Pose2
    speed_mps: float = 0.0
    yaw_rate_radps: float = 0.0
    mode: PoseMode = PoseMode.DEAD_RECKONING
    map_revision: int = 0
    covariance: Tuple[float, ...] = (0.0,) * 9

    @property
    def position_sigma_m(self) -> float:
        """1 sigma in the mean direction."""
        return math.sqrt(max(0.5 * (self.covariance[0] + self.covariance[4]), 0.0))

    @property
    def stands(self) -> bool:
        """True if the robot is stationary."""
        return abs(self.speed_mps) < STANDING_MPS and abs(self.yaw_rate_radps) < STANDING_RADPS


class PoseHistory:
    """Valid poses of base_link in map by time.

    Attributes:
        newest: the last one.
        stands_since_s: start of the standstill, None while the robot moves.
    """

    def __init__(self, first: RobotPose):
        self._rows: Deque[Tuple[float, float, float, float]] = deque(maxlen=KEPT)
        self.newest = first
        self.stands_since_s: Optional[float] = None
        self.add(first)

    def add(self, robot: RobotPose) -> None:
        """Add the next pose; another map, or a time that is not later than the last one, restarts the history."""
        heading = robot.pose.heading
        if self._rows:
            if robot.time_s <= self._rows[-1][0] or robot.map_revision != self.newest.map_revision:
                self._rows.clear()
            else:
                last = self._rows[-1][3]
                heading = last + wrap_angle(heading - last)
        self._rows.append((robot.time_s, robot.pose.x, robot.pose.y, heading))
        self.newest = robot
        if not robot.stands:
            self.stands_since_s = None
        elif self.stands_since_s is None or robot.time_s < self.stands_since_s:
            self.stands_since_s = robot.time_s

    def is_fresh(self, now_s: float) -> bool:
        """Return True if the robot's pose is known at present."""
        return now_s - self.newest.time_s <= FRESH_S

    def at(self, times_s: FloatArray) -> Optional[Tuple[FloatArray, FloatArray, FloatArray]]:
        """Return x, y and heading at the times; None if they are not covered."""
        if len(self._rows) < 2 or len(times_s) == 0:
            return None
        rows = np.array(self._rows)
        known, begin, end = rows[:, 0], times_s.min(), times_s.max()
        if not known[0] <= begin <= end <= known[-1]:
            return None
        first = np.searchsorted(known, begin, side="right") - 1
        last = np.searchsorted(known, end, side="left")
        if last > first and np.diff(known[first:last + 1]).max() > MAX_GAP_S:
            return None
        x, y, heading = (np.interp(times_s, known, rows[:, column]) for column in (1, 2, 3))
        return x, y, heading

    def standing_s(self, now_s: float) -> float:
        """Return the duration of the standstill, 0 while the robot moves."""
        return 0.0 if self.stands_since_s is None else max(now_s - self.stands_since_s, 0.0)
