"""Errors of reported distances at many places, in figures: bias, spread, and what 95 % of them keep."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from typing import Sequence

from scipy.special import bdtr

from ..interval import LEVEL, SIGMAS_OF_LEVEL
from ..student import quantile

_SHARE = 0.95


@dataclass(frozen=True)
class ErrorSummary:
    """In m; errors are reported less measured distance.

    bias_m: their mean, with the ends of its 95 % interval, None of one place; what the robot may be off everywhere
    alike is in it. spread_m: their standard deviation, None
    of one place. within_m: 95 % of the places have at most this error without its sign; within_low_m, within_high_m:
    its 95 % interval without any assumption on how errors are distributed. The upper end is None with fewer than 72
    places: then nobody knows what the worst twentieth would be.
    """

    count: int
    bias_m: float
    bias_low_m: float | None
    bias_high_m: float | None
    spread_m: float | None
    within_m: float
    within_low_m: float | None
    within_high_m: float | None


def summarize(errors_m: Sequence[float], common_sigma_m: float = 0.0) -> ErrorSummary | None:
    """None without an error. common_sigma_m: 1 sigma of an error that all places may have alike.

    Places count as independent: of a field that is smooth around the Car the intervals are too narrow where places lie
    closer to each other than it varies.
    """
    count = len(errors_m)
    if not count:
        return None
    bias_m = statistics.fmean(errors_m)
    spread_m = statistics.stdev(errors_m) if count > 1 else None
    reach_m = None if spread_m is None else \
        math.hypot(quantile(count - 1) * spread_m / math.sqrt(count),
                   SIGMAS_OF_LEVEL * common_sigma_m)
    sizes_m = sorted(abs(error_m) for error_m in errors_m)
    low, high = _ranks(count)
    return ErrorSummary(
        count, bias_m, None if reach_m is None else bias_m - reach_m, None if reach_m is None else bias_m + reach_m,
        spread_m, sizes_m[math.ceil(_SHARE * count) - 1], None if low is None else sizes_m[low - 1],
        None if high is None else sizes_m[high - 1])


def _ranks(count: int) -> tuple[int | None, int | None]:
    """Ranks, from 1, of the ordered errors between which their 95 % quantile lies with 95 %; None where no rank does.

    So many of the errors as are below the quantile follow a binomial distribution: each tail has at most 2.5 %.
    """
    tail = (1.0 - LEVEL) / 2.0
    low = max((rank for rank in range(1, count + 1) if bdtr(rank - 1, count, _SHARE) <= tail), default=None)
    high = next((rank for rank in range(1, count + 1) if 1.0 - bdtr(rank - 1, count, _SHARE) <= tail), None)
    return low, high
