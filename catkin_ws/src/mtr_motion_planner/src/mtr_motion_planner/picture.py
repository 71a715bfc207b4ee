"""The planner's state as lines for visualisation."""
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
        keep_out: zone that a plan's footprint never enters; closed.
        trajectory: planned positions, and the speed there in m/s.
        reference: current reference pose.
        goal: goal of base_link.
    """

    in_car_frame: bool
    keep_out: Tuple[Point, ...]
    trajectory: Tuple[Tuple[float, float, float], ...]
    reference: Optional[Pose2]
    goal: Pose2


def picture_of(planner: MotionPlanner, parameters: MotionParameters) -> Optional[PlanPicture]:
    """Return the current picture, or None without a goal."""
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
