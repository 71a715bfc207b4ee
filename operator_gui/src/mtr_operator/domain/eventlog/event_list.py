"""The event list as the Operator looks at it: bounded, and filtered by kind, severity and words."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from dataclasses import dataclass
from typing import Iterable, Sequence

from .entry import INFO, EventEntry, EventKind

# A day of tests; what is older is in the files of the tests.
MAX_KEPT = 10_000


@dataclass(frozen=True)
class EventFilter:
    """kind: None for all. severity: the least that is shown. words: all of them have to be in source or sentence."""

    kind: EventKind | None = None
    severity: int = INFO
    words: tuple[str, ...] = ()

    def takes(self, entry: EventEntry, sentence: str) -> bool:
        """True for an entry that is to be shown; sentence: its text in the language in which it is shown."""
        if entry.severity < self.severity or self.kind not in (None, entry.kind):
            return False
        said = f"{entry.source} {sentence} {entry.text}".casefold()
        return all(word in said for word in self.words)


def event_filter(kind: EventKind | None, severity: int, searched: str) -> EventFilter:
    """A filter with the words of what was typed."""
    return EventFilter(kind, severity, tuple(searched.casefold().split()))


class EventList:
    """Attributes: count: of all entries that there were; those that are not kept any more are in it."""

    def __init__(self) -> None:
        self.count = 0
        self._entries: collections.deque[EventEntry] = collections.deque(maxlen=MAX_KEPT)

    def add(self, entry: EventEntry) -> None:
        """The list grows."""
        self.count += 1
        self._entries.append(entry)

    @property
    def entries(self) -> Sequence[EventEntry]:
        """Those that are kept, the oldest first."""
        return tuple(self._entries)

    def since(self, count: int) -> Iterable[EventEntry]:
        """Those that are kept of what came after so many, the oldest first."""
        wanted = min(self.count - count, len(self._entries))
        return [self._entries[index] for index in range(len(self._entries) - wanted, len(self._entries))]
