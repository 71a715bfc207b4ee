"""Counters in messages: which values they count through, and whether one goes on from frame to frame.

Not every counter has a power of two of values: those of AUTOSAR's E2E profiles leave one out, others the zero.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..database.car_database import is_finite
from .entries import Entries, is_whole

# A counter that begins again does so with one of these.
_FIRST_VALUES = (0, 1)
# Values less than all of its bits that a counter of changes may leave out at its end.
_LEFT_OUT = 1


@dataclass(frozen=True)
class CountRange:
    """low, high: values that it counts through before it begins again. length: bits. is_declared: by the profile, so
    that no other value is right; else they are limits of the database or of its bits."""

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
    """Return the values of a counter (a signal of cantools).

    values: of the profile's entry key: lowest and highest, or their number from 0; None without one.
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
    """All values, where the database names no others that may be."""
    limits = (signal.minimum, signal.maximum)
    if None in limits or not signal.scale or not all(map(is_finite, limits)):
        return CountRange(0, most, signal.length)
    low, high = sorted((float(limit) - signal.offset) / signal.scale for limit in limits)
    if not (low in _FIRST_VALUES and high.is_integer() and low + 1 < high <= most):
        return CountRange(0, most, signal.length)
    return CountRange(int(low), int(high), signal.length)


class CountWatch:
    """Follows one counter. may_learn: it counts so often that it begins again soon; then the value after which it does
    is taken from the first time, until it counts beyond it."""

    def __init__(self, values: CountRange, may_learn: bool):
        self._values = values
        self._may_learn = may_learn
        self._highest = -1
        self._wrap: tuple[int, int] | None = None

    def step(self, before: int, now: int) -> int | None:
        """Return 0 for a repeated value, 1 for the next value, None for a jump."""
        before, now = (self._values.unsigned(each) for each in (before, now))
        if self._values.is_declared:
            return self._declared_step(before, now)
        self._highest = max(self._highest, before) if self._highest < 0 else self._highest
        if now == before:
            return 0
        if now == before + 1:
            self._highest = max(self._highest, now)
            is_beyond = self._wrap is not None and before == self._wrap[0]
            self._wrap = None if is_beyond else self._wrap
            return None if is_beyond else 1
        return 1 if self._begins_again(before, now) else None

    def _declared_step(self, before: int, now: int) -> int | None:
        values = self._values
        if not (values.low <= before <= values.high and values.low <= now <= values.high):
            return None
        step = (now - before) % (values.high - values.low + 1)
        return step if step <= 1 else None

    def _begins_again(self, before: int, now: int) -> bool:
        values, most = self._values, (1 << self._values.length) - 1
        if (before, now) in ((most, 0), (values.high, values.low), self._wrap):
            self._wrap = self._wrap or (before, now)
            return True
        is_end = before >= self._highest if self._may_learn else before >= most - _LEFT_OUT
        if self._wrap is not None or now not in _FIRST_VALUES or not is_end or before - now <= 1:
            return False
        self._wrap = (before, now)
        return True
