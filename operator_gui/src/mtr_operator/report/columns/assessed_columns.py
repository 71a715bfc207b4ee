"""Last columns of results.csv, which are computed instead of measured: parts of the uncertainty, and the verdict."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Iterator

from mtr_operator.domain.results.line_result import Column, LineResult, Looked
from mtr_operator.domain.scenario import AnyScenario
from mtr_operator.domain.scenarios.line_search.result import SearchedResult
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.domain.verdict.verdict import Verdict


class AssessedColumns:
    """Computed columns. Attributes: columns: in their order."""

    def __init__(self, scenario: AnyScenario, assessment: Assessment | None):
        self._words = scenario.distance_words
        self._assessment = assessment
        self.columns = (*(column for word in self._words for column in _of_distance(word)),
                        Column("verdict", "", "pass, inconclusive or fail by the limits; not_set without"),
                        Column("verdict_reason", "", "why the line did not pass"),
                        *(_to_outline(word) for word in self._words))
        self._has_looks = issubclass(scenario.result_type, Looked)
        if self._has_looks:
            self.columns += (*_LOOKS, *(column for word in self._words for column in _look_ends(word)))
        if issubclass(scenario.result_type, SearchedResult):
            self.columns += _HOLES

    def metadata(self) -> Iterator[str]:
        """Yield the metadata lines above the table."""
        judgement = None if self._assessment is None else self._assessment.judgement
        if judgement is not None:
            for requirement in dict.fromkeys(each.requirement for each in judgement.judgements):
                yield f"limit {requirement.name}: {requirement.text}"
            yield f"verdict: {judgement.verdict.word}"
        for column in self.columns:
            unit = f" [{column.unit}]" if column.unit else ""
            yield f"column {column.name}{unit}: {column.doc}"

    def values(self, result: LineResult) -> list[Any]:
        """Return the values of one line, in the order of the columns; None for an empty cell."""
        assessment = self._assessment
        values: list[Any] = []
        for word in self._words:
            budget = None if assessment is None else assessment.budget(result.number, word)
            values += ([None] * len(_of_distance(word)) if budget is None
                       else [budget.own_sigma_m, budget.common_sigma_m, budget.expanded_m])
        judgement = None if assessment is None else assessment.judgement
        verdict = Verdict.NOT_SET if judgement is None else judgement.of_line(result.number)
        outlines = {} if assessment is None else assessment.to_outline_m
        return [*values, verdict.word, "" if judgement is None else judgement.reason_of(result.number),
                *(outlines.get((result.number, word)) for word in self._words), *self._looks(result)]

    def _looks(self, result: LineResult) -> list[Any]:
        if not self._has_looks or not isinstance(result, Looked):
            return []
        ends = [end_m for distance in result.distances for end_m in distance.look_m or (None, None)]
        return [len(result.looks) or None, result.look_percent, *ends, *_hole(result)]


def _of_distance(word: str) -> tuple[Column, ...]:
    return (Column(f"{word}_own_sigma_m", "m", "1 sigma of the errors of this distance alone; see budget.json"),
            Column(f"{word}_common_sigma_m", "m", "1 sigma of the errors that the other lines have too"),
            Column(f"{word}_expanded_m", "m", "expanded uncertainty, 95 % coverage, of all that budget.json lists; "
                   "it holds what other attempts would do only where the method gives an interval; empty where one "
                   "end of that is open"))


_LOOKS = (Column("looks", "", "looks at this line for its verdict, one before and one after each further attempts; "
                 "empty when it was judged once, by the 95 % interval"),
          Column("look_percent", "%", "confidence of the interval by which the last look judges: all looks together "
                 "err as rarely as one by the 95 % interval", 2))
_HOLES = (Column("boundaries", "", "several: one falling curve does not describe the line; its interval reaches from "
                 "the nearest boundary to the farthest; empty for one boundary"),
          Column("hole_from_m", "m", "farthest attempt that worked before the nearest hole of such a line, if any"),
          Column("hole_to_m", "m", "nearest attempt that worked beyond that hole"))


def _hole(result: LineResult) -> list[Any]:
    return [result.boundaries, result.hole_from_m, result.hole_to_m] if isinstance(result, SearchedResult) else []


def _look_ends(word: str) -> tuple[Column, ...]:
    return tuple(Column(f"{word}_look_{end}_m", "m", f"{side} end of the interval of look_percent; empty when it lies "
                        "beyond the places") for end, side in (("low", "lower"), ("high", "upper")))


def _to_outline(word: str) -> Column:
    return Column(f"{word}_to_outline_m", "m", "shortest distance of the key from the Car's outline in the plane of "
                  "the LiDARs, which is grown to the data sheet's size where the robot was given one")
