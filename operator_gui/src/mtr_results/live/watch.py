"""Shared cache of the sections of followed tests: files are read once per change, for any number of browsers."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import threading
from typing import Mapping

from mtr_operator.domain.errors import OperatorError

from ..report.pages import render_part
from ..store import reading
from ..store.database import Database
from .followed import Followed, FollowedTest, Stamp, look
from .sections import NOW, MeasuredSoFar, read_so_far, sections

# Number of cached tests; with more followed tests, files are read more often.
_REMEMBERED = 8
Read = tuple[tuple[Stamp, Stamp], MeasuredSoFar]


class Watch:
    """Sections of the tests in some folders. Each browser polls at its own rate."""

    def __init__(self, followed: Followed, database: Database):
        self._followed = followed
        self._database = database
        self._lock = threading.Lock()
        self._read: collections.OrderedDict[str, Read] = collections.OrderedDict()

    def tests(self) -> list[FollowedTest]:
        """See Followed."""
        return self._followed.tests()

    @property
    def is_following(self) -> bool:
        """True if folders are followed."""
        return bool(self._followed.folders)

    def test(self, name: str) -> FollowedTest:
        """See Followed."""
        return self._followed.test(name)

    def sections(self, test: FollowedTest) -> Mapping[str, str]:
        """Return the HTML by section id, or the reason if the files cannot be read at present."""
        try:
            seen = look(test.path)
            with self._lock:
                measured = self._measured(test, seen.test)
            return sections(measured, seen, self._number(measured.entry.test_id))
        except (OperatorError, OSError, LookupError, TypeError, ValueError, ArithmeticError, AttributeError) as error:
            said = str(error) if isinstance(error, OperatorError) else f"{type(error).__name__}: {error}"
            return {NOW: render_part("live_problem.html", sentence=said)}

    def so_far(self, test: FollowedTest) -> MeasuredSoFar:
        """Return the contents of the test's files; OperatorError if they do not contain a test."""
        with self._lock:
            return self._measured(test, look(test.path).test)

    def _measured(self, test: FollowedTest, stamp: tuple[Stamp, Stamp]) -> MeasuredSoFar:
        known = self._read.get(test.name)
        if known is None or known[0] != stamp:
            known = self._read[test.name] = stamp, read_so_far(test.path)
            while len(self._read) > _REMEMBERED:
                self._read.popitem(last=False)
        self._read.move_to_end(test.name)
        return known[1]

    def _number(self, test_id: str) -> int | None:
        """Return the number of the test in the store; None if it is unavailable, so that the page still works."""
        try:
            with self._database.reading() as connection:
                return reading.number_by_key(connection, test_id)
        except OperatorError:
            return None
