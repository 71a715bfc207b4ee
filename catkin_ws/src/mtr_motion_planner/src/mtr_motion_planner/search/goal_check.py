"""Checks whether the robot may stop at a goal next to the Car, and recommends a remedy."""
# SPDX-License-Identifier: Apache-2.0
import math

from shapely.geometry import Point as ShapelyPoint

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.se2 import Pose2

from .. import problems
from ..geometry.growth import MARGIN_SIGMAS
from ..geometry.keep_out import KeepOut, rows_of

SENTENCES = {"front": problems.FRONT_UNCERTAIN, "rear": problems.REAR_UNCERTAIN, "left": problems.SIDE_UNCERTAIN,
             "right": problems.SIDE_UNCERTAIN}


def problem_at(goal: Pose2, keep_out: KeepOut) -> Problem:
    """Return why the robot must not stop at the goal; no problem if it may."""
    room_m = room_at(goal, keep_out)
    if room_m >= 0.0:
        return NO_PROBLEM
    exact = keep_out.without_growth()
    left_m = exact.clearance(goal)
    low_m = left_m - room_m
    if room_at(goal, exact) < 0.0:
        return problems.GOAL_TOO_CLOSE(left_m=left_m, low_m=left_m - room_at(goal, exact))
    side = _side_before(goal, keep_out)
    sigma_m = keep_out.bounds.growth._asdict()[side] / MARGIN_SIGMAS
    own_sigma_m = keep_out.bounds.own_sigma_m
    if own_sigma_m > math.sqrt(0.5) * sigma_m:
        return problems.OWN_POSITION_UNCERTAIN(sigma_m=own_sigma_m, left_m=left_m)
    return SENTENCES[side](sigma_m=sigma_m, left_m=left_m, low_m=low_m)


def room_at(pose: Pose2, keep_out: KeepOut) -> float:
    """Return the robot's distance from the Car minus the required distance; negative: too close."""
    room_m = float(keep_out.room(rows_of(pose)).min())
    if keep_out.outline.contains(ShapelyPoint(pose.x, pose.y)):
        return min(room_m, -keep_out.least_clearance_m)
    return room_m


def _side_before(goal: Pose2, keep_out: KeepOut) -> str:
    """Return the side in front of the robot; at a corner the side that has grown more."""
    growth = keep_out.bounds.growth._asdict()
    gaps_m = keep_out.gaps_beyond(goal)._asdict()
    before = [side for side, gap_m in gaps_m.items() if gap_m > -growth[side]] or list(gaps_m)
    return max(before, key=lambda side: growth[side])
