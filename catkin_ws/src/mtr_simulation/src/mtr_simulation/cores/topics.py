"""What the parts say to each other, read at ticks by the rules of docs/lock-step.md; messages are plain records."""
# SPDX-License-Identifier: Apache-2.0
import bisect
import math
from typing import Any, Callable, List, Optional

from mtr_core.liveness import NS, is_fresh
from mtr_core.schedule import CLOCK_STEP, KEPT_SAMPLES


class Topic:
    """Messages of one producer that are still read, by their stamps."""

    def __init__(self) -> None:
        self._stamps_ns: List[int] = []
        self._messages: List[Any] = []
        self._listeners: List[Callable[[Any], None]] = []

    def input(self, lag_ns: int = CLOCK_STEP.period_ns) -> "Input":
        """One more reader; a message is due to it lag_ns after its stamp."""
        return Input(self, lag_ns)

    def listen(self, listener: Callable[[Any], None]) -> None:
        """Have each message told at once."""
        self._listeners.append(listener)

    def publish(self, message: Any) -> None:
        """A message with a header."""
        self.add(message.header.stamp.to_nsec(), message)
        for listener in self._listeners:
            listener(message)

    def add(self, stamp_ns: int, message: Any) -> None:
        """A message of that time, which is later than those before."""
        self._stamps_ns.append(stamp_ns)
        self._messages.append(message)
        if len(self._stamps_ns) > 2 * KEPT_SAMPLES:
            del self._stamps_ns[:-KEPT_SAMPLES], self._messages[:-KEPT_SAMPLES]

    def until(self, time_ns: int) -> Optional[Any]:
        """The newest message that is stamped no later, None without one."""
        index = bisect.bisect_right(self._stamps_ns, time_ns)
        return self._messages[index - 1] if index else None


class Input:
    """A topic as a part reads it, as mtr_core.lockstep.TickInput in lock-step."""

    def __init__(self, topic: Topic, lag_ns: int):
        self._topic, self._lag_ns = topic, lag_ns
        self._used: Optional[Any] = None

    def at(self, tick_ns: int) -> Optional[Any]:
        """Message to use at the tick, None before the first one."""
        self._used = self._topic.until(tick_ns - self._lag_ns)
        return self._used

    def fresh_at(self, tick_ns: int, limit_s: float) -> Optional[Any]:
        """The same, None when it no longer tells the present."""
        message = self.at(tick_ns)
        return message if is_fresh(self.age_s(tick_ns), limit_s) else None

    def age_s(self, tick_ns: int) -> float:
        """Age at the tick of the message that `at` gave last; inf for none."""
        return math.inf if self._used is None else (tick_ns - self._used.header.stamp.to_nsec()) * NS

    @property
    def stamp_s(self) -> float:
        """Stamp of the message that `at` gave last; NaN for none."""
        return math.nan if self._used is None else self._used.header.stamp.to_nsec() * NS


class Topics:
    """All that parts read of each other at ticks, by who says it."""

    def __init__(self) -> None:
        self.pose = Topic()
        self.desired = Topic()
        self.mode = Topic()
        self.car = Topic()
        self.check = Topic()
        self.velocity = Topic()
        self.motion = Topic()
        self.drive = Topic()
        self.peripherals = Topic()
