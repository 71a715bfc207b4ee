"""Speed limit for the uncertainty of the robot's own pose."""
# SPDX-License-Identifier: Apache-2.0
import math

from ..geometry.growth import MARGIN_SIGMAS
from ..limits import MotionLimits

# The limit changes in steps, and rises by two at once: each new limit requires a new plan, and sigma is noisy.
STEP_MPS, RISE_STEPS = 0.05, 2
_ROUNDING = 1e-9


def speed_within(limits: MotionLimits, room_m: float) -> float:
    """Return the highest speed in m/s from which the robot stops within a distance; 0 if there is none."""
    half_ramp_mps = 0.5 * limits.acceleration_mps2 * limits.ramp_s
    return math.sqrt(half_ramp_mps ** 2 + 2.0 * limits.acceleration_mps2 * max(room_m, 0.0)) - half_ramp_mps


class PoseSpeed:
    """Keeps stopping distance plus 2 sigma of the pose within a margin.

    If sigma alone exceeds the margin, the robot creeps, because its pose improves only by motion.
    """

    def __init__(self, limits: MotionLimits, margin_m: float, creep_mps: float):
        self._limits, self._margin_m, self._creep_mps = limits, margin_m, creep_mps
        self._steps = math.inf

    def limit(self, sigma_m: float) -> float:
        """Return the speed limit in m/s for 1 sigma of the pose."""
        room_m = self._margin_m - MARGIN_SIGMAS * sigma_m
        steps = math.floor(speed_within(self._limits, room_m) / STEP_MPS + _ROUNDING)
        if steps < self._steps or steps >= self._steps + RISE_STEPS:
            self._steps = steps
        return max(STEP_MPS * self._steps, self._creep_mps)
