"""Whether a message still tells the present: ages that no step of the robot's clock touches. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
from typing import NamedTuple, Optional

from .schedule import MILLISECOND_NS

NS = 1e-9
# NTP slews a clock by at most 0.5 ms per s; what moves it by more than this between two readings has set it.
CLOCK_STEP_NS = 20 * MILLISECOND_NS


def is_fresh(age_s: float, limit_s: float) -> bool:
    """True for an age up to the limit; a message from farther in the future than that, or NaN, is not fresh."""
    return abs(age_s) <= limit_s


class Instant(NamedTuple):
    """One reading of the robot's clock, which may be set, and of the steady one, which never is; ns."""

    clock_ns: int
    steady_ns: int

    @property
    def offset_ns(self) -> int:
        """What lies between the two: it changes only when the robot's clock is set."""
        return self.clock_ns - self.steady_ns

    def steady_of(self, clock_ns: int) -> int:
        """The steady clock when the robot's showed this, as both were set at the reading."""
        return clock_ns - self.offset_ns


def steady_stamp_ns(stamp_ns: int, now: Instant, before: Optional[Instant] = None) -> int:
    """The steady clock's time of a stamp of the robot's clock.

    The clock may have been set between the stamp and now; of the offsets now and before, that one holds which makes
    the message younger, and not of the future.
    """
    stamps = [stamp_ns - reading.offset_ns for reading in (now, before or now)]
    past = [stamp for stamp in stamps if stamp <= now.steady_ns + CLOCK_STEP_NS]
    return min(past or stamps, key=lambda stamp: abs(now.steady_ns - stamp))


class ClockWatch:
    """Notices that the robot's clock was set.

    Attributes:
        steps: times that it was, since the first reading.
    """

    def __init__(self) -> None:
        self.steps = 0
        self._before: Optional[Instant] = None

    def update(self, now: Instant) -> bool:
        """Take a reading; True when the clock was set since the one before."""
        before, self._before = self._before, now
        stepped = before is not None and abs(now.offset_ns - before.offset_ns) > CLOCK_STEP_NS
        self.steps += stepped
        return stepped
