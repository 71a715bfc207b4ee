"""Checks that the front LiDAR has seen the ground behind the robot that a turn sweeps, for one without a rear LiDAR."""
# SPDX-License-Identifier: Apache-2.0
import math
from collections import deque
from typing import Deque, NamedTuple

from mtr_core.se2 import Pose2

# Drive control trusts ground for 20 s after it was seen free, its ground_memory_s.
MEMORY_S = 15.0
# After NEEDED_M straight ahead all ground behind the robot was seen, or occupied by it; the robot drives AHEAD_M.
NEEDED_M, AHEAD_M = 0.4, 0.5
ASIDE_M, TURNED_RAD = 0.05, 0.1
STEP_M = 0.05


class _Passed(NamedTuple):
    """A pose of base_link in map and its time on the steady clock, s."""

    pose: Pose2
    time_s: float


class GroundBehind:
    """Records the poses of base_link in map, m and rad, over the last MEMORY_S."""

    def __init__(self) -> None:
        self._way: Deque[_Passed] = deque()
        self._seen_s = -math.inf

    def observe(self, pose: Pose2, now_s: float) -> None:
        """Add the pose at a tick; now_s: steady clock, s."""
        while self._way and now_s - self._way[0].time_s > MEMORY_S:
            self._way.popleft()
        if any(_is_straight_ahead(passed.pose.inverse() @ pose) for passed in self._way):
            self._seen_s = now_s
        if not self._way or self._way[-1].pose.distance_to(pose) > STEP_M:
            self._way.append(_Passed(pose, now_s))

    def is_seen(self, now_s: float) -> bool:
        """Return True if the robot may turn, because the ground was recently seen free."""
        return now_s - self._seen_s <= MEMORY_S


def _is_straight_ahead(way: Pose2) -> bool:
    return way.x >= NEEDED_M and abs(way.y) <= ASIDE_M and abs(way.heading) <= TURNED_RAD
