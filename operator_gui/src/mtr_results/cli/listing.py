"""Commands that show the contents of the store."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
from typing import Any

from mtr_operator.cli.exit_codes import EXIT_PASS
from mtr_operator.report.table import line_name
from mtr_operator.terminal import show

from ..store import reading
from .meant import place_of, search_of
from .output import cell, print_json, print_table

_HEADINGS = ("test", "started", "scenario", "lines", "verdict", "car", "software", "key", "campaign")
_FACTS = ("test_key", "scenario", "started", "car_profile", "vin", "model", "car_software", "key_serial", "key_type",
          "operator", "place", "weather", "campaign", "verdict", "software", "robot_software", "notes")
_MEASURED = ("word", "status", "first_m", "second_m", "low_m", "high_m", "expanded_m")
_TRIED = ("line", "number", "attempt", "word", "status", "distance_m", "x_m", "y_m", "speed_mps", "cause")


def list_tests(options: argparse.Namespace) -> int:
    """Print the tests that match the search."""
    search = search_of(options)
    with place_of(options).open().reading() as connection:
        found, total = reading.find(connection, search), reading.count(connection, search)
    if options.json:
        print_json(found)
        return EXIT_PASS
    print_table(_HEADINGS, [(row["id"], row["started"].replace("T", " ")[:16], row["scenario"],
                             f"{row['done']}/{row['total']}", row["verdict"], row["car"], row["car_software"],
                             row["key"], row["campaign"]) for row in found])
    if total > len(found):
        show(f"{total - len(found)} more fit; --limit 0 lists all.")
    return EXIT_PASS


def show_test(options: argparse.Namespace) -> int:
    """Print one test: properties, current distances, verdicts and files."""
    with place_of(options).open().reading() as connection:
        number = reading.number_of(connection, options.test)
        test, parts = reading.test_row(connection, number), reading.parts(connection, number)
        side = reading.side(connection, number)
    if options.json:
        print_json({**test, **parts})
        return EXIT_PASS
    show(f"Test {number}: {side.scenario.title}")
    for name in _FACTS:
        if test[name]:
            show(f"  {name.replace('_', ' ')}: {' '.join(str(test[name]).split())}")
    names = {result.number: line_name(side.scenario, result) for result in side.progress.results}
    counting = [row for row in parts["measurements"] if row["is_current"]]
    print_table(("line", "what", "became", "m", "to m", "95 % from m", "to m", "expanded m"),
                [(names[row["line"]], *(row[name] for name in _MEASURED)) for row in counting])
    _print_verdicts(parts["verdicts"], names)
    if options.trials:
        print_table(_TRIED, [tuple(row[name] for name in _TRIED) for row in parts["trials"]])
    else:
        show(f"{len(parts['trials'])} points of all attempts; --trials lists them.")
    for file in parts["files"]:
        show(f"file {file['name']} ({file['size']} bytes, SHA-256 {file['sha256'][:12]}...)")
    return EXIT_PASS


def _print_verdicts(verdicts: list[dict[str, Any]], names: dict[int, str]) -> None:
    for row in verdicts:
        where = names.get(row["line"], f"line {row['line']}") if row["line"] else "Verdict of the test"
        show(f"{where}: {row['verdict']}" + (f" ({cell(row['requirement'])}) {row['reason']}" if row["line"] else ""))
