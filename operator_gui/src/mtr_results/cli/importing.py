"""Commands that import tests into the store."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
from typing import Iterator

from mtr_operator.cli.exit_codes import EXIT_ERROR, EXIT_PASS
from mtr_operator.terminal import show, show_error

from ..errors import StoreError
from ..intake.source import tests_in
from ..store.database import Database, engine_of
from ..store.intake import REFUSED, Door, Intake
from ..store.place import default_spool
from ..store.spool import Spool
from .meant import place_of
from .output import print_json


def import_tests(options: argparse.Namespace) -> int:
    """Import waiting tests, then the given paths; exit code 0 if each test is stored or waits in the spool."""
    door = place_of(options).door(frozenset(options.station))
    found = []
    for intake in _taken(door, options):
        found.append(intake)
        if not options.json:
            show(f"{intake.outcome}: {intake.path}")
            if intake.sentence:
                show_error(intake.sentence)
    if options.json:
        print_json([intake.to_document() for intake in found])
    return EXIT_ERROR if any(intake.outcome == REFUSED for intake in found) else EXIT_PASS


def _taken(door: Door, options: argparse.Namespace) -> Iterator[Intake]:
    yield from door.take_waiting()
    for path in options.paths:
        try:
            tests = tests_in(path)
        except StoreError as error:
            yield Intake(str(path), REFUSED, str(error))
            continue
        yield from (door.take(test, options.campaign) for test in tests)


def list_waiting(options: argparse.Namespace) -> int:
    """List the tests in the spool of this computer, with their stores."""
    spool = Spool(options.spool or default_spool())
    rows = [{"path": str(place), "store": spool.store_of(place), "campaign": spool.campaign_of(place)}
            for place in spool.all_waiting()]
    if options.json:
        print_json(rows)
    for row in () if options.json else rows:
        show(f"{row['path']}: waits for {row['store'] or 'a store that nobody knows'}")
    return EXIT_PASS


def upgrade(options: argparse.Namespace) -> int:
    """Migrate a store to the version of this program."""
    database = Database(engine_of(options.store))
    database.make_ready(may_upgrade=True)
    if options.json:
        print_json({"store": database.where})
    else:
        show(f"The store {database.where} has the version of this program.")
    return EXIT_PASS
