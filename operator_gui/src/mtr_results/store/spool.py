"""Spool of tests for an unavailable store: copies in a folder, imported with the next import into that store."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import hashlib
import os
import pathlib
import shutil
import tempfile

from mtr_operator.storage.progress_file import FILE_NAME
from mtr_operator.storage.recovery import progress_path

from ..errors import StoreError
from ..intake.record import TestRecord

_PART = ".part-"
# Hidden files, so that they are not files of the test.
_CAMPAIGN, _STORE = ".campaign", ".store"
# Name of an incomplete copy within its temporary folder.
_WHOLE = "test"


class Spool:
    """Folder with a subfolder for each waiting test, named by test, reach and measurements.

    store: identity of the store for which tests wait, without its password; a test is never imported into another one.
    """

    def __init__(self, folder: pathlib.Path, store: str = ""):
        self.folder = folder
        self._store = store

    def put(self, record: TestRecord, path: pathlib.Path, campaign: str = "") -> pathlib.Path:
        """Copy the files of a test, atomically and only once; StoreError if that fails.

        path: of its progress file. campaign: assigned at the import.
        """
        # The name includes the points: copies that diverged are different, even with the same reach.
        measured = f"{self._store} {record.test['test_key']} {record.reach} {record.test['digest']} {record.trials}"
        name = hashlib.sha256(measured.encode()).hexdigest()[:24]
        target = self.folder / name
        if target.exists():
            return target
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            # Remove a failed copy, because its remains would keep a full disk full.
            with tempfile.TemporaryDirectory(prefix=_PART, dir=self.folder) as name:
                part = pathlib.Path(name, _WHOLE)
                part.mkdir()
                for file, source in record.files.items():
                    copied = part / _own_name(file, progress_path(path))
                    copied.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copyfile(source, copied)
                (part / _CAMPAIGN).write_text(campaign, encoding="utf-8")
                (part / _STORE).write_text(self._store, encoding="utf-8")
                _name(part, target)
        except OSError as error:
            raise StoreError(f"The test in {path} cannot wait in the folder {self.folder}: {error.strerror or error}. "
                             "It is where it was; import it again.") from None
        return target

    def campaign_of(self, place: pathlib.Path) -> str:
        """Return the campaign of a waiting test; empty if not specified."""
        return _read(place / _CAMPAIGN) or ""

    def store_of(self, place: pathlib.Path) -> str | None:
        """Return the store of a waiting test; None if it is unknown, as for copies of older versions."""
        return _read(place / _STORE)

    def all_waiting(self) -> list[pathlib.Path]:
        """Return the folders of all waiting tests, sorted."""
        if not self.folder.is_dir():
            return []
        return sorted(path for path in self.folder.iterdir() if path.is_dir() and not path.name.startswith(_PART))

    def waiting(self) -> list[pathlib.Path]:
        """Return the folders of the tests that wait for this store, sorted."""
        return [place for place in self.all_waiting() if self.store_of(place) == self._store]

    def unassigned(self) -> list[pathlib.Path]:
        """Return the folders of the tests whose store is unknown, sorted."""
        return [place for place in self.all_waiting() if self.store_of(place) is None]

    def remove(self, place: pathlib.Path) -> None:
        """Remove an imported test from the spool; if that fails, it is imported again, which has no effect."""
        shutil.rmtree(place, ignore_errors=True)


def _read(path: pathlib.Path) -> str | None:
    with contextlib.suppress(OSError, ValueError):
        return path.read_text(encoding="utf-8")
    return None


def _name(part: pathlib.Path, target: pathlib.Path) -> None:
    try:
        os.rename(part, target)
    except OSError:
        # Another program has just put the same test there; its copy is equivalent.
        if not target.is_dir():
            raise


def _own_name(name: str, record: pathlib.Path) -> str:
    """Return the name of a file in the folder of the copy: a record named after the test gets the standard name."""
    stem = pathlib.Path(FILE_NAME).stem
    if record.name == FILE_NAME:
        return name
    first, _, rest = name.partition("/")
    if rest:
        return f"photos/{rest}"
    return f"{stem}{pathlib.Path(first).suffix}"
