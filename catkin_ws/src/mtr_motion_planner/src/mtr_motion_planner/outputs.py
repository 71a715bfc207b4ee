"""Outputs of the motion planner at a tick."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.problems import Problem
from mtr_core.requests import GoalId
from mtr_core.states import Result

from .inputs import Point


@dataclass(frozen=True)
class Path:
    """Line of the turn centre of a new plan, in map or in the Car's frame."""

    in_car_frame: bool
    points: Tuple[Point, ...]


@dataclass(frozen=True)
class PlannerOutput:
    """Velocity and status of one tick; path only when it is new.

    replans: number of new paths to an active goal since the start, because the robot or the Car was not at its expected
    pose. A change of speed or a correction at the goal does not count.
    """

    linear_mps: float
    angular_radps: float
    active: bool
    goal_id: GoalId
    result: Result
    remaining_m: float
    message: Problem
    path: Optional[Path] = None
    replans: int = 0
