"""python-can's logs in a database (SQLite): only stored rows are read, and nothing is written."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import pathlib
import sqlite3
from typing import Any, Iterator, Sequence

from .text.lines import CLASSIC_BYTES, Damaged, LoggedFrame, checked

_TABLE = "messages"
_SCHEMA = f"SELECT type, rootpage FROM sqlite_master WHERE name = '{_TABLE}'"
_COLUMNS = f"PRAGMA table_xinfo({_TABLE})"
_ROWS = f"SELECT ts, arbitration_id, extended, remote, error, dlc, data FROM {_TABLE}"
# A function or a recursion in the file's own schema could return any amount of data.
_ALLOWED = (sqlite3.SQLITE_READ, sqlite3.SQLITE_SELECT, sqlite3.SQLITE_PRAGMA)
# Maximum characters of a value in a sentence.
_SHOWN = 20


class DatabaseLog:
    """Iterator over the data frames; Damaged states the reason if it is not such a log, or at the first damage."""

    def __init__(self, path: pathlib.Path):
        self._address = f"{path.resolve().as_uri()}?mode=ro"

    def __iter__(self) -> Iterator[LoggedFrame]:
        try:
            # The link connects and observes in different threads, one after the other.
            with contextlib.closing(sqlite3.connect(self._address, uri=True, check_same_thread=False)) as database:
                database.set_authorizer(_authorize)
                _check_schema(database)
                for number, row in enumerate(database.execute(_ROWS), 1):
                    yield from _frames(number, row)
        except sqlite3.Error as error:
            raise Damaged(f"SQLite reports: {error}") from None


def _authorize(action: int, *_: Any) -> int:
    return sqlite3.SQLITE_OK if action in _ALLOWED else sqlite3.SQLITE_DENY


def _check_schema(database: sqlite3.Connection) -> None:
    """Accept only a table with stored rows: a view or a computed column could have any size."""
    found = database.execute(_SCHEMA).fetchall()
    if not found:
        raise Damaged(f"it has no table {_TABLE}, as python-can writes it")
    # A view and a virtual table have no page; a computed column is marked as hidden by its last value.
    is_stored = all(kind == "table" and page for kind, page in found)
    if not is_stored or any(column[-1] for column in database.execute(_COLUMNS)):
        raise Damaged(f"its table {_TABLE} computes values that it does not store")


def _frames(number: int, row: Sequence[Any]) -> Iterator[LoggedFrame]:
    time_s, can_id, is_extended, is_remote, is_error, length, data = row
    if is_remote or is_error:
        return
    if not (isinstance(time_s, (int, float)) and isinstance(can_id, int) and isinstance(data, bytes)):
        raise Damaged(f"row {number} has values of other types than a frame")
    if length != len(data):
        raise Damaged(f"row {number} has {len(data)} bytes of data, and says {str(length)[:_SHOWN]}")
    try:
        yield checked(LoggedFrame(time_s, can_id, bool(is_extended), data, length > CLASSIC_BYTES))
    except Damaged as error:
        raise Damaged(f"row {number} {error}") from None
