"""Path of the robot, as far as it was observed and is in the current frame of the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import List, Optional, Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.robot_status import RobotStatus

# Positions of the robot in their order; None is a gap without an observation.
Places = List[Optional[Point]]
# Five times the distance of the fastest robot between two Statuses: a larger one was not driven.
GAP_M = 1.0


def thinned(places: Sequence[Point | None]) -> Places:
    """Return every other position; the gaps remain."""
    return [place for index, place in enumerate(places) if place is None or index % 2 == 0]


class Passing:
    """Decides for each Status if its position continues the trail; one instance per trail."""

    def __init__(self) -> None:
        self._robot_session_id = 0
        self._had_car = False
        self._last: Point | None = None

    def begins_anew(self, status: RobotStatus) -> bool:
        """Return True if earlier positions are in an obsolete frame: the robot was restarted, or maps the Car again.
        Call it before places()."""
        is_new = (status.robot_session_id, status.car is not None) != (self._robot_session_id, self._had_car)
        self._robot_session_id, self._had_car = status.robot_session_id, status.car is not None
        if is_new:
            self._last = None
        return is_new

    def places(self, status: RobotStatus) -> Places:
        """Return the additions of this Status: its position, after a gap if it was not driven there, or nothing."""
        before = self._last
        self._last = (status.x, status.y) if status.pose_valid else None
        if self._last is None:
            return [None] if before is not None else []
        if before is not None and math.dist(before, self._last) > GAP_M:
            return [None, self._last]
        return [self._last]
