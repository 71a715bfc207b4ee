"""Pieces of a drive and a controller that follows them on the true pose, because only localization is evaluated."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import List, NamedTuple, Tuple, Union

from mtr_core.se2 import Pose2, wrap_angle

Point = Tuple[float, float]
Velocity = Tuple[float, float]

ACCELERATION_MPS2, TURN_ACCELERATION_RADPS2 = 0.6, 1.5
MAX_TURN_RADPS = 0.8
ARRIVAL_M, ARRIVAL_RAD = 0.01, 0.01
LOOK_AHEAD_M = 0.5
CROSS_GAIN_PER_M, HEADING_GAIN_PER_S = 3.0, 2.5


class StandLeg(NamedTuple):
    """The robot is stopped."""

    duration_s: float


class TurnLeg(NamedTuple):
    """Turn on the spot to a heading in frame car."""

    heading: float


class StraightLeg(NamedTuple):
    """Straight line to a point in frame car. backwards: the robot drives in reverse."""

    to: Point
    speed_mps: float
    backwards: bool = False


class PathLeg(NamedTuple):
    """Forward drive along a polyline in frame car; corners are cut."""

    points: Tuple[Point, ...]
    speed_mps: float


class LiftLeg(NamedTuple):
    """A person lifts the robot and puts it down to its left, turned."""

    aside_m: float
    turn_rad: float


class CarryLeg(NamedTuple):
    """A person carries the robot to a random free place and turns it; the drive's seed determines where."""


class WanderLeg(NamedTuple):
    """Random drive near the Car; the drive's seed determines it."""

    duration_s: float


# Legs that LegFollower handles.
FollowedLeg = Union[StandLeg, TurnLeg, StraightLeg, PathLeg, LiftLeg, CarryLeg]
# One piece of a drive.
Leg = Union[FollowedLeg, WanderLeg]


def leg_name(leg: Leg) -> str:
    """Return the leg's name in a drive's files: stand, turn, straight, path, lift, carry or wander."""
    return type(leg).__name__[:-len("Leg")].lower()


class LegFollower:
    """Follows one leg from its initial pose."""

    def __init__(self, leg: FollowedLeg, start: Pose2, period_s: float):
        self._leg, self._start, self._period_s = leg, start, period_s
        self._elapsed_s = self._speed = self._turning = 0.0
        self._ahead: List[Point] = [(start.x, start.y), *leg.points] if isinstance(leg, PathLeg) else []

    def update(self, pose: Pose2) -> Tuple[Velocity, bool]:
        """Return the command for the true pose, and whether the leg is finished."""
        self._elapsed_s += self._period_s
        if isinstance(self._leg, (LiftLeg, CarryLeg)):
            return (0.0, 0.0), True
        if isinstance(self._leg, StandLeg):
            return (0.0, 0.0), self._elapsed_s >= self._leg.duration_s
        if isinstance(self._leg, TurnLeg):
            return self._turn(wrap_angle(self._leg.heading - pose.heading))
        if isinstance(self._leg, StraightLeg):
            return self._straight(self._leg, pose)
        return self._along(self._leg, pose)

    def _turn(self, error: float) -> Tuple[Velocity, bool]:
        wanted = math.copysign(min(MAX_TURN_RADPS, math.sqrt(2.0 * TURN_ACCELERATION_RADPS2 * 0.5 * abs(error))), error)
        step = TURN_ACCELERATION_RADPS2 * self._period_s
        self._turning += max(-step, min(step, wanted - self._turning))
        done = abs(error) < ARRIVAL_RAD
        return (0.0, 0.0 if done else self._turning), done

    def _straight(self, leg: StraightLeg, pose: Pose2) -> Tuple[Velocity, bool]:
        sign = -1.0 if leg.backwards else 1.0
        way = math.atan2(leg.to[1] - self._start.y, leg.to[0] - self._start.x)
        ahead, aside = Pose2(leg.to[0], leg.to[1], way).inverse().apply(pose.x, pose.y)
        heading = wrap_angle(pose.heading - way - (math.pi if leg.backwards else 0.0))
        done = -ahead < ARRIVAL_M
        speed = sign * self._ramp(leg.speed_mps, -ahead)
        turning = -HEADING_GAIN_PER_S * heading - CROSS_GAIN_PER_M * speed * aside
        return ((0.0, 0.0) if done else (speed, _clip(turning, MAX_TURN_RADPS))), done

    def _along(self, leg: PathLeg, pose: Pose2) -> Tuple[Velocity, bool]:
        goal = self._look_ahead(pose)
        left_m = _length([(pose.x, pose.y), *self._ahead[1:]])
        x, y = pose.inverse().apply(*goal)
        distance = math.hypot(x, y)
        curvature = 2.0 * y / max(distance * distance, 0.01)
        done = left_m < 2.0 * ARRIVAL_M or (len(self._ahead) == 2 and x < 0.0)
        speed = self._ramp(min(leg.speed_mps, MAX_TURN_RADPS / max(abs(curvature), 1e-6)), left_m)
        return ((0.0, 0.0) if done else (speed, _clip(speed * curvature, MAX_TURN_RADPS))), done

    def _look_ahead(self, pose: Pose2) -> Point:
        """Return the point of the polyline at the look-ahead distance from the robot; remove the points that were
        passed."""
        while len(self._ahead) > 2 and math.hypot(self._ahead[1][0] - pose.x,
                                                  self._ahead[1][1] - pose.y) < LOOK_AHEAD_M:
            self._ahead.pop(0)
        (x1, y1), (x2, y2) = self._ahead[0], self._ahead[1]
        length = max(math.hypot(x2 - x1, y2 - y1), 1e-9)
        along = ((pose.x - x1) * (x2 - x1) + (pose.y - y1) * (y2 - y1)) / length
        share = min(1.0, max(0.0, (along + LOOK_AHEAD_M) / length))
        return x1 + share * (x2 - x1), y1 + share * (y2 - y1)

    def _ramp(self, speed_mps: float, left_m: float) -> float:
        braking = math.sqrt(2.0 * ACCELERATION_MPS2 * max(0.0, left_m - 0.5 * ARRIVAL_M)) + 0.01
        self._speed = min(speed_mps, braking, self._speed + ACCELERATION_MPS2 * self._period_s)
        return self._speed


def _length(points: List[Point]) -> float:
    return sum(math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:]))


def _clip(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
