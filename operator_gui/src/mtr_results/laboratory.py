"""The store as a source of the application's history: a list of tests, and export of each test to files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import os
import pathlib
from typing import Any, Iterator, Mapping

from mtr_operator.domain.results.progress import Progress
from mtr_operator.history.entry import TestEntry
from mtr_operator.storage.atomic import output_folder, write_bytes
from mtr_operator.storage.inside import inside
from mtr_operator.storage.journal.journal_file import SUFFIX, journal_path
from mtr_operator.storage.photos import photo_folder
from mtr_operator.storage.progress_file import save_progress

from .errors import StoreError
from .store import reading
from .store.database import Database
from .store.place import ADDRESS_VARIABLE, Place, default_address, default_file

# Columns of a store row with the same name in a TestEntry.
_SAME = ("entries", "started", "scenario", "car", "key", "operator", "place", "done", "total", "invalid", "is_complete",
         "verdict", "words")


def open_laboratory() -> ResultsLaboratory | None:
    """Return the store from the environment variable or the default one; None if the default store does not exist."""
    is_named = bool(os.environ.get(ADDRESS_VARIABLE))
    return ResultsLaboratory(Place(default_address())) if is_named or default_file().is_file() else None


class ResultsLaboratory:
    """Read-only store; see mtr_operator.history.laboratory."""

    def __init__(self, place: Place):
        self._place = place
        self.where = place.shown

    def entries(self) -> list[TestEntry]:
        """See Laboratory. Parameters are not in the tables; they are known after fetch()."""
        with self._opened() as database, database.reading() as connection:
            found = reading.find(connection, reading.Search(limit=0), ("entries", "words"))
        return [self._entry(row) for row in found]

    def fetch(self, entry: TestEntry, path: pathlib.Path) -> None:
        """See Laboratory. Restores the record, and the journal and photos if their contents are stored."""
        number = int(entry.path)
        with self._opened() as database, database.reading() as connection:
            has_journal = reading.test_row(connection, number)["has_journal"]
            progress, files = reading.side(connection, number).progress, reading.files(connection, number)
        for name, target in _belongings(path, progress, files, has_journal).items():
            self._fetch_content(files[name], target)
        # The record is written last, because it makes the test visible.
        save_progress(path, progress)

    def _entry(self, row: Mapping[str, Any]) -> TestEntry:
        return TestEntry(str(row["id"]), test_id=row["test_key"], store=self.where,
                         **{name: row[name] for name in _SAME})

    @contextlib.contextmanager
    def _opened(self) -> Iterator[Database]:
        database = self._place.existing()
        try:
            yield database
        finally:
            database.close()

    def _fetch_content(self, sha256: str, target: pathlib.Path) -> None:
        kept = self._place.kept_files()
        # The measurements are in the database, too; a missing file must not prevent the export.
        with contextlib.suppress(StoreError):
            if kept is not None:
                content = kept.read(sha256)
                with output_folder(target.parent):
                    write_bytes(target, content)


def _belongings(path: pathlib.Path, progress: Progress, files: Mapping[str, str],
                has_journal: bool) -> dict[str, pathlib.Path]:
    """Return the target path of each file that belongs to the record of a test, by its name in the store.

    has_journal: the stored journal belongs to this test.
    """
    found = {name: journal_path(path) for name in files if has_journal and name.endswith(SUFFIX)}
    photos = {photo.sha256: photo.name for photo in progress.identity.photos} if progress.identity else {}
    folder = photo_folder(path)
    found.update({name: inside(folder, photos[sha256]) for name, sha256 in files.items() if sha256 in photos})
    return found
