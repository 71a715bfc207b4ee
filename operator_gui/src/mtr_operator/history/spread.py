"""Repeated tests: mean and spread of each distance, with 95 % intervals, and differing circumstances."""
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
    """Spread of one distance of one line.

    Attributes:
        line: its result in the first test. ray: its position. word: of the distance.
        tests: their number. values_m: of the tests with a value, in their order.
        mean: of all tests with a result. spread: variance of repetition, and of each differing factor.
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
        """Tests without a value: invalid, not reached, or known from one side only."""
        return self.tests - len(self.values_m)

    @property
    def sigma_m(self) -> float | None:
        """Standard deviation of repetitions with the same car and key; None for fewer than two values."""
        if self.spread.components:
            return self.spread.repeatability
        return statistics.stdev(self.values_m) if len(self.values_m) > 1 else None

    @property
    def sigma_ends_m(self) -> Ends | None:
        """95 % interval of sigma_m, the upper end infinite if unbounded; None without a result."""
        if not self.spread.components:
            return None
        repeated = self.spread.components[-1]
        return repeated.low, repeated.high


@dataclass(frozen=True)
class TestSpread:
    """Spread of several tests. Attributes: tests: oldest first. distances: line by line. differing: names of differing
    circumstances."""

    # Otherwise pytest would collect it because of its name.
    __test__ = False

    tests: Tests
    distances: tuple[DistanceSpread, ...]
    differing: tuple[str, ...]

    def of(self, word: str) -> list[DistanceSpread]:
        """Return the distances of one word."""
        return [distance for distance in self.distances if distance.word == word]


def spread_of(sides: Sequence[Side]) -> TestSpread:
    """Return the spread of tests of one scenario; OperatorError if they cannot be compared."""
    tests = Tests(sides)
    found = tuple(distance_spread(tests, result, word, {}) for result in tests.first.progress.results
                  for word in tests.words)
    return TestSpread(tests, found, differing_names(sides))


def distance_spread(tests: Tests, line: LineResult, word: str,
                    factors: Mapping[str, Sequence[str]]) -> DistanceSpread:
    """Return the spread of a distance of a line of the first test. factors: name -> level of each test."""
    every = [tests.distance(test, line.number, word) for test in range(len(tests.sides))]
    kept = [index for index, each in enumerate(every) if each is not None and each.value is not None]
    values = tuple(each.value for each in every if each is not None and each.value is not None)
    levels = {name: [each[index] for index in kept] for name, each in factors.items()}
    return DistanceSpread(line, tests.ray(line.number), word, len(every), values,
                          estimate([each for each in every if each is not None]), components(values, levels))
