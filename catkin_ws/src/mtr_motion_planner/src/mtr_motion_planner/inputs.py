"""Inputs of the motion planner at a tick, and the check that they may be used."""
# SPDX-License-Identifier: Apache-2.0
import enum
import itertools
import math
from dataclasses import dataclass
from typing import NamedTuple, Optional, Tuple, TypeVar

from mtr_core.problems import NO_PROBLEM, Problem, ProblemError
from mtr_core.requests import Goal
from mtr_core.se2 import Pose2

from . import problems

Point = Tuple[float, float]

# Maximum speed of the platform by its data sheet.
MAX_SPEED_MPS = 2.0


@dataclass(frozen=True)
class DesiredMotion:
    """Goal and maximum speed, from the state machine.

    Attributes:
        follows_waypoints: the robot is not on hold and in the state that drives to a waypoint if one is set.
    """

    stamp_s: float
    goal: Goal
    max_speed_mps: float
    follows_waypoints: bool = False


@dataclass(frozen=True)
class RobotState:
    """Pose of base_link in map, and its motion.

    Attributes:
        message: why the pose is not valid.
        position_sigma_m: 1 sigma of the position in its least certain direction.
        heading_sigma: 1 sigma, rad.
    """

    stamp_s: float
    valid: bool
    pose: Pose2
    speed_mps: float
    yaw_rate_radps: float
    message: Problem = NO_PROBLEM
    is_degenerate: bool = False
    position_sigma_m: float = 0.0
    heading_sigma: float = 0.0

    def is_finite(self) -> bool:
        """True when pose, velocity and their uncertainty are finite."""
        return self.pose.is_finite() and all(map(math.isfinite, (
            self.speed_mps, self.yaw_rate_radps, self.position_sigma_m, self.heading_sigma)))


class SideSigmas(NamedTuple):
    """1 sigma in m of each side of the Car, across the side: errors of the Car's centre and size together."""

    front: float = 0.0
    rear: float = 0.0
    left: float = 0.0
    right: float = 0.0


EXACT_SIDES = SideSigmas()


@dataclass(frozen=True)
class EstimatedCar:
    """Pose of the Car in map, and its outline in its own frame. Before it is located both are a rough prior.

    Attributes:
        sides: 1 sigma of each side; not used if the Car is not located.
        heading_sigma: 1 sigma, rad.
        size: length and width, m; infinite if only the outline is known.
    """

    stamp_s: float
    located: bool
    pose: Pose2
    outline: Tuple[Point, ...]
    sides: SideSigmas = EXACT_SIDES
    heading_sigma: float = 0.0
    size: Tuple[float, float] = (math.inf, math.inf)

    def is_finite(self) -> bool:
        """True when pose, outline and, for a located Car, their uncertainty are finite."""
        sigmas = (*self.sides, self.heading_sigma) if self.located else ()
        return (self.pose.is_finite() and all(map(math.isfinite, (*itertools.chain(*self.outline), *sigmas)))
                and min(sigmas, default=0.0) >= 0.0)


class Zone(enum.IntEnum):
    """State of drive control's collision stop, with the numbers of DriveStatus."""

    CLEAR = 0
    SLOWED = 1
    BLOCKED = 2
    BLIND = 3


@dataclass(frozen=True)
class CollisionStop:
    """Drive control's collision stop; obstacle in base_link, m and rad, NaN without an obstacle."""

    stamp_s: float
    zone: Zone = Zone.CLEAR
    obstacle_m: float = math.nan
    obstacle_bearing: float = math.nan
    message: Problem = NO_PROBLEM


@dataclass(frozen=True)
class DrawnArea:
    """The Operator's test area, which drive control enforces: corners in map, m; empty: no bound."""

    corners: Tuple[Point, ...] = ()


NO_AREA = DrawnArea()


@dataclass(frozen=True)
class Inputs:
    """Newest message of each kind at a tick, None before the first; drive control's message is optional."""

    tick_s: float
    desired: Optional[DesiredMotion]
    robot: Optional[RobotState]
    car: Optional[EstimatedCar]
    collision_stop: Optional[CollisionStop] = None
    area: DrawnArea = NO_AREA


class InputsUnusable(ProblemError):
    """The inputs must not move the robot; the text states the cause."""


@dataclass(frozen=True)
class Situation:
    """Inputs that may move the robot: complete, recent and finite."""

    tick_s: float
    desired: DesiredMotion
    robot: RobotState
    car: EstimatedCar
    collision_stop: Optional[CollisionStop]
    area: DrawnArea = NO_AREA


Stamped = TypeVar("Stamped", DesiredMotion, RobotState, EstimatedCar)


def situation_of(inputs: Inputs, age_limit_s: float) -> Situation:
    """Return the checked inputs; InputsUnusable if they must not move the robot."""
    now = Situation(inputs.tick_s, _fresh("order", inputs.desired, inputs.tick_s, age_limit_s),
                    _fresh("pose", inputs.robot, inputs.tick_s, age_limit_s),
                    _fresh("position of the Car", inputs.car, inputs.tick_s, age_limit_s), inputs.collision_stop,
                    inputs.area)
    fault = _value_fault(now.desired, now.robot, now.car)
    if fault:
        raise InputsUnusable(fault)
    return now


def _fresh(name: str, message: Optional[Stamped], tick_s: float, age_limit_s: float) -> Stamped:
    if message is None:
        raise InputsUnusable(problems.INPUT_MISSING(what=name))
    age_s = tick_s - message.stamp_s
    if not age_s <= age_limit_s:
        raise InputsUnusable(problems.INPUT_OLD(what=name, age_s=age_s, limit_s=age_limit_s))
    if age_s < -age_limit_s:
        raise InputsUnusable(problems.INPUT_IN_FUTURE(what=name, ahead_s=-age_s, limit_s=age_limit_s))
    return message


def _value_fault(desired: DesiredMotion, robot: RobotState, car: EstimatedCar) -> Problem:
    if not robot.valid:
        cause = robot.message
        return problems.POSITION_UNKNOWN_BECAUSE(cause=cause) if cause else problems.POSITION_UNKNOWN()
    if not robot.is_finite():
        return problems.POSE_NOT_A_NUMBER()
    if not car.is_finite():
        return problems.CAR_NOT_A_NUMBER()
    if not 0.0 < desired.max_speed_mps <= MAX_SPEED_MPS:
        return problems.MAXIMUM_SPEED(value=desired.max_speed_mps, high=MAX_SPEED_MPS)
    return NO_PROBLEM
