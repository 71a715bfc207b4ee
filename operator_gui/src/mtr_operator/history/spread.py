"""Repeated tests: mean and spread of each distance, with their 95 % intervals, and in what the tests differ."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics
from dataclasses import dataclass
from typing import Mapping, Sequence

from mtr_operator.domain.estimation.components import Spread, components
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineResult

from .circumstances import differing_names
from .distance_reader import Ends
from .estimate import Estimate, estimate
from .line_pairs import Side
from .same_lines import Tests


@dataclass(frozen=True)
class DistanceSpread:
    """Of one distance of one line.

    Attributes:
        line: its result in the first test. ray: where it lies. word: of the distance.
        tests: how many there are. values_m: of those that have one, in their order.
        mean: of all that know something of it. spread: what repetition adds, and each factor by which tests differ.
    """

    line: LineResult
    ray: Ray
    word: str
    tests: int
    values_m: tuple[float, ...]
    mean: Estimate
    spread: Spread

    @property
    def without(self) -> int:
        """Tests that have no value: invalid, not reached, or known from one side only."""
        return self.tests - len(self.values_m)

    @property
    def sigma_m(self) -> float | None:
        """Standard deviation of the same car and key again; None of less than two values."""
        if self.spread.components:
            return self.spread.repeatability
        return statistics.stdev(self.values_m) if len(self.values_m) > 1 else None

    @property
    def sigma_ends_m(self) -> Ends | None:
        """95 % interval of sigma_m, the upper end infinite where it is not bounded; None where nothing is known."""
        if not self.spread.components:
            return None
        repeated = self.spread.components[-1]
        return repeated.low, repeated.high


@dataclass(frozen=True)
class TestSpread:
    """Attributes: tests: oldest first. distances: line by line. differing: names of that in which the tests are not
    alike."""

    # The name would make pytest collect it.
    __test__ = False

    tests: Tests
    distances: tuple[DistanceSpread, ...]
    differing: tuple[str, ...]

    def of(self, word: str) -> list[DistanceSpread]:
        """Those of one word."""
        return [distance for distance in self.distances if distance.word == word]


def spread_of(sides: Sequence[Side]) -> TestSpread:
    """Of tests of one scenario; OperatorError when they cannot be looked at together."""
    tests = Tests(sides)
    found = tuple(distance_spread(tests, result, word, {}) for result in tests.first.progress.results
                  for word in tests.words)
    return TestSpread(tests, found, differing_names(sides))


def distance_spread(tests: Tests, line: LineResult, word: str,
                    factors: Mapping[str, Sequence[str]]) -> DistanceSpread:
    """Of a distance of a line of the first test. factors: name -> of each test the level that it has."""
    every = [tests.distance(test, line.number, word) for test in range(len(tests.sides))]
    kept = [index for index, each in enumerate(every) if each is not None and each.value is not None]
    values = tuple(each.value for each in every if each is not None and each.value is not None)
    levels = {name: [each[index] for index in kept] for name, each in factors.items()}
    return DistanceSpread(line, tests.ray(line.number), word, len(every), values,
                          estimate([each for each in every if each is not None]), components(values, levels))
