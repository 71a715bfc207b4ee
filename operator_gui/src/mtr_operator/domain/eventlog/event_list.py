"""Event list for the Operator: bounded, and filtered by kind, severity and words."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
from dataclasses import dataclass
from typing import Iterable, Sequence

from .entry import INFO, EventEntry, EventKind

# One day of tests; older entries are in the files of the tests.
MAX_KEPT = 10_000


@dataclass(frozen=True)
class EventFilter:
    """Filter. kind: None for all. severity: the lowest shown. words: all of them must be in source or sentence."""

    kind: EventKind | None = None
    severity: int = INFO
    words: tuple[str, ...] = ()

    def takes(self, entry: EventEntry, sentence: str) -> bool:
        """Return True for an entry to be shown; sentence: its text in the displayed language."""
        if entry.severity < self.severity or self.kind not in (None, entry.kind):
            return False
        said = f"{entry.source} {sentence} {entry.text}".casefold()
        return all(word in said for word in self.words)


def event_filter(kind: EventKind | None, severity: int, searched: str) -> EventFilter:
    """Return a filter with the words of the typed text."""
    return EventFilter(kind, severity, tuple(searched.casefold().split()))


class EventList:
    """List of the newest entries. Attributes: count: of all entries so far, including dropped ones."""

    def __init__(self) -> None:
        self.count = 0
        self._entries: collections.deque[EventEntry] = collections.deque(maxlen=MAX_KEPT)

    def add(self, entry: EventEntry) -> None:
        """Add an entry."""
        self.count += 1
        self._entries.append(entry)

    @property
    def entries(self) -> Sequence[EventEntry]:
        """Return the stored entries, oldest first."""
        return tuple(self._entries)

    def since(self, count: int) -> Iterable[EventEntry]:
        """Return the stored entries after the first `count` ones, oldest first."""
        wanted = min(self.count - count, len(self._entries))
        return [self._entries[index] for index in range(len(self._entries) - wanted, len(self._entries))]
