"""The robot's latest warnings, each of which is sent in several Status messages."""
# SPDX-License-Identifier: Apache-2.0
import threading
from collections import deque
from dataclasses import dataclass
from typing import Deque, List

from .texts import cut

KEPT_ENTRIES = 50
# Each sentence is sent this often, so that a lost Status does not lose it.
REPETITIONS = 10
ENTRIES_PER_STATUS = 10
# A sentence that a node repeats at each tick is sent once within this time.
QUIET_S = 5.0


@dataclass
class Entry:
    """One sentence; severity: 1 info, 2 warning, 3 error."""

    id: int
    stamp_s: float
    severity: int
    source: str
    text: str
    sent: int = 0


class LogBuffer:
    """Thread-safe queue of sentences."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._entries: Deque[Entry] = deque(maxlen=KEPT_ENTRIES)
        self._next_id = 1

    def add(self, stamp_s: float, severity: int, source: str, text: str) -> None:
        """Add a sentence, unless the same one arrived within QUIET_S."""
        source, text = cut(source), cut(text)
        with self._lock:
            for entry in self._entries:
                if (entry.source, entry.text) == (source, text) and abs(stamp_s - entry.stamp_s) < QUIET_S:
                    return
            self._entries.append(Entry(self._next_id, stamp_s, severity, source, text))
            self._next_id += 1

    def due(self) -> List[Entry]:
        """Return the sentences for the next Status, oldest first, and count them as sent."""
        with self._lock:
            entries = [entry for entry in self._entries if entry.sent < REPETITIONS][:ENTRIES_PER_STATUS]
            for entry in entries:
                entry.sent += 1
            return entries
