"""Map for an adapter whose clock is the robot's own: both are the simulated one.

In simulation, arrivals depend on the load of the machine: with a late reading thread or a fast simulator, the same
frame arrives before or after a Status. The stamps have the order of arrival on a real robot. The map uses that order,
so a simulated test does not depend on the speed of the machine.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import math

from .adapter_clock import AdapterClockMap
from .clock_map import ClockMap

# Stamps of an adapter restart each minute.
_MINUTE_S = 60.0
# Largest age or lead of the newest frame when a Status arrives; a different clock may be anywhere in the minute.
_NEAR_S = 0.25
# All frames older than this relative to the newest Status have arrived: a Status waits for frames that are a cycle
# older.
_SETTLED_S = 0.4
# Limit of the frames that wait for a Status: one second of the busiest possible bus.
_MOST_WAITING = 10_000
# Medians by arrival are accurate to some hundredths of a second, even on a busy machine.
_APART_S = 0.3


def minutes_between(local_s: float, stamp_s: float) -> float | None:
    """Return the offset of a frame's simulated time from its stamp, in s; None if the adapter has a different clock."""
    whole_s = _MINUTE_S * round((stamp_s - local_s) / _MINUTE_S) if math.isfinite(stamp_s - local_s) else math.nan
    return whole_s if abs(stamp_s - local_s - whole_s) <= _NEAR_S else None


class OrderedClockMap(ClockMap):
    """Map by the order of the stamps.

    Attributes:
        whole_s: offset of a frame's simulated time from its stamp.
        by_arrival: map by arrivals, which detects that the clocks are not the same.
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
        """False if the arrivals show that the adapter's clock is a different one, or was set."""
        by_arrival = self.by_arrival
        return not by_arrival.is_ready or abs(by_arrival.to_robot(0.0) - self.whole_s) <= _APART_S

    @property
    def gap_s(self) -> float:
        """Median interval of the frames."""
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
