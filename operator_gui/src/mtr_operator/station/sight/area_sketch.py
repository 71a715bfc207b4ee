"""A test area while it is drawn: corners, a cursor for the keyboard, and steps back."""
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
        cursor: where the keyboard adds and picks.
        picked: index of the corner that is being moved, None while none is.
    """

    def __init__(self) -> None:
        self.corners: tuple[Point, ...] = ()
        self.cursor: Point = (0.0, 0.0)
        self.picked: int | None = None
        self._before: list[tuple[Point, ...]] = []

    @property
    def problem(self) -> str:
        """Why a robot would refuse these corners; empty when it would not."""
        try:
            check_corners(self.corners)
        except InvalidParameter as error:
            return str(error)
        return ""

    @property
    def can_undo(self) -> bool:
        """There is a step to take back."""
        return bool(self._before)

    def add(self, point: Point) -> bool:
        """Add a corner behind the newest one; False when there are as many as a robot accepts."""
        if len(self.corners) >= MAX_CORNERS:
            return False
        self._change((*self.corners, _within(point)))
        return True

    def replace(self, corners: tuple[Point, ...]) -> None:
        """Other corners in their place."""
        self.picked = None
        self._change(tuple(map(_within, corners)))

    def remove(self, index: int) -> None:
        """Remove a corner."""
        self.picked = None
        self._change(self.corners[:index] + self.corners[index + 1:])

    def pick(self, index: int) -> None:
        """Begin to move a corner; one undo takes the whole move back."""
        self._change(self.corners)
        self.picked = index

    def move(self, point: Point) -> None:
        """Move the corner that is picked."""
        if self.picked is not None:
            self.corners = tuple(_within(point) if index == self.picked else corner
                                 for index, corner in enumerate(self.corners))

    def drop(self) -> None:
        """Leave the corner that is picked where it is."""
        self.picked = None
        if self._before and self._before[-1] == self.corners:
            self._before.pop()

    def undo(self) -> None:
        """Take the newest step back."""
        self.picked = None
        if self._before:
            self.corners = self._before.pop()

    def nearest(self, point: Point, reach_m: float) -> int | None:
        """Index of the nearest corner within reach, None without one."""
        found = min(range(len(self.corners)), key=lambda index: math.dist(point, self.corners[index]), default=None)
        return found if found is not None and math.dist(point, self.corners[found]) <= reach_m else None

    def _change(self, corners: tuple[Point, ...]) -> None:
        self._before = [*self._before, self.corners][-_KEPT_STEPS:]
        self.corners = corners


def _within(point: Point) -> Point:
    """To the centimetre, and no farther than a robot accepts."""
    x, y = (round(min(max(value, -MAX_CORNER_M), MAX_CORNER_M), 2) for value in point)
    return x, y
