"""The robot's pose between two Statuses, so that thirty pictures a second move and do not jump."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.geometry.pose import Pose, wrap_angle

# Status comes ten times a second; after a longer gap the robot is where the last one says.
MAX_GAP_S = 0.3
MAX_STEP_M = 1.0


class Glide:
    """Shows the way from the Status before the last to the last one, one Status late."""

    def __init__(self) -> None:
        self._from: Pose | None = None
        self._to: Pose | None = None
        self._to_s = self._gap_s = 0.0

    def put(self, pose: Pose | None, now_s: float) -> None:
        """The newest pose, which arrived at now_s; None while it is not known."""
        if pose == self._to:
            return
        gap_s = now_s - self._to_s
        jumps = pose is None or self._to is None or gap_s > MAX_GAP_S \
            or abs(pose.x - self._to.x) + abs(pose.y - self._to.y) > MAX_STEP_M
        self._from = pose if jumps else self.at(now_s)
        self._to, self._to_s, self._gap_s = pose, now_s, gap_s

    def at(self, now_s: float) -> Pose | None:
        """Where to paint the robot."""
        start, end = self._from, self._to
        if start is None or end is None or start is end or self._gap_s <= 0.0:
            return end
        part = min(max((now_s - self._to_s) / self._gap_s, 0.0), 1.0)
        turn = wrap_angle(end.heading - start.heading)
        return Pose(start.x + part * (end.x - start.x), start.y + part * (end.y - start.y),
                    wrap_angle(start.heading + part * turn))

    def is_moving(self, now_s: float) -> bool:
        """True while the next picture will be another one."""
        return self._from is not self._to and now_s - self._to_s < self._gap_s
