"""A topic as input of a periodic node."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, NamedTuple, Optional

import rospy

from mtr_core.liveness import NS, Instant, is_fresh, steady_stamp_ns
from mtr_core.schedule import CLOCK_STEP, Slot

from . import clock
from .patience import patience_s
from .samples import Samples


class Arrived(NamedTuple):
    """A message, and its stamp on the steady clock."""

    message: Any
    steady_stamp_ns: int


class TickInput:
    """Subscription to a periodic topic with a header; `at(tick)` returns the message to use at a tick.

    In lock-step it waits for the message that is due at that tick, so that the result does not depend on the speed of
    the machine. Otherwise it returns the newest message.
    """

    def __init__(self, topic: str, message_type: Any, slot: Slot, lag_ns: int = CLOCK_STEP.period_ns):
        self._samples: Samples[Arrived] = Samples(slot, lag_ns, waits=clock.is_lockstep())
        self._samples.patience_s = patience_s()
        self._before: Optional[Instant] = None
        self._used: Optional[Arrived] = None
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=50, tcp_nodelay=True)

    def at(self, tick_ns: int) -> Optional[Any]:
        """Return the message to use at the tick, or None before the first one."""
        self._used = self._samples.at(tick_ns)
        return self._used.message if self._used else None

    def age_s(self, tick_ns: int) -> float:
        """Return the age at the tick of the last message of `at`, unaffected by clock steps; inf without a message."""
        return (clock.steady_at(tick_ns) - self._used.steady_stamp_ns) * NS if self._used else math.inf

    @property
    def stamp_s(self) -> float:
        """Stamp of the last message of `at` on the steady clock in s; NaN without a message."""
        return self._used.steady_stamp_ns * NS if self._used else math.nan

    def fresh_at(self, tick_ns: int, limit_s: float) -> Optional[Any]:
        """Return the message like `at`, but None if it is older than the limit."""
        message = self.at(tick_ns)
        return message if is_fresh(self.age_s(tick_ns), limit_s) else None

    def _take(self, message: Any) -> None:
        stamp_ns = message.header.stamp.to_nsec()
        now = clock.reading()
        self._samples.add(stamp_ns, Arrived(message, stamp_ns if clock.is_simulated() else
                                            steady_stamp_ns(stamp_ns, now, self._before)))
        self._before = now
        self._samples.wait_until_wanted()
