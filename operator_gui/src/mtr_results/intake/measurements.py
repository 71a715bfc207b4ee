"""Rows of lines, of their distances in all revisions, and of verdicts."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import AbstractSet, Any, Iterator, Sequence

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import figure_of
from mtr_operator.domain.results.line_result import LineResult, MeasuredDistance, result_from_document
from mtr_operator.domain.verdict.assessment import Assessment, Assessor
from mtr_operator.history.line_pairs import Side
from mtr_operator.report.assessed import assess
from mtr_operator.storage.given_files import calibration_of
from mtr_operator.storage.journal.journal_file import Entry

from .trials import Row, revisions_of

_OF_BUDGET = ("own_sigma_m", "common_sigma_m", "expanded_m")


def assessment_of(side: Side) -> Assessment | None:
    """Return the assessment, or None before the Car was mapped, because nothing has been measured then."""
    return None if side.progress.car is None else assess(side.scenario, side.parameters, side.progress)


def line_rows(side: Side, tried: AbstractSet[int]) -> Iterator[Row]:
    """Yield a row for each line with a result or a point.

    tried: numbers of lines that have at least one point; such a line may not have a result.
    """
    results = {result.number: result for result in side.progress.results}
    if side.progress.car is None:
        return
    for line in side.scenario.lines(side.parameters, side.progress.car):
        result = results.get(line.number)
        if result is not None or line.number in tried:
            yield {"number": line.number, "place": result.place if result else "", "origin_x_m": line.ray.origin_x,
                   "origin_y_m": line.ray.origin_y, "direction_x": line.ray.direction_x,
                   "direction_y": line.ray.direction_y, "height_m": getattr(line, "height_m", None),
                   "reason": result.reason if result else "", "holes_m": getattr(result, "holes_m", "")}


def measurement_rows(side: Side, assessment: Assessment | None, entries: Sequence[Entry]) -> list[Row]:
    """Return a row for each distance of each result revision.

    The current distance is the one in the progress. A revision with the same values is not duplicated; it is marked as
    current.
    """
    current = {result.number: result for result in side.progress.results}
    if not current:
        return []
    assessor = Assessor(side.scenario, side.parameters, side.progress.measured_car, calibration_of(side.progress))
    histories: dict[int, list[LineResult]] = {number: [] for number in current}
    for document in revisions_of(entries):
        result = result_from_document(side.scenario.result_type, document)
        histories[result.number].append(result)
    rows: list[Row] = []
    for number, counting in current.items():
        others = [result for result in histories[number] if result != counting]
        for revision, result in enumerate([*others, counting], start=1):
            for distance in result.distances:
                budget = assessment.budget(number, distance.word) if assessment and result is counting else None
                rows.append({"line": number, "revision": revision, "is_current": result is counting,
                             **_distance(side, assessor, result, distance),
                             **{name: getattr(budget, name, None) for name in _OF_BUDGET}})
    return rows


def _distance(side: Side, assessor: Assessor, result: LineResult, distance: MeasuredDistance) -> Row:
    figure = figure_of(distance, part(side.scenario, Judging).unreached(side.parameters, result, distance.word))
    ends = assessor.interval(result, distance)
    low_m, high_m = (None, None) if ends is None else map(_finite, ends)
    return {"word": distance.word, "status": distance.status.value, "kind": figure.kind.value,
            "first_m": figure.first_m, "second_m": figure.second_m, "sigma_m": distance.uncertainty_m,
            "has_interval": ends is not None, "low_m": low_m, "high_m": high_m,
            **{name: getattr(result, name, None) for name in ("coverage", "coverage_low", "coverage_high")}}


def _finite(end_m: float) -> float | None:
    return end_m if math.isfinite(end_m) else None


def verdict_rows(assessment: Assessment | None) -> Iterator[Row]:
    """Yield the verdict of the test, then one row for each limit and line; none without limits."""
    judgement = None if assessment is None else assessment.judgement
    if judgement is None:
        return
    found: list[tuple[int, str, Any, str]] = [(0, "", judgement.verdict, "")]
    found += [(each.line, each.requirement.text, each.verdict, each.reason) for each in judgement.judgements]
    for number, (line, requirement, verdict, reason) in enumerate(found):
        yield {"number": number, "line": line, "requirement": requirement, "verdict": verdict.word, "reason": reason}
