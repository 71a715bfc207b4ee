"""The journal of a test that is being measured: where it goes on, and where else it is kept when that fails."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pathlib
from typing import Any, Iterator, Mapping

from mtr_operator.domain.errors import OutputError
from mtr_operator.domain.results.journal import (
    BEGUN,
    DECISION,
    EVENT,
    IDENTITY,
    LINE,
    LINE_BEGUN,
    POINT,
    SESSION,
    Journal,
    plain_fields,
)
from mtr_operator.domain.results.progress import JournalMark, Progress

from .journal_file import FORMAT, VERSION, Entry, JournalFile, Recovered, journal_path, line_of
from .second_place import open_second_place

# Kinds that measure nothing: until something else comes they are not worth a file.
_REMARKS = (SESSION, EVENT, DECISION, IDENTITY)
_MEASURED = (POINT, LINE)
_Finding = tuple[str, Mapping[str, Any]]


class KeptJournal(Journal):
    """Makes or goes on with the file when there is something to keep; the progress learns how far it reaches.

    path: of the progress file. recovered: what the file holds, which is nothing else than what the progress knows.

    Attributes:
        place: the file. is_open: something was kept in it.
        holds_findings: something was measured in it, also where it was superseded since.
    """

    def __init__(self, path: pathlib.Path, progress: Progress, mark: JournalMark, recovered: Recovered):
        self._path = path
        self._progress = progress
        self._mark = mark
        self._content = recovered.content
        # What the progress was recovered from and the file lacks: it was kept in a second place, or in another folder.
        begins = progress.journal.startswith(recovered.content)
        self._missing = progress.journal[len(recovered.content):] if begins else b""
        is_up_to_date = bool(recovered.entries) and recovered.entries[-1].sequence == mark.entries
        self._is_whole = is_up_to_date or bool(self._missing)
        self.place = journal_path(path)
        self._file = JournalFile(self.place)
        self._remarks: list[_Finding] = []
        self.is_open = False
        self.holds_findings = recovered.holds_findings or bool(self._missing)
        # Why nothing can be written anywhere at present; each finding tries again.
        self._failure = ""

    def add(self, kind: str, values: Mapping[str, Any]) -> None:
        """See Journal. What cannot be written here is kept in a second place, and OutputError says where."""
        if not self.is_open and kind in _REMARKS:
            self._remarks.append((kind, values))
        else:
            self._append([*self._beginning(), (kind, values)])

    def open(self) -> None:
        """Have a file even if there is nothing to keep yet."""
        if not self.is_open:
            self._append([*self._beginning()])

    def close(self) -> None:
        """Safe to call twice."""
        self._file.close()

    def _beginning(self) -> Iterator[_Finding]:
        if self.is_open:
            return
        progress = self._progress
        if self._is_whole:
            yield SESSION, dict(progress.session)
        else:
            yield BEGUN, {"format": FORMAT, "version": VERSION, "id": self._mark.id, "progress": progress.to_document()}
            if progress.line_at_hand is not None:
                yield LINE_BEGUN, {"line": progress.line_at_hand}
            for word, point in progress.points.items():
                yield POINT, {"word": word, **plain_fields(point)}
        yield from self._remarks

    def _append(self, findings: list[_Finding]) -> None:
        lines = self._missing + self._lines_of(findings)
        try:
            if self._failure:
                raise OutputError(self._failure)
            if not self.is_open:
                self._file.open(len(self._content))
            self._file.append(lines)
        except OutputError as error:
            self._keep_elsewhere(lines, str(error))
        finally:
            self._note(lines, findings)

    def _lines_of(self, findings: list[_Finding]) -> bytes:
        first = self._mark.entries + 1
        try:
            return b"".join(line_of(Entry(number, *finding)) for number, finding in enumerate(findings, start=first))
        except ValueError:
            raise OutputError("A finding cannot be kept, for a value in it is no finite number.") from None

    def _note(self, lines: bytes, findings: list[_Finding]) -> None:
        self._content += lines
        self._mark = self._progress.kept = JournalMark(self._mark.id, self._mark.entries + len(findings))
        self.holds_findings |= any(kind in _MEASURED for kind, _ in findings)
        self.is_open = True
        self._remarks, self._missing, self._progress.journal = [], b"", b""

    def _keep_elsewhere(self, lines: bytes, failure: str) -> None:
        self._file.close()
        kept = open_second_place(self._path.stem, self._mark, self._content + lines)
        if kept is None:
            self._failure = failure
            raise OutputError(f"{failure} No second place could be written either; what was measured last is in this "
                              "application only.") from None
        self._failure = ""
        self._file, self.place = kept
        raise OutputError(f"{failure} What was measured is kept in {self.place}, with which the test can be continued.")
