"""Command that writes pages to files."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from mtr_operator.cli.exit_codes import EXIT_PASS
from mtr_operator.storage.atomic import write_bytes

from ..errors import StoreError
from ..store import reading
from ..store.sets import read_set
from .meant import place_of
from .output import print_json


def report(options: argparse.Namespace) -> int:
    """Write the report of one test or of a comparison of two sets."""
    from ..report.pages import page_of_comparison, page_of_test
    with place_of(options).open().reading() as connection:
        if options.second is None:
            number = reading.number_of(connection, options.first)
            page = page_of_test(reading.test_row(connection, number), reading.parts(connection, number),
                                reading.side(connection, number))
        else:
            first, second = (read_set(connection, text) for text in (options.first, options.second))
            page = page_of_comparison(first.sides, second.sides, (options.first, options.second))
    if not options.out.parent.is_dir():
        raise StoreError(f"There is no folder {options.out.parent}; make it first.")
    write_bytes(options.out, page.encode("utf-8"))
    if options.json:
        print_json({"file": str(options.out)})
    else:
        print(f"The report is in {options.out}.")
    return EXIT_PASS
