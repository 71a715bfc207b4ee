"""Recognises check sums, and counters of the frames and of the changes of the locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Iterator, NamedTuple, Sequence

from ..further.counting import CountRange, CountWatch
from .bits import BITS_PER_BYTE, Held, field_of
from .recording import Message

# Counters of frames have 2 to 8 bits in one byte.
_MIN_WIDTH = 2
# Lost frames make a counter jump.
_MIN_SHARE = 0.9
# Repetitions of the same decrease before it counts as the wrap.
_MIN_WRAPS = 2
# Minimum number of frames whose other bytes repeat, so that the same check sum must follow.
_MIN_REPEATS = 16
# Maximum number of frames: more add no information and cost time.
_MIN_FRAMES, _MAX_FRAMES = 32, 2000


class Field(NamedTuple):
    """Neighbouring bits of one byte; start: number of the lowest one, from 0 in the first byte."""

    start: int
    width: int

    @property
    def byte(self) -> int:
        """Number of the byte, from 0."""
        return self.start // BITS_PER_BYTE

    def holds(self, bit: int) -> bool:
        """Return True if the field contains this bit."""
        return self.start <= bit < self.start + self.width


class FrameCounter(NamedTuple):
    """Frame counter. field: its bits. values: lowest and highest value of a counter that omits values of its bits; None
    for any other."""

    field: Field
    values: tuple[int, int] | None = None


def frame_counter(message: Message) -> FrameCounter | None:
    """Return the bits that count the frames of a message; None without any."""
    values = [sample.value for sample in message.samples[:_MAX_FRAMES]]
    if len(values) < _MIN_FRAMES or not message.length:
        return None
    found = [each for field in _fields(message.length) for each in _shares(values, field)]
    share, *_, best = max(found, key=lambda each: each[:3])
    return _checked(message, best) if share >= _MIN_SHARE else None


def change_counter(parts: Sequence[Held], length: int) -> Field | None:
    """Return the widest field that is constant in each stay and increments from stay to stay; None without one."""
    found = [field for field in _fields(length) if _counts_stays(parts, field)]
    return max(found, key=lambda field: field.width) if found else None


def check_sum(message: Message, counter: Field | None) -> int | None:
    """Return the number of the byte that changes with the counter and repeats with the other bytes; None without one.

    counter: of the frames; without one a check sum cannot be distinguished from a measured value.
    """
    if counter is None:
        return None
    found = (byte for byte in range(message.length) if byte != counter.byte and _is_check_sum(message, byte))
    return next(found, None)


def _fields(length: int) -> list[Field]:
    """Return all candidate fields for a counter."""
    return [Field(byte * BITS_PER_BYTE + low, width) for byte in range(length)
            for low in range(BITS_PER_BYTE - _MIN_WIDTH + 1) for width in range(_MIN_WIDTH, BITS_PER_BYTE - low + 1)]


def _checked(message: Message, found: FrameCounter) -> FrameCounter | None:
    """Return the counter as a test would follow it over the whole recording, without a range if the range does not fit.
    None if a test would not understand most of its frames either way."""
    parts = [field_of(sample.value, *found.field) for sample in message.samples]
    return next((each for each in (found, FrameCounter(found.field)) if _share_of_steps(parts, each) >= _MIN_SHARE),
                None)


def _share_of_steps(parts: Sequence[int], counter: FrameCounter) -> float:
    """Return the share of the steps that CountWatch accepts as increments or wraps."""
    width = counter.field.width
    low, high = counter.values or (0, (1 << width) - 1)
    watch = CountWatch(CountRange(low, high, width, counter.values is not None), may_learn=True)
    return sum(watch.step(before, now) == 1 for before, now in zip(parts, parts[1:])) / (len(parts) - 1)


def _shares(values: Sequence[int], field: Field) -> Iterator[tuple[float, int, bool, FrameCounter]]:
    """Yield the share of increments and wraps, the width, True for a full range, and the counter."""
    parts = [field_of(value, field.start, field.width) for value in values]
    steps = collections.Counter(zip(parts, parts[1:]))
    counted = sum(number for (before, now), number in steps.items() if now == before + 1)
    most = (1 << field.width) - 1
    yield (counted + steps[most, 0]) / (len(parts) - 1), field.width, True, FrameCounter(field)
    decreases = ((number, before, now) for (before, now), number in steps.items() if now < before)
    # The most frequent decrease is used, so that a single unusual value does not count as an end.
    wraps, high, low = max(decreases, default=(0, 0, 0))
    # The highest bit changes, so it belongs to the counter.
    if (low, high) != (0, most) and low <= most >> 1 < high and wraps >= _MIN_WRAPS:
        yield (counted + wraps) / (len(parts) - 1), field.width, False, FrameCounter(field, (low, high))


def _counts_stays(parts: Sequence[Held], field: Field) -> bool:
    mask = (1 << field.width) - 1 << field.start
    if any(part.still & mask != mask for part in parts):
        return False
    values = [field_of(part.value, *field) for part in parts]
    watch = CountWatch(CountRange(0, (1 << field.width) - 1, field.width), may_learn=False)
    return all(watch.step(before, now) == 1 for before, now in zip(values, values[1:]))


def _is_check_sum(message: Message, byte: int) -> bool:
    mask = 0xFF << byte * BITS_PER_BYTE
    sums: dict[int, int] = {}
    repeats = moves = 0
    before = -1
    for sample in message.samples:
        rest, value = sample.value & ~mask, sample.value & mask
        if rest in sums:
            repeats += 1
            if sums[rest] != value:
                return False
        sums[rest] = value
        moves += value != before
        before = value
    return repeats >= _MIN_REPEATS and moves >= _MIN_SHARE * len(message.samples)
