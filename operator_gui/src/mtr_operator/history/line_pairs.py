"""Assigns the lines of one test to the lines of another one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import pathlib
from dataclasses import dataclass

from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.results.line_result import LineResult
from mtr_operator.domain.results.progress import SAME_CAR_M, Progress
from mtr_operator.domain.scenario import AnyScenario, Line, ScenarioParameters
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.report.table import line_name
from mtr_operator.storage.progress_file import open_progress

from .bundles import progress_file_of

# At 5 m this equals the allowed difference in size between Cars.
_SAME_DIRECTION_RAD = math.radians(2.0)
_SAME_HEIGHT_M = 0.05
_SAME_PLACE_M = 0.01


@dataclass(frozen=True)
class Side:
    """One of two tests."""

    scenario: AnyScenario
    parameters: ScenarioParameters
    progress: Progress


def open_side(path: pathlib.Path) -> Side:
    """Open the test in a progress file or bundle; ProgressFileError states a fault."""
    with progress_file_of(path) as file:
        return Side(*open_progress(file, SCENARIOS))


@dataclass(frozen=True)
class LinePair:
    """Results of one line, and its ray in the first test."""

    first: LineResult
    second: LineResult
    ray: Ray

    @property
    def number(self) -> int:
        """Number of the line in the first test."""
        return self.first.number


def line_pairs(first: Side, second: Side) -> tuple[list[LinePair], tuple[str, ...], tuple[str, ...]]:
    """Return lines at the same place in both tests, and names of the unmatched lines of the first and of the second
    one."""
    of_first, of_second = _lines(first), _lines(second)
    pairs: list[LinePair] = []
    alone: list[str] = []
    for result, line in of_first:
        # The same number has priority: with equal parameters it is the same line.
        other = next((other for other in sorted(of_second, key=lambda other: other[0].number != result.number)
                      if _is_same(line, other[1]) and _is_level((line, first), (other[1], second))), None)
        if other is None:
            alone.append(line_name(first.scenario, result))
        else:
            of_second.remove(other)
            pairs.append(LinePair(result, other[0], line.ray))
    return pairs, tuple(alone), tuple(line_name(second.scenario, result) for result, _ in of_second)


def _lines(side: Side) -> list[tuple[LineResult, Line]]:
    lines = {line.number: line for line in side.scenario.lines(side.parameters, side.progress.measured_car)}
    return [(result, lines[result.number]) for result in side.progress.results]


def _is_same(line: Line, other: Line) -> bool:
    mine, its = line.ray, other.ray
    apart_m = math.dist((mine.origin_x, mine.origin_y), (its.origin_x, its.origin_y))
    across = mine.direction_x * its.direction_y - mine.direction_y * its.direction_x
    along = mine.direction_x * its.direction_x + mine.direction_y * its.direction_y
    # Only places of a phone test have their own distance, several on one ray.
    places_m = [getattr(each, "distance_m", 0.0) for each in (line, other)]
    return (apart_m <= SAME_CAR_M and abs(math.atan2(across, along)) <= _SAME_DIRECTION_RAD
            and abs(places_m[0] - places_m[1]) <= _SAME_PLACE_M)


def _is_level(line: tuple[Line, Side], other: tuple[Line, Side]) -> bool:
    """Return True if the key height is equal; only zones have their own height."""
    heights_m: list[float] = [getattr(each, "height_m", side.parameters.key_height_m) for each, side in (line, other)]
    return abs(heights_m[0] - heights_m[1]) <= _SAME_HEIGHT_M
