"""Timing of a path: as fast as the limits allow, with jerk-limited changes of speed.

Speeds along the path result from a forward and a backward pass (as in time-optimal path parametrisation). A moving
average over the build-up time of the acceleration then limits the jerk. The average preserves the distance. If the
acceleration phases are at least that long, it is the quickest S-curve.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, List, Optional

import numpy as np

from mtr_core.arrays import FloatArray

from ..geometry.curve import Curve
from ..limits import MotionLimits

SAMPLE_S = 0.02
# The change of curvature alone may use this share of the angular acceleration.
BEND_SHARE = 0.9
# Rounding error of the squared speed if a stop ends exactly at the end.
ROUNDING = 1e-6

# A gain is the change of the squared speed per metre, of either sign, at a sample and a squared speed.
Gain = Callable[[int, float], float]


def speed_caps(curve: Curve, limits: MotionLimits, max_speed: float) -> FloatArray:
    """Return the highest speed at each sample of a curve."""
    bends, changes = np.maximum(np.abs(curve.curvature), 1e-9), np.maximum(np.abs(curve.bend), 1e-9)
    caps = np.minimum(limits.max_angular_radps / bends, np.sqrt(limits.lateral_acceleration_mps2 / bends))
    caps = np.minimum(caps, limits.max_linear_mps / (1.0 + limits.curve_lever_m * bends))
    caps = np.minimum(caps, np.sqrt(BEND_SHARE * limits.angular_acceleration_radps2 / changes))
    return np.minimum(caps, max_speed)


def curve_gain(curve: Curve, limits: MotionLimits) -> Gain:
    """Return the gain that linear and angular acceleration allow on a curve."""
    bends, changes = np.abs(curve.curvature).tolist(), np.abs(curve.bend).tolist()
    linear, angular = 2.0 * limits.acceleration_mps2, 2.0 * limits.angular_acceleration_radps2

    def gain(index: int, square: float) -> float:
        bend = bends[index]
        if bend * linear <= 0.1 * angular:
            return linear
        spare = angular - 2.0 * changes[index] * square
        return min(linear, max(spare, 0.1 * angular) / bend)
    return gain


def speeds_on(curve: Curve, limits: MotionLimits, max_speed: float, start_speed: float) -> Optional[List[float]]:
    """Return the speed at each sample of a curve, ending at rest; None if the robot cannot stop in time."""
    return speeds_along(speed_caps(curve, limits, max_speed), curve_gain(curve, limits), curve.step_m, start_speed,
                        2.0 * limits.acceleration_mps2)


def speeds_along(caps: FloatArray, gain: Gain, step: float, start_speed: float, max_gain: float
                 ) -> Optional[List[float]]:
    """Return the speed at each sample, ending at rest; None if the robot cannot stop in time.

    max_gain is the gain for braking if the start is faster than the caps.
    """
    braking = start_speed ** 2 - max_gain * step * np.arange(len(caps))
    squares = np.maximum(caps ** 2, braking).tolist()
    squares[-1] = 0.0
    for i in range(len(squares) - 2, -1, -1):
        reached = squares[i + 1] + gain(i, squares[i + 1]) * step
        squares[i] = min(squares[i], reached)
    if squares[0] < start_speed ** 2 - ROUNDING:
        return None
    squares[0] = start_speed ** 2
    for i in range(1, len(squares)):
        reached = squares[i - 1] + gain(i - 1, squares[i - 1]) * step
        squares[i] = min(squares[i], reached)
    return [math.sqrt(max(square, 0.0)) for square in squares]


def ways_at_samples(speeds: List[float], step: float, first_way: float, ramp_s: float) -> FloatArray:
    """Return the distance at each SAMPLE_S, with limited jerk. speeds are given from first_way on, starting with the
    present.

    first_way is at least history_way: the distance that the moving average adds for the speed before the start.
    """
    start = speeds[0]
    speed = np.asarray(speeds)
    times = np.concatenate(([0.0], np.cumsum(2.0 * step / np.maximum(speed[:-1] + speed[1:], ROUNDING))))
    ways = first_way + step * np.arange(len(speeds))
    early = first_way - history_way(start, ramp_s)
    if early > ROUNDING and start > 0.0:
        times, ways = np.concatenate(([0.0], times + early / start)), np.concatenate(([first_way - early], ways))
        speed = np.concatenate(([start], speed))
    samples = _evenly(times, ways, speed)
    window = _window(ramp_s)
    moved = np.concatenate((np.full(window, start * SAMPLE_S), np.diff(samples), np.zeros(window)))
    sums = np.concatenate(([0.0], np.cumsum(moved)))
    return np.concatenate(([0.0], np.cumsum((sums[window:] - sums[:-window])[1:] / window)))


def _evenly(times: FloatArray, ways: FloatArray, speeds: FloatArray) -> FloatArray:
    """Return the distance at each SAMPLE_S, with constant acceleration between two times."""
    at = np.minimum(np.arange(0.0, times[-1] + 2.0 * SAMPLE_S, SAMPLE_S), times[-1])
    index = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    passed, span = at - times[index], times[index + 1] - times[index]
    return ways[index] + passed * (speeds[index] + 0.5 * passed * (speeds[index + 1] - speeds[index]) / span)


def history_way(start_speed: float, ramp_s: float) -> float:
    """Return the distance that the moving average adds for the speed before the start."""
    return start_speed * SAMPLE_S * 0.5 * (_window(ramp_s) - 1)


def _window(ramp_s: float) -> int:
    return max(1, round(ramp_s / SAMPLE_S))
