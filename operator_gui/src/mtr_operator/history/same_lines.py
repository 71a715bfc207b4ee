"""The same line in many tests: assigns each test's results to the lines of the first one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import collections
import functools
import math
from typing import Sequence

from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.identity.identity import NOBODY
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Judging
from mtr_operator.domain.results.figure import Figure, Kind
from mtr_operator.domain.results.line_result import LineResult, LineStatus
from mtr_operator.domain.verdict.assessment import Assessment, LastingSigmas
from mtr_operator.domain.verdict.verdict import Verdict

from .distance_reader import DistanceReader
from .estimate import NOT_MEASURED, Known
from .line_pairs import Side, line_pairs

MAX_TESTS = 500
_NOWHERE = (-math.inf, math.inf)
INVALID = "The line is invalid."
ASLEEP = "The key worked on no line of this test; it may have been asleep."
UNLIKE = ("The tests tell different things here, such as a boundary and the place of one event; choose tests that were "
          "measured alike.")


class Tests:
    """Tests of one scenario, with their results for the lines of the first one.

    Attributes:
        sides: the tests. first: its lines are the reference. results: of each test, by the first one's number of a
        line. alone: of each test the names of lines that the first one lacks.
    """

    # Otherwise pytest would collect it because of its name.
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
        self._rays: dict[int, Ray] = {line.number: line.ray for line in self.first.scenario.lines(
            self.first.parameters, self.first.progress.measured_car)}
        self._readers = [DistanceReader(side) for side in sides]
        self._assessments: dict[int, Assessment] = {}
        self._distances: dict[tuple[int, int, str], Known | None] = {}
        self._lasting: dict[tuple[int, int, str], LastingSigmas] = {}
        self._measurands: dict[tuple[int, str], str] = {}

    @property
    def words(self) -> tuple[str, ...]:
        """Names of the distances of a line."""
        return self.first.scenario.distance_words

    def ray(self, line: int) -> Ray:
        """Return the ray of a line in the first test."""
        return self._rays[line]

    def figure(self, test: int, line: int, word: str) -> Figure:
        """Return a distance as its own test states it; the line must have a result in this test."""
        result = self.results[test][line]
        return self._readers[test].figure(result, result.distances[self.words.index(word)])

    def assessment(self, test: int) -> Assessment:
        """Return budgets and verdicts of a test."""
        if test not in self._assessments:
            self._assessments[test] = self._readers[test].assessment()
        return self._assessments[test]

    def verdict(self, test: int) -> Verdict:
        """Return the verdict of a test by its limits; NOT_SET without limits."""
        judgement = None if self.sides[test].progress.limits is None else self.assessment(test).judgement
        return Verdict.NOT_SET if judgement is None else judgement.verdict

    def distance(self, test: int, line: int, word: str) -> Known | None:
        """Return a distance of a test, or only a reason if it is a different quantity than in the other tests. None if
        it is invalid or missing, or the key may have been asleep."""
        key = test, line, word
        # Requested by its line, and by the area of which it is a corner.
        if key not in self._distances:
            self._distances[key] = self._distance(*key)
        return self._distances[key]

    def why_unknown(self, test: int, line: int, word: str) -> str:
        """Return the reason why distance() is None, a sentence."""
        result = self.results[test].get(line)
        if result is None:
            return NOT_MEASURED
        return INVALID if result.distances[self.words.index(word)].status is LineStatus.INVALID else ASLEEP

    def _distance(self, test: int, line: int, word: str) -> Known | None:
        result = self.results[test].get(line)
        if result is None:
            return None
        distance = result.distances[self.words.index(word)]
        reader = self._readers[test]
        # If a distance was reached on no line of a test, the key may have been asleep.
        if distance.status is LineStatus.INVALID or not reader.is_alive(word):
            return None
        if self._measurand(test, line, word) not in (None, self._common_measurand(line, word)):
            return Known(None, *_NOWHERE, None, reason=UNLIKE)
        figure = reader.figure(result, distance)
        low_m, high_m = _ends(figure)
        unshown_m, lasting = reader.unshown_sigma_m(result, word), self.lasting_sigmas(test, line, word)
        shared_m = math.hypot(unshown_m, lasting.timing_m)
        return Known(figure.first_m if figure.kind is Kind.VALUE else None, low_m, high_m,
                     reader.ends(result, distance), math.hypot(unshown_m, max(lasting.all_timing_m, lasting.timing_m)),
                     shared_m, *self._alike_m(line, lasting))

    def _measurand(self, test: int, line: int, word: str) -> str | None:
        """See Judging.measurand; None without a measurement: an end that was not reached bounds all measurands."""
        result, side = self.results[test].get(line), self.sides[test]
        if result is None or result.distances[self.words.index(word)].status is not LineStatus.OK:
            return None
        return part(side.scenario, Judging).measurand(side.parameters, result, word)

    def _common_measurand(self, line: int, word: str) -> str:
        """Return the common quantity of the compared tests: the boundary if one test has it, else the most frequent
        one."""
        key = line, word
        if key not in self._measurands:
            found = [each for test in range(len(self.sides)) if (each := self._measurand(test, *key)) is not None]
            self._measurands[key] = "" if "" in found else collections.Counter(found).most_common(1)[0][0]
        return self._measurands[key]

    def _alike_m(self, line: int, lasting: LastingSigmas) -> tuple[float, float]:
        """Return the common errors: the outline of the same Car as far as it was mapped alike, and its timing while its
        software is unchanged."""
        if not self.is_same_car:
            return 0.0, 0.0
        scatter_m = self.outline_scatter_m(line)
        outline_m = math.hypot(*(math.sqrt(max(sigma_m ** 2 - scatter_m ** 2, 0.0))
                                 for sigma_m in (lasting.outline_m, lasting.outline_in_place_m)))
        software = {(side.progress.identity or NOBODY).car_software for side in self.sides}
        return outline_m, lasting.timing_m if len(software) == 1 else 0.0

    def outline_scatter_m(self, line: int) -> float:
        """Return the scatter between the tests of the Car's mapped outline at the start of a line."""
        ray = self.ray(line)
        if (ray.origin_x, ray.origin_y) == (0.0, 0.0):
            return 0.0
        cars = [side.progress.measured_car for side in self.sides]
        length_m, width_m = (max(sizes) - min(sizes) for sizes in ([car.length for car in cars],
                                                                   [car.width for car in cars]))
        return float(abs(ray.direction_x) * length_m + abs(ray.direction_y) * width_m) / 2.0

    def lasting_sigmas(self, test: int, line: int, word: str) -> LastingSigmas:
        """Return the errors of a distance that other lines or other tests have in common with it."""
        key = test, line, word
        # Requested by the distance, and by each side with its line.
        if key not in self._lasting:
            self._lasting[key] = self._readers[test].lasting_sigmas(self.results[test][line], word)
        return self._lasting[key]

    @functools.cached_property
    def is_same_car(self) -> bool:
        """True if all tests name the same Car: by its VIN, or its model if none has a VIN."""
        identities = [side.progress.identity or NOBODY for side in self.sides]
        named = {(identity.car_vin, "" if identity.car_vin else identity.car_model) for identity in identities}
        return len(named) == 1 and named != {("", "")}

    def coverage(self, test: int, line: int) -> Known | None:
        """Return the part of a zone's area where at least half of the presses work; None for scenarios without
        zones."""
        result = self.results[test].get(line)
        share, low, high = (getattr(result, f"coverage{end}", None) for end in ("", "_low", "_high"))
        if share is None:
            return None
        return Known(share, share, share, None if low is None or high is None else (low, high))


def check(sides: Sequence[Side]) -> None:
    """Raise OperatorError for tests that cannot be compared."""
    if not sides:
        raise OperatorError("No test fits.")
    if len(sides) > MAX_TESTS:
        raise OperatorError(f"{len(sides)} tests fit; at most {MAX_TESTS} are looked at together. Narrow the search.")
    titles = sorted({side.scenario.title for side in sides})
    if len(titles) > 1:
        raise OperatorError(f"Tests of the scenarios {' and '.join(titles)} cannot be looked at together; choose one.")
    if any(not side.progress.results for side in sides):
        raise OperatorError("A test that has measured nothing cannot be compared.")


def _ends(figure: Figure) -> tuple[float, float]:
    """Return the bounds of a boundary, in m."""
    first_m, second_m = figure.first_m, figure.second_m
    if first_m is None:
        return _NOWHERE
    if figure.kind is Kind.VALUE:
        return first_m, first_m
    if figure.kind is Kind.BETWEEN and second_m is not None:
        return first_m, second_m
    return (first_m, math.inf) if figure.kind is Kind.AT_LEAST else (-math.inf, first_m)
