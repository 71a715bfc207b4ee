"""Inputs and output of the Car locator at a tick."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple

from mtr_core.problems import Problem
from mtr_core.requests import NO_GOAL, Goal, GoalReport, Waypoint
from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Result

from .measure.car_fit import UNKNOWN_SIDES, CarFit, SideSigmas
from .rectangle import Point, Rectangle
from .scan import Scan
from .survey.surface_map import MapPhase, SurfaceMap
from .watch.self_check import CheckReport

NO_MOTION = Pose2(0.0, 0.0, 0.0)


@dataclass(frozen=True)
class LocatorTask:
    """Request of the state machine: mapping or checking, their ids, and the goal of the motion planner."""

    mapping: bool
    map_car_id: int
    goal: Goal = NO_GOAL
    checking: bool = False
    check_car_id: int = 0


@dataclass(frozen=True)
class Inputs:
    """New inputs of a tick; all poses up to it have already been added."""

    now_s: float
    task: Optional[LocatorTask] = None
    motion: GoalReport = GoalReport()
    scans: Sequence[Scan] = ()
    surfaces: Optional[SurfaceMap] = None


@dataclass(frozen=True)
class Estimate:
    """State of knowledge about the Car at a tick.

    Attributes:
        sigmas: (x, y, heading) in the Car's frame.
        revision: number of frames that the Car has had, 0 before the first one.
        correction: the present frame in the previous one.
        phase: order to the mapper of localization.
        map_id: id of the map; each survey has its own one, also when mapping is repeated.
        places: remaining places of the robot for the locator.
        fit: the Car, once it was found.
        map_revision: of the localization map that the Car is in, once it was found.
        side_sigmas: 1 sigma of each side of the rectangle, of centre and size together.
    """

    state: CarState
    rectangle: Rectangle
    outline: Tuple[Point, ...]
    sigmas: Tuple[float, float, float]
    length_sigma: float
    width_sigma: float
    waypoint: Optional[Waypoint]
    map_car_id: int
    message: Problem
    revision: int = 0
    correction: Pose2 = NO_MOTION
    phase: MapPhase = MapPhase.IDLE
    map_id: int = 0
    check: CheckReport = CheckReport()
    places: Tuple[Pose2, ...] = ()
    fit: Optional[CarFit] = None
    map_revision: int = 0
    side_sigmas: SideSigmas = UNKNOWN_SIDES


def result_at(waypoint: Optional[Waypoint], task: Optional[LocatorTask], motion: GoalReport) -> Result:
    """Return the motion planner's result for a waypoint; IDLE while its goal is another one."""
    if waypoint is None or task is None or not motion.is_about(task.goal):
        return Result.IDLE
    goal = task.goal.waypoint
    return motion.result if (goal.requester, goal.id) == (waypoint.requester, waypoint.id) else Result.IDLE
