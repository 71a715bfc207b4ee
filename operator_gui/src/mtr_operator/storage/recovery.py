"""A test from its progress file and its journal, of which either may be missing, older than the other, or damaged.

The journal is written first, and the progress file follows from it; so the one that reaches farther counts.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import os
import pathlib
from typing import Any

from mtr_operator.domain.errors import ProgressFileError
from mtr_operator.domain.results.journal import BEGUN
from mtr_operator.domain.results.notebook import apply
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario

from .journal.journal_file import SUFFIX, Recovered, journal_of
from .journal.second_place import distrusted, kept_journals
from .progress_document import DAMAGED, mark_in, progress_from_document, read_document


class Recovery:
    """Both files of a test; ProgressFileError when there is nothing to go on with.

    path: of the progress file, or of the journal when that alone shall count. to_go_on: what was kept in a second place
    counts, too, where it continues the test; a copy that is only looked at is what it is.

    Attributes:
        document: of the progress file, or the one with which the journal began.
    """

    def __init__(self, path: pathlib.Path, to_go_on: bool = False):
        self._stored, self._journal, notice = _read(path)
        self._notices = [notice]
        self._to_go_on = to_go_on
        if to_go_on:
            self._take_kept()
        begun = self._journal.entries[0].values.get("progress") if self._journal.entries else None
        self.document: dict[str, Any] = _table(begun if self._stored is None else self._stored)

    def progress(self, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
        """The test as far as it is known; ProgressFileError says what does not fit."""
        notices = [*self._notices]
        progress = None if self._stored is None else progress_from_document(self._stored, scenario, parameters)
        if self._journal_counts():
            try:
                progress = _replayed(self._journal, scenario, parameters)
                progress.journal = self._journal.content if self._to_go_on else b""
            except ProgressFileError:
                if progress is None or progress.kept is None:
                    raise
                notices.append("The journal does not fit together; the progress file alone counts.")
        if progress is None:
            raise ProgressFileError(DAMAGED)
        progress.notice = " ".join(filter(None, notices))
        return progress

    def _take_kept(self) -> None:
        """Go on with the journal in a second place that reaches farthest, if it continues what is here."""
        marks = [mark for mark in (self._journal.mark, mark_in(self._stored)) if mark is not None]
        if not marks:
            return
        mine, reach = self._journal.content, max(mark.entries for mark in marks)
        self._notices += distrusted(marks[0])
        farther = [(place, kept) for place, kept in kept_journals(marks[0]) if kept.entries[-1].sequence > reach]
        continuing = [(place, kept) for place, kept in farther if kept.content.startswith(mine)]
        if continuing:
            place, self._journal = max(continuing, key=lambda each: each[1].entries[-1].sequence)
            self._notices.append(f"What was measured last is taken from {place}, where it was kept.")
        self._notices += [f"Another part of this test, measured apart from this one, is kept in {place}."
                          for place, kept in farther if not self._journal.content.startswith(kept.content)]

    def _journal_counts(self) -> bool:
        """True when the journal reaches at least as far as the progress file."""
        there = self._journal.mark
        if there is None or self._stored is None:
            return there is not None
        mine = mark_in(self._stored)
        if mine is None:
            # Of a version without journals, or killed before the first line was complete.
            return _continues(self._journal, self._stored)
        if mine.id != there.id:
            raise ProgressFileError("The journal beside it belongs to another test; move that file elsewhere.")
        return there.entries >= mine.entries


def progress_path(path: pathlib.Path) -> pathlib.Path:
    """Of the test to which a person names the progress file or the journal."""
    return path.with_suffix(".json") if path.suffix == SUFFIX else path


def _read(path: pathlib.Path) -> tuple[Any, Recovered, str]:
    """Document of the progress file or None, good part of the journal, and what is to be said of them."""
    notice = ""
    try:
        journal = journal_of(path)
        if journal.is_damaged:
            count = len(journal.entries)
            notice = (f"Of the journal of {path}, its last entry was cut off; the {count} entries before that are used."
                      if journal.is_torn else f"The journal of {path} is damaged; its first {count} entries are used.")
    except ProgressFileError as error:
        if path.suffix == SUFFIX and not os.path.lexists(progress_path(path)):
            # It is all that there is of the test.
            raise
        journal, notice = Recovered((), b""), str(error)
    if path.suffix == SUFFIX and journal.entries:
        return None, journal, notice
    try:
        # "null" is a document, and none of a test.
        return read_document(progress_path(path)) or {}, journal, notice
    except ProgressFileError as error:
        if not journal.entries:
            raise
        return None, journal, " ".join(filter(None, (f"The progress file {path} was recovered from its journal. "
                                                     f"{error}", notice)))


def _table(document: Any) -> dict[str, Any]:
    return document if isinstance(document, dict) else {}


def _continues(journal: Recovered, stored: Any) -> bool:
    begun = _table(journal.entries[0].values.get("progress"))
    if begun.get("results") != _table(stored).get("results"):
        raise ProgressFileError("The journal beside it belongs to another test; move that file elsewhere.")
    return True


def _replayed(journal: Recovered, scenario: AnyScenario, parameters: dict[str, Any]) -> Progress:
    progress: Progress | None = None
    try:
        for entry in journal.entries:
            if entry.kind == BEGUN:
                progress = progress_from_document(entry.values["progress"], scenario, parameters)
            elif progress is not None:
                apply(progress, scenario.result_type, entry.kind, entry.values)
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError):
        raise ProgressFileError(DAMAGED) from None
    if progress is None:
        raise ProgressFileError(DAMAGED)
    progress.kept = journal.mark
    return progress
