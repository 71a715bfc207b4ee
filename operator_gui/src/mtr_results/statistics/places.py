"""The same line in many tests: each test's results beside those of the first one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from typing import Sequence

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.line_result import LineResult, LineStatus
from mtr_operator.domain.verdict.assessment import Assessment
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.history.comparison import DistanceReader
from mtr_operator.history.line_pairs import Side, line_pairs

from .estimate import Known

MAX_TESTS = 500
_NOWHERE = (-math.inf, math.inf)


class Tests:
    """Tests of one scenario, with what each says of the lines of the first one.

    Attributes:
        sides: the tests. first: whose lines are the places. results: of each test, by the first one's number of a line.
        alone: of each test the names of lines that the first one has not.
    """

    # The name would make pytest collect it.
    __test__ = False

    def __init__(self, sides: Sequence[Side]):
        check(sides)
        self.sides = sides
        self.first = sides[0]
        self.results: list[dict[int, LineResult]] = []
        self.alone: list[tuple[str, ...]] = []
        for side in sides:
            pairs, _, alone = line_pairs(self.first, side)
            self.results.append({pair.number: pair.second for pair in pairs})
            self.alone.append(alone)
        self._readers = [DistanceReader(side) for side in sides]
        self._assessments: dict[int, Assessment] = {}
        self._distances: dict[tuple[int, int, str], Known | None] = {}

    @property
    def words(self) -> tuple[str, ...]:
        """What the distances of a line are called."""
        return self.first.scenario.distance_words

    def assessment(self, test: int) -> Assessment:
        """Budgets and verdicts of a test."""
        if test not in self._assessments:
            self._assessments[test] = self._readers[test].assessment()
        return self._assessments[test]

    def verdict(self, test: int) -> Verdict:
        """Of a test by its limits; without any nothing is judged."""
        judgement = None if self.sides[test].progress.limits is None else self.assessment(test).judgement
        return Verdict.NOT_SET if judgement is None else judgement.verdict

    def distance(self, test: int, line: int, word: str) -> Known | None:
        """What a test says of a distance; None where that is invalid or not there, or the key may have slept."""
        key = test, line, word
        # Asked for by its line, and by the area that it is a corner of.
        if key not in self._distances:
            self._distances[key] = self._distance(*key)
        return self._distances[key]

    def _distance(self, test: int, line: int, word: str) -> Known | None:
        result = self.results[test].get(line)
        if result is None:
            return None
        distance = result.distances[self.words.index(word)]
        reader = self._readers[test]
        # What was reached nowhere in a test may have been asleep.
        if distance.status is LineStatus.INVALID or not reader.is_alive(word):
            return None
        figure = reader.figure(distance)
        low_m, high_m = _ends(figure)
        return Known(figure.first_m if figure.kind is Kind.VALUE else None, low_m, high_m,
                     reader.ends(result, distance), reader.unshown_sigma_m(result, word))

    def coverage(self, test: int, line: int) -> Known | None:
        """Part of the area of a zone where at least half of the presses work; None where the scenario has none."""
        result = self.results[test].get(line)
        share, low, high = (getattr(result, f"coverage{end}", None) for end in ("", "_low", "_high"))
        if share is None:
            return None
        return Known(share, share, share, None if low is None or high is None else (low, high))


def check(sides: Sequence[Side]) -> None:
    """Raise OperatorError for tests that cannot be looked at together."""
    if not sides:
        raise OperatorError("No test fits; mtr-results list shows what there is.")
    if len(sides) > MAX_TESTS:
        raise OperatorError(f"{len(sides)} tests fit; at most {MAX_TESTS} are looked at together. Narrow the search.")
    titles = sorted({side.scenario.title for side in sides})
    if len(titles) > 1:
        raise OperatorError(f"Tests of the scenarios {' and '.join(titles)} cannot be looked at together; choose one.")
    if any(not side.progress.results for side in sides):
        raise OperatorError("A test that has measured nothing cannot be compared.")


def _ends(figure: Figure) -> tuple[float, float]:
    """Between which distances a boundary lies, in m."""
    first_m, second_m = figure.first_m, figure.second_m
    if first_m is None:
        return _NOWHERE
    if figure.kind is Kind.VALUE:
        return first_m, first_m
    if figure.kind is Kind.BETWEEN and second_m is not None:
        return first_m, second_m
    return (first_m, math.inf) if figure.kind is Kind.AT_LEAST else (-math.inf, first_m)
