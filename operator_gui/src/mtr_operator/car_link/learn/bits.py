"""Constant bits of a message during each stay, and their values."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import bisect
from typing import Iterator, NamedTuple, Sequence

from .recording import Message, Sample, Stay

BITS_PER_BYTE = 8


class Held(NamedTuple):
    """Data of a message during one stay, and a mask of the bits that did not change in it."""

    value: int
    still: int


def held(message: Message, stays: Sequence[Stay]) -> list[Held]:
    """Return the data of each stay. For a message that is sent only on change the last data applies, and zeros before
    its first frame."""
    times_s = [sample.time_s for sample in message.samples]
    everything = (1 << BITS_PER_BYTE * message.length) - 1
    found = []
    for stay in stays:
        begin, end = bisect.bisect_left(times_s, stay.begin_s), bisect.bisect_right(times_s, stay.end_s)
        if begin == end:
            begin -= 1
        if begin < 0:
            found.append(Held(0, everything))
            continue
        common = either = message.samples[begin].value
        for sample in message.samples[begin + 1:end]:
            common &= sample.value
            either |= sample.value
        found.append(Held(common, everything & ~(common ^ either)))
    return found


def still_bits(parts: Sequence[Held]) -> int:
    """Return the mask of the bits that were constant in every stay."""
    mask = -1
    for part in parts:
        mask &= part.still
    return mask


def ones(mask: int) -> Iterator[int]:
    """Yield the numbers of the set bits."""
    bit = 0
    while mask >> bit:
        if mask >> bit & 1:
            yield bit
        bit += 1


def field_of(value: int, start: int, width: int) -> int:
    """Return the value of some bits."""
    return value >> start & (1 << width) - 1


def changes(samples: Sequence[Sample], start: int, width: int) -> list[tuple[float, int]]:
    """Return times and values of the changes of some bits; the first item is the initial value."""
    found: list[tuple[float, int]] = []
    for sample in samples:
        value = field_of(sample.value, start, width)
        if not found or found[-1][1] != value:
            found.append((sample.time_s, value))
    return found
