"""A delay that polls and motors do not explain: some Cars lock seconds after the key has gone, by a timer."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from typing import Iterator, Sequence

from .timing import MAX_REACTION_S

# Speeds nearer to each other than this say next to nothing of the reaction time.
MIN_SPEED_RATIO = 1.3
# So much of a reaction may be polls and debounce; a timer is only taken for what goes beyond, in steps.
_POLLED_S = MAX_REACTION_S - 1.3
_STEP_S = 0.4
# A single axis' slope is as noisy as the Car; its hypotheses reach up to MAX_REACTION_S anyway.
_MIN_AXES = 3


def has_two_speeds(speeds_mps: Sequence[float]) -> bool:
    """True when passes at these speeds tell the boundary from the reaction time."""
    return len(speeds_mps) > 1 and max(speeds_mps) >= MIN_SPEED_RATIO * min(speeds_mps) > 0.0


def base_delay(axes: Sequence[Sequence[tuple[float, float]]]) -> float:
    """Delay in s that comes on top on all axes; each has the places along the way, in m, and speeds of its passes."""
    slopes_s = list(_slopes(axes))
    if len(slopes_s) < _MIN_AXES:
        return 0.0
    return _STEP_S * max(0, math.floor((statistics.median(slopes_s) - _POLLED_S) / _STEP_S))


def _slopes(axes: Sequence[Sequence[tuple[float, float]]]) -> Iterator[float]:
    for passes in filter(None, axes):
        (slow_m, slow_mps), (fast_m, fast_mps) = (pick(passes, key=lambda each: each[1]) for pick in (min, max))
        if has_two_speeds((slow_mps, fast_mps)):
            yield (fast_m - slow_m) / (fast_mps - slow_mps)
