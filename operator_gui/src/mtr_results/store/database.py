"""A store by its address: a file of SQLite, or a database of PostgreSQL; made and brought up to date by migrations."""
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

# So long a writer waits for another one; a test is written in some hundredths of a second.
BUSY_S = 30.0
_AGAIN_S = 0.01
CONNECT_S = 10.0
# Any number that no other program on the server locks.
_LOCK = 7_304_121
_WRITES = "mtr_writes"
_SQLITE, _POSTGRESQL = "sqlite", "postgresql"
# Where a server listens that is named without a port.
_PORT = 5432


def engine_of(address: str) -> Engine:
    """Engine of a path or URL; StoreError for another database. Nothing is opened yet."""
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
    """A path or URL as it may be shown: without its password, and without options, which may hold one."""
    if "://" not in address:
        return address
    try:
        url = make_url(address)
    except (ArgumentError, ValueError):
        # Not even its parts can be told apart.
        return address.partition("?")[0].rpartition("@")[2]
    return url.set(query={}).render_as_string(hide_password=True)


def _set_up_sqlite(connection: Any, _record: Any) -> None:
    # Transactions are begun below, not by the driver; readers do not wait for a writer.
    connection.isolation_level = None
    _write_ahead(connection)
    for pragma in ("foreign_keys = ON", "synchronous = FULL"):
        connection.execute(f"PRAGMA {pragma}")


def _write_ahead(connection: sqlite3.Connection) -> None:
    """SQLite waits for another program's lock everywhere but where it changes a new file to this journal."""
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
    # A writer that began as a reader is refused instead of made to wait.
    writes = connection.get_execution_options().get(_WRITES, False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


class Database:
    """Transactions on a store.

    Attributes:
        where: the store as it may be shown, without its password.
    """

    def __init__(self, engine: Engine):
        self._engine = engine
        self._writer = engine.execution_options(**{_WRITES: True})
        self.where = shown_address(engine.url.render_as_string(hide_password=False))

    @property
    def file(self) -> pathlib.Path | None:
        """Of SQLite; None on a server."""
        url = self._engine.url
        return pathlib.Path(url.database) if url.get_backend_name() == _SQLITE and url.database else None

    @property
    def target(self) -> str:
        """Which store it is: the whole path of a file; server and database without user and password."""
        if self.file is not None:
            return str(self.file.resolve())
        url = self._engine.url
        return f"{url.get_backend_name()}://{url.host or 'localhost'}:{url.port or _PORT}/{url.database or ''}"

    @contextlib.contextmanager
    def reading(self) -> Iterator[Connection]:
        """Transaction that changes nothing; StoreError when it fails."""
        with told(self.where), self._engine.connect() as connection:
            yield connection

    @contextlib.contextmanager
    def writing(self) -> Iterator[Connection]:
        """Transaction that is done whole or not at all."""
        with told(self.where), self._writer.begin() as connection:
            yield connection

    def make_ready(self, may_upgrade: bool = False) -> None:
        """Make the tables of a new store; StoreError for one of another version, unless it may be upgraded."""
        if self.file is not None and not self.file.parent.is_dir():
            # Perhaps of a disk that is not there now: a new store in its place would hide that.
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
        """Safe to call twice."""
        self._engine.dispose()

    def _upgrade(self) -> None:
        with self.writing() as connection:
            if connection.dialect.name == _POSTGRESQL:
                connection.execute(text("SELECT pg_advisory_xact_lock(:number)"), {"number": _LOCK})
            # Another program may have done it while this one waited.
            if version_of(connection) != HEAD:
                _migrate(connection)


def version_of(connection: Connection) -> str | None:
    """None of a store without tables; StoreError when the tables are another program's."""
    names = inspect(connection).get_table_names()
    if "alembic_version" in names:
        found = connection.execute(text("SELECT version_num FROM alembic_version")).scalar()
        if found is not None:
            return str(found)
    if names:
        raise StoreError("The database holds tables of another program; give the store one of its own.")
    return None


def _migrate(connection: Connection) -> None:
    # Imported only where something is to be done: it takes a third of a second.
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(pathlib.Path(__file__).parent.parent / "migrations"))
    config.attributes["connection"] = connection
    command.upgrade(config, "head")
