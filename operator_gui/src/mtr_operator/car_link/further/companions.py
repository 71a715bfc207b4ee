"""Follows the further signals of the Car and assigns their values to the changes of its locks."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from typing import Iterator, Mapping, NamedTuple

from ..database.codec import SignalReader
from .counting import CountWatch
from .declared import Further
from .places import MessageKey, Place

# Stored values of each signal; a pending change needs none of the older ones.
_KEPT = 512


class Told(NamedTuple):
    """Facts that belong to a change. source: as in CarEvent, empty if unknown. raw: of a value that the profile does
    not list. key: number of the key, None if not reported. doubt: reason why the change is not plausible."""

    source: str = ""
    raw: str = ""
    key: int | None = None
    doubt: str = ""


class Companions:
    """History of the further signals, updated with every frame in the order of arrival. Local times are of the clock
    that times the first bus."""

    def __init__(self, further: Further):
        self._further = further
        self._readers: dict[MessageKey, list[SignalReader]] = collections.defaultdict(list)
        for place in further.places():
            self._readers[place.key].append(SignalReader(place.message, (place.signal,)))
        self._values: dict[tuple[MessageKey, str], collections.deque[tuple[float, int]]] = {
            (place.key, place.signal): collections.deque(maxlen=_KEPT) for place in further.places()}
        self._counters = [*((place, False) for place in further.counters), *((place, True) for place in further.alive)]
        self._watches = {(place.key, place.signal): CountWatch(place.counts, is_alive)
                         for place, is_alive in self._counters}
        self._open: set[str] = set()

    def restart(self) -> None:
        """Restart after the adapter was reopened: earlier values do not belong to later changes."""
        for values in self._values.values():
            values.clear()

    def frame(self, key: MessageKey, data: bytes, local_s: float) -> list[str]:
        """Add a frame; return sentences on values that are doubtful from now on."""
        readers = self._readers.get(key)
        if readers is None:
            return []
        values = {name: value for reader in readers for name, value in reader.values(data).items()}
        doubts = [*self._steps(key, values), *self._opened(key, values)]
        for (of_message, signal), kept in self._values.items():
            if of_message == key and signal in values:
                kept.append((local_s, values[signal]))
        return doubts

    def _steps(self, key: MessageKey, values: Mapping[str, int]) -> Iterator[str]:
        """Yield a sentence for each counter that is stuck or jumps."""
        for place, is_alive in self._counters:
            kept = self._values[place.key, place.signal]
            if place.key != key or place.signal not in values or not kept:
                continue
            before, now = (place.counts.unsigned(each) for each in (kept[-1][1], values[place.signal]))
            step = self._watches[place.key, place.signal].step(before, now)
            if step is None:
                yield f"{_signal(place)} went from {before} to {now}."
            elif is_alive and step == 0:
                yield f"{_signal(place)} stands still at {now}."

    def _opened(self, key: MessageKey, values: Mapping[str, int]) -> Iterator[str]:
        for door in self._further.doors:
            if door.place.key != key or door.place.signal not in values:
                continue
            if values[door.place.signal] not in door.open:
                self._open.discard(door.name)
            elif door.name not in self._open:
                self._open.add(door.name)
                yield f"The Car's bus tells that {door.name} is open; leave the Car's doors closed during the test."

    def told(self, change_s: float) -> Told:
        """Return the facts of a change at a local time; they are complete settles_s later."""
        sources, raws = self._causes(change_s)
        key = self._key(change_s)
        return Told(next(iter(sources), ""), "" if sources else next(iter(raws), ""), key,
                    next(self._doubts(change_s, sources, key), ""))

    def _doubts(self, change_s: float, sources: list[str], key: int | None) -> Iterator[str]:
        if len(set(sources)) > 1:
            yield f"The Car's bus names two causes of one change, {sources[0]} and {sources[-1]}."
        under_test = self._further.key_under_test
        if under_test is not None and key is None:
            yield (f"The Car's bus did not say which key moved its locks, and number {under_test} is under test; "
                   "increase cause_within_s of the car profile if it says so later.")
        elif under_test is not None and key != under_test:
            yield f"The key with the number {key} moved the Car's locks, and number {under_test} is under test."
        for counter in self._further.counters:
            yield from self._doubts_of(counter, change_s)
        if self._open:
            yield f"The Car's locks moved while {', '.join(sorted(self._open))} was open."

    def _doubts_of(self, counter: Place, change_s: float) -> Iterator[str]:
        """Yield a doubt if the counter missed the change; nothing if too few values precede the change."""
        kept, around = self._values[counter.key, counter.signal], self._around(counter, change_s)
        before = [value for time_s, value in kept if time_s < change_s - self._further.within_s]
        if not around:
            yield (f"The Car's locks moved on its bus, and {counter.signal} was silent; increase cause_within_s of the "
                   "car profile if it counts later.")
        elif before and around[-1] == before[-1]:
            yield f"The Car's locks moved on its bus, and {counter.signal} counted nothing."

    def _causes(self, change_s: float) -> tuple[list[str], list[str]]:
        """Return the listed causes and the unlisted values."""
        sources: dict[str, None] = {}
        raws: dict[str, None] = {}
        for cause in self._further.causes:
            values = self._about(cause.place, change_s, 0.0 if cause.stays else self._further.within_s)
            for value in values[-1:] if cause.stays else values:
                if value in cause.sources:
                    sources[cause.sources[value]] = None
                elif value not in cause.idle:
                    raws[f"{cause.place.signal} = {value}"] = None
        return list(sources), list(raws)

    def _key(self, change_s: float) -> int | None:
        place = self._further.key
        values = [] if place is None else self._about(place, change_s, 0.0) or self._around(place, change_s)
        return values[-1] if values else None

    def _around(self, place: Place, change_s: float) -> list[int]:
        """Return values before and after a change: a counter may be sent with either frame."""
        return self._about(place, change_s, self._further.within_s)

    def _about(self, place: Place, change_s: float, before_s: float) -> list[int]:
        """Return the values of a signal from before_s before a change to the end of the window after it."""
        return [value for time_s, value in self._values[place.key, place.signal]
                if change_s - before_s <= time_s <= change_s + self._further.within_s]


def _signal(place: Place) -> str:
    return f"The signal {place.signal} of the Car's message {place.message.name}"
