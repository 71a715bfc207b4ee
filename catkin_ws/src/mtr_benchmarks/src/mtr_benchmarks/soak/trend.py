"""Slope of a series with its confidence interval. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass
from typing import Dict, List, Sequence, Tuple

import numpy as np
from scipy import stats

# Consecutive samples are correlated; the slope uses the means of this number of blocks, which hardly are.
BLOCKS = 12
CONFIDENCE = 0.95
HOUR_S = 3600.0


@dataclass(frozen=True)
class Trend:
    """Slope per hour and half the width of its 95 % interval. p: probability of such a slope without a trend."""

    per_hour: float
    half_width: float
    p: float

    @property
    def is_flat(self) -> bool:
        """True if the interval contains zero."""
        return abs(self.per_hour) <= self.half_width


def trend_of(samples: Sequence[Tuple[float, float]]) -> Trend:
    """Return the trend of (time, value).

    Raises:
        ValueError: there are fewer than three blocks.
    """
    times_s, values = blocks(samples)
    if len(times_s) < 3:
        raise ValueError("A slope with its interval needs three blocks of samples.")
    hours = np.asarray(times_s) / HOUR_S
    fit = stats.linregress(hours, values)
    if not np.any(np.asarray(values) != values[0]):
        # The value is constant.
        return Trend(0.0, 0.0, 1.0)
    half_width = float(fit.stderr * stats.t.ppf(0.5 + 0.5 * CONFIDENCE, len(hours) - 2))
    return Trend(float(fit.slope), half_width, float(fit.pvalue))


def blocks(samples: Sequence[Tuple[float, float]]) -> Tuple[Sequence[float], Sequence[float]]:
    """Return the mean time and mean value of each block of equal time that has samples."""
    if not samples:
        return [], []
    begin_s, end_s = samples[0][0], samples[-1][0]
    length_s = max((end_s - begin_s) / BLOCKS, 1e-9)
    parts: Dict[int, List[Tuple[float, float]]] = {}
    for time_s, value in samples:
        parts.setdefault(min(int((time_s - begin_s) / length_s), BLOCKS - 1), []).append((time_s, value))
    means = [tuple(map(float, np.mean(part, axis=0))) for _, part in sorted(parts.items())]
    return [time_s for time_s, _ in means], [value for _, value in means]


def growing(trends: Sequence[Trend]) -> int:
    """Return the number of growing series by Holm's method, with 5 % for all of them together."""
    ordered = sorted((each.p, each.per_hour > 0.0) for each in trends)
    found = 0
    for index, (p, grows) in enumerate(ordered):
        if p > (1.0 - CONFIDENCE) / (len(ordered) - index):
            break
        found += grows
    return found


def difference(before: Sequence[float], after: Sequence[float]) -> Tuple[float, float]:
    """Return the later minus the earlier mean, and half the width of its 95 % interval (Welch)."""
    if min(len(before), len(after)) < 2:
        return math.nan, math.nan
    squares = [float(np.var(each, ddof=1)) / len(each) for each in (before, after)]
    spread = sum(square ** 2 / (len(each) - 1) for square, each in zip(squares, (before, after)))
    freedom = sum(squares) ** 2 / max(spread, 1e-30)
    half_width = math.sqrt(sum(squares)) * float(stats.t.ppf(0.5 + 0.5 * CONFIDENCE, max(freedom, 1.0)))
    return float(np.mean(after) - np.mean(before)), half_width
