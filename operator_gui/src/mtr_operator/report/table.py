"""Results as text: one distance, one line, and a table of all lines."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Iterator, Sequence

from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.line_result import LineResult, MeasuredDistance, has_intervals
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

from .figures import (
    INTERVAL,
    TEMPLATES,
    figures_of,
    filled,
    interval_text,
    meanings,
    sigma_text,
    sigma_word,
)

_GAP = "  "
_PLUS_MINUS = "\N{PLUS-MINUS SIGN}"
# Kinds without a number, which need no unit.
_WORDS = (Kind.NOT_REACHED, Kind.INVALID, Kind.UNKNOWN)


def line_name(scenario: AnyScenario, result: LineResult) -> str:
    """Return a name such as "axis 3 (right)"."""
    return f"{scenario.line_word} {result.number} ({result.place})"


def line_text(scenario: AnyScenario, result: LineResult, parameters: ScenarioParameters | None = None) -> str:
    """Return a text such as "axis 3 (right): unlock 0.887 \N{PLUS-MINUS SIGN} 0.012 m, lock at least 3.00 m".

    Without parameters, a distance that was not reached has no bound.
    """
    figures = zip(result.distances, figures_of(scenario, parameters, result))
    distances = [f"{distance.word} {_with_unit(distance, figure)}" for distance, figure in figures]
    reason = f": {result.reason}" if result.reason else ""
    return f"{line_name(scenario, result)}: {', '.join((*distances, *result.findings))}{reason}"


def results_table(scenario: AnyScenario, results: Sequence[LineResult],
                  parameters: ScenarioParameters | None = None) -> Iterator[str]:
    """Yield the lines of a table of all results, distances in m with 1 sigma, then the lines' further findings, the
    meaning of the figures, and the reasons of the invalid ones."""
    shows_intervals = has_intervals(results)
    heading = [scenario.line_word, ""]
    for word in scenario.distance_words:
        heading += [f"{word} m", f"{sigma_word(results)} m", *([f"{INTERVAL} m"] if shows_intervals else [])]
    rows = [heading, *(_row(scenario, parameters, result, shows_intervals) for result in results)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for row in rows:
        # Only the column of the place contains words.
        cells = (cell.ljust(width) if index == 1 else cell.rjust(width)
                 for index, (cell, width) in enumerate(zip(row, widths)))
        yield _GAP.join(cells).rstrip()
    yield from (f"{line_name(scenario, result)}: {finding}" for result in results for finding in result.findings)
    yield from meanings(results)
    for result in results:
        if result.reason:
            yield f"{line_name(scenario, result)} is invalid: {result.reason}"


def _row(scenario: AnyScenario, parameters: ScenarioParameters | None, result: LineResult,
         shows_intervals: bool) -> list[str]:
    row = [str(result.number), result.place]
    for distance, figure in zip(result.distances, figures_of(scenario, parameters, result)):
        row += [filled(TEMPLATES[figure.kind], figure, sigma_m=distance.uncertainty_m),
                sigma_text(distance.uncertainty_m), *([interval_text(distance)] if shows_intervals else [])]
    return row


def _with_unit(distance: MeasuredDistance, figure: Figure) -> str:
    text = filled(TEMPLATES[figure.kind], figure, sigma_m=distance.uncertainty_m)
    if figure.kind in _WORDS:
        return text
    sigma = sigma_text(distance.uncertainty_m) if figure.kind is Kind.VALUE else ""
    tail = f" {_PLUS_MINUS} {sigma}" if sigma else ""
    return f"{text}{tail} m"
