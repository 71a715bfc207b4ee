"""Results as text: one distance, one line, and a table of all lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.domain.scenario import REASON, LineStatus, Measurement, Result, Scenario

_CM_PER_M = 100.0
_GAP = "  "
_PLUS_MINUS = "\N{PLUS-MINUS SIGN}"


def line_name(scenario: Scenario, result: Result) -> str:
    """Such as "axis 3 (right)"."""
    return f"{scenario.line_word} {scenario.number_of(result)} ({scenario.place_of(result)})"


def line_text(scenario: Scenario, result: Result) -> str:
    """Such as "axis 3 (right): unlock 88.7 ± 6.8 cm, lock not reached"."""
    distances = [f"{measurement.word} {_distance(result, measurement)}" for measurement in scenario.measurements]
    reason = f": {result[REASON]}" if result[REASON] else ""
    return f"{line_name(scenario, result)}: {', '.join(distances)}{reason}"


def results_table(scenario: Scenario, results: Sequence[Result]) -> Iterator[str]:
    """Lines of a table of all results, distances in cm with 1 sigma, and the reasons of the invalid ones."""
    rows = [_heading(scenario), *(_row(scenario, result) for result in results)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = (cell.rjust(width) if _is_number(index) else cell.ljust(width)
                 for index, (cell, width) in enumerate(zip(row, widths)))
        yield _GAP.join(cells).rstrip()
    for result in results:
        if result[REASON]:
            yield f"{line_name(scenario, result)} is invalid: {result[REASON]}"


def _heading(scenario: Scenario) -> list[str]:
    row = [scenario.line_word, ""]
    for measurement in scenario.measurements:
        row += [measurement.word, "cm", f"{_PLUS_MINUS} cm"]
    return row


def _row(scenario: Scenario, result: Result) -> list[str]:
    row = [str(scenario.number_of(result)), scenario.place_of(result)]
    for measurement in scenario.measurements:
        row += [_words(result[measurement.status]), _cm(result[measurement.distance]),
                _cm(result[measurement.uncertainty])]
    return row


def _is_number(column: int) -> bool:
    # Number of the line and its place, then state, distance and uncertainty of each measurement.
    return column == 0 or (column > 1 and (column - 2) % 3 > 0)


def _distance(result: Result, measurement: Measurement) -> str:
    if result[measurement.status] != LineStatus.OK.value:
        return _words(result[measurement.status])
    sigma = _cm(result[measurement.uncertainty])
    tail = f" {_PLUS_MINUS} {sigma}" if sigma else ""
    return f"{_cm(result[measurement.distance])}{tail} cm"


def _words(status: str) -> str:
    return status.replace("_", " ")


def _cm(value_m: float | None) -> str:
    return "" if value_m is None else f"{value_m * _CM_PER_M:.1f}"
