"""Where the robot has been, as far as it belongs to the Car's frame of now and was seen."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import List, Optional, Sequence

from mtr_operator.domain.geometry.pose import Point
from mtr_operator.domain.robot_status import RobotStatus

# Places of the robot in their order; None is a gap, in which nobody saw where it was.
Places = List[Optional[Point]]
# Fastest robot times the time between two Statuses, five times over: what is farther apart was not driven in between.
GAP_M = 1.0


def thinned(places: Sequence[Point | None]) -> Places:
    """Every other place; the gaps stay."""
    return [place for index, place in enumerate(places) if place is None or index % 2 == 0]


class Passing:
    """Tells of each Status whether its place goes on with the trail; one per trail."""

    def __init__(self) -> None:
        self._robot_session_id = 0
        self._had_car = False
        self._last: Point | None = None

    def begins_anew(self, status: RobotStatus) -> bool:
        """True when what was passed before lies in a frame that is no more: the robot was restarted, or maps the Car
        anew. To be asked before place()."""
        is_new = (status.robot_session_id, status.car is not None) != (self._robot_session_id, self._had_car)
        self._robot_session_id, self._had_car = status.robot_session_id, status.car is not None
        if is_new:
            self._last = None
        return is_new

    def places(self, status: RobotStatus) -> Places:
        """What this Status adds: its place, a gap before it where it did not drive there, or nothing."""
        before = self._last
        self._last = (status.x, status.y) if status.pose_valid else None
        if self._last is None:
            return [None] if before is not None else []
        if before is not None and math.dist(before, self._last) > GAP_M:
            return [None, self._last]
        return [self._last]
