"""Tests that wait for a store that is away: copies in a folder, which go in with the next import into that store."""
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
# Hidden, so that it is no file of the test.
_CAMPAIGN, _STORE = ".campaign", ".store"
# Of a copy, in its folder, as long as it is made.
_WHOLE = "test"


class Spool:
    """A folder with a folder for each test that waits, named by its test, how far it came and what it measured.

    store: for which store tests wait, without its password; a test never goes into another one.
    """

    def __init__(self, folder: pathlib.Path, store: str = ""):
        self.folder = folder
        self._store = store

    def put(self, record: TestRecord, path: pathlib.Path, campaign: str = "") -> pathlib.Path:
        """Copy the files of a test; it is there whole or not at all, and once. StoreError when that fails.

        path: of its progress file. campaign: into which it is to go.
        """
        # With its points: two copies that went on apart are two, though they came equally far.
        measured = f"{self._store} {record.test['test_key']} {record.reach} {record.test['digest']} {record.trials}"
        name = hashlib.sha256(measured.encode()).hexdigest()[:24]
        target = self.folder / name
        if target.exists():
            return target
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            # What is left of a copy that fails would keep a full disk full.
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
        """Into which a test that waits is to go; empty when nobody said."""
        return _read(place / _CAMPAIGN) or ""

    def store_of(self, place: pathlib.Path) -> str | None:
        """For which store a test waits; None for one that was put here before that was kept."""
        return _read(place / _STORE)

    def all_waiting(self) -> list[pathlib.Path]:
        """Folders of the tests that wait for any store, sorted."""
        if not self.folder.is_dir():
            return []
        return sorted(path for path in self.folder.iterdir() if path.is_dir() and not path.name.startswith(_PART))

    def waiting(self) -> list[pathlib.Path]:
        """Folders of the tests that wait for this store, sorted."""
        return [place for place in self.all_waiting() if self.store_of(place) == self._store]

    def unassigned(self) -> list[pathlib.Path]:
        """Folders of the tests of which nobody knows for which store they wait, sorted."""
        return [place for place in self.all_waiting() if self.store_of(place) is None]

    def remove(self, place: pathlib.Path) -> None:
        """A test that is in the store waits no longer; where that fails it goes in again, which changes nothing."""
        shutil.rmtree(place, ignore_errors=True)


def _read(path: pathlib.Path) -> str | None:
    with contextlib.suppress(OSError, ValueError):
        return path.read_text(encoding="utf-8")
    return None


def _name(part: pathlib.Path, target: pathlib.Path) -> None:
    try:
        os.rename(part, target)
    except OSError:
        # Where another program has just put the same test, its copy is as good.
        if not target.is_dir():
            raise


def _own_name(name: str, record: pathlib.Path) -> str:
    """Of a file in a folder of the test's own: a record that bore the test's name has the usual one there."""
    stem = pathlib.Path(FILE_NAME).stem
    if record.name == FILE_NAME:
        return name
    first, _, rest = name.partition("/")
    if rest:
        return f"photos/{rest}"
    return f"{stem}{pathlib.Path(first).suffix}"
