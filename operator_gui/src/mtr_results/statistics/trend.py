"""A distance over time with control limits: which test is unlike the others, by chart of individual values.

The limits are 2.66 mean moving ranges from the mean (Shewhart; ISO 7870-2): three sigmas of what one test differs from
the next. A test beyond them is worth a look: by chance one in 400 is there with limits from many tests, and one in
42 with limits from 10. A distance with an open end has no value to chart, and is only beyond a limit where its known
end is.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np

from mtr_operator.history.estimate import Known

# 3 / d2 of two values.
_RANGES = 2.66
MIN_TESTS = 5


@dataclass(frozen=True)
class Point:
    """Of one test. known: None where it has not measured the distance. is_beyond: outside the limits."""

    known: Known | None
    is_beyond: bool = False


@dataclass(frozen=True)
class Trend:
    """In the order of the tests. centre, low, high: NaN where there are too few values; reason says so."""

    points: tuple[Point, ...]
    centre: float = math.nan
    low: float = math.nan
    high: float = math.nan
    reason: str = ""

    @property
    def unlike(self) -> str:
        """Why tests that measured the distance have no point; empty when none."""
        return next((point.known.reason for point in self.points if point.known and point.known.reason), "")

    @property
    def beyond(self) -> list[int]:
        """Places of the tests that are unlike the others."""
        return [index for index, point in enumerate(self.points) if point.is_beyond]


def trend(known: Sequence[Known | None], baseline: int = 0) -> Trend:
    """Of a distance in tests, in the order of their time. baseline: how many of the first values make the limits, 0 for
    all."""
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
