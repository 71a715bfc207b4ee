"""Test area of a virtual robot, which confirms the area but does not enforce it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import AreaOrder
from mtr_operator.domain.robot_status import AreaState


class VirtualArea:
    """Store of the newest area. origin_id: of this start of the robot; start: its pose in the Car's frame at that
    time."""

    def __init__(self, origin_id: int, start: Pose):
        self._origin_id = origin_id
        x, y = start.to_source((0.0, 0.0))
        # Car in the frame of the robot's start pose.
        self._car = Pose(x, y, -start.heading)
        self._session_id = 0
        self._order: AreaOrder | None = None

    def take(self, session_id: int, order: AreaOrder | None) -> None:
        """Store a new order; a repeated id has no effect."""
        if order is not None and (self._order is None or (self._session_id, self._order.id) != (session_id, order.id)):
            self._session_id, self._order = session_id, order

    def state(self, session_id: int, pose: Pose, *, is_mapped: bool) -> AreaState:
        """Return the reported state. pose: in the Car's frame."""
        order = self._order or AreaOrder(0, 0, ())
        robot = Pose(*self._car.apply((pose.x, pose.y)), self._car.heading + pose.heading)
        return AreaState(area_id=order.id if session_id and session_id == self._session_id else 0,
                         area_origin_id=order.origin_id, corners=order.corners, origin_id=self._origin_id, robot=robot,
                         car=self._car if is_mapped else None)
