"""The course of a test for whoever computes its distances anew: each Status, and what the test expected of the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Any, Mapping

from ..ports import BusMark
from ..robot_status import RobotStatus
from .journal import FURTHER, LINE, LINE_BEGUN, LINE_RESUMED, POINT, Journal

# What a line expects of the locks, and when nobody looks at them any more; see LockHistory.
WATCHED, HELD, EXPECTED, ALLOWED, CLOSED, UNWATCHED = "watched", "held", "expected", "allowed", "closed", "unwatched"
# Entries of the journal of which a replay has to know when they were made.
_OF_JOURNAL = (LINE_BEGUN, LINE_RESUMED, FURTHER, POINT, LINE)


class Course:
    """Keeps nothing; the one in storage writes a file. Never ends a test."""

    def status(self, status: RobotStatus, mark: BusMark | None) -> None:
        """A Status was taken, and the bus observed up to it."""

    def note(self, kind: str, values: Mapping[str, Any]) -> None:
        """Something that was done between this Status and the next."""


class CourseJournal(Journal):
    """Hands each entry on, and notes in the course when it was made."""

    def __init__(self, journal: Journal, course: Course):
        self._journal = journal
        self._course = course

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        if kind in _OF_JOURNAL:
            self._course.note(kind, values)
        self._journal.add(kind, values)

    def wait(self, patience_s: float = math.inf) -> bool:
        return self._journal.wait(patience_s)

    def check(self) -> None:
        self._journal.check()
