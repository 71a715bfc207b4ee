"""What the planner has in mind, as lines for people who look."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Optional, Tuple

from mtr_core.se2 import Pose2

from .inputs import Point
from .parameters import MotionParameters
from .planner import MotionPlanner

ROUND_STEPS = 8


@dataclass(frozen=True)
class PlanPicture:
    """Lines in map or in the Car's frame.

    Attributes:
        keep_out: into what the robot's footprint is never led; closed.
        trajectory: where the robot is to be, and how fast in m/s.
        reference: where it is to be now.
        goal: of base_link.
    """

    in_car_frame: bool
    keep_out: Tuple[Point, ...]
    trajectory: Tuple[Tuple[float, float, float], ...]
    reference: Optional[Pose2]
    goal: Pose2


def picture_of(planner: MotionPlanner, parameters: MotionParameters) -> Optional[PlanPicture]:
    """The present picture; None when the robot goes nowhere."""
    site, follower = planner.site, planner.follower
    if site is None:
        return None
    zone = site.keep_out.outline.buffer(parameters.margins.keep_out_m, ROUND_STEPS)
    parts = follower.plan.parts if follower else ()
    trajectory = tuple((float(x), float(y), abs(float(speed))) for part in parts for (x, y, _), speed in zip(
        part.trajectory.poses[::5], part.trajectory.linear[::5]))
    return PlanPicture(site.in_car_frame, tuple(zone.exterior.coords), trajectory,
                   follower.reference().pose if follower else None,
                   site.goal @ parameters.slip.base_from_centre.inverse())
