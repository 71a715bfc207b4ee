"""Samples of one periodic producer, and the selection of the sample for a consumer's tick. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import bisect
import threading
import time
from typing import Callable, Generic, List, Optional, TypeVar

from mtr_core.schedule import (
    CLOCK_STEP,
    KEPT_SAMPLES,
    LATE_PRODUCER_SHARE,
    PRODUCER_LOST_AFTER_WALL_S,
    SIMULATION_START_NS,
    Slot,
)

T = TypeVar("T")

# Limit of the wait for a consumer (wall time), after which the next sample is read regardless.
UNWANTED_LIMIT_WALL_S = 1.0


class Samples(Generic[T]):
    """Thread-safe history of stamped samples of one producer.

    Attributes:
        slot: the producer's ticks.
        lag_ns: a sample is due this long after its stamp; 0 for sensors, which precede the clock.
        waits: True in lock-step, where `at` returns the same sample at any speed of the machine.
        patience_s: wall time after which a silent producer counts as dead. After its return the wait is a share of
            this, until it is in time.
    """

    def __init__(self, slot: Slot, lag_ns: int = CLOCK_STEP.period_ns, waits: bool = True,
                 wall_clock: Callable[[], float] = time.monotonic):
        self.slot, self.lag_ns, self.waits = slot, lag_ns, waits
        self.patience_s = PRODUCER_LOST_AFTER_WALL_S
        self._wall_clock = wall_clock
        self._changed = threading.Condition()
        self._stamps: List[int] = []
        self._values: List[T] = []
        self._lost = self._late = False
        self._asked_ns = self._wanted_ns = 0

    def add(self, stamp_ns: int, value: T) -> None:
        """Add the producer's next sample; an older one replaces the history (a restart), an equal one the last."""
        with self._changed:
            while self._stamps and stamp_ns <= self._stamps[-1]:
                restarted = stamp_ns < self._stamps[-1]
                del self._stamps[0 if restarted else -1:], self._values[0 if restarted else -1:]
            self._stamps.append(stamp_ns)
            self._values.append(value)
            del self._stamps[:-KEPT_SAMPLES], self._values[:-KEPT_SAMPLES]
            self._lost = False
            if stamp_ns >= self._asked_ns:
                self._changed.notify_all()

    def wait_until_wanted(self) -> None:
        """Wait until the consumer needs a newer sample than the newest, unless it needs the next one.

        The thread that reads samples from a connection calls this after each one. Samples of a fast producer then
        remain in the connection until one is due, and the thread wakes once for all of them.
        """
        with self._changed:
            newest_ns = self._stamps[-1] if self._stamps else 0
            if self.waits and self._asked_ns <= newest_ns < self._wanted_ns - self.slot.period_ns:
                self._changed.wait(UNWANTED_LIMIT_WALL_S)

    def at(self, tick_ns: int) -> Optional[T]:
        """Return the sample for a consumer's tick: in lock-step the sample that is due, otherwise the newest."""
        with self._changed:
            if not self.waits:
                return self._values[-1] if self._values else None
            self._wait_for(self._ask(tick_ns))
            index = bisect.bisect_right(self._stamps, tick_ns - self.lag_ns)
            return self._values[index - 1] if index else None

    def _ask(self, tick_ns: int) -> int:
        """Return the stamp of the sample that is due, and release wait_until_wanted."""
        due_ns = self.slot.last_at(tick_ns - self.lag_ns)
        self._asked_ns, self._wanted_ns = due_ns, due_ns + (due_ns - self._asked_ns if self._asked_ns else 0)
        self._changed.notify_all()
        return due_ns

    def _wait_for(self, due_ns: int) -> None:
        if due_ns <= SIMULATION_START_NS:
            return
        deadline = self._wall_clock() + self.patience_s * (LATE_PRODUCER_SHARE if self._late else 1.0)
        while not self._lost and not self._has_arrived(due_ns):
            remaining = deadline - self._wall_clock()
            if remaining <= 0.0:
                self._lost = True
            else:
                self._changed.wait(remaining)
        self._late = not self._has_arrived(due_ns)

    def _has_arrived(self, due_ns: int) -> bool:
        return bool(self._stamps) and self._stamps[-1] >= due_ns
