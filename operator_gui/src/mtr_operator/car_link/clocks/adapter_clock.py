"""Map from the clock of a CAN adapter that stamps its frames to the robot's clock.

Both clocks run at true rate (in an accelerated simulation both are the simulated one), so only an offset is estimated.
The stamp of a Status that arrives between two frames lies approximately between their stamps. The transmission delays
of Statuses and frames scatter, by tens of milliseconds of simulated time in an accelerated simulation; the offset is
constant. The map therefore uses the median over many pairs.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
import collections
import math
import statistics
from typing import NamedTuple

from .clock_map import MIN_PAIRS, MIN_SPAN_S, ClockMap

# 30 s of Status: quartz clocks that differ by 200 ppm drift 6 ms in it, and the median lags half of that.
_WINDOW = 300
_RATE_TOLERANCE = 200e-6
# A longer gap between two frames does not locate a Status between them.
_MAX_GAP_S = 0.25
# A clock was set if this many consecutive pairs deviate by this much.
_JUMP_S = 1.0
_JUMP_PAIRS = 10
_STAMP_MODULO_MS = 60_000
# A stamp that is older than the last one by less than this is a late frame, not a new minute.
_DISORDER_MS = 1_000
# The outer two of these quantiles (16.7 % and 83.3 %) are about one sigma from the median.
_QUANTILES = 6


class StampUnwrapper:
    """Continuous time in s from stamps in ms that start again each minute; gaps must be shorter than 59 s."""

    def __init__(self) -> None:
        self._total_ms: int | None = None

    def unwrap(self, stamp_ms: int) -> float:
        """Return the continuous time of a stamp."""
        if self._total_ms is None:
            self._total_ms = stamp_ms
            return stamp_ms / 1000.0
        ahead_ms = (stamp_ms - self._total_ms) % _STAMP_MODULO_MS
        if ahead_ms > _STAMP_MODULO_MS - _DISORDER_MS:
            return (self._total_ms + ahead_ms - _STAMP_MODULO_MS) / 1000.0
        self._total_ms += ahead_ms
        return self._total_ms / 1000.0


class _Pair(NamedTuple):
    stamp_s: float
    offset_s: float
    gap_s: float


class _Ordered:
    """Sorted multiset. Sorting all values for each Status would be the largest cost of this map.

    Attributes: values: in ascending order.
    """

    def __init__(self) -> None:
        self.values: list[float] = []

    def add(self, value: float) -> None:
        """Insert a value."""
        bisect.insort(self.values, value)

    def remove(self, value: float) -> None:
        """Remove a value that was added."""
        del self.values[bisect.bisect_left(self.values, value)]


class AdapterClockMap(ClockMap):
    """robot = adapter + offset.

    Attributes:
        gap_s: median interval of the two frames around a Status.
    """

    def __init__(self) -> None:
        self.sigma_s = self.gap_s = math.nan
        self._pairs: collections.deque[_Pair] = collections.deque()
        self._offsets_s = _Ordered()
        self._gaps_s = _Ordered()
        self._strays = 0
        self._newest_s: float | None = None
        self._pending: tuple[float, float] | None = None
        self._offset_s = math.nan

    def frame(self, local_s: float) -> None:
        """See ClockMap."""
        if self._pending is not None:
            stamp_s, before_s = self._pending
            if local_s == before_s:
                return
            self._pending = None
            if 0.0 < local_s - before_s <= _MAX_GAP_S:
                self._add(_Pair(stamp_s, stamp_s - (before_s + local_s) / 2, local_s - before_s))
        self._newest_s = local_s

    def status(self, stamp_s: float, arrival_s: float) -> None:
        """See ClockMap; the arrival counts only as a position between the frames."""
        if self._newest_s is not None:
            self._pending = (stamp_s, self._newest_s)

    @property
    def is_ready(self) -> bool:
        """See ClockMap."""
        return (len(self._pairs) >= MIN_PAIRS
                and self._pairs[-1].stamp_s - self._pairs[0].stamp_s >= MIN_SPAN_S - 1e-6)

    def to_robot(self, local_s: float) -> float:
        """See ClockMap."""
        return local_s + self._offset_s

    def _add(self, pair: _Pair) -> None:
        self._strays = self._strays + 1 if abs(pair.offset_s - self._offset_s) > _JUMP_S else 0
        self._keep(pair)
        if self._strays >= _JUMP_PAIRS:
            self._forget(len(self._pairs) - _JUMP_PAIRS)
            self._strays, self._offset_s = 0, math.nan
        if len(self._pairs) >= MIN_PAIRS:
            self._estimate()

    def _keep(self, pair: _Pair) -> None:
        self._pairs.append(pair)
        self._offsets_s.add(pair.offset_s)
        self._gaps_s.add(pair.gap_s)
        self._forget(len(self._pairs) - _WINDOW)

    def _forget(self, count: int) -> None:
        """Remove the oldest pairs."""
        for _ in range(count):
            oldest = self._pairs.popleft()
            self._offsets_s.remove(oldest.offset_s)
            self._gaps_s.remove(oldest.gap_s)

    def _estimate(self) -> None:
        offsets = self._offsets_s.values
        self._offset_s = statistics.median(offsets)
        # Delays are one-sided, so their scatter is also the size of the error that all pairs may share; it is not
        # divided by the square root of their number.
        quantiles = statistics.quantiles(offsets, n=_QUANTILES)
        scatter_s = (quantiles[-1] - quantiles[0]) / 2
        self.gap_s = statistics.median(self._gaps_s.values)
        drift_s = _RATE_TOLERANCE * (self._pairs[-1].stamp_s - self._pairs[0].stamp_s) / 2
        self.sigma_s = math.hypot(scatter_s, self.gap_s / math.sqrt(12.0), drift_s / math.sqrt(3.0))
