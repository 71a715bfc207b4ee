"""Multiple comparisons: p-value of each difference, and the differences that remain after a joint correction.

Of 40 intervals of 95 %, two exclude zero by chance. Holm (1979, Scandinavian Journal of Statistics 6, 65) limits the
probability of any false difference to 5 %, for any dependence between the distances. With weights (his section 4), some
get a larger share of these 5 % than others.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from scipy.special import ndtr, stdtr

from mtr_operator.domain.estimation.interval import LEVEL
from mtr_operator.domain.estimation.student import NORMAL_FROM, quantile

ALPHA = 1.0 - LEVEL


def chance(value: float | None, low: float, high: float, freedom: float = math.inf) -> float:
    """Return the two-sided p-value of a difference, from its 95 % interval.

    If only one end of the interval is known, it is 0.05 when that end excludes zero, otherwise 1.
    """
    end = low if (low + high if value is None else value) > 0.0 else high
    if value is None or not math.isfinite(end):
        return ALPHA if low > 0.0 or high < 0.0 else 1.0
    reach = abs(value - end)
    if reach == 0.0:
        return 1.0 if value == 0.0 else 0.0
    errors = abs(value) / reach * quantile(freedom)
    return float(2.0 * (ndtr(-errors) if freedom > NORMAL_FROM else stdtr(freedom, -errors)))


def holm(chances: Sequence[float], weights: Sequence[float] | None = None) -> list[float]:
    """Return adjusted p-values; at most 0.05 is a difference among all. weights: positive, equal by default."""
    given = [1.0] * len(chances) if weights is None else weights
    order = sorted(range(len(chances)), key=lambda index: chances[index] / given[index])
    adjusted = [1.0] * len(chances)
    least = 0.0
    for rank, index in enumerate(order):
        left = sum(given[other] for other in order[rank:])
        least = max(least, min(1.0, left * chances[index] / given[index]))
        adjusted[index] = least
    return adjusted
