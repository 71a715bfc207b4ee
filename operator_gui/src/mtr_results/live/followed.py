"""Tests in followed folders, and the changes of their files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import hashlib
import pathlib
import time
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.history.places import stamps
from mtr_operator.storage.journal.journal_file import journal_path
from mtr_operator.storage.lock import is_held
from mtr_operator.storage.recorded.recording import recorded_runs, recording_folder
from mtr_operator.storage.recovery import progress_path

from ..errors import StoreError

# A measuring application writes several times a second. After this silence it is paused or was killed.
SILENT_S = 30.0
_NAME_LETTERS = 12
Stamp = tuple[int, int]
_NOTHING = (0, 0)


@dataclass(frozen=True)
class FollowedTest:
    """Attributes: name: identifier in addresses, which do not reveal paths. path: of the progress file or journal."""

    name: str
    path: pathlib.Path


@dataclass(frozen=True)
class Seen:
    """File state of a test: times and sizes, not contents.

    Attributes:
        test: stamps of progress file and journal. course: newest status recording, or None. of_course: its stamp.
        is_held: an application has the test open, or was killed while it had. silent_s: time since the last write.
    """

    test: tuple[Stamp, Stamp]
    course: pathlib.Path | None
    of_course: Stamp
    is_held: bool
    silent_s: float

    @property
    def is_measured(self) -> bool:
        """True if an application is writing the test now."""
        return self.is_held and self.silent_s < SILENT_S


class Followed:
    """Scans folders on request, without locks and without writing."""

    def __init__(self, folders: Sequence[pathlib.Path]):
        self.folders = tuple(folders)

    def tests(self) -> list[FollowedTest]:
        """Return all tests in the folders, the most recently written one first."""
        found = sorted(stamps(self.folders).items(), key=lambda item: max(item[1][0], item[1][2]), reverse=True)
        return [FollowedTest(_name_of(path), pathlib.Path(path)) for path, _ in found]

    def test(self, name: str) -> FollowedTest:
        """Return a test by its name; StoreError if there is none."""
        for test in self.tests():
            if test.name == name:
                return test
        raise StoreError("There is no such test in the folders that are followed; it was moved or deleted.")


def look(path: pathlib.Path) -> Seen:
    """Return the state of the files of a test."""
    record = progress_path(path)
    runs = recorded_runs(recording_folder(record))
    course = runs[-1].course if runs else None
    test = (_stamp(record), _stamp(journal_path(record)))
    of_course = _NOTHING if course is None else _stamp(course)
    written_ns = max(*(stamp[0] for stamp in test), of_course[0])
    return Seen(test, course, of_course, is_held(record), max(0.0, time.time() - written_ns * 1e-9))


def _name_of(path: str) -> str:
    return hashlib.sha256(str(progress_path(pathlib.Path(path)).absolute()).encode()).hexdigest()[:_NAME_LETTERS]


def _stamp(path: pathlib.Path) -> Stamp:
    try:
        found = path.stat()
    except OSError:
        return _NOTHING
    return found.st_mtime_ns, found.st_size
