"""Two tests beside each other: the difference of each distance, with its 95 % interval.

A distance is called different only where the whole interval of the difference lies on one side of zero. The interval
follows from those of both distances, with all their errors (MOVER: Zou and Donner 2008, Statistics in Medicine 27,
1693): from a + [a - low_a, high_a - a] and the same of b,

    b - a - hypot(b - low_b, high_a - a)  to  b - a + hypot(high_b - b, a - low_a)

Errors that both tests have alike, such as those of one calibration record, would leave a difference; here they count
in full for each, so that the interval is rather too wide. Where one end of a distance is not known, the ends are taken
as they are. Where a measurement does not say how sure it is, nothing is called different, whatever the figures are.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import enum
import math
from dataclasses import dataclass, replace
from typing import Sequence

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.estimation.interval import LEVEL
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import Figure, Kind, figure_of
from mtr_operator.domain.results.line_result import LineResult, LineStatus, MeasuredDistance
from mtr_operator.domain.verdict.assessment import Assessment, Assessor, LastingSigmas
from mtr_operator.storage.given_files import calibration_of

from .line_pairs import LinePair, Side, line_pairs

Ends = tuple[float, float]
_NOWHERE: Ends = (-math.inf, math.inf)


class Change(enum.Enum):
    """What may be said of a difference."""

    FARTHER = "farther"
    NEARER = "nearer"
    NOT_SHOWN = "no difference shown"
    NOT_KNOWN = "not known"


@dataclass(frozen=True)
class Difference:
    """Of one distance of one line, second less first.

    Attributes:
        pair: the line in both tests. word: of the distance. first, second: what may be said of each.
        value_m: None where one of them is no value. low_m, high_m: 95 % interval, infinite where an end is not known.
        reason: why nothing can be said, a sentence; empty when something can.
    """

    pair: LinePair
    word: str
    first: Figure
    second: Figure
    value_m: float | None
    low_m: float = -math.inf
    high_m: float = math.inf
    reason: str = ""

    @property
    def change(self) -> Change:
        """Where the second one lies."""
        if self.reason or (self.low_m, self.high_m) == _NOWHERE:
            return Change.NOT_KNOWN
        if self.low_m > 0.0:
            return Change.FARTHER
        return Change.NEARER if self.high_m < 0.0 else Change.NOT_SHOWN


@dataclass(frozen=True)
class Comparison:
    """Attributes: first, second: the tests. differences: line by line. only_first, only_second: names of lines that the
    other test has not, or not there."""

    first: Side
    second: Side
    differences: tuple[Difference, ...]
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]

    def counts(self) -> dict[Change, int]:
        """How many distances came to what; none that is 0."""
        changes = [difference.change for difference in self.differences]
        return {change: changes.count(change) for change in Change if change in changes}

    @property
    def expected_by_chance(self) -> float:
        """How many differences would be shown on average although there is none."""
        known = [difference for difference in self.differences if difference.change is not Change.NOT_KNOWN]
        return (1.0 - LEVEL) * len(known)


def compare(first: Side, second: Side) -> Comparison:
    """Compare two tests; OperatorError when they are of different scenarios, or one has measured nothing."""
    if first.scenario.name != second.scenario.name:
        raise OperatorError(f"A test of the scenario {first.scenario.title} and one of {second.scenario.title} cannot "
                            "be compared; choose two of one scenario.")
    if not first.progress.results or not second.progress.results:
        raise OperatorError("A test that has measured nothing cannot be compared.")
    pairs, only_first, only_second = line_pairs(first, second)
    sides = DistanceReader(first), DistanceReader(second)
    found: list[Difference] = []
    for pair in pairs:
        for index, word in enumerate(first.scenario.distance_words):
            found.append(_difference(pair, word, index, sides))
    return Comparison(first, second, tuple(found), only_first, only_second)


class DistanceReader:
    """What one test says of its distances."""

    def __init__(self, side: Side):
        self._side = side
        progress = side.progress
        self._assessor = Assessor(side.scenario, side.parameters, progress.measured_car, calibration_of(progress))
        self._alive = {distance.word for result in progress.results for distance in result.distances
                       if distance.status is LineStatus.OK}

    def figure(self, result: LineResult, distance: MeasuredDistance) -> Figure:
        """What may be said of it."""
        judging = part(self._side.scenario, Judging)
        return figure_of(distance, judging.unreached(self._side.parameters, result, distance.word))

    def ends(self, result: LineResult, distance: MeasuredDistance) -> Ends | None:
        """95 % interval; None where the measurement does not say how sure it is."""
        return self._assessor.interval(result, distance) if self.is_alive(distance.word) else None

    def is_alive(self, word: str) -> bool:
        """False where the key worked on no line of the test: it may have been asleep."""
        return word in self._alive

    def assessment(self) -> Assessment:
        """Budgets and verdicts of the test."""
        return self._assessor.assess(self._side.progress)

    def unshown_sigma_m(self, result: LineResult, word: str) -> float:
        """1 sigma of the errors that repeating the test does not show, or not all of."""
        return self._assessor.guard_sigma(result, word)

    def lasting_sigmas(self, result: LineResult, word: str) -> LastingSigmas:
        """What of the errors of a distance other lines, or other tests, have as well."""
        return self._assessor.lasting_sigmas(result, word)


def _difference(pair: LinePair, word: str, index: int, sides: tuple[DistanceReader, DistanceReader]) -> Difference:
    results = pair.first, pair.second
    distances = [result.distances[index] for result in results]
    first, second = (side.figure(result, distance)
                     for side, result, distance in zip(sides, results, distances))
    values = [figure.first_m if figure.kind is Kind.VALUE else None for figure in (first, second)]
    known = Difference(pair, word, first, second,
                       None if values[0] is None or values[1] is None else values[1] - values[0])
    for number, distance in enumerate(distances, start=1):
        if distance.status is LineStatus.INVALID:
            return replace(known, reason=f"It is invalid in test {number}.")
    ends = []
    for number, (side, result, distance) in enumerate(zip(sides, results, distances), start=1):
        found = side.ends(result, distance)
        if found is None:
            return replace(known, reason=f"Test {number} does not say how sure this distance is.")
        ends.append(found)
    low_m, high_m = difference_interval(values, ends[0], ends[1])
    return replace(known, low_m=low_m, high_m=high_m)


def difference_interval(values: Sequence[float | None], first: Ends, second: Ends) -> Ends:
    """95 % interval of the second of two values less the first, from those of both; None for a value nobody knows."""
    a, b = (_middle(value, ends) for value, ends in zip(values, (first, second)))
    if a is None or b is None:
        return second[0] - first[1], second[1] - first[0]
    return (b - a - math.hypot(b - second[0], first[1] - a), b - a + math.hypot(second[1] - b, a - first[0]))


def _middle(value: float | None, ends: Ends) -> float | None:
    """A value within both ends; None where one of them is not known."""
    if not all(map(math.isfinite, ends)):
        return None
    return value if value is not None and ends[0] <= value <= ends[1] else sum(ends) / 2.0
