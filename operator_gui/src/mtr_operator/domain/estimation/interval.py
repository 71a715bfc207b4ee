"""A value with the interval that contains it with a given probability.

Intervals are credible intervals with equal tails: each tail has the probability (1 - level) / 2 of the posterior.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

LEVEL = 0.95
# Half the width of a normal distribution's 95 % interval, in sigmas.
SIGMAS_OF_LEVEL = 1.959964


@dataclass(frozen=True)
class Interval:
    """Median and 95 % interval of a distance, in m; sigma_m is one standard deviation.

    shared_m: part of sigma_m, in squares, that repeated measurements of the same Car have in common, because they
    cannot resolve it.
    """

    value_m: float
    low_m: float
    high_m: float
    sigma_m: float
    shared_m: float = 0.0

    @property
    def half_width_m(self) -> float:
        """Half of the distance between the ends; NaN if unknown."""
        return (self.high_m - self.low_m) / 2.0

    def widened(self, sigma_m: float, sigmas: float = SIGMAS_OF_LEVEL) -> Interval:
        """Add an independent normal error of this sigma; NaN makes the ends unknown.

        sigmas: reach of the interval to each side, by default for 95 %.
        """
        reach_m = sigmas * sigma_m
        return Interval(self.value_m, self.value_m - math.hypot(self.value_m - self.low_m, reach_m),
                        self.value_m + math.hypot(self.high_m - self.value_m, reach_m),
                        math.hypot(self.sigma_m, sigma_m), self.shared_m)

    def holds(self, value_m: float) -> bool:
        """Return True if the value lies within; False for NaN."""
        return self.low_m <= value_m <= self.high_m


UNKNOWN = Interval(*5 * (math.nan,))


def interval_of(edges_m: FloatArray, weights: FloatArray, level: float = LEVEL) -> Interval:
    """Return the interval of a histogram: weights between edges, uniform in between; UNKNOWN without a finite
    weight."""
    total = float(np.sum(weights))
    if not math.isfinite(total) or total <= 0.0:
        return UNKNOWN
    share = weights / total
    below = np.concatenate(([0.0], np.cumsum(share)))
    tail = (1.0 - level) / 2.0
    low, value, high = np.interp([tail, 0.5, 1.0 - tail], below, edges_m)
    middles, widths = (edges_m[1:] + edges_m[:-1]) / 2.0, np.diff(edges_m)
    mean = float(share @ middles)
    variance = float(share @ ((middles - mean) ** 2 + widths ** 2 / 12.0))
    return Interval(float(value), float(low), float(high), math.sqrt(variance))


def difference_holds(first: Interval, second: Interval) -> bool:
    """Return True if two values of one Car agree: zero lies within the 95 % interval of their difference.

    The shared error cancels in the difference; the remaining errors are independent.
    """
    alone = (math.sqrt(max(each.sigma_m ** 2 - each.shared_m ** 2, 0.0)) for each in (first, second))
    sigma_m = math.hypot(*alone, first.shared_m - second.shared_m)
    return abs(first.value_m - second.value_m) <= SIGMAS_OF_LEVEL * sigma_m


def interval_of_draws(values_m: FloatArray, level: float = LEVEL) -> Interval:
    """Return the interval of equally probable values."""
    tail = (1.0 - level) / 2.0
    low, value, high = np.quantile(values_m, [tail, 0.5, 1.0 - tail])
    return Interval(float(value), float(low), float(high), float(np.std(values_m)))
