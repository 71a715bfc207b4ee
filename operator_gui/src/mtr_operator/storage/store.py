"""What is on disk of one test while it is measured: a lock, the journal, and the progress file that follows from it."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import itertools
import os
import pathlib
import secrets
from typing import Any, Mapping

from mtr_operator.domain.errors import InUse, OutputError
from mtr_operator.domain.results.journal import Journal
from mtr_operator.domain.results.progress import JournalMark, Progress

from .atomic import write_bytes
from .journal.journal_file import Recovered, journal_of, journal_path
from .journal.kept_journal import KeptJournal
from .lock import Lock
from .progress_file import journal_mark, progress_content, refuse_to_overwrite

_ID_BYTES = 8


class Store(Journal):
    """Context in which this application alone writes a test. Nothing is written before there is something to keep.

    path: of the progress file. progress: the test as it was loaded, or a new one. InUse when another application
    holds the test, or what is on disk has gone on since.
    """

    def __init__(self, path: pathlib.Path, progress: Progress):
        self.path = path
        self._progress = progress
        self._held = contextlib.ExitStack()
        self._journal: KeptJournal | None = None
        self._saved: tuple[int, int, int] | None = None

    def __enter__(self) -> Store:
        with contextlib.ExitStack() as held:
            held.enter_context(Lock(self.path))
            recovered = self._compared()
            mark = self._progress.kept or JournalMark(secrets.token_hex(_ID_BYTES), 0)
            self._journal = KeptJournal(self.path, self._progress, mark, recovered)
            held.callback(self._journal.close)
            self._held = held.pop_all()
        return self

    def __exit__(self, *_: object) -> None:
        self._held.close()

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        self._opened.add(kind, values)

    def content(self) -> bytes:
        """Of the progress file, as the test stands."""
        return progress_content(self._progress)

    def save(self, content: bytes | None = None) -> None:
        """Write the progress file; OutputError when that fails, InUse when a newer one is there. content: of a moment
        before, with all entries of then."""
        self._opened.open()
        if self._stamp() != self._saved:
            self._check(journal_mark(self.path))
        try:
            write_bytes(self.path, self.content() if content is None else content)
        except OutputError as error:
            raise OutputError(f"{error} What was measured is in {self._opened.place}.") from None
        self._saved = self._stamp()

    def move(self, path: pathlib.Path) -> None:
        """Go on in another folder; on an OperatorError it goes on where it was."""
        other = Store(path, self._progress).__enter__()
        self._held.close()
        self.path, self._held, self._journal, self._saved = path, other._held, other._journal, None

    @property
    def has_changed(self) -> bool:
        """True when something was kept since it was opened."""
        return self._opened.is_open

    @property
    def has_findings(self) -> bool:
        """True when something was measured, in this run or before; also when it does not count any more."""
        return self._progress.has_findings or self._opened.holds_findings

    def discard_if_empty(self) -> None:
        """Leave no file of a test that has never measured anything."""
        if not self.has_findings:
            self._opened.close()
            for path in (self.path, journal_path(self.path)):
                with contextlib.suppress(OSError):
                    path.unlink()

    @property
    def _opened(self) -> KeptJournal:
        if self._journal is None:
            raise OutputError("The test's files are not open.")
        return self._journal

    def _compared(self) -> Recovered:
        """The good part of the journal on disk, which the progress has to know."""
        if self._progress.kept is None and not self._progress.results:
            refuse_to_overwrite(self.path)
            return Recovered((), b"")
        recovered = journal_of(self.path)
        self._check(recovered.mark)
        self._check(journal_mark(self.path))
        if recovered.is_damaged and not recovered.is_torn:
            _copy_aside(journal_path(self.path))
        return recovered

    def _check(self, there: JournalMark | None) -> None:
        _check_mark(self.path, self._progress.kept, there)

    def _stamp(self) -> tuple[int, int, int] | None:
        with contextlib.suppress(OSError):
            found = os.stat(self.path)
            return found.st_ino, found.st_size, found.st_mtime_ns
        return None


def check_newest(path: pathlib.Path, progress: Progress) -> None:
    """InUse when the files hold more of the test than this progress, or another one."""
    for there in (journal_of(path).mark, journal_mark(path)):
        _check_mark(path, progress.kept, there)


def _check_mark(path: pathlib.Path, mine: JournalMark | None, there: JournalMark | None) -> None:
    if there is None:
        return
    if mine is None or mine.id != there.id:
        raise InUse(f"The files of {path} belong to another test; choose another folder.")
    if mine.entries < there.entries:
        raise InUse(f"The test in {path} was gone on with since it was opened here; open it again.")


def _copy_aside(path: pathlib.Path) -> None:
    """Keep a damaged journal for a person; its good part goes on under its name."""
    numbered = (path.with_name(f"{path.name}.damaged-{number}") for number in itertools.count(1))
    write_bytes(next(free for free in numbered if not os.path.lexists(free)), path.read_bytes())
