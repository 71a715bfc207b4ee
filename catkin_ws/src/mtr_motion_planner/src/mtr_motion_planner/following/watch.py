"""Monitors the motion for a robot that is held up, and for one that is about to touch the Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional

import numpy as np

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.se2 import Pose2

from .. import problems
from ..geometry.keep_out import KeepOut, rows_of
from ..inputs import CollisionStop, RobotState, Zone
from ..parameters import MotionParameters
from .tracking import DELAY_S, Velocity

STALL_AFTER_S = 2.0
# Drive control resets its lock for an unresponsive base after one second without a motion request (kRestS).
REST_S = 2.0
MOVED_M, MOVED_RAD = 0.01, math.radians(1.0)
# The plan keeps the margins; half of the footprint's margin is reserved for control errors before the robot is stopped.
GUARD_SHARE = 0.5
# A pose with more room than the present one may be approached from anywhere.
OPENING_M = 0.002
SIDES = ((math.radians(45.0), "ahead"), (math.radians(135.0), "to the left"), (math.radians(180.0), "behind"))


class StallWatch:
    """Detects that the robot does not follow the command, and inserts a rest between two attempts."""

    def __init__(self) -> None:
        self._since_s: Optional[float] = None
        self._from: Optional[Pose2] = None

    def reset(self) -> None:
        """Reset the observation."""
        self._since_s = self._from = None

    def stalls(self, pose: Pose2, is_wanted: bool, now_s: float) -> bool:
        """Return True if motion was requested for a while without a change of the pose."""
        if not is_wanted or self._from is None or self._since_s is None or _has_moved(self._from, pose):
            self._since_s, self._from = now_s, pose
            return False
        return now_s - self._since_s > STALL_AFTER_S

    def rests(self, now_s: float) -> bool:
        """Return True for a while after each attempt to move that had no effect."""
        since_s = now_s if self._since_s is None else self._since_s + STALL_AFTER_S
        return now_s > since_s and (now_s - since_s) % (REST_S + STALL_AFTER_S) < REST_S


def _has_moved(before: Pose2, now: Pose2) -> bool:
    moved = before.inverse() @ now
    return math.hypot(moved.x, moved.y) > MOVED_M or abs(moved.heading) > MOVED_RAD


def is_heading_into(keep_out: KeepOut, pose: Pose2, robot: RobotState, wanted: Velocity, parameters: MotionParameters
                    ) -> bool:
    """Return True if the robot, braking now, would come too close to the Car and closer than it is."""
    speed = max(abs(robot.speed_mps), abs(wanted.linear_mps) * 0.1)
    reach = speed ** 2 / (2.0 * parameters.limits.acceleration_mps2) + speed * DELAY_S
    if wanted.linear_mps == 0.0 or keep_out.turn_distance(pose) > keep_out.robot.radius_m + reach + 0.1:
        return False
    sense = robot.speed_mps if abs(robot.speed_mps) > 0.05 else wanted.linear_mps
    stopped = pose @ Pose2(math.copysign(reach, sense), 0.0, 0.0)
    here, there = keep_out.room(np.concatenate((rows_of(pose), rows_of(stopped))))
    return bool(((there < -GUARD_SHARE * parameters.margins.keep_out_m) & (there < here - OPENING_M)).any())


def problem_of_drive(drive: CollisionStop) -> Problem:
    """Return the sentence about drive control's collision stop; no problem if the path is free."""
    if drive.zone == Zone.CLEAR:
        return NO_PROBLEM
    if drive.zone == Zone.BLIND:
        return drive.message or problems.LIDAR_SILENT()
    what = "blocked" if drive.zone == Zone.BLOCKED else "slowed"
    if not math.isfinite(drive.obstacle_m):
        return drive.message or problems.OBSTACLE(what=what)
    return problems.OBSTACLE_AT(what=what, distance_m=drive.obstacle_m, side=_side(drive.obstacle_bearing))


def _side(bearing: float) -> str:
    if not math.isfinite(bearing):
        return "away"
    side = next((name for limit, name in SIDES if abs(bearing) <= limit), "behind")
    return "to the right" if side == "to the left" and bearing < 0.0 else side
