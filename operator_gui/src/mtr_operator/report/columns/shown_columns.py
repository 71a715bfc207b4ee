"""First columns of a row of results.csv: each distance as shown in table, window and PDF."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Sequence, TypeVar

from mtr_operator.domain.results.figure import Figure, Kind, interval_of
from mtr_operator.domain.results.line_result import Column, LineResult, MeasuredDistance
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

from ..figures import figures_of

Item = TypeVar("Item")
_NAMES = ("result_m", "low_m", "high_m")
# The identification of a line ends at the first column of its measurement.
_STATUS = "status"


class ShownColumns:
    """Columns of the reportable distances, after the identification of a line.

    Attributes: columns: three for each distance, prefixed by its word if the names alone would be ambiguous.
    """

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters):
        self._scenario, self._parameters = scenario, parameters
        own = [column.name for column in scenario.result_type.columns()]
        words = scenario.distance_words
        is_clear = len(words) == 1 and not set(_NAMES) & set(own)
        self.columns = tuple(column for word in words for column in _columns_of(word, "" if is_clear else f"{word}_"))
        self._place = next((index for index, name in enumerate(own) if name.endswith(_STATUS)), len(own))

    def values(self, result: LineResult) -> list[Any]:
        """Return the values of one line, in the order of the columns; None for an empty cell."""
        figures = figures_of(self._scenario, self._parameters, result)
        return [value for distance, figure in zip(result.distances, figures) for value in _shown(distance, figure)]

    def inserted(self, own: Sequence[Item], shown: Sequence[Item]) -> list[Item]:
        """Return a row or header with the shown part inserted after the line's identification."""
        return [*own[:self._place], *shown, *own[self._place:]]


def _columns_of(word: str, prefix: str) -> tuple[Column, ...]:
    result, low, high = (f"{prefix}{name}" for name in _NAMES)
    return (Column(result, "m", f"distance of {word} as the table shows it; empty where only its ends are known"),
            Column(low, "m", f"lower end of its 95 % interval, or the distance that {word} is at least"),
            Column(high, "m", f"upper end of its 95 % interval, or the distance that {word} is at most"))


def _shown(distance: MeasuredDistance, figure: Figure) -> tuple[float | None, float | None, float | None]:
    if figure.kind is Kind.VALUE:
        interval = interval_of(distance)
        return (figure.first_m, *((None, None) if interval is None else _ends(interval)))
    return (None, *_ends(figure))


def _ends(figure: Figure) -> tuple[float | None, float | None]:
    return (None, figure.first_m) if figure.kind is Kind.AT_MOST else (figure.first_m, figure.second_m)
