"""Location of the store: its address, the folder of its files and the spool, given by a person or by default."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import os
import pathlib
from dataclasses import dataclass
from typing import Collection

import platformdirs

from ..errors import StoreAway, StoreError
from .database import Database, engine_of, version_of
from .intake import Door
from .kept_files import KeptFiles
from .spool import Spool

ADDRESS_VARIABLE = "MTR_RESULTS_STORE"
_APPLICATION = "mtr-results"
_FILE = "results.sqlite"
_FILES_SUFFIX = ".files"


def default_address() -> str:
    """Return the address from the environment, or a file in the user's data folder."""
    return os.environ.get(ADDRESS_VARIABLE) or str(default_file())


def default_file() -> pathlib.Path:
    """Return the path of the default store."""
    return platformdirs.user_data_path(_APPLICATION, appauthor=False) / _FILE


def default_spool() -> pathlib.Path:
    """Return the spool of this computer, which is shared by all stores."""
    return platformdirs.user_data_path(_APPLICATION, appauthor=False) / "spool"


@dataclass(frozen=True)
class Place:
    """Attributes: address: path or URL. files: folder of file contents; None selects the folder next to the SQLite
    file, and for a server stores check sums only. spool: folder of waiting tests."""

    address: str
    files: pathlib.Path | None = None
    spool: pathlib.Path | None = None

    def open(self) -> Database:
        """Open the store, and create it if necessary; StoreError with the reason if it cannot be used."""
        database = Database(engine_of(self.address))
        if self.address == str(default_file()):
            # The default store requires no setup.
            with contextlib.suppress(OSError):
                default_file().parent.mkdir(parents=True, exist_ok=True)
        database.make_ready()
        return database

    @property
    def shown(self) -> str:
        """Address for display, without its password; StoreError for an invalid address."""
        database = Database(engine_of(self.address))
        return database.where if database.file is None else str(database.file)

    @property
    def target(self) -> str:
        """Identity of the store, independent of user and working folder; StoreError for an invalid address."""
        return Database(engine_of(self.address)).target

    def existing(self) -> Database:
        """Open an existing store without creating it; StoreError with the reason if it cannot be read."""
        database = Database(engine_of(self.address))
        if database.file is not None and not database.file.is_file():
            raise StoreAway(f"The store {self.shown} is away: there is no such file; connect its disk, or name another "
                            "store.")
        try:
            with database.reading() as connection:
                if version_of(connection) is None:
                    raise StoreError(f"The database {self.shown} holds no store yet; mtr-results import makes one.")
            database.make_ready()
        except StoreError:
            database.close()
            raise
        return database

    def kept_files(self) -> KeptFiles | None:
        """Return the folder of file contents, or None if contents are not stored."""
        file = Database(engine_of(self.address)).file
        folder = self.files or (None if file is None else file.with_name(file.name + _FILES_SUFFIX))
        return None if folder is None else KeptFiles(folder)

    def door(self, stations: Collection[str] = ()) -> Door:
        """Return the importer, also while the store is unavailable; StoreError if waiting does not help.

        stations: see Door.
        """
        spool = Spool(self.spool or default_spool(), self.target)
        try:
            return Door(self.open(), self.kept_files(), spool, stations=stations)
        except StoreAway as error:
            return Door(None, self.kept_files(), spool, str(error), stations)
