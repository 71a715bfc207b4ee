"""What the Car locator is told at a tick, and what it says."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple

from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Result

from .measure.car_fit import CarFit
from .rectangle import Rectangle
from .scan import Scan
from .survey.survey import MapPhase, Place, SurfaceMap
from .watch.self_check import CheckReport

NO_MOTION = Pose2(0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Order:
    """What the state machine wants: mapping or checking, under which ids, and the goal that the motion planner has."""

    mapping: bool
    map_car_id: int
    goal_id: int = 0
    goal_x: float = 0.0
    goal_y: float = 0.0
    checking: bool = False
    check_car_id: int = 0


@dataclass(frozen=True)
class Drive:
    """What the motion planner says of a goal."""

    goal_id: int
    result: Result


@dataclass(frozen=True)
class Inputs:
    """Everything that is new at a tick; all poses up to it have been added."""

    now_s: float
    order: Optional[Order] = None
    drive: Optional[Drive] = None
    scans: Sequence[Scan] = ()
    surfaces: Optional[SurfaceMap] = None


@dataclass(frozen=True)
class Estimate:
    """What is known of the Car at a tick.

    Attributes:
        sigmas: (x, y, heading) in the Car's frame.
        revision: counts the frames that the Car has had, 0 before the first.
        correction: the present frame in the previous one.
        phase: what localization's mapper shall do.
        map_id: with which map; each survey has its own, also when an order is tried again.
        places: where the robot shall still go for the locator.
        fit: the Car once it was found.
    """

    state: CarState
    rectangle: Rectangle
    outline: Tuple[Tuple[float, float], ...]
    sigmas: Tuple[float, float, float]
    length_sigma: float
    width_sigma: float
    place: Optional[Place]
    map_car_id: int
    message: str
    revision: int = 0
    correction: Pose2 = NO_MOTION
    phase: MapPhase = MapPhase.IDLE
    map_id: int = 0
    check: CheckReport = CheckReport()
    places: Tuple[Pose2, ...] = ()
    fit: Optional[CarFit] = None


def result_at(place: Optional[Place], order: Optional[Order], drive: Optional[Drive]) -> Result:
    """The motion planner's word on a place, which the state machine gives a goal id of its own."""
    if place is None or drive is None or order is None or order.goal_id == 0 or drive.goal_id != order.goal_id:
        return Result.IDLE
    is_here = abs(order.goal_x - place.pose.x) < 1e-6 and abs(order.goal_y - place.pose.y) < 1e-6
    return drive.result if is_here else Result.IDLE
