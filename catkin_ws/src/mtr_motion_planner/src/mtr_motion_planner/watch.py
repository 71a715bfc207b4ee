"""Watches the motion: a robot that is held, and one that is about to touch the Car."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional

from mtr_core.se2 import Pose2

from .inputs import RobotState
from .obstacle import CarObstacle
from .parameters import MotionParameters
from .profile import DELAY_S
from .ramp import Ramp
from .tracking import Wanted

STALL_AFTER_S = 2.0
STALL_MPS, STALL_RADPS = 0.03, 0.05
MOVED_M, MOVED_RAD = 0.01, math.radians(1.0)
# The plan keeps 0.10 m; half of it is left for errors of control before the robot is stopped.
GUARD_SHARE = 0.5
# A pose that leaves more room than the present one may be driven to from anywhere.
OPENING_M = 0.002


class StallWatch:
    """Notices that the robot does not follow the command."""

    def __init__(self) -> None:
        self._since_s: Optional[float] = None
        self._from: Optional[Pose2] = None

    def reset(self) -> None:
        """Forget what was seen."""
        self._since_s = self._from = None

    def stalls(self, robot: RobotState, ramp: Ramp, now_s: float) -> bool:
        """True when motion has been commanded for a while and the pose stayed."""
        commanded = abs(ramp.linear_mps) >= STALL_MPS or abs(ramp.angular_radps) >= STALL_RADPS
        if not commanded or self._from is None or self._since_s is None or self._moved(robot.pose):
            self._since_s, self._from = now_s, robot.pose
            return False
        return now_s - self._since_s > STALL_AFTER_S

    def _moved(self, pose: Pose2) -> bool:
        moved = self._from.inverse() @ pose
        return math.hypot(moved.x, moved.y) > MOVED_M or abs(moved.heading) > MOVED_RAD


def is_heading_into(obstacle: CarObstacle, robot: RobotState, wanted: Wanted, parameters: MotionParameters) -> bool:
    """True when the robot, braking now, would come too close to the Car and closer than it is."""
    speed = max(abs(robot.speed_mps), abs(wanted.linear_mps) * 0.1)
    reach = speed ** 2 / (2.0 * parameters.acceleration_mps2) + speed * DELAY_S
    if wanted.linear_mps == 0.0 or obstacle.distance_of_point(robot.pose) > parameters.turn_radius_m + reach + 0.1:
        return False
    sign = robot.speed_mps if abs(robot.speed_mps) > 0.05 else wanted.linear_mps
    ahead = robot.pose @ Pose2(math.copysign(reach, sign), 0.0, 0.0)
    clearance = obstacle.clearance(ahead)
    return (clearance < GUARD_SHARE * parameters.keep_out_m
            and clearance < obstacle.clearance(robot.pose) - OPENING_M)
