"""What is requested of the robot, and what became of it: the same types from the application's Command to the motor."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import NamedTuple, Tuple

from . import names
from .problems import NO_PROBLEM, Problem
from .se2 import Pose2
from .states import Direction, Result

# Requesters of waypoints that are nodes; an application's name is made by `application`.
CAR_LOCATOR = "car_locator"
RVIZ = "rviz"


def application(session_id: int) -> str:
    """The requester that stands for an application: its waypoints count from 1 in each session."""
    return f"application/{session_id:x}"


@dataclass(frozen=True)
class Waypoint:
    """A pose of base_link that somebody wants the robot to have.

    Attributes:
        id: the requester's own number, which comes back with what became of it; 0: no waypoint.
        requester: who wants it; requester and id together tell waypoints apart.
        frame: names.CAR or names.MAP.
        pose: m and rad in the frame.
        direction: of travel on the last straight piece, a number of Direction.
    """

    id: int = 0
    requester: str = ""
    frame: str = names.CAR
    pose: Pose2 = Pose2(0.0, 0.0, 0.0)
    direction: int = Direction.ANY


NO_WAYPOINT = Waypoint()


class GoalId(NamedTuple):
    """Identity of a goal; waypoint_id 0: none."""

    requester: str = ""
    waypoint_id: int = 0
    attempt: int = 0


NO_GOAL_ID = GoalId()


@dataclass(frozen=True)
class Goal:
    """The waypoint that the motion planner drives to.

    Attributes:
        attempt: grows each time a waypoint is taken up, so that one that is taken up again is a new goal.
    """

    waypoint: Waypoint = NO_WAYPOINT
    attempt: int = 0

    @property
    def id(self) -> GoalId:
        """What the motion planner echoes; NO_GOAL_ID when there is nowhere to go."""
        waypoint = self.waypoint
        return GoalId(waypoint.requester, waypoint.id, self.attempt) if waypoint.id else NO_GOAL_ID


NO_GOAL = Goal()


@dataclass(frozen=True)
class GoalReport:
    """What the motion planner says of a goal."""

    goal_id: GoalId = NO_GOAL_ID
    result: Result = Result.IDLE
    message: Problem = NO_PROBLEM

    def is_about(self, goal: Goal) -> bool:
        """True when it speaks of this goal, and there is one."""
        return goal.id != NO_GOAL_ID and self.goal_id == goal.id


@dataclass(frozen=True)
class Press:
    """One press of buttons of the Remote key that an application wants.

    Attributes:
        id: the application's own number, which counts up; 0: no press. One that is repeated never presses twice.
        session_id: of the application; session and id together tell presses apart.
        buttons: numbers of the buttons, pressed together.
        strength: 0 no travel, 1 full travel.
        duration_s: time to hold; 0: the key's default.
    """

    id: int = 0
    session_id: int = 0
    buttons: Tuple[int, ...] = ()
    strength: float = 1.0
    duration_s: float = 0.0


NO_PRESS = Press()


@dataclass(frozen=True)
class PressReport:
    """One press as it went: times on the robot's clock, and why not when it was not carried out."""

    id: int
    session_id: int
    start_ns: int
    end_ns: int
    error: Problem = NO_PROBLEM


@dataclass(frozen=True)
class DesiredState:
    """What the robot shall do now, as the dispatcher makes it of the Commands; the defaults hold when it is silent.

    Attributes:
        session_id: application in control, 0 for none.
        link_alive: False when the link is silent for longer than its limit.
        stop: the robot shall stand; always True while the link is not alive.
        waypoint: where the Operator wants the robot.
        max_speed_mps: above 0 in a message of the dispatcher.
        key_height_m: Remote key above ground; NaN: as it is.
        press: the newest press.
        map_car_id, check_car_id: requests to map the Car again and to check its frame, 0: none.
        resume_hold_id: hold that the Operator has released, 0: none.
        area_problem: why the robot neither maps nor tests for want of a test area.
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
