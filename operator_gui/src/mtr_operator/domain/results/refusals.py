"""What was refused while a test ran, counted into its record: an invalid line says why, and this how often."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Mapping

from ..ports import LinkStatistics
from ..robot_status import RobotStatus
from .journal import SESSION, Journal
from .refused import Refused
from .session_record import REFUSED_COMMANDS, REFUSED_FRAMES, REFUSED_REPORTS, REFUSED_STATUSES

# Robot time between two entries: a flood of bad messages does not become a flood of writes.
_ENTRY_PERIOD_S = 1.0
NOTHING = Refused()
_BETWEEN = "; the last one: "


class Refusals:
    """Keeps the counts in the record of a test as they grow; those of a test that is continued go on."""

    def __init__(self, session: Mapping[str, str] | None = None, journal: Journal | None = None):
        """session: the record so far."""
        self._journal = journal or Journal()
        self._counts = {kind: _count_in(text) for kind, text in (session or {}).items()}
        self._seen: dict[str, int] = {REFUSED_STATUSES: 0}
        self._due: dict[str, str] = {}
        self._kept_s = -math.inf

    def look(self, status: RobotStatus, link: LinkStatistics, car: Refused, phone: Refused = NOTHING) -> None:
        """Take the counts as of this Status, and keep what has grown; OutputError when it cannot be kept."""
        for kind, refused in ((REFUSED_STATUSES, link.refused), (REFUSED_FRAMES, car), (REFUSED_REPORTS, phone),
                              (REFUSED_COMMANDS, Refused(status.rejected_messages))):
            # What was refused before the test does not count, nor does a robot that counts anew.
            grown = refused.count - self._seen.setdefault(kind, refused.count)
            self._seen[kind] = refused.count
            if grown > 0:
                self._counts[kind] = self._counts.get(kind, 0) + grown
                self._due[kind] = f"{self._counts[kind]}{_BETWEEN if refused.last else ''}{refused.last}"
        # The robot's clock may have been set back.
        if self._due and abs(status.stamp_s - self._kept_s) >= _ENTRY_PERIOD_S:
            self._kept_s = status.stamp_s
            self.keep()

    def keep(self) -> None:
        """Keep what has grown since the last entry."""
        if self._due:
            due, self._due = self._due, {}
            self._journal.add(SESSION, due)


def _count_in(text: str) -> int:
    number = text.partition(";")[0]
    return int(number) if number.isdecimal() and len(number) < 10 else 0
