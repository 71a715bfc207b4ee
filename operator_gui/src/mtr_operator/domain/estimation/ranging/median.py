"""Median of distances that were reported at standstill, and its uncertainty."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from ..interval import SIGMAS_OF_LEVEL
from ..student import quantile

# Filtered values that hardly vary contain little more information than a single one.
_MAX_CORRELATION = 0.95
_MIN_COUNT = 2.0
# Minimum number of values for the bias correction; with fewer, it is too uncertain and makes intervals too wide.
_FULL_CORRECTION = 12


@dataclass(frozen=True)
class Median:
    """Median in m.

    spread_m: standard deviation of the values. sigma_m: 1 sigma of the median in normal equivalents: half the width of
    its 95 % interval in sigmas of a normal distribution, so that few values are treated by Student's t.
    """

    value_m: float
    spread_m: float
    sigma_m: float


def median_of(values_m: Sequence[float], resolution_m: float) -> Median:
    """Return the median of values in the order of arrival; resolution_m: their step. A single value has an infinite
    sigma.

    A phone filters its values, so that each is similar to the previous one: the correlation r of neighbours reduces
    their number n to n (1 - r) / (1 + r). The step is a common error of all values, uniform over its width.
    """
    step_m = resolution_m / math.sqrt(12.0)
    if len(values_m) < _MIN_COUNT:
        return Median(values_m[0], 0.0, math.inf)
    spread_m = statistics.stdev(values_m)
    correlation = min(max(_neighbours(values_m), 0.0), _MAX_CORRELATION)
    count = max(len(values_m) * (1.0 - correlation) / (1.0 + correlation), _MIN_COUNT)
    factor = quantile(count - 1.0) / SIGMAS_OF_LEVEL * _sigmas_of_mean(len(values_m))
    return Median(statistics.median(values_m), spread_m, math.hypot(factor * spread_m / math.sqrt(count), step_m))


def _sigmas_of_mean(count: int) -> float:
    """Return the ratio of the standard deviations of median and mean of independent normal values, within 2 % for any
    count.

    The limit is sqrt(pi / 2); the median of two values is their mean.
    """
    return math.sqrt(math.pi * count / (2.0 * count + (math.pi - 2.0 if count % 2 else 2.0 * (math.pi - 2.0))))


def _neighbours(values_m: Sequence[float]) -> float:
    """Return the correlation of each value with the previous one, corrected for its bias; 0 without variation.

    n values underestimate it by (1 + 4 r) / n: Kendall, Note on bias in the estimation of autocorrelation, 1954.
    """
    mean_m = statistics.fmean(values_m)
    off_m = [value_m - mean_m for value_m in values_m]
    total = sum(each * each for each in off_m)
    if not total:
        return 0.0
    found = sum(first * second for first, second in zip(off_m, off_m[1:])) / total
    return found + (1.0 + 4.0 * max(found, 0.0)) / max(len(values_m), _FULL_CORRECTION)
