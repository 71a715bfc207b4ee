"""Random drive near the Car without a goal and without contacts; speeds and turns are random."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Sequence, Tuple

import numpy as np

from mtr_core.se2 import Pose2, wrap_angle

from .legs import ACCELERATION_MPS2, MAX_TURN_RADPS, TURN_ACCELERATION_RADPS2, Velocity
from .site_bodies import Body, clearance_m

MIN_SPEED_MPS, MAX_SPEED_MPS = 0.2, 0.6
MIN_HOLD_S, MAX_HOLD_S = 0.5, 1.5
# The path is free if base_link can continue straight for this distance with this clearance. The robot stops from its
# highest speed within 0.3 m, and turns on the spot within a circle of 0.35 m.
AHEAD_M, AHEAD_STEP_M, ROOM_M = 0.8, 0.1, 0.45
# Beyond this distance from the Car's centre the robot turns back until it faces the Car within this angle.
FAR_M, FACING_RAD = 9.0, 0.5
PLACES_AHEAD_M = tuple(AHEAD_STEP_M * step for step in range(1, round(AHEAD_M / AHEAD_STEP_M) + 1))


class Wanderer:
    """Returns commands for a limited time, starting from standstill; poses of base_link in frame car."""

    def __init__(self, bodies: Sequence[Body], chance: np.random.Generator, duration_s: float, period_s: float):
        self._bodies, self._chance, self._left_s, self._period_s = bodies, chance, duration_s, period_s
        self._wanted, self._hold_s = (0.0, 0.0), 0.0
        self._speed = self._turning = self._evading = 0.0

    def update(self, pose: Pose2) -> Tuple[Velocity, bool]:
        """Return the command for the true pose, and whether the time is over."""
        self._left_s -= self._period_s
        speed, turning = self._choice(pose)
        self._speed = _nearer(self._speed, speed, ACCELERATION_MPS2 * self._period_s)
        self._turning = _nearer(self._turning, turning, TURN_ACCELERATION_RADPS2 * self._period_s)
        return (self._speed, self._turning), self._left_s <= 0.0

    def _choice(self, pose: Pose2) -> Velocity:
        speed, turning = self._drawn()
        if not self._is_free(pose):
            # It keeps turning to the same side until the path is free; otherwise it would oscillate in a corner.
            self._evading = self._evading or math.copysign(MAX_TURN_RADPS, turning)
            return 0.0, self._evading
        self._evading = 0.0
        bearing = wrap_angle(math.atan2(-pose.y, -pose.x) - pose.heading)
        if math.hypot(pose.x, pose.y) > FAR_M and abs(bearing) > FACING_RAD:
            return speed, math.copysign(MAX_TURN_RADPS, bearing)
        return speed, turning

    def _drawn(self) -> Velocity:
        """Return speed and turn rate; they are held for a while."""
        self._hold_s -= self._period_s
        if self._hold_s <= 0.0:
            self._hold_s = float(self._chance.uniform(MIN_HOLD_S, MAX_HOLD_S))
            self._wanted = (float(self._chance.uniform(MIN_SPEED_MPS, MAX_SPEED_MPS)),
                            float(self._chance.uniform(-MAX_TURN_RADPS, MAX_TURN_RADPS)))
        return self._wanted

    def _is_free(self, pose: Pose2) -> bool:
        cos, sin = math.cos(pose.heading), math.sin(pose.heading)
        return all(clearance_m(self._bodies, pose.x + ahead * cos, pose.y + ahead * sin) >= ROOM_M
                   for ahead in PLACES_AHEAD_M)


def _nearer(value: float, wanted: float, step: float) -> float:
    return value + max(-step, min(step, wanted - value))
