"""Controllers that follow one leg of a plan each."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Union

from mtr_core.se2 import wrap_angle

from .inputs import RobotState
from .parameters import MotionParameters
from .plan import Leg, Route, Straight, Turn
from .profile import approach_speed, clamp
from .pursuit import Polyline

# Slowest motion that still ends a leg, and the rest at which it is cut.
CREEP_MPS, CREEP_RADPS = 0.03, 0.05
STOP_AT_M, STOP_AT_RAD = 0.006, math.radians(0.4)
# A robot slower than this stands.
STANDING_MPS, STANDING_RADPS = 0.02, 0.03
# Heading loop, 1/s, and lateral offset to change of heading, rad/m, on a straight leg.
HEADING_GAIN = 2.5
OFFSET_GAIN_RADPM = 1.5
OFFSET_HEADING_MAX_RAD = 0.3
# The offset no longer bends the heading on the last stretch, so that the robot arrives aligned.
ALIGN_OVER_M = 0.25
TURNED_RAD = math.radians(6.0)
YAW_RESERVE = 0.8


@dataclass(frozen=True)
class Wanted:
    """Velocity that a leg asks for before the limits of acceleration, and what is left of it."""

    linear_mps: float
    angular_radps: float
    remaining_m: float
    finished: bool


def stands(robot: RobotState) -> bool:
    """True when the robot does not move."""
    return abs(robot.speed_mps) < STANDING_MPS and abs(robot.yaw_rate_radps) < STANDING_RADPS


class StraightTracker:
    """Drives along an axis with the heading held."""

    def __init__(self, leg: Straight, parameters: MotionParameters):
        self._leg, self._parameters = leg, parameters

    def step(self, robot: RobotState, max_speed_mps: float, _commanded_mps: float) -> Wanted:
        """Velocity for the robot's present state."""
        leg, limits = self._leg, self._parameters
        at = leg.end.inverse() @ robot.pose
        rest = -at.x * leg.sign
        speed = approach_speed(rest - STOP_AT_M, robot.speed_mps, limits.acceleration_mps2, CREEP_MPS)
        fade = max(0.0, min(1.0, rest / ALIGN_OVER_M))
        bend = -leg.sign * fade * clamp(OFFSET_GAIN_RADPM * at.y, OFFSET_HEADING_MAX_RAD)
        yaw_rate = clamp(HEADING_GAIN * wrap_angle(bend - at.heading), limits.max_angular_radps)
        finished = rest <= 2.0 * STOP_AT_M and stands(robot)
        if speed == 0.0:
            yaw_rate = 0.0
        return Wanted(leg.sign * min(speed, max_speed_mps), yaw_rate, max(rest, 0.0), finished)


class RouteTracker:
    """Follows a polyline towards a point ahead of the robot; corners become arcs, large turns are made standing."""

    def __init__(self, leg: Route, parameters: MotionParameters):
        self._line, self._sign, self._parameters = Polyline(leg.points), leg.sign, parameters
        self._turning = False

    def step(self, robot: RobotState, max_speed_mps: float, commanded_mps: float) -> Wanted:
        """Velocity for the robot's present state."""
        limits = self._parameters
        rest = self._line.advance(robot.pose.x, robot.pose.y)
        x, y = self._line.ahead(limits.lookahead_m)
        reach = max(math.hypot(x - robot.pose.x, y - robot.pose.y), 0.5 * limits.lookahead_m)
        error = self.error_to(robot, x, y)
        self._turning = abs(error) > (TURNED_RAD if self._turning else limits.turn_in_place_rad)
        if rest <= 2.0 * STOP_AT_M and stands(robot):
            return Wanted(0.0, 0.0, 0.0, True)
        if self._turning:
            return Wanted(0.0, turn_rate(error, robot, limits), rest, False)
        curvature = 2.0 * math.sin(error) / reach
        speed = approach_speed(rest - STOP_AT_M, robot.speed_mps, limits.acceleration_mps2, CREEP_MPS)
        speed = min(speed, max_speed_mps, YAW_RESERVE * limits.max_angular_radps / max(abs(curvature), 1e-6))
        return Wanted(self._sign * speed, curvature * abs(commanded_mps), rest, False)

    def error_to(self, robot: RobotState, x: float, y: float) -> float:
        """Change of heading that lets the leading side face the point."""
        bearing = math.atan2(y - robot.pose.y, x - robot.pose.x)
        return wrap_angle(bearing - robot.pose.heading + (0.0 if self._sign > 0 else math.pi))


class TurnTracker:
    """Turns on the spot."""

    def __init__(self, leg: Turn, parameters: MotionParameters):
        self._heading, self._parameters = leg.heading, parameters

    def step(self, robot: RobotState, _max_speed_mps: float, _commanded_mps: float) -> Wanted:
        """Velocity for the robot's present state."""
        error = wrap_angle(self._heading - robot.pose.heading)
        finished = abs(error) <= 0.8 * self._parameters.goal_heading_rad and stands(robot)
        return Wanted(0.0, turn_rate(error, robot, self._parameters), 0.0, finished)


def turn_rate(error: float, robot: RobotState, parameters: MotionParameters) -> float:
    """Yaw rate that ends a turn on the spot in time."""
    if abs(error) > math.radians(170.0) and abs(robot.yaw_rate_radps) > CREEP_RADPS:
        error = math.copysign(error, robot.yaw_rate_radps)
    rate = approach_speed(abs(error) - STOP_AT_RAD, robot.yaw_rate_radps, parameters.angular_acceleration_radps2,
                          CREEP_RADPS)
    return math.copysign(min(rate, parameters.max_angular_radps), error)


Tracker = Union[StraightTracker, RouteTracker, TurnTracker]


def tracker_of(leg: Leg, parameters: MotionParameters) -> Tracker:
    """Controller for a leg."""
    kinds = {Straight: StraightTracker, Route: RouteTracker, Turn: TurnTracker}
    return kinds[type(leg)](leg, parameters)
