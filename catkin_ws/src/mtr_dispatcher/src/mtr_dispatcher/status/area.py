"""The test area in a Status, with the poses of robot and Car in its frame."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple

from mtr_core.problems import Problem
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_proto import robot_link_pb2 as link

from ..area.keeper import AreaKeeper
from .inputs import Inputs
from .texts import problem_messages


class AreaReport(NamedTuple):
    """Inputs of the test area's state in a Status."""

    keeper: AreaKeeper
    problem: Problem
    session_id: int
    is_one_map: bool


def add_area(state: link.TestAreaState, fresh: Inputs, report: AreaReport) -> None:
    """Fill the state of the test area."""
    keeper, pose, car = report.keeper, fresh.pose, fresh.car
    state.required, state.fixed = keeper.required, keeper.is_fixed
    state.problems.extend(problem_messages(report.problem))
    area = keeper.area
    if area is not None and area.corners:
        is_own = bool(report.session_id) and area.session_id == report.session_id
        state.area.id = area.id if is_own else 0
        state.area.origin_id = area.origin_id
        state.area.x.extend(x for x, _ in area.corners)
        state.area.y.extend(y for _, y in area.corners)
    elif area is not None and report.session_id and area.session_id == report.session_id:
        state.area.id = area.id
    if pose is None:
        return
    state.origin_id = pose.origin_id
    if pose.valid and Pose2(pose.x, pose.y, pose.heading).is_finite():
        state.x, state.y, state.heading = pose.x, pose.y, pose.heading
    if (car is not None and car.state == CarState.LOCATED and report.is_one_map
            and Pose2(car.x, car.y, car.heading).is_finite()):
        state.car_x, state.car_y, state.car_heading = car.x, car.y, car.heading
