"""Commands that export the tables to other programs."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from mtr_operator.cli.exit_codes import EXIT_PASS

from .meant import place_of
from .output import print_json, print_table


def export(options: argparse.Namespace) -> int:
    """Write all tables as Parquet."""
    from ..export import export_tables
    with place_of(options).open().reading() as connection:
        counts = export_tables(connection, options.folder)
    if options.json:
        print_json(counts)
    else:
        print_table(("table", "rows"), list(counts.items()))
    return EXIT_PASS


def query(options: argparse.Namespace) -> int:
    """Print the result of an SQL query over exported tables."""
    from ..export import query_tables
    headings, rows = query_tables(options.folder, options.sql)
    if options.json:
        print_json([dict(zip(headings, row)) for row in rows])
    else:
        print_table(headings, rows)
    return EXIT_PASS
