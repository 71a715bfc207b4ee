"""Assessment of a test's distances: their uncertainty budgets, and the verdicts on them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Mapping, Sequence

from ..estimation.budget.calibration import CalibrationRecord
from ..estimation.budget.distance_budget import DistanceBudget
from ..estimation.budget.terms import Carriage, Measurement, terms_of
from ..estimation.interval import SIGMAS_OF_LEVEL
from ..geometry.outline import side_errors
from ..geometry.polygon import distance_to_polygon
from ..geometry.pose import Point
from ..geometry.ray import Ray
from ..interfaces.part import part
from ..interfaces.scenario_parts import Judging
from ..results.line_result import LineResult, MeasuredDistance
from ..results.progress import Progress
from ..robot_status import CarDimensions
from ..scenario import AnyScenario, Line, ScenarioParameters
from .judgement import Circumstances, TestJudgement, guarded, judge

# Columns of the Remote key's height: at an event, or of a zone.
_HEIGHTS = ("key_height_m", "height_m")


@dataclass(frozen=True)
class Assessment:
    """Assessment. Attributes: budgets: one for each distance. judgement: None without limits.

    to_outline_m: by line and word, distance of the key from the nearest point of the Car's outline as seen by the
    robot's LiDARs; empty if the robot has not reported an outline.
    """

    budgets: tuple[DistanceBudget, ...]
    judgement: TestJudgement | None
    to_outline_m: Mapping[tuple[int, str], float] = field(default_factory=dict)

    def decided(self) -> list[int]:
        """Return the numbers of the lines that pass or fail."""
        return [] if self.judgement is None else self.judgement.decided()

    def undecided(self) -> list[int]:
        """Return the numbers of the lines that more measurements may decide."""
        return [] if self.judgement is None else self.judgement.undecided()

    def budget(self, line: int, word: str) -> DistanceBudget | None:
        """Return the budget of a distance; None without a measurement."""
        return next((budget for budget in self.budgets if (budget.line, budget.word) == (line, word)), None)


@dataclass(frozen=True)
class LastingSigmas:
    """1 sigma in m of the errors that a distance shares with others.

    Attributes:
        outline_m: of the Car's outline; outline_in_place_m: the same error within the position of the key, 0 if the
        sides
            are known.
        timing_m: of the Car's timing, common to all tests of it; all_timing_m: common to all lines of the test.
        robot_m: of its calibration record.
    """

    outline_m: float
    outline_in_place_m: float
    timing_m: float
    all_timing_m: float
    robot_m: float


class Assessor:
    """Assesses results of one test; car: dimensions that define the lines."""

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters, car: CarDimensions,
                 record: CalibrationRecord):
        self._scenario = scenario
        self._parameters = parameters
        self._car = car
        self._record = record
        self._lines: Sequence[Line] = scenario.lines(parameters, car)
        self._rays = {line.number: line.ray for line in self._lines}

    def assess(self, progress: Progress) -> Assessment:
        """Assess all lines measured so far; a boundary with an open end has no budget, because its distance is
        unknown."""
        budgets = tuple(self._budget(result, distance) for result in progress.results for distance in result.distances
                        if distance.distance_m is not None)
        judgement = None
        if progress.limits is not None:
            judgement = judge(progress.limits, self._lines, progress.results,
                              Circumstances(self.guard_sigma, self._unreached))
        return Assessment(budgets, judgement, self._to_outline(progress))

    def interval(self, result: LineResult, distance: MeasuredDistance) -> tuple[float, float] | None:
        """Return the ends of the 95 % interval of a boundary with all its errors, in m, infinite if open. None if the
        measurement has no interval."""
        if distance.low_m is None and distance.high_m is None:
            return None
        return guarded(distance, SIGMAS_OF_LEVEL * self.guard_sigma(result, distance.word))

    def _budget(self, result: LineResult, distance: MeasuredDistance) -> DistanceBudget:
        attempts_m = _attempts_sigma(distance)
        timing_m = min(distance.common_sigma_m or 0.0, attempts_m)
        measurement = replace(self._placed(result, distance), attempts_m=math.sqrt(attempts_m ** 2 - timing_m ** 2),
                              timing_m=timing_m, word=distance.word)
        return DistanceBudget(result.number, distance.word, distance.distance_m or 0.0,
                              terms_of(measurement, self._carriage(result, distance.word), self._record))

    def _to_outline(self, progress: Progress) -> dict[tuple[int, str], float]:
        if not self._car.outline:
            return {}
        return {(result.number, distance.word): distance_to_polygon(
                    self._key(result, distance.word, distance_m if distance.key_m is None else distance.key_m),
                    self._car.outline)
                for result in progress.results for distance in result.distances
                if (distance_m := distance.distance_m) is not None}

    def _key(self, result: LineResult, word: str, distance_m: float) -> Point:
        """Return the position of the key in the Car coordinate system, including a recorded lateral offset from its
        line."""
        ray = self._rays[result.number]
        x, y = ray.point(distance_m)
        left_m = _recorded(result, word, "lateral_offset_m") or 0.0
        return x - left_m * ray.direction_y, y + left_m * ray.direction_x

    def guard_sigma(self, result: LineResult, word: str) -> float:
        """Return 1 sigma of all errors that repeated attempts do not show, in m."""
        distance = next(item for item in result.distances if item.word == word)
        terms = terms_of(self._placed(result, distance), self._carriage(result, word), self._record)
        return math.hypot(*(term.contribution_m for term in terms))

    def lasting_sigmas(self, result: LineResult, word: str) -> LastingSigmas:
        """Return the errors that a further test has, or may have, in common."""
        distance = next(item for item in result.distances if item.word == word)
        length_m, width_m = self._outline(result)
        ray = self._rays[result.number]
        sides = side_errors(ray, self._car)
        outline_m = math.hypot(length_m * ray.direction_x / 2.0, width_m * ray.direction_y / 2.0,
                               *(side.along_m for side in sides))
        record = terms_of(Measurement(0.0, 0.0, (0.0, 0.0)), self._carriage(result, word), self._record)
        in_place_m = 0.0 if sides else min(outline_m, _place_sigma(result, distance))
        return LastingSigmas(outline_m, in_place_m,
                             _recorded(result, word, "static_shared_sigma_m") or 0.0, distance.common_sigma_m or 0.0,
                             math.hypot(*(term.contribution_m for term in record)))

    def _unreached(self, result: LineResult, word: str) -> tuple[float | None, float | None]:
        return part(self._scenario, Judging).unreached(self._parameters, result, word)

    def _placed(self, result: LineResult, distance: MeasuredDistance) -> Measurement:
        """Return the uncertainty of position and time of the key, and of the outline, which lines of one side share."""
        sides = side_errors(self._rays[result.number], self._car)
        common_m = math.hypot(*(side.along_m for side in sides))
        place_m = math.sqrt(max(_place_sigma(result, distance) ** 2 - common_m ** 2, 0.0))
        return Measurement(place_m, 0.0, self._outline(result), sides=sides)

    def _outline(self, result: LineResult) -> tuple[float, float]:
        """Return the sigmas of the Car's size if the line begins on its outline and the sides' own sigmas are
        unknown."""
        if self._rays[result.number].begins_in_centre or self._car.knows_sides:
            return 0.0, 0.0
        return self._car.length_sigma, self._car.width_sigma

    def _carriage(self, result: LineResult, word: str) -> Carriage:
        ray: Ray = self._rays[result.number]
        heights_m = (_recorded(result, word, name) for name in _HEIGHTS)
        return Carriage((ray.direction_x, ray.direction_y),
                        next((height_m for height_m in heights_m if height_m is not None),
                             self._parameters.key_height_m),
                        math.radians(_recorded(result, word, "heading_offset_deg") or 0.0))


def _place_sigma(result: LineResult, distance: MeasuredDistance) -> float:
    """Return the sigma of the key's position at a measurement, including the Car's outline. Without sigmas of the sides
    the outline counts twice, which is conservative."""
    recorded_m = _recorded(result, distance.word, "uncertainty_m")
    return (distance.uncertainty_m or 0.0) if recorded_m is None else recorded_m


def _attempts_sigma(distance: MeasuredDistance) -> float:
    if distance.low_m is None or distance.high_m is None:
        return 0.0
    return (distance.high_m - distance.low_m) / (2.0 * SIGMAS_OF_LEVEL)


def _recorded(result: LineResult, word: str, name: str) -> float | None:
    """Return the value of a column for one of the distances; the name has its word as prefix if a line has several."""
    value = getattr(result, f"{word}_{name}", getattr(result, name, None))
    return value if isinstance(value, float) else None
