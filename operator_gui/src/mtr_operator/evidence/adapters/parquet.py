"""Tables as Parquet, written by DuckDB, an optional package."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import json
import pathlib
import tempfile

from mtr_operator.domain.errors import OutputError

from .tables import Table

# DuckDB must not download extensions.
_SETTINGS = {"autoinstall_known_extensions": "false", "autoload_known_extensions": "false"}


def parquet_of(table: Table) -> bytes:
    """Return the file; OutputError if it cannot be created, for example without the package."""
    try:
        import duckdb
    except ImportError:
        raise OutputError("The package duckdb is not installed; pip install duckdb, then bundle the test "
                          "anew.") from None
    columns = ", ".join(f"'{name}': '{kind}'" for name, kind in table.columns.items())
    with tempfile.TemporaryDirectory(prefix="mtr_parquet_") as folder:
        rows, made = pathlib.Path(folder) / "rows", pathlib.Path(folder) / "made"
        try:
            with open(rows, "w", encoding="utf-8") as file:
                for row in table.rows:
                    file.write(json.dumps(dict(zip(table.columns, row)), allow_nan=False) + "\n")
            with duckdb.connect(config=_SETTINGS) as engine:
                engine.execute(f"COPY (SELECT * FROM read_json({_quoted(rows)}, format = 'newline_delimited', "
                               f"columns = {{{columns}}})) TO {_quoted(made)} (FORMAT parquet)")
            return made.read_bytes()
        except (duckdb.Error, OSError, ValueError) as error:
            raise OutputError(f"It cannot be made: {' '.join(str(error).split())}") from None


def _quoted(path: pathlib.Path) -> str:
    return "'" + str(path).replace("'", "''") + "'"
