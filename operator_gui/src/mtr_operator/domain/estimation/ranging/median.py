"""The median of distances that were reported while nothing moved, and how sure it is."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from ..interval import SIGMAS_OF_LEVEL
from ..student import quantile

# Of the median of a normal distribution beside the mean's (its asymptotic efficiency is 2 / pi).
_OF_MEDIAN = math.sqrt(math.pi / 2.0)
# Filtered figures that hardly move say little more than one of them.
_MAX_CORRELATION = 0.95
_MIN_COUNT = 2.0


@dataclass(frozen=True)
class Median:
    """In m.

    spread_m: standard deviation of the figures. sigma_m: 1 sigma of the median, as if it were normal: half the width of
    its 95 % interval in sigmas of a normal distribution, so that few figures count by Student's t.
    """

    value_m: float
    spread_m: float
    sigma_m: float


def median_of(values_m: Sequence[float], resolution_m: float) -> Median:
    """Of figures in the order in which they came; resolution_m: their step. One figure has an infinite sigma.

    A phone filters what it tells, so that a figure is like the one before it: the correlation of neighbours takes that
    from their number, n (1 - r) / (1 + r). The step is an error of all of them alike, even over its width.
    """
    step_m = resolution_m / math.sqrt(12.0)
    if len(values_m) < _MIN_COUNT:
        return Median(values_m[0], 0.0, math.inf)
    spread_m = statistics.stdev(values_m)
    correlation = min(max(_neighbours(values_m), 0.0), _MAX_CORRELATION)
    count = max(len(values_m) * (1.0 - correlation) / (1.0 + correlation), _MIN_COUNT)
    factor = quantile(count - 1.0) / SIGMAS_OF_LEVEL
    return Median(statistics.median(values_m), spread_m,
                  math.hypot(factor * _OF_MEDIAN * spread_m / math.sqrt(count), step_m))


def _neighbours(values_m: Sequence[float]) -> float:
    """Correlation of each figure with the one before it; 0 where nothing varies."""
    mean_m = statistics.fmean(values_m)
    off_m = [value_m - mean_m for value_m in values_m]
    total = sum(each * each for each in off_m)
    return sum(first * second for first, second in zip(off_m, off_m[1:])) / total if total > 0.0 else 0.0
