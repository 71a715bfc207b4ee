"""Map for an adapter whose clock is the robot's own: both are the simulated one.

There arrivals tell what the machine had to do: a reading thread that is late, or a simulator that is ahead, makes the
same frame one of before a Status or of after it. Their stamps tell the order that they would come in on a robot, so the
map is made in that order, and a simulated test does not depend on the machine's speed.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math

from .adapter_clock import AdapterClockMap
from .clock_map import ClockMap

# Stamps of an adapter start again each minute.
_MINUTE_S = 60.0
# A newest frame is as old as this, or as far ahead, when a Status comes; another clock is anywhere in the minute.
_NEAR_S = 0.25
# What is older than this against the newest Status has all come: a Status waits for frames that are a cycle older.
_SETTLED_S = 0.4
# A bus speaks on when no Status comes: a second of the busiest that there is.
_MOST_WAITING = 10_000
# Medians by arrival are within some hundredths of a second of the truth, however busy the machine is.
_APART_S = 0.3


def minutes_between(local_s: float, stamp_s: float) -> float | None:
    """What a frame's simulated time is beyond its stamp, in s; None where the adapter's clock is another one."""
    whole_s = _MINUTE_S * round((stamp_s - local_s) / _MINUTE_S) if math.isfinite(stamp_s - local_s) else math.nan
    return whole_s if abs(stamp_s - local_s - whole_s) <= _NEAR_S else None


class OrderedClockMap(ClockMap):
    """Attributes:
        whole_s: what a frame's simulated time is beyond its stamp.
        by_arrival: the map that arrivals tell, which knows when the clocks are not one.
    """

    def __init__(self, whole_s: float) -> None:
        self.by_arrival = AdapterClockMap()
        self._in_order = AdapterClockMap()
        self.whole_s = whole_s
        self._frames_s: collections.deque[float] = collections.deque(maxlen=_MOST_WAITING)
        self._stamps_s: collections.deque[float] = collections.deque(maxlen=_MOST_WAITING)

    def frame(self, local_s: float) -> None:
        """See ClockMap."""
        self.by_arrival.frame(local_s)
        self._frames_s.append(local_s)

    def status(self, stamp_s: float, arrival_s: float) -> None:
        """See ClockMap."""
        self.by_arrival.status(stamp_s, arrival_s)
        self._stamps_s.append(stamp_s)
        settled_s = stamp_s - _SETTLED_S
        while self._next_s <= settled_s:
            if self._next_frame_s <= self._next_stamp_s:
                self._in_order.frame(self._frames_s.popleft())
            else:
                self._in_order.status(self._stamps_s.popleft(), arrival_s)

    @property
    def is_one_clock(self) -> bool:
        """False when arrivals say that the adapter's clock is another one, or was set."""
        by_arrival = self.by_arrival
        return not by_arrival.is_ready or abs(by_arrival.to_robot(0.0) - self.whole_s) <= _APART_S

    @property
    def gap_s(self) -> float:
        """From frame to frame, by the median."""
        return self._in_order.gap_s

    @property
    def is_ready(self) -> bool:
        """See ClockMap."""
        return self._in_order.is_ready

    @property
    def sigma_s(self) -> float:  # type: ignore[override]
        """See ClockMap."""
        return self._in_order.sigma_s

    def to_robot(self, local_s: float) -> float:
        """See ClockMap."""
        return self._in_order.to_robot(local_s)

    @property
    def _next_frame_s(self) -> float:
        return self._frames_s[0] + self.whole_s if self._frames_s else math.inf

    @property
    def _next_stamp_s(self) -> float:
        return self._stamps_s[0] if self._stamps_s else math.inf

    @property
    def _next_s(self) -> float:
        return min(self._next_frame_s, self._next_stamp_s)
