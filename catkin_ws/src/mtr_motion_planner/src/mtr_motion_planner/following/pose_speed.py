"""Speed limit by the uncertainty of the robot's own pose."""
# SPDX-License-Identifier: Apache-2.0
import math

from ..geometry.growth import MARGIN_SIGMAS
from ..limits import MotionLimits

# The limit changes in these steps, and rises by two at once: another limit makes another plan, and sigma is noisy.
STEP_MPS = 0.05
_ROUNDING = 1e-9


def speed_within(limits: MotionLimits, room_m: float) -> float:
    """Highest speed in m/s from which the robot stops within a distance; 0 when there is none."""
    half_ramp_mps = 0.5 * limits.acceleration_mps2 * limits.ramp_s
    return math.sqrt(half_ramp_mps ** 2 + 2.0 * limits.acceleration_mps2 * max(room_m, 0.0)) - half_ramp_mps


class PoseSpeed:
    """Keeps stopping distance and 2 sigma of the pose together within a margin.

    The robot creeps where sigma alone exceeds the margin: it finds its place only by moving.
    """

    def __init__(self, limits: MotionLimits, margin_m: float, creep_mps: float):
        self._limits, self._margin_m, self._creep_mps = limits, margin_m, creep_mps
        self._limit_mps = math.inf

    def limit(self, sigma_m: float) -> float:
        """Speed limit in m/s at 1 sigma of the pose."""
        room_m = self._margin_m - MARGIN_SIGMAS * sigma_m
        speed_mps = max(speed_within(self._limits, room_m), self._creep_mps)
        stepped_mps = max(STEP_MPS * math.floor(speed_mps / STEP_MPS + _ROUNDING), self._creep_mps)
        if stepped_mps < self._limit_mps or stepped_mps >= self._limit_mps + 2.0 * STEP_MPS - _ROUNDING:
            self._limit_mps = stepped_mps
        return self._limit_mps
