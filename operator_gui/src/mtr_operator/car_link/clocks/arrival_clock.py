"""Map from the laptop's clock, which stamps frames at arrival, to the robot's clock: offset and rate.

A Status is never early, so the true line lies above all points (arrival, stamp) and touches the fastest ones: it is the
edge of their upper convex hull over the mean arrival, the line with the least total delay (Moon, Skelly and Towsley,
INFOCOM 1999).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math
import statistics
from typing import NamedTuple

from .clock_map import LEAST_WAY_S, MIN_PAIRS, MIN_SPAN_S, ClockMap

# 10 s of Status.
_WINDOW = 100
# A rate this close to 1 belongs to a robot, whose quartz is far better than any estimate from 10 s.
_TRUE_RATE_TOLERANCE = 0.02
_BACKWARD_STEP_S = 1.0


class _Pair(NamedTuple):
    arrival_s: float
    stamp_s: float


class ArrivalClockMap(ClockMap):
    """robot = rate * (arrival - origin) + offset."""

    def __init__(self) -> None:
        self.sigma_s = math.nan
        self._pairs: collections.deque[_Pair] = collections.deque(maxlen=_WINDOW)
        self._origin = _Pair(math.nan, math.nan)
        self._rate = 1.0

    @property
    def rate(self) -> float:
        """See ClockMap."""
        return self._rate

    def frame(self, local_s: float) -> None:
        """See ClockMap; frames do not affect this map."""

    def status(self, stamp_s: float, arrival_s: float) -> None:
        """See ClockMap."""
        if self._pairs and stamp_s < self._pairs[-1].stamp_s - _BACKWARD_STEP_S:
            self._pairs.clear()
        self._pairs.append(_Pair(arrival_s, stamp_s))
        if self.is_ready:
            self._estimate()

    @property
    def is_ready(self) -> bool:
        """See ClockMap."""
        return (len(self._pairs) >= MIN_PAIRS
                and self._pairs[-1].stamp_s - self._pairs[0].stamp_s >= MIN_SPAN_S - 1e-6)

    def to_robot(self, local_s: float) -> float:
        """See ClockMap."""
        return self._origin.stamp_s + self._rate * (local_s - self._origin.arrival_s)

    def _estimate(self) -> None:
        left, right = _edge_over_mean(list(self._pairs))
        self._origin = left
        self._rate = (right.stamp_s - left.stamp_s) / (right.arrival_s - left.arrival_s)
        if abs(self._rate - 1.0) <= _TRUE_RATE_TOLERANCE:
            self._rate = 1.0
            self._origin = max(self._pairs, key=lambda pair: pair.stamp_s - pair.arrival_s)
        delay_s = statistics.median(self.to_robot(pair.arrival_s) - pair.stamp_s for pair in self._pairs)
        self.sigma_s = math.hypot(delay_s, self._rate * LEAST_WAY_S)


def _edge_over_mean(pairs: list[_Pair]) -> tuple[_Pair, _Pair]:
    """Ends of the edge of the upper convex hull over the mean arrival; arrivals increase."""
    hull: list[_Pair] = []
    for pair in pairs:
        while len(hull) >= 2 and not _turns_right(hull[-2], hull[-1], pair):
            hull.pop()
        hull.append(pair)
    mean_s = sum(pair.arrival_s for pair in pairs) / len(pairs)
    right = next(index for index in range(1, len(hull)) if hull[index].arrival_s >= mean_s or index == len(hull) - 1)
    return hull[right - 1], hull[right]


def _turns_right(first: _Pair, second: _Pair, third: _Pair) -> bool:
    return ((second.arrival_s - first.arrival_s) * (third.stamp_s - first.stamp_s)
            < (second.stamp_s - first.stamp_s) * (third.arrival_s - first.arrival_s))
