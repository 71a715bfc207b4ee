"""A distance over time with control limits, as a chart of individual values.

The limits are 2.66 mean moving ranges from the mean (Shewhart; ISO 7870-2), which is three sigmas of the difference
between consecutive tests. A test beyond them should be examined: by chance, this is one in 400 tests with limits from
many tests, and one in 42 with limits from 10. A distance with an open end has no value in the chart. It is beyond a
limit only if its known end is.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np

from mtr_operator.history.estimate import Known

# 3 / d2 for ranges of two values.
_RANGES = 2.66
MIN_TESTS = 5


@dataclass(frozen=True)
class Point:
    """Point of one test. known: None if the test did not measure the distance. is_beyond: outside the limits."""

    known: Known | None
    is_beyond: bool = False


@dataclass(frozen=True)
class Trend:
    """Points in the order of the tests. centre, low, high: NaN if there are too few values; see reason."""

    points: tuple[Point, ...]
    centre: float = math.nan
    low: float = math.nan
    high: float = math.nan
    reason: str = ""

    @property
    def unlike(self) -> str:
        """Reason why tests with a measured distance have no point; empty if all have one."""
        return next((point.known.reason for point in self.points if point.known and point.known.reason), "")

    @property
    def beyond(self) -> list[int]:
        """Indices of the tests outside the limits."""
        return [index for index, point in enumerate(self.points) if point.is_beyond]


def trend(known: Sequence[Known | None], baseline: int = 0) -> Trend:
    """Return the trend of a distance over tests in order of time.

    baseline: number of first values for the limits, 0 for all.
    """
    values = [each.value for each in known if each is not None and each.value is not None]
    of_limits = np.array(values[:baseline] if baseline else values)
    if len(of_limits) < MIN_TESTS:
        return Trend(tuple(map(Point, known)), reason=f"{len(of_limits)} values make no limits; {MIN_TESTS} are the "
                                                      "fewest.")
    centre = float(np.mean(of_limits))
    reach = _RANGES * float(np.mean(np.abs(np.diff(of_limits))))
    low, high = centre - reach, centre + reach
    points = (Point(each, each is not None and (each.low > high or each.high < low)) for each in known)
    return Trend(tuple(points), centre, low, high)
