"""Many differences at once: how likely each is by chance, and which remain when all of them are judged together.

Of 40 intervals of 95 % two miss zero by chance. Holm (1979, Scandinavian Journal of Statistics 6, 65) keeps the chance
that any difference is called one at 5 %, however the distances depend on each other; with weights (his section 4) some
get a larger part of these 5 % than others.
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
    """Two-sided probability of such a difference where there is none, from the 95 % interval of the difference.

    Where only an end of the interval is known nothing more is: 0.05 when that end is beyond zero, else 1.
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
    """Adjusted: what is at most 0.05 is a difference among all. weights: positive; all alike where not given."""
    given = [1.0] * len(chances) if weights is None else weights
    order = sorted(range(len(chances)), key=lambda index: chances[index] / given[index])
    adjusted = [1.0] * len(chances)
    least = 0.0
    for rank, index in enumerate(order):
        left = sum(given[other] for other in order[rank:])
        least = max(least, min(1.0, left * chances[index] / given[index]))
        adjusted[index] = least
    return adjusted
