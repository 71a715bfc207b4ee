"""Lower bound of the time along a line for a robot that is turned by any angle at its ends.

The state is the angle between heading and line, and the speed, negative backwards. The progress is the integral of
speed times cosine of the angle. Dynamic programming over a grid gives the largest progress in a time. The grid's steps
are the largest changes that the limits allow in STEP_S, rounded up, so that the grid is quicker than the robot. Angle
and speed have their required values at both ends. Near both ends they stay within the jerk-limited turn and S-curve
from rest. The position across the line is ignored, because it can only make the path longer. A line that bends around
the Car may bend whenever it suits the robot, in LEVELS equal parts.
"""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np

from mtr_core.arrays import BoolArray, FloatArray
from mtr_core.se2 import wrap_angle
from mtr_motion_planner.limits import MotionLimits

STEP_S = 0.05
MAX_DURATION_S = 120.0
LEVELS = 6


class TurningBound:
    """Grid for one set of limits and one speed limit; states are bends behind the robot, angle and speed."""

    def __init__(self, limits: MotionLimits, speed: float):
        self._limits = limits
        angles = math.floor(2.0 * math.pi / (limits.max_angular_radps * STEP_S))
        speeds = max(1, math.floor(speed / (limits.acceleration_mps2 * STEP_S)))
        self._angles = 2.0 * math.pi / angles * np.arange(angles)
        self._speeds = speed / speeds * np.arange(-speeds, speeds + 1)
        self._gain = 0.5 * STEP_S * np.outer(np.cos(self._angles), self._speeds)

    def time(self, length: float, first_angle: float, last_angle: float, bend: float = 0.0) -> float:
        """Return the minimum time in s for a length, between headings that are off the line by the angles.

        bend: angle by which the line turns to the left between its ends.
        """
        levels = LEVELS if bend else 0
        cells = round(bend / max(levels, 1) / float(self._angles[1]))
        start, end = self._begun(first_angle, levels), self._begun(last_angle, levels)
        gone_before = 0.0
        for step in range(1, round(0.5 * MAX_DURATION_S / STEP_S)):
            # The end is processed backwards, so its line turns the other way.
            start = _bent(self._after(start, first_angle, step, bend), -cells)
            end = _bent(self._after(end, last_angle, step, bend), cells)
            gone = float((start + end[::-1]).max())
            if gone >= length:
                share = (length - gone_before) / (gone - gone_before)
                return 2.0 * STEP_S * (step - 1 + share)
            gone_before = max(gone, 0.0)
        return MAX_DURATION_S

    def _begun(self, angle: float, levels: int) -> FloatArray:
        """Return the progress of the initial states: 0 if the robot is stopped at an end, else impossible."""
        best = np.full((levels + 1, *self._gain.shape), -np.inf)
        best[0, self._near(angle, 0.0), len(self._speeds) // 2] = 0.0
        return best

    def _after(self, best: FloatArray, angle: float, step: int, bend: float) -> FloatArray:
        best = best + self._gain
        best = np.maximum(best, np.maximum(np.roll(best, 1, axis=1), np.roll(best, -1, axis=1)))
        faster, slower = np.full_like(best, -np.inf), np.full_like(best, -np.inf)
        faster[..., 1:], slower[..., :-1] = best[..., :-1], best[..., 1:]
        best = np.maximum(best, np.maximum(faster, slower)) + self._gain
        passed = step * STEP_S
        best[:, ~self._near(angle, turned_from_rest(passed, self._limits) + abs(bend))] = -np.inf
        reached = speed_from_rest(passed, self._limits) + float(np.diff(self._speeds)[0])
        best[..., np.abs(self._speeds) > reached] = -np.inf
        return best

    def _near(self, angle: float, within: float) -> BoolArray:
        off = np.abs(np.vectorize(wrap_angle)(self._angles - angle))
        return off <= within + 0.5 * float(self._angles[1]) + 1e-9


def _bent(best: FloatArray, cells: int) -> FloatArray:
    """Let the line bend at once by any number of its parts; each part changes the robot's angle by `cells`."""
    for level in range(1, len(best)):
        best[level] = np.maximum(best[level], np.roll(best[level - 1], cells, axis=0))
    return best


def speed_from_rest(passed: float, limits: MotionLimits) -> float:
    """Return the highest speed at a time after standstill, without a speed limit."""
    ramp = limits.ramp_s
    return 0.5 * limits.jerk_mps3 * min(passed, ramp) ** 2 + limits.acceleration_mps2 * max(passed - ramp, 0.0)


def turned_from_rest(passed: float, limits: MotionLimits) -> float:
    """Return the largest turned angle at a time after standstill."""
    ramp, jerk = limits.angular_ramp_s, limits.angular_jerk_radps3
    first = jerk * min(passed, ramp) ** 3 / 6.0
    later = max(passed - ramp, 0.0)
    rate = 0.5 * jerk * min(passed, ramp) ** 2
    return first + rate * later + 0.5 * limits.angular_acceleration_radps2 * later ** 2
