"""Tables as Parquet files, and SQL over them by DuckDB: for analyses that a store need not know of."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import json
import os
import pathlib
import tempfile
from typing import Any, Iterator

import duckdb
from sqlalchemy import Boolean, Connection, Float, Integer, LargeBinary, Table, select

from .errors import StoreError
from .model.tables import EXPORTED
from .store.text_order import ordering

SUFFIX = ".parquet"
# Rows that are in memory at once.
_CHUNK = 10_000
_TYPES = ((Boolean, "BOOLEAN"), (Integer, "BIGINT"), (Float, "DOUBLE"))
# No extension is fetched from anywhere.
_SETTINGS = {"autoinstall_known_extensions": "false", "autoload_known_extensions": "false"}
_FAILURES = (duckdb.Error, OSError)


def export_tables(connection: Connection, folder: pathlib.Path) -> dict[str, int]:
    """Write each table into a file of its own; names and rows. StoreError when that fails; files are whole, or
    as they were.

    What was recorded as a document stays in the store: the tables hold what it says.
    """
    counts = {}
    with _told(folder):
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".") as part, duckdb.connect(config=_SETTINGS) as engine:
            for model in EXPORTED:
                table = model.__table__
                assert isinstance(table, Table)
                rows, made = pathlib.Path(part) / "rows", pathlib.Path(part) / f"{table.name}{SUFFIX}"
                counts[table.name] = _write_rows(connection, table, rows)
                engine.execute(f"COPY (SELECT * FROM read_json({_quoted(rows)}, format = 'newline_delimited', "
                               f"columns = {{{_columns(table)}}})) TO {_quoted(made)} (FORMAT parquet)")
            for model in EXPORTED:
                name = f"{model.__tablename__}{SUFFIX}"
                os.replace(pathlib.Path(part) / name, folder / name)
    return counts


def query_tables(folder: pathlib.Path, sql: str) -> tuple[list[str], list[tuple[Any, ...]]]:
    """Headings and rows of a query over exported tables, by their names; StoreError says what is wrong with it."""
    files = sorted(folder.glob(f"*{SUFFIX}"))
    if not files:
        raise StoreError(f"The folder {folder} holds no exported tables; mtr-results export makes them.")
    with _told(folder), duckdb.connect(config=_SETTINGS) as engine:
        for file in files:
            engine.execute(f'CREATE VIEW "{file.stem}" AS SELECT * FROM read_parquet({_quoted(file)})')
        found = engine.execute(sql)
        return [column[0] for column in found.description or ()], found.fetchall()


@contextlib.contextmanager
def _told(folder: pathlib.Path) -> Iterator[None]:
    try:
        yield
    except _FAILURES as error:
        raise StoreError(f"The tables in {folder} failed: {' '.join(str(error).split())}") from None


def _write_rows(connection: Connection, table: Table, path: pathlib.Path) -> int:
    count = 0
    columns = _exported(table)
    with open(path, "w", encoding="utf-8") as file:
        wanted = select(*columns).order_by(*ordering(table.primary_key))
        for row in connection.execution_options(yield_per=_CHUNK).execute(wanted).mappings():
            file.write(json.dumps(dict(row)) + "\n")
            count += 1
    return count


def _exported(table: Table) -> list[Any]:
    return [column for column in table.c if not isinstance(column.type, LargeBinary)]


def _columns(table: Table) -> str:
    types = ((column.name, next((name for kind, name in _TYPES if isinstance(column.type, kind)), "VARCHAR"))
             for column in _exported(table))
    return ", ".join(f"'{name}': '{kind}'" for name, kind in types)


def _quoted(path: pathlib.Path) -> str:
    return "'" + str(path).replace("'", "''") + "'"
