"""Motions and their trajectories: where the robot is to be, and how fast, at each instant until it stands."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from functools import cached_property
from typing import List, Optional, Union

import numpy as np

from mtr_core.se2 import Pose2, wrap_angle

from ..geometry.curve import STEP_M, Curve
from ..limits import MotionLimits
from .speeds import SAMPLE_S, history_way, speeds_along, speeds_on, ways_at_samples

PIVOT_STEP_RAD = 0.02
# A robot slower than this is taken to stand.
SLOWEST_MPS, SLOWEST_RADPS = 0.02, 0.03


@dataclass(frozen=True)
class Reference:
    """Pose and velocity to have at an instant."""

    pose: Pose2
    linear_mps: float
    angular_radps: float
    way: float  # m or, on the spot, rad since the motion's beginning


class Trajectory:
    """Samples of a motion; constant after their end.

    Attributes:
        duration_s: until the robot is to stand.
        length_m: way of the turn centre.
        ways, poses, linear, angular: at each sample; poses are rows of x, y, heading.
    """

    def __init__(self, ways: np.ndarray, poses: np.ndarray, linear: np.ndarray, angular: np.ndarray, length_m: float):
        self.duration_s = SAMPLE_S * (len(ways) - 1)
        self.length_m = length_m
        self.ways, self.poses, self.linear, self.angular = ways, poses, linear, angular

    @cached_property
    def _rows(self) -> List[List[float]]:
        return np.column_stack((self.ways, self.poses, self.linear, self.angular)).tolist()

    def at(self, time_s: float) -> Reference:
        """Reference at a time since the beginning."""
        place = min(max(time_s, 0.0) / SAMPLE_S, len(self._rows) - 1.0)
        index = min(int(place), len(self._rows) - 2)
        share = place - index
        way, x, y, heading, linear, angular = (
            a + share * (b - a) for a, b in zip(self._rows[index], self._rows[index + 1]))
        if time_s >= self.duration_s:
            linear = angular = 0.0
        return Reference(Pose2(x, y, wrap_angle(heading)), linear, angular, way)


@dataclass(frozen=True)
class Drive:
    """Follow a curve; sign -1: the rear leads."""

    curve: Curve
    sign: int

    @property
    def length_m(self) -> float:
        """Way of the turn centre."""
        return self.curve.length

    def timed(self, limits: MotionLimits, max_speed: float, start_speed: float = 0.0) -> Optional[Trajectory]:
        """Trajectory from the beginning; None when the robot cannot stop on the curve from the start speed."""
        curve = self.curve
        start_speed = start_speed if start_speed > SLOWEST_MPS else 0.0
        first = math.ceil(history_way(start_speed, limits.ramp_s) / curve.step_m)
        if first + 1 >= len(curve.x):
            return None
        speeds = speeds_on(curve.after(first), limits, max_speed, start_speed)
        if speeds is None:
            return None
        return self._sampled(ways_at_samples(speeds, curve.step_m, first * curve.step_m, limits.ramp_s))

    def _sampled(self, ways: np.ndarray) -> Trajectory:
        curve = self.curve
        along = curve.step_m * np.arange(len(curve.x))
        speed = np.gradient(ways, SAMPLE_S)
        heading = np.interp(ways, along, curve.heading)
        angular = np.interp(ways, along, curve.curvature) * speed
        turned = heading if self.sign > 0 else heading + math.pi
        poses = np.column_stack((np.interp(ways, along, curve.x), np.interp(ways, along, curve.y), turned))
        return Trajectory(ways, poses, self.sign * speed, angular, curve.length)

    def from_way(self, way: float) -> "Drive":
        """The rest of it; at least one step is left."""
        curve = self.curve
        begin = max(0.0, min(way, curve.length - curve.step_m))
        along = curve.step_m * np.arange(len(curve.x))
        places = np.linspace(begin, curve.length, max(3, math.ceil((curve.length - begin) / STEP_M) + 1))
        x, y, heading, curvature, bend = (np.interp(places, along, row) for row in (
            curve.x, curve.y, curve.heading, curve.curvature, curve.bend))
        return Drive(Curve(float(places[1] - places[0]), x, y, heading, curvature, bend), self.sign)


@dataclass(frozen=True)
class Pivot:
    """Turn on the spot by an angle, counterclockwise positive."""

    start: Pose2
    angle: float

    @property
    def length_m(self) -> float:
        """Way of the turn centre: none."""
        return 0.0

    def timed(self, limits: MotionLimits, _max_speed: float = 0.0, start_rate: float = 0.0) -> Optional[Trajectory]:
        """Trajectory; start_rate is the present yaw rate towards the angle. None when it is too fast to stop."""
        size = abs(self.angle)
        start_rate = start_rate if start_rate > SLOWEST_RADPS else 0.0
        first = history_way(start_rate, limits.angular_ramp_s)
        steps = max(2, math.ceil((size - first) / PIVOT_STEP_RAD))
        step = (size - first) / steps
        gain = 2.0 * limits.angular_acceleration_radps2
        caps = np.full(steps + 1, limits.max_angular_radps)
        speeds = speeds_along(caps, lambda _index, _square: gain, step, start_rate, gain) if step > 0.0 else None
        if speeds is None:
            return None
        ways = ways_at_samples(speeds, step, first, limits.angular_ramp_s)
        heading = self.start.heading + math.copysign(1.0, self.angle) * ways
        poses = np.column_stack((np.full_like(ways, self.start.x), np.full_like(ways, self.start.y), heading))
        return Trajectory(ways, poses, np.zeros_like(ways), np.gradient(heading, SAMPLE_S), 0.0)

    def from_way(self, way: float) -> "Pivot":
        """The rest of it."""
        turned = math.copysign(min(way, abs(self.angle)), self.angle)
        return Pivot(Pose2(self.start.x, self.start.y, wrap_angle(self.start.heading + turned)), self.angle - turned)


Motion = Union[Drive, Pivot]
