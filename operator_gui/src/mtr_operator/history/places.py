"""Locations of tests: each candidate file with a stamp that changes with the file."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import errno
import os
import pathlib
import stat
from dataclasses import dataclass, field
from typing import Iterable

from mtr_operator.evidence.container import SUFFIX as BUNDLE
from mtr_operator.report.files import FILE_NAMES
from mtr_operator.storage.journal.journal_file import SUFFIX
from mtr_operator.storage.progress_file import FILE_NAME

# Sizes and times of the progress file and its journal; zeros if one is missing.
Stamp = tuple[int, ...]
_NOTHING = (0, 0)
_RECORD = ".json"
# A missing path is not a fault: folders are created with their first test, and files may be deleted by others.
_GONE = (errno.ENOENT, errno.ENOTDIR)


@dataclass
class Places:
    """Found tests.

    Attributes:
        stamps: of each test by the path of its progress file, journal or bundle.
        problems: sentences on unreadable locations of tests, by path.
    """

    stamps: dict[str, Stamp] = field(default_factory=dict)
    problems: dict[str, str] = field(default_factory=dict)

    def look_into(self, folder: str) -> None:
        """Search a folder for files, and each folder within it for one test."""
        names = set(self._names(folder))
        folders = set(filter(self._is_folder, names))
        for path in folders:
            self._look_at_test(os.path.join(path, FILE_NAME))
            self._look_at_bundle(os.path.join(path, os.path.basename(path) + BUNDLE))
            self._look_at_report(path)
        for path in names - folders:
            if path.endswith(_RECORD) or (path.endswith(SUFFIX) and _record_of(path) not in names):
                self._look_at_test(path)
            elif path.endswith(BUNDLE):
                self._look_at_bundle(path)

    def _names(self, folder: str) -> list[str]:
        try:
            return [os.path.join(folder, name) for name in os.listdir(folder) if not name.startswith(".")]
        except OSError as error:
            if error.errno not in _GONE:
                self.problems[folder] = f"The folder {folder} cannot be read: {error.strerror or error}."
            return []

    def _is_folder(self, path: str) -> bool:
        """Return False also for an inaccessible path, so that the others are still searched."""
        try:
            return stat.S_ISDIR(os.stat(path).st_mode)
        except OSError as error:
            # A link to itself contains no test.
            if error.errno not in (*_GONE, errno.ELOOP):
                self.problems[path] = f"The folder {path} cannot be read: {error.strerror or error}."
            return False

    def _look_at_test(self, path: str) -> None:
        """Add a test by the path of its progress file, or of a journal without one."""
        record = _record_of(path)
        journal = record[:-len(_RECORD)] + SUFFIX
        of_record, of_journal = self._stamp(record), self._stamp(journal)
        if of_record or of_journal:
            self.stamps[record if of_record else journal] = (*(of_record or _NOTHING), *(of_journal or _NOTHING))

    def _look_at_bundle(self, path: str) -> None:
        stamp = self._stamp(path)
        if stamp:
            self.stamps[path] = stamp

    def _look_at_report(self, folder: str) -> None:
        """Record a problem for a report without its test, because the missing test would remain unnoticed."""
        held = [os.path.join(folder, name) for name in
                (FILE_NAME, FILE_NAME[:-len(_RECORD)] + SUFFIX, os.path.basename(folder) + BUNDLE)]
        if any(path in self.stamps or path in self.problems for path in held):
            return
        report = next((name for name in FILE_NAMES if os.path.lexists(os.path.join(folder, name))), "")
        if report:
            self.problems[folder] = (f"The folder {folder} holds {report}, and no {FILE_NAME}: what was measured can "
                                     "be read there, and is no test that can be opened.")

    def _stamp(self, path: str) -> Stamp:
        """Return the stamp; empty for a missing file."""
        try:
            found = os.stat(path)
        except OSError as error:
            if error.errno not in _GONE:
                self.problems[path] = f"The test in {path} cannot be read: {error.strerror or error}."
            return ()
        return found.st_mtime_ns, found.st_size


def _record_of(path: str) -> str:
    return path[:-len(SUFFIX)] + _RECORD if path.endswith(SUFFIX) else path


def look(folders: Iterable[pathlib.Path]) -> Places:
    """Return the tests in these folders."""
    found = Places()
    for folder in dict.fromkeys(folders):
        found.look_into(str(folder))
    return found


def stamps(folders: Iterable[pathlib.Path]) -> dict[str, Stamp]:
    """Return the stamp of each test outside of bundles, by its path."""
    return {path: stamp for path, stamp in look(folders).stamps.items() if not path.endswith(BUNDLE)}
