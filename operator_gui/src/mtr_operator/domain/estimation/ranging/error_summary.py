"""Statistics of the errors of reported distances at many places: bias, spread, and bound of 95 % of them."""
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
    """Statistics in m; errors are reported less measured distance.

    bias_m: mean error, with the ends of its 95 % interval, None for one place; it includes the robot's common error.
    spread_m: standard deviation, None for one place. within_m: bound of the absolute error at 95 % of the places;
    within_low_m, within_high_m: its 95 % interval for any distribution of the errors. The upper end is None with fewer
    than 72 places, because the worst twentieth is then unknown.
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
    """Summarize errors; None without one. common_sigma_m: 1 sigma of an error that all places may have in common.

    Places count as independent. If they are closer together than the field varies, the intervals are too narrow.
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
    """Return ranks, from 1, of the ordered errors that bound their 95 % quantile with 95 % confidence; None without
    such a rank.

    The number of errors below the quantile is binomial: each tail has at most 2.5 %.
    """
    tail = (1.0 - LEVEL) / 2.0
    low = max((rank for rank in range(1, count + 1) if bdtr(rank - 1, count, _SHARE) <= tail), default=None)
    high = next((rank for rank in range(1, count + 1) if 1.0 - bdtr(rank - 1, count, _SHARE) <= tail), None)
    return low, high
