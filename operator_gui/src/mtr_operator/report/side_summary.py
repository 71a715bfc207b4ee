"""Minimum, mean and maximum of the distances per side of the Car, and the worst line of each side."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import Figure, Kind, between, figure_of
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.verdict.judgement import TestJudgement
from mtr_operator.domain.verdict.requirement import SIDES, side_of
from mtr_operator.domain.verdict.verdict import Verdict, worst

ALL_SIDES = "all sides"
# Ends of a distance that is unknown.
_UNKNOWN = (-math.inf, math.inf)
_WITHOUT = (Kind.INVALID, Kind.NOT_REACHED)


@dataclass(frozen=True)
class SideSummary:
    """Summary of one distance on one side.

    Attributes:
        side: of requirement.SIDES with blanks, or ALL_SIDES. word: of the scenario's distance_words. count: lines with
        a result. minimum, mean, maximum: bounds if some lines know only one end.
        worst_line: number of the line with the worst verdict, the nearest of several; None without any result. verdict:
        the worst on the side; NOT_SET without limits.
    """

    side: str
    word: str
    count: int
    minimum: Figure
    mean: Figure
    maximum: Figure
    worst_line: int | None
    verdict: Verdict


def side_summaries(scenario: AnyScenario, parameters: ScenarioParameters, progress: Progress,
                   judgement: TestJudgement | None) -> list[SideSummary]:
    """Return summaries per distance: the sides with lines, clockwise from the front, then all of them if there are
    several."""
    rays = {line.number: line.ray for line in scenario.lines(parameters, progress.measured_car)}
    by_side: dict[str, list[LineResult]] = {side: [] for side in SIDES}
    for result in progress.results:
        by_side[side_of(rays[result.number])].append(result)
    groups = [(side.replace("_", " "), results) for side, results in by_side.items() if results]
    if len(groups) > 1:
        groups.append((ALL_SIDES, list(progress.results)))
    return [_summary((side, index), results, (scenario, parameters), judgement)
            for index in range(len(scenario.distance_words)) for side, results in groups]


def _summary(of: tuple[str, int], results: Sequence[LineResult], test: tuple[AnyScenario, ScenarioParameters],
             judgement: TestJudgement | None) -> SideSummary:
    (side, index), (scenario, parameters) = of, test
    word = scenario.distance_words[index]
    judging = part(scenario, Judging)
    figures = {result.number: figure_of(result.distances[index], judging.unreached(parameters, result, word))
               for result in results}
    known = {number: _ends(figure) for number, figure in figures.items() if figure.kind not in _WITHOUT}
    lows, highs = [low for low, _ in known.values()], [high for _, high in known.values()]
    verdicts = {number: Verdict.NOT_SET if judgement is None else judgement.of_line(number) for number in figures}
    worst_line = min(known, key=lambda number: (-verdicts[number], known[number][0], number), default=None)
    if not known:
        nothing = Figure(Kind.NOT_REACHED)
        return SideSummary(side, word, 0, nothing, nothing, nothing, None, worst(verdicts.values()))
    mean = _figure(sum(lows) / len(lows), sum(highs) / len(highs))
    return SideSummary(side, word, len(known), _figure(min(lows), min(highs)), mean, _figure(max(lows), max(highs)),
                       worst_line, worst(verdicts.values()))


def _ends(figure: Figure) -> tuple[float, float]:
    """Return the bounds of the distance."""
    low_m, high_m = figure.first_m, figure.second_m
    if figure.kind is Kind.VALUE:
        high_m = low_m
    elif figure.kind is Kind.AT_MOST:
        low_m, high_m = None, figure.first_m
    return (_UNKNOWN[0] if low_m is None else low_m), (_UNKNOWN[1] if high_m is None else high_m)


def _figure(low_m: float, high_m: float) -> Figure:
    if (low_m, high_m) == _UNKNOWN:
        return Figure(Kind.UNKNOWN)
    if low_m == high_m:
        return Figure(Kind.VALUE, low_m)
    return between(low_m if math.isfinite(low_m) else None, high_m if math.isfinite(high_m) else None)
