"""Test area during drawing: corners, a cursor for the keyboard, and undo."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.geometry.area import MAX_CORNER_M, MAX_CORNERS, check_corners
from mtr_operator.domain.geometry.pose import Point

_KEPT_STEPS = 200


class AreaSketch:
    """Corners in the robot's start frame, m.

    Attributes:
        corners: in their order.
        cursor: position at which the keyboard adds and picks.
        picked: index of the corner being moved, None without one.
    """

    def __init__(self) -> None:
        self.corners: tuple[Point, ...] = ()
        self.cursor: Point = (0.0, 0.0)
        self.picked: int | None = None
        self._before: list[tuple[Point, ...]] = []

    @property
    def problem(self) -> str:
        """Reason why a robot would reject these corners; empty if it would not."""
        try:
            check_corners(self.corners)
        except InvalidParameter as error:
            return str(error)
        return ""

    @property
    def can_undo(self) -> bool:
        """True if there is a step to undo."""
        return bool(self._before)

    def add(self, point: Point) -> bool:
        """Add a corner after the newest one; return False at the robot's maximum."""
        if len(self.corners) >= MAX_CORNERS:
            return False
        self._change((*self.corners, _within(point)))
        return True

    def replace(self, corners: tuple[Point, ...]) -> None:
        """Replace all corners."""
        self.picked = None
        self._change(tuple(map(_within, corners)))

    def remove(self, index: int) -> None:
        """Remove a corner."""
        self.picked = None
        self._change(self.corners[:index] + self.corners[index + 1:])

    def pick(self, index: int) -> None:
        """Start to move a corner; one undo reverts the whole move."""
        self._change(self.corners)
        self.picked = index

    def move(self, point: Point) -> None:
        """Move the picked corner."""
        if self.picked is not None:
            self.corners = tuple(_within(point) if index == self.picked else corner
                                 for index, corner in enumerate(self.corners))

    def drop(self) -> None:
        """End the move of the picked corner at its position."""
        self.picked = None
        if self._before and self._before[-1] == self.corners:
            self._before.pop()

    def undo(self) -> None:
        """Revert the newest step."""
        self.picked = None
        if self._before:
            self.corners = self._before.pop()

    def nearest(self, point: Point, reach_m: float) -> int | None:
        """Return the index of the nearest corner within reach, None without one."""
        found = min(range(len(self.corners)), key=lambda index: math.dist(point, self.corners[index]), default=None)
        return found if found is not None and math.dist(point, self.corners[found]) <= reach_m else None

    def _change(self, corners: tuple[Point, ...]) -> None:
        self._before = [*self._before, self.corners][-_KEPT_STEPS:]
        self.corners = corners


def _within(point: Point) -> Point:
    """Round to centimetres, and limit to the range that a robot accepts."""
    x, y = (round(min(max(value, -MAX_CORNER_M), MAX_CORNER_M), 2) for value in point)
    return x, y
