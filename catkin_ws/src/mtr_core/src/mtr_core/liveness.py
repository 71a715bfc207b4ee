"""Freshness of messages: their ages are not affected by steps of the robot's clock. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Optional

from .schedule import MILLISECOND_NS

NS = 1e-9
# NTP slews a clock by at most 0.5 ms per s; a larger change between two readings is a step.
CLOCK_STEP_NS = 20 * MILLISECOND_NS


def is_fresh(age_s: float, limit_s: float) -> bool:
    """Return True for an age up to the limit; False also for a stamp beyond the limit in the future, and for NaN."""
    return abs(age_s) <= limit_s


class Instant(NamedTuple):
    """One reading of the robot's clock, which may be set, and of the steady clock, which is never set; ns."""

    clock_ns: int
    steady_ns: int

    @property
    def offset_ns(self) -> int:
        """Difference of the clocks, which changes only when the robot's clock is set."""
        return self.clock_ns - self.steady_ns

    def steady_of(self, clock_ns: int) -> int:
        """Return the steady time at a time of the robot's clock, for the offset at the reading."""
        return clock_ns - self.offset_ns


def steady_stamp_ns(stamp_ns: int, now: Instant, before: Optional[Instant] = None) -> int:
    """Return the steady time of a stamp of the robot's clock.

    The clock may have been set between the stamp and now. Of the current and the previous offset, the function uses the
    one that makes the message younger, but not newer than now.
    """
    stamps = [stamp_ns - reading.offset_ns for reading in (now, before or now)]
    past = [stamp for stamp in stamps if stamp <= now.steady_ns + CLOCK_STEP_NS]
    return min(past or stamps, key=lambda stamp: abs(now.steady_ns - stamp))


class ClockWatch:
    """Detects steps of the robot's clock.

    Attributes:
        steps: number of steps since the first reading.
    """

    def __init__(self) -> None:
        self.steps = 0
        self._before: Optional[Instant] = None

    def update(self, now: Instant) -> bool:
        """Process a reading; return True if the clock was set since the previous one."""
        before, self._before = self._before, now
        stepped = before is not None and abs(now.offset_ns - before.offset_ns) > CLOCK_STEP_NS
        self.steps += stepped
        return stepped
