"""Follows a plan part by part; waits for a robot that is held up, and then retimes the rest."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Optional

from mtr_core.se2 import Pose2

from ..inputs import RobotState
from ..limits import MotionLimits
from ..parameters import MotionParameters
from ..timing.plan import Moving, Plan, PlanPart
from ..timing.trajectory import Reference
from .tolerance import miss_of
from .tracking import DELAY_S, Velocity, deviation, tracked

# The reference waits for a robot that lags by more than this; the rest is then retimed from the robot's own speed.
LAG_M, LAG_RAD = 0.08, 0.15
RETIME_AFTER_S = 0.2
# At a larger distance from its reference the robot needs another plan.
LOST_ALONG_M, LOST_ACROSS_M, LOST_RAD = 0.40, 0.15, math.radians(25.0)
# A slower robot counts as stopped.
STANDING_MPS, STANDING_RADPS = 0.02, 0.03
# Time of the controller after the end of the last trajectory to remove the remaining error.
SETTLE_S = 0.8
# Reported remaining distance while the robot still turns on the spot.
MIN_REMAINING_M = 0.001


@dataclass(frozen=True)
class FollowerOutput:
    """Velocity, remaining distance (0: the reference has arrived), and result of the plan."""

    velocity: Velocity
    remaining_m: float
    finished: bool = False
    lost: bool = False


def stands(robot: RobotState) -> bool:
    """Return True if the robot is stopped."""
    return abs(robot.speed_mps) < STANDING_MPS and abs(robot.yaw_rate_radps) < STANDING_RADPS


class Follower:
    """Reference of a plan and the velocity that follows it; all poses in the plan's frame.

    Attributes:
        plan: the followed plan.
    """

    def __init__(self, plan: Plan, parameters: MotionParameters, speed: float):
        self.plan = plan
        self._parameters, self._speed = parameters, speed
        self._index, self._time_s, self._pace = 0, 0.0, 1.0
        self._part: Optional[PlanPart] = plan.parts[0] if plan.parts else None
        self._waited_s = 0.0
        self._cannot_go_on = False

    @property
    def _limits(self) -> MotionLimits:
        return self._parameters.limits

    @property
    def remaining_m(self) -> float:
        """Remaining distance in m; 0 if the reference has arrived."""
        if self._part is None or self._is_over():
            return 0.0
        done = 0.0 if self._part.is_on_the_spot else self.reference().way
        return max(self._part.trajectory.length_m - done + self.plan.length_after(self._index), MIN_REMAINING_M)

    def reference(self, ahead_s: float = 0.0) -> Reference:
        """Return the reference now, or after a time within the present part."""
        if self._part is None:
            return Reference(self.plan.goal, 0.0, 0.0, 0.0)
        return self._part.trajectory.at(self._time_s + ahead_s)

    def moving(self, ahead_s: float = 0.0) -> Moving:
        """Return the reference as the start of another plan."""
        then = self._later(ahead_s)
        return Moving(then.pose, then.linear_mps, then.angular_radps)

    def _later(self, ahead_s: float) -> Reference:
        """Return the reference after a time in which the robot keeps up with it, also in the next parts."""
        index, time_s = self._index, self._time_s + ahead_s
        part = self._part
        while part is not None and time_s >= part.trajectory.duration_s and index + 1 < len(self.plan.parts):
            time_s -= part.trajectory.duration_s
            index += 1
            part = self.plan.parts[index]
        return self.reference() if part is None else part.trajectory.at(time_s)

    def is_near(self, pose: Pose2) -> bool:
        """Return True if the robot is close enough to its reference to continue from there."""
        error = deviation(self.reference(), pose)
        return abs(error.x) < LOST_ALONG_M and abs(error.y) < LOST_ACROSS_M and abs(error.heading) < LOST_RAD

    def set_speed(self, speed: float) -> bool:
        """Change the speed limit; return False if this requires another plan."""
        if speed == self._speed or self._part is None:
            return True
        self._speed = speed
        if self._index + 1 < len(self.plan.parts):
            return False
        now = self.reference()
        present = now.angular_radps if self._part.is_on_the_spot else now.linear_mps
        return self._retime(self._part, now.way, abs(present))

    def step(self, pose: Pose2, robot: RobotState, passed_s: float) -> FollowerOutput:
        """Return the velocity, passed_s after the last step."""
        if not self.is_near(pose):
            return FollowerOutput(Velocity(), self.remaining_m, lost=True)
        if self._part is not None:
            self._advance(self._part, pose, robot, passed_s)
        if self._cannot_go_on:
            return FollowerOutput(Velocity(), self.remaining_m, lost=True)
        now = self.reference()
        if self._is_over() and self._has_settled(pose, robot):
            return FollowerOutput(Velocity(), 0.0, finished=True)
        tracking = tracked(now, self.reference(DELAY_S), pose, self._speed)
        self._pace = tracking.pace
        return FollowerOutput(tracking.velocity, self.remaining_m)

    def _advance(self, part: PlanPart, pose: Pose2, robot: RobotState, passed_s: float) -> None:
        now = self.reference()
        lag = part.motion.lag(deviation(now, pose))
        limit = LAG_RAD if part.is_on_the_spot else LAG_M
        self._waited_s = self._waited_s + passed_s if lag > limit else 0.0
        if self._waited_s > RETIME_AFTER_S:
            self._waited_s = 0.0
            measured, planned = ((robot.yaw_rate_radps, now.angular_radps) if part.is_on_the_spot
                                 else (robot.speed_mps, now.linear_mps))
            self._cannot_go_on = not self._retime(part, now.way - lag, min(abs(measured), abs(planned)))
        elif lag <= limit:
            self._time_s += self._pace * passed_s
        self._begin_parts_that_are_due()

    def _begin_parts_that_are_due(self) -> None:
        while (self._part is not None and self._time_s >= self._part.trajectory.duration_s
               and self._index + 1 < len(self.plan.parts)):
            self._time_s -= self._part.trajectory.duration_s
            self._index += 1
            self._part = self.plan.parts[self._index]

    def _retime(self, part: PlanPart, way: float, speed: float) -> bool:
        rest = part.motion.from_way(max(way, 0.0))
        trajectory = None if rest is None else rest.timed(self._limits, self._speed, speed)
        if rest is None or trajectory is None:
            return False
        self._part, self._time_s = PlanPart(rest, trajectory), 0.0
        return True

    def _is_over(self) -> bool:
        return self._part is None or (self._index + 1 == len(self.plan.parts)
                                      and self._time_s >= self._part.trajectory.duration_s)

    def _has_settled(self, pose: Pose2, robot: RobotState) -> bool:
        if not stands(robot):
            return False
        late = self._part is None or self._time_s >= self._part.trajectory.duration_s + SETTLE_S
        return late or miss_of(self.plan.goal, pose, self._parameters.arrival).is_within
