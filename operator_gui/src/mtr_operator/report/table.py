"""Results as text: one distance, one line, and a table of all lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance, has_intervals
from mtr_operator.domain.scenario import AnyScenario

_CM_PER_M = 100.0
_GAP = "  "
_PLUS_MINUS = "\N{PLUS-MINUS SIGN}"


def line_name(scenario: AnyScenario, result: LineResult) -> str:
    """Such as "axis 3 (right)"."""
    return f"{scenario.line_word} {result.number} ({result.place})"


def line_text(scenario: AnyScenario, result: LineResult) -> str:
    """Such as "axis 3 (right): unlock 88.7 ± 6.8 cm, lock not reached"."""
    distances = [f"{distance.word} {_distance(distance)}" for distance in result.distances]
    reason = f": {result.reason}" if result.reason else ""
    return f"{line_name(scenario, result)}: {', '.join(distances)}{reason}"


def results_table(scenario: AnyScenario, results: Sequence[LineResult]) -> Iterator[str]:
    """Lines of a table of all results, distances in cm with 1 sigma, and the reasons of the invalid ones."""
    shows_intervals = has_intervals(results)
    rows = [_heading(scenario, shows_intervals), *(_row(result, shows_intervals) for result in results)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        cells = (cell.rjust(width) if _is_number(index, shows_intervals) else cell.ljust(width)
                 for index, (cell, width) in enumerate(zip(row, widths)))
        yield _GAP.join(cells).rstrip()
    for result in results:
        if result.reason:
            yield f"{line_name(scenario, result)} is invalid: {result.reason}"


def _heading(scenario: AnyScenario, shows_intervals: bool) -> list[str]:
    row = [scenario.line_word, ""]
    for word in scenario.distance_words:
        row += [word, "cm", f"{_PLUS_MINUS} cm", *(["95 % cm"] if shows_intervals else [])]
    return row


def _row(result: LineResult, shows_intervals: bool) -> list[str]:
    row = [str(result.number), result.place]
    for distance in result.distances:
        row += [_words(distance.status), _cm(distance.distance_m), _cm(distance.uncertainty_m)]
        row += [_interval(distance)] if shows_intervals else []
    return row


def _is_number(column: int, shows_intervals: bool) -> bool:
    # Number of the line and its place, then state, distance, uncertainty and perhaps interval of each measurement.
    return column == 0 or (column > 1 and (column - 2) % (4 if shows_intervals else 3) > 0)


def _interval(distance: MeasuredDistance) -> str:
    """Such as "512 to 571"; one end alone where the boundary lies beyond the other."""
    low, high = (None if end is None else f"{end * _CM_PER_M:.0f}" for end in (distance.low_m, distance.high_m))
    if low is None or high is None:
        return f"above {low}" if low else f"below {high}" if high else ""
    return f"{low} to {high}"


def _distance(distance: MeasuredDistance) -> str:
    if distance.status is not LineStatus.OK:
        return _words(distance.status)
    sigma = _cm(distance.uncertainty_m)
    tail = f" {_PLUS_MINUS} {sigma}" if sigma else ""
    return f"{_cm(distance.distance_m)}{tail} cm"


def _words(status: LineStatus) -> str:
    return status.value.replace("_", " ")


def _cm(value_m: float | None) -> str:
    return "" if value_m is None else f"{value_m * _CM_PER_M:.1f}"
