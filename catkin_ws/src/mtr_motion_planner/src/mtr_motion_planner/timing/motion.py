"""Motions of the robot: along a curve and on the spot."""
# SPDX-License-Identifier: Apache-2.0
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Optional

import numpy as np

from mtr_core.arrays import FloatArray
from mtr_core.se2 import Pose2, wrap_angle

from ..geometry.curve import STEP_M, Curve
from ..limits import MotionLimits
from .speeds import SAMPLE_S, history_way, speeds_along, speeds_on, ways_at_samples
from .trajectory import Trajectory

PIVOT_STEP_RAD = 0.02
# A slower robot counts as stopped.
STANDING_MPS, STANDING_RADPS = 0.02, 0.03


class PlannedMotion(ABC):
    """Motion of the robot between two stops."""

    @property
    @abstractmethod
    def length_m(self) -> float:
        """Path length of the turn centre."""

    @abstractmethod
    def timed(self, limits: MotionLimits, max_speed: float, start_speed: float = 0.0) -> Optional[Trajectory]:
        """Return the trajectory from the start speed to rest; None if it does not exist."""

    @abstractmethod
    def lag(self, error: Pose2) -> float:
        """Return how far the robot is behind, m, or rad on the spot; error is the reference as seen from the robot."""

    @abstractmethod
    def from_way(self, way: float) -> "Optional[PlannedMotion]":
        """Return the rest from a distance on, m or rad; None if that requires another plan."""


@dataclass(frozen=True)
class CurveMotion(PlannedMotion):
    """Drive along a curve; sign -1: the rear leads."""

    curve: Curve
    sign: int

    @property
    def length_m(self) -> float:
        """Length of the curve."""
        return self.curve.length

    def timed(self, limits: MotionLimits, max_speed: float, start_speed: float = 0.0) -> Optional[Trajectory]:
        """Return the trajectory; None if the robot cannot stop on the curve from the start speed."""
        curve = self.curve
        start_speed = start_speed if start_speed > STANDING_MPS else 0.0
        first = math.ceil(history_way(start_speed, limits.ramp_s) / curve.step_m)
        if first + 1 >= len(curve.x):
            return None
        speeds = speeds_on(curve.after(first), limits, max_speed, start_speed)
        if speeds is None:
            return None
        return self._sampled(ways_at_samples(speeds, curve.step_m, first * curve.step_m, limits.ramp_s))

    def _sampled(self, ways: FloatArray) -> Trajectory:
        curve = self.curve
        along = curve.step_m * np.arange(len(curve.x))
        speed = np.gradient(ways, SAMPLE_S)
        heading = np.interp(ways, along, curve.heading)
        angular = np.interp(ways, along, curve.curvature) * speed
        turned = heading if self.sign > 0 else heading + math.pi
        poses = np.column_stack((np.interp(ways, along, curve.x), np.interp(ways, along, curve.y), turned))
        return Trajectory(ways, poses, self.sign * speed, angular, curve.length)

    def lag(self, error: Pose2) -> float:
        """Return the distance in m by which the robot is behind."""
        return error.x * self.sign

    def from_way(self, way: float) -> "CurveMotion":
        """Return the rest of the curve; at least one step remains."""
        curve = self.curve
        begin = max(0.0, min(way, curve.length - curve.step_m))
        along = curve.step_m * np.arange(len(curve.x))
        places = np.linspace(begin, curve.length, max(3, math.ceil((curve.length - begin) / STEP_M) + 1))
        x, y, heading, curvature, bend = (np.interp(places, along, row) for row in (
            curve.x, curve.y, curve.heading, curve.curvature, curve.bend))
        return CurveMotion(Curve(float(places[1] - places[0]), x, y, heading, curvature, bend), self.sign)


@dataclass(frozen=True)
class Pivot(PlannedMotion):
    """Turn on the spot by an angle, counterclockwise positive."""

    start: Pose2
    angle: float

    @property
    def length_m(self) -> float:
        """Zero, because the turn centre does not move."""
        return 0.0

    def timed(self, limits: MotionLimits, max_speed: float, start_speed: float = 0.0) -> Optional[Trajectory]:
        """Return the trajectory; start_speed is the yaw rate towards the angle, rad/s. None if it is too high."""
        size = abs(self.angle)
        start_rate = start_speed if start_speed > STANDING_RADPS else 0.0
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

    def lag(self, error: Pose2) -> float:
        """Return the angle in rad by which the robot is behind."""
        return math.copysign(1.0, self.angle) * error.heading

    def from_way(self, way: float) -> "Pivot":
        """Return the rest of the turn."""
        turned = math.copysign(min(way, abs(self.angle)), self.angle)
        return Pivot(Pose2(self.start.x, self.start.y, wrap_angle(self.start.heading + turned)), self.angle - turned)
