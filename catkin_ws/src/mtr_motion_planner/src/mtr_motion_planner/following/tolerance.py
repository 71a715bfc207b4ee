"""Distance of the robot from its goal, and the resulting verdict."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional

from mtr_core.problems import Problem
from mtr_core.se2 import Pose2

from .. import problems
from ..parameters import Arrival

# Out of tolerance, but near enough for a measurement if no correction helped.
NEAR_M = 0.10
NEAR_RAD = math.radians(5.0)
# A robot that was displaced this far after it had settled drives back.
DISPLACED_M = 0.15
DISPLACED_RAD = math.radians(5.0)


@dataclass(frozen=True)
class Miss:
    """Distance and heading error at the goal, and the verdict."""

    distance_m: float
    heading_rad: float
    is_within: bool

    @property
    def is_near(self) -> bool:
        """True when the robot may stay although it is out of tolerance."""
        return self.distance_m <= NEAR_M and abs(self.heading_rad) <= NEAR_RAD


def miss_of(goal: Pose2, pose: Pose2, arrival: Arrival) -> Miss:
    """Return the distance and heading error of pose at goal."""
    at = goal.inverse() @ pose
    within = (abs(at.x) <= arrival.goal_along_m and abs(at.y) <= arrival.goal_across_m
              and abs(at.heading) <= arrival.goal_heading_rad)
    return Miss(math.hypot(at.x, at.y), at.heading, within)


def problem_of_miss(miss: Miss, corrections: int) -> Problem:
    """Return the sentence for the Operator."""
    return problems.OFF_GOAL(corrections=corrections, distance_m=miss.distance_m,
                             turn_deg=math.degrees(abs(miss.heading_rad)))


def was_displaced(settled_at: Optional[Pose2], pose: Pose2) -> bool:
    """Return True if the robot is no longer at the pose at which it had settled."""
    if settled_at is None:
        return True
    moved = settled_at.inverse() @ pose
    return math.hypot(moved.x, moved.y) > DISPLACED_M or abs(moved.heading) > DISPLACED_RAD
