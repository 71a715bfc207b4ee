"""Hypotheses of the reaction time: values near the slopes of the axes, for any delay of the Car.

Some Cars lock seconds after the key has left, by a timer; polls and motors alone last up to two seconds.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics
from typing import Iterator, Sequence

import numpy as np

from .timing import MAX_REACTION_S

# Speeds with a smaller ratio hardly determine the reaction time.
MIN_SPEED_RATIO = 1.3
# With fewer axes the error of a single slope is unknown.
_MIN_AXES = 3
# Range of reaction times around the median of the slopes, in deviations of one slope, and steps per deviation. The
# lower side is larger: noise makes slow passes react early, which increases the slopes.
_BELOW, _ABOVE, _STEPS = 3.0, 2.0, 5
_DEVIATION_S = (0.03, 0.6)
# Sigma of a normal distribution in median absolute deviations.
_SIGMAS_OF_MAD = 1.4826
_STEP_S = 0.08


def has_two_speeds(speeds_mps: Sequence[float]) -> bool:
    """Return True if passes at these speeds distinguish the boundary from the reaction time."""
    return len(speeds_mps) > 1 and max(speeds_mps) >= MIN_SPEED_RATIO * min(speeds_mps) > 0.0


def reaction_times(axes: Sequence[Sequence[tuple[float, float]]]) -> tuple[float, ...]:
    """Return hypotheses in s, evenly spaced; each axis has the positions along the path, in m, and speeds of its
    passes."""
    slopes_s = list(_slopes(axes))
    if len(slopes_s) < _MIN_AXES:
        return _evenly(0.0, MAX_REACTION_S, _STEP_S)
    median_s = statistics.median(slopes_s)
    spread_s = _SIGMAS_OF_MAD * statistics.median(abs(slope_s - median_s) for slope_s in slopes_s)
    deviation_s = float(np.clip(spread_s, *_DEVIATION_S))
    first_s = max(0.0, median_s - _BELOW * deviation_s)
    return _evenly(first_s, max(median_s, 0.0) + _ABOVE * deviation_s, deviation_s / _STEPS)


def _evenly(first_s: float, last_s: float, step_s: float) -> tuple[float, ...]:
    return tuple(float(value) for value in np.arange(first_s, last_s + step_s / 2.0, step_s))


def _slopes(axes: Sequence[Sequence[tuple[float, float]]]) -> Iterator[float]:
    for passes in filter(None, axes):
        (slow_m, slow_mps), (fast_m, fast_mps) = (pick(passes, key=lambda each: each[1]) for pick in (min, max))
        if has_two_speeds((slow_mps, fast_mps)):
            yield (fast_m - slow_m) / (fast_mps - slow_mps)
