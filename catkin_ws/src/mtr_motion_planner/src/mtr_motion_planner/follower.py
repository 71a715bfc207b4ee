"""Follows a plan leg by leg."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Optional

from .inputs import RobotState
from .parameters import MotionParameters
from .plan import Plan, Straight, Turn
from .tracking import RouteTracker, Wanted, tracker_of


class Follower:
    """Velocity wanted along a plan.

    Attributes:
        plan: the plan that is followed.
    """

    def __init__(self, plan: Plan, parameters: MotionParameters):
        self.plan = plan
        self._parameters = parameters
        self._index = 0
        self._tracker = tracker_of(plan.legs[0], parameters)

    def step(self, robot: RobotState, max_speed_mps: float, commanded_mps: float) -> Optional[Wanted]:
        """Velocity wanted now, None when all legs are finished."""
        while True:
            wanted = self._tracker.step(robot, max_speed_mps, commanded_mps)
            if not wanted.finished:
                rest = wanted.remaining_m + self.plan.length_after(self._index)
                return Wanted(wanted.linear_mps, wanted.angular_radps, rest, False)
            if self._index + 1 == len(self.plan.legs):
                return None
            self._index += 1
            self._tracker = tracker_of(self.plan.legs[self._index], self._parameters)

    def continues(self, robot: RobotState, commanded_mps: float) -> bool:
        """True when the first leg can be entered at the commanded speed, without a stop."""
        leg = self.plan.legs[0]
        if isinstance(leg, Turn):
            return False
        if commanded_mps * leg.sign < 0.0:
            return False
        if isinstance(leg, Straight):
            return self._can_stop_on(math.dist(*leg.points), commanded_mps)
        x, y = leg.points[1] if len(leg.points) > 2 else leg.points[-1]
        error = RouteTracker(leg, self._parameters).error_to(robot, x, y)
        return abs(error) < self._parameters.turn_in_place_rad

    def _can_stop_on(self, length_m: float, speed_mps: float) -> bool:
        return speed_mps ** 2 <= 2.0 * self._parameters.acceleration_mps2 * length_m
