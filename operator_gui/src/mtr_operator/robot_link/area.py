"""The test area on the link."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any

from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import AreaOrder
from mtr_operator.domain.robot_status import AreaState, Problem
from mtr_proto import robot_link_pb2 as pb


def area_message(order: AreaOrder) -> pb.TestArea:
    """Return an order as a message to the robot."""
    return pb.TestArea(id=order.id, origin_id=order.origin_id, x=[x for x, _ in order.corners],
                       y=[y for _, y in order.corners])


def area_order_from(message: pb.TestArea) -> AreaOrder:
    """Return the order in a Command."""
    return AreaOrder(message.id, message.origin_id, tuple(zip(message.x, message.y)))


def area_state_from(message: pb.TestAreaState, problems: tuple[Problem, ...]) -> AreaState:
    """Return the reported state; an area or pose that is not finite is omitted."""
    corners = tuple(zip(message.area.x, message.area.y))
    is_finite = all(math.isfinite(value) for corner in corners for value in corner)
    return AreaState(message.required, message.fixed, message.area.id, message.area.origin_id,
                     corners if is_finite else (), message.origin_id, _pose(message, "x", "y", "heading"),
                     _pose(message, "car_x", "car_y", "car_heading"), problems)


def fill_area_state(message: pb.TestAreaState, state: AreaState) -> None:
    """Fill the message that a robot in this state sends, without its problems."""
    message.required, message.fixed, message.origin_id = state.required, state.is_fixed, state.origin_id
    if state.corners or state.area_id:
        message.area.CopyFrom(area_message(AreaOrder(state.area_id, state.area_origin_id, state.corners)))
    for names, pose in ((("x", "y", "heading"), state.robot), (("car_x", "car_y", "car_heading"), state.car)):
        if pose is not None:
            for name, value in zip(names, (pose.x, pose.y, pose.heading)):
                setattr(message, name, value)


def _pose(message: Any, *names: str) -> Pose | None:
    if not all(map(message.HasField, names)):
        return None
    values = [getattr(message, name) for name in names]
    return Pose(*values) if all(map(math.isfinite, values)) else None
