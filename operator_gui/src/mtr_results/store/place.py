"""Which store: its address, the folder of its files and the spool, as a person names them or by default."""
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
    """That of the environment, else a file where the system keeps a person's data."""
    return os.environ.get(ADDRESS_VARIABLE) or str(default_file())


def default_file() -> pathlib.Path:
    """Where the store is when nobody says otherwise."""
    return platformdirs.user_data_path(_APPLICATION, appauthor=False) / _FILE


def default_spool() -> pathlib.Path:
    """Where tests wait on this computer, whatever store they wait for."""
    return platformdirs.user_data_path(_APPLICATION, appauthor=False) / "spool"


@dataclass(frozen=True)
class Place:
    """Attributes: address: path or URL. files: folder of the contents of files, None beside the file of SQLite; with a
    server and without a folder check sums alone are kept. spool: where tests wait."""

    address: str
    files: pathlib.Path | None = None
    spool: pathlib.Path | None = None

    def open(self) -> Database:
        """The store, made where there is none; StoreError says why it cannot be used."""
        database = Database(engine_of(self.address))
        if self.address == str(default_file()):
            # Nobody has to set anything up for the usual place.
            with contextlib.suppress(OSError):
                default_file().parent.mkdir(parents=True, exist_ok=True)
        database.make_ready()
        return database

    @property
    def shown(self) -> str:
        """The store as it may be shown, without its password; StoreError for what is no address."""
        database = Database(engine_of(self.address))
        return database.where if database.file is None else str(database.file)

    @property
    def target(self) -> str:
        """Which store it is, whoever opens it and from where; StoreError for what is no address."""
        return Database(engine_of(self.address)).target

    def existing(self) -> Database:
        """The store, never made by who looks at it; StoreError says why it cannot be read."""
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
        """Contents of files, None where none are kept."""
        file = Database(engine_of(self.address)).file
        folder = self.files or (None if file is None else file.with_name(file.name + _FILES_SUFFIX))
        return None if folder is None else KeptFiles(folder)

    def door(self, stations: Collection[str] = ()) -> Door:
        """Through which tests come in, also while the store is away; StoreError where waiting does not help.

        stations: see Door.
        """
        spool = Spool(self.spool or default_spool(), self.target)
        try:
            return Door(self.open(), self.kept_files(), spool, stations=stations)
        except StoreAway as error:
            return Door(None, self.kept_files(), spool, str(error), stations)
