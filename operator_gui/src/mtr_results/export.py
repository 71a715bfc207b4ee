"""Export of the tables to Parquet files, and SQL queries over them with DuckDB."""
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
# Number of rows in memory at a time.
_CHUNK = 10_000
_TYPES = ((Boolean, "BOOLEAN"), (Integer, "BIGINT"), (Float, "DOUBLE"))
# DuckDB must not download extensions.
_SETTINGS = {"autoinstall_known_extensions": "false", "autoload_known_extensions": "false"}
_FAILURES = (duckdb.Error, OSError)


def export_tables(connection: Connection, folder: pathlib.Path) -> dict[str, int]:
    """Write each table to its own file; return the number of rows by table name.

    Raises StoreError on failure; a file is either complete or unchanged. Documents are not exported: the tables hold
    their contents.
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
    """Return headings and rows of a query over exported tables, which have their usual names.

    Raises StoreError with the reason if the query fails.
    """
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
