"""Requests to the robot and the reports on them: the same types from the application's Command to the motor."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Tuple

from . import names
from .problems import NO_PROBLEM, Problem
from .se2 import Pose2
from .states import Direction, Result

# Nodes that request waypoints; `application` returns the name of an application.
CAR_LOCATOR = "car_locator"
RVIZ = "rviz"


def application(session_id: int) -> str:
    """Return the requester name of an application; its waypoint ids start at 1 in each session."""
    return f"application/{session_id:x}"


@dataclass(frozen=True)
class Waypoint:
    """A requested pose of base_link.

    Attributes:
        id: the requester's own number, which the report repeats; 0: no waypoint.
        requester: name of the requester; requester and id together identify a waypoint.
        frame: names.CAR or names.MAP.
        pose: m and rad in the frame.
        direction: of travel on the last straight segment, a number of Direction.
    """

    id: int = 0
    requester: str = ""
    frame: str = names.CAR
    pose: Pose2 = Pose2(0.0, 0.0, 0.0)
    direction: int = Direction.ANY


NO_WAYPOINT = Waypoint()


class GoalId(NamedTuple):
    """Identity of a goal; waypoint_id 0: no goal."""

    requester: str = ""
    waypoint_id: int = 0
    attempt: int = 0


NO_GOAL_ID = GoalId()


@dataclass(frozen=True)
class Goal:
    """The waypoint that the motion planner drives to.

    Attributes:
        attempt: incremented each time a waypoint becomes the goal, so that a resumed waypoint is a new goal.
    """

    waypoint: Waypoint = NO_WAYPOINT
    attempt: int = 0

    @property
    def id(self) -> GoalId:
        """Identity that the motion planner echoes; NO_GOAL_ID without a waypoint."""
        waypoint = self.waypoint
        return GoalId(waypoint.requester, waypoint.id, self.attempt) if waypoint.id else NO_GOAL_ID


NO_GOAL = Goal()


@dataclass(frozen=True)
class GoalReport:
    """Report of the motion planner on a goal."""

    goal_id: GoalId = NO_GOAL_ID
    result: Result = Result.IDLE
    message: Problem = NO_PROBLEM

    def is_about(self, goal: Goal) -> bool:
        """Return True if the report refers to this goal, and the goal has a waypoint."""
        return goal.id != NO_GOAL_ID and self.goal_id == goal.id


@dataclass(frozen=True)
class Press:
    """One press of buttons of the Remote key, requested by an application.

    Attributes:
        id: the application's own number, which increases; 0: no press. A repeated id never presses twice.
        session_id: of the application; session and id together identify a press.
        buttons: numbers of the buttons, pressed together.
        strength: 0 no travel, 1 full travel.
        duration_s: hold time; 0: the key's default.
    """

    id: int = 0
    session_id: int = 0
    buttons: Tuple[int, ...] = ()
    strength: float = 1.0
    duration_s: float = 0.0


NO_PRESS = Press()


@dataclass(frozen=True)
class PressReport:
    """One press: times on the robot's clock, and an error if it was not executed."""

    id: int
    session_id: int
    start_ns: int
    end_ns: int
    error: Problem = NO_PROBLEM


@dataclass(frozen=True)
class DesiredState:
    """Desired state that the dispatcher derives from the Commands; the defaults apply while it is silent.

    Attributes:
        session_id: application in control, 0 for none.
        link_alive: False if the link is silent for longer than its limit.
        stop: the robot must stop; always True while the link is not alive.
        waypoint: pose requested by the Operator.
        max_speed_mps: above 0 in a message of the dispatcher.
        key_height_m: height of the Remote key above ground; NaN: unchanged.
        press: the newest press.
        map_car_id, check_car_id: requests to map the Car again and to check its frame, 0: none.
        resume_hold_id: hold that the Operator has released, 0: none.
        area_problem: why the robot neither maps nor tests because of its test area.
    """

    session_id: int = 0
    command_id: int = 0
    link_alive: bool = False
    stop: bool = True
    waypoint: Waypoint = NO_WAYPOINT
    max_speed_mps: float = 0.0
    key_height_m: float = math.nan
    press: Press = NO_PRESS
    map_car_id: int = 0
    check_car_id: int = 0
    resume_hold_id: int = 0
    area_problem: Problem = NO_PROBLEM
