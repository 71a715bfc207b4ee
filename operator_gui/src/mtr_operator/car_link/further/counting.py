"""Counters in messages: their values, and their steps from frame to frame.

The number of values is not always a power of two: the counters of AUTOSAR's E2E profiles omit the highest value or
zero.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..database.car_database import is_finite
from .entries import Entries, is_whole

# The first accepted wrap of a counter leads to one of these.
_FIRST_VALUES = (0, 1)
# Number of values at the end of its range that a change counter may omit.
_LEFT_OUT = 1


@dataclass(frozen=True)
class CountRange:
    """Range of a counter. low, high: lowest and highest value; high wraps to low. length: in bits. is_declared: by the
    profile, so that any other value is wrong; else limits of the database or of the bits."""

    low: int
    high: int
    length: int
    is_declared: bool = False

    def value(self, count: int) -> int:
        """Return the value for a count from 0."""
        return self.low + count % (self.high - self.low + 1)

    def unsigned(self, value: int) -> int:
        """Return a raw value as the profile declares it: -1 of a signed counter of 4 bits is 15."""
        return value % (1 << self.length)


def count_range(entries: Entries, key: str, values: Any, signal: Any) -> CountRange:
    """Return the range of a counter (a signal of cantools).

    values: content of the profile's entry key: lowest and highest value, or their number from 0; None without one.
    """
    most = (1 << signal.length) - 1
    if values is None:
        return _of_database(signal, most)
    low, high = values if isinstance(values, list) and len(values) == 2 else (0, values)
    if not isinstance(values, list) and is_whole(values):
        high = values - 1
    if not (is_whole(low) and is_whole(high) and 0 <= low < high <= most):
        raise entries.wrong(f"{key} is {values}; allowed are the lowest and the highest value of the counter, such as "
                            f"[0, {max(most - 1, 1)}], up to {most}.")
    return CountRange(low, high, signal.length, True)


def _of_database(signal: Any, most: int) -> CountRange:
    """Return the database's range if it is usable, else all values of the bits."""
    limits = (signal.minimum, signal.maximum)
    if None in limits or not signal.scale or not all(map(is_finite, limits)):
        return CountRange(0, most, signal.length)
    low, high = sorted((float(limit) - signal.offset) / signal.scale for limit in limits)
    if not (low in _FIRST_VALUES and high.is_integer() and low + 1 < high <= most):
        return CountRange(0, most, signal.length)
    return CountRange(int(low), int(high), signal.length)


class CountWatch:
    """Checks the steps of one counter.

    may_learn: set for a counter that wraps often. Its first wrap to 0 or 1 then defines the highest value, and a later
    value beyond it is reported as a jump. A decrease that repeats is a wrap of any counter: the second one in a row is
    accepted, and replaces an earlier wrap. A single unusual value is therefore reported once.
    """

    def __init__(self, values: CountRange, may_learn: bool):
        self._values = values
        self._may_learn = may_learn
        # Highest value reached by an increment.
        self._highest = -1
        self._wrap: tuple[int, int] | None = None
        self._is_confirmed = False
        self._newest_decrease: tuple[int, int] | None = None

    def step(self, before: int, now: int) -> int | None:
        """Return 0 for a repeated value, 1 for an increment or a wrap, None for a jump."""
        before, now = (self._values.unsigned(each) for each in (before, now))
        if self._values.is_declared:
            return self._declared_step(before, now)
        if now == before:
            return 0
        is_step = self._is_increment(before, now) if now == before + 1 else self._is_wrap(before, now)
        return 1 if is_step else None

    def _declared_step(self, before: int, now: int) -> int | None:
        values = self._values
        if not (values.low <= before <= values.high and values.low <= now <= values.high):
            return None
        step = (now - before) % (values.high - values.low + 1)
        return step if step <= 1 else None

    def _is_increment(self, before: int, now: int) -> bool:
        """False for a value beyond the highest one; a wrap that was seen only once is then forgotten."""
        self._highest = max(self._highest, now)
        if self._wrap is None or before != self._wrap[0]:
            return True
        self._wrap = self._wrap if self._is_confirmed else None
        return False

    def _is_wrap(self, before: int, now: int) -> bool:
        decrease, most = (before, now), (1 << self._values.length) - 1
        is_known = decrease in ((most, 0), (self._values.high, self._values.low))
        # Two frames in the wrong order are not a wrap.
        if not is_known and before - now <= 1:
            return False
        is_repeated = decrease in (self._wrap, self._newest_decrease)
        self._newest_decrease = decrease
        if is_repeated:
            self._wrap, self._is_confirmed = decrease, True
        elif self._wrap is None and (before == self._highest if is_known else self._may_be_first(before, now)):
            self._wrap = decrease
        return is_known or decrease == self._wrap

    def _may_be_first(self, before: int, now: int) -> bool:
        """True for a decrease that is accepted as a wrap before it repeats."""
        most = (1 << self._values.length) - 1
        return now in _FIRST_VALUES and before >= (self._highest if self._may_learn else most - _LEFT_OUT)
