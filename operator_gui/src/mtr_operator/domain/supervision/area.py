"""Test area before the robot moves: the robot must have it, or no test starts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ..actions.control_loop import ControlLoop
from ..errors import RobotFailed
from ..geometry.pose import Point
from ..requests import AreaOrder
from ..robot_status import AreaState, RobotStatus

# A robot confirms an area with its next Status; a busy laptop reads older Statuses first.
CONFIRMED_WITHIN_S = 5.0
# A robot that has just started determines its start frame after a short standstill.
ORIGIN_WITHIN_S = 30.0
TOO_OLD = "The robot's software is too old to keep a test area; update it, or begin without one."


def set_area(loop: ControlLoop, corners: Sequence[Point]) -> None:
    """Order this area, drawn in the robot's current localization frame; RobotFailed if it is rejected."""
    until_s = loop.waited_s + ORIGIN_WITHIN_S
    while _state(loop.status).origin_id == 0:
        if loop.waited_s >= until_s:
            raise RobotFailed("The robot does not know its position yet, so it cannot keep a test area.")
        loop.step()
    state = _state(loop.status)
    if state.is_fixed:
        raise RobotFailed("The robot's launch file sets its test area; begin the test without another one.")
    loop.change(area=AreaOrder(1, state.origin_id, tuple(corners)))


def await_area(loop: ControlLoop) -> None:
    """Wait until the robot enforces the ordered area; RobotFailed if it requires one and has none."""
    until_s = loop.waited_s + CONFIRMED_WITHIN_S
    order = loop.desired.area
    while order is not None and _state(loop.status).area_id != order.id:
        if loop.waited_s >= until_s:
            texts = [notification.text for notification in loop.status.notifications]
            raise RobotFailed(" ".join(["The robot did not accept the test area.", *texts]))
        loop.step()
    state = loop.status.area
    if state is not None and state.problems:
        raise RobotFailed(f"No test begins. {state.problems[0].text}")


def _state(status: RobotStatus) -> AreaState:
    if status.area is None:
        raise RobotFailed(TOO_OLD)
    return status.area
