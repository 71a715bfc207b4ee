"""Database by address: an SQLite file or a PostgreSQL database, created and migrated by Alembic."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
import sqlite3
import time
from typing import Any, Iterator

from sqlalchemy import Connection, Engine, create_engine, event, inspect, text
from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError

from ..errors import StoreAway, StoreError
from ..migrations import HEAD
from .sentences import told

# Waiting time of a writer for another one; writing a test takes some hundredths of a second.
BUSY_S = 30.0
_AGAIN_S = 0.01
CONNECT_S = 10.0
# Lock number that no other program on the server uses.
_LOCK = 7_304_121
_WRITES = "mtr_writes"
_SQLITE, _POSTGRESQL = "sqlite", "postgresql"
# Default port of the server.
_PORT = 5432


def engine_of(address: str) -> Engine:
    """Return the engine for a path or URL without opening it; StoreError for other databases."""
    url = _url(address)
    if url.get_backend_name() == _SQLITE:
        engine = create_engine(url, connect_args={"timeout": BUSY_S})
        event.listen(engine, "connect", _set_up_sqlite)
        event.listen(engine, "begin", _begin_sqlite)
        return engine
    return create_engine(url.set(drivername=f"{_POSTGRESQL}+pg8000"), connect_args={"timeout": CONNECT_S},
                         pool_pre_ping=True)


def _url(address: str) -> URL:
    if "://" not in address:
        return URL.create(_SQLITE, database=str(pathlib.Path(address).expanduser()))
    try:
        url = make_url(address)
        if url.get_backend_name() in (_SQLITE, _POSTGRESQL):
            return url
    except (ArgumentError, ValueError):
        pass
    raise StoreError(f"{shown_address(address)} is no address of a store; give the path of a file, or "
                     "postgresql://USER:PASSWORD@HOST/DATABASE.")


def shown_address(address: str) -> str:
    """Return an address for display, without its password and without options, which may contain one."""
    if "://" not in address:
        return address
    try:
        url = make_url(address)
    except (ArgumentError, ValueError):
        # The address cannot be parsed.
        return address.partition("?")[0].rpartition("@")[2]
    return url.set(query={}).render_as_string(hide_password=True)


def _set_up_sqlite(connection: Any, _record: Any) -> None:
    # Transactions are started by _begin_sqlite, not by the driver; readers do not wait for a writer.
    connection.isolation_level = None
    _write_ahead(connection)
    for pragma in ("foreign_keys = ON", "synchronous = FULL"):
        connection.execute(f"PRAGMA {pragma}")


def _write_ahead(connection: sqlite3.Connection) -> None:
    """Enable the write-ahead journal, with retries: for this change SQLite itself does not wait for locks."""
    until_s = time.monotonic() + BUSY_S
    while True:
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            return
        except sqlite3.OperationalError as error:
            if "locked" not in str(error) or time.monotonic() > until_s:
                raise
        time.sleep(_AGAIN_S)


def _begin_sqlite(connection: Connection) -> None:
    # A transaction that starts as a reader and then writes fails instead of waiting for the lock.
    writes = connection.get_execution_options().get(_WRITES, False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


class Database:
    """Transactions on a store.

    Attributes:
        where: address of the store for display, without its password.
    """

    def __init__(self, engine: Engine):
        self._engine = engine
        self._writer = engine.execution_options(**{_WRITES: True})
        self.where = shown_address(engine.url.render_as_string(hide_password=False))

    @property
    def file(self) -> pathlib.Path | None:
        """Path of an SQLite file; None for a server."""
        url = self._engine.url
        return pathlib.Path(url.database) if url.get_backend_name() == _SQLITE and url.database else None

    @property
    def target(self) -> str:
        """Identity of the store: absolute path of a file, or server and database without user and password."""
        if self.file is not None:
            return str(self.file.resolve())
        url = self._engine.url
        return f"{url.get_backend_name()}://{url.host or 'localhost'}:{url.port or _PORT}/{url.database or ''}"

    @contextlib.contextmanager
    def reading(self) -> Iterator[Connection]:
        """Read-only transaction; StoreError if it fails."""
        with told(self.where), self._engine.connect() as connection:
            yield connection

    @contextlib.contextmanager
    def writing(self) -> Iterator[Connection]:
        """Atomic transaction."""
        with told(self.where), self._writer.begin() as connection:
            yield connection

    def make_ready(self, may_upgrade: bool = False) -> None:
        """Create the tables of a new store; StoreError for another version, unless upgrading is allowed."""
        if self.file is not None and not self.file.parent.is_dir():
            # The folder may be on a disk that is not connected; a new store in its place would hide that.
            raise StoreAway(f"The store {self.where} is away: there is no folder {self.file.parent}; connect its "
                            "disk, or make it.")
        with self.reading() as connection:
            found = version_of(connection)
        if found == HEAD:
            return
        if found is None or (may_upgrade and found < HEAD):
            self._upgrade()
        elif found < HEAD:
            raise StoreError(f"The store {self.where} has version {found}, and this program version {HEAD}; keep a "
                             "copy, then bring it up to date with mtr-results upgrade.")
        else:
            raise StoreError(f"The store {self.where} has version {found}, which is newer than version {HEAD} of this "
                             "program; install the newer program.")

    def close(self) -> None:
        """Close all connections; safe to call twice."""
        self._engine.dispose()

    def _upgrade(self) -> None:
        with self.writing() as connection:
            if connection.dialect.name == _POSTGRESQL:
                connection.execute(text("SELECT pg_advisory_xact_lock(:number)"), {"number": _LOCK})
            # Another program may have migrated the store while this one waited for the lock.
            if version_of(connection) != HEAD:
                _migrate(connection)


def version_of(connection: Connection) -> str | None:
    """Return the version of the tables, or None for an empty database; StoreError for tables of another program."""
    names = inspect(connection).get_table_names()
    if "alembic_version" in names:
        found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
        if found is not None:
            return str(found)
    if names:
        raise StoreError("The database holds tables of another program; give the store one of its own.")
    return None


def _migrate(connection: Connection) -> None:
    # Imported on demand, because the import takes a third of a second.
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(pathlib.Path(__file__).parent.parent / "migrations"))
    config.attributes["connection"] = connection
    command.upgrade(config, "head")
