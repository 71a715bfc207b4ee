"""The Digital key scenario: how far off a phone's own distance is, at places around the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Sequence

from ... import limits
from ...actions.car import Car
from ...actions.distance import Distance
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...estimation.interval import SIGMAS_OF_LEVEL
from ...ports import LockFacts
from ...prospect import Prospect
from ...results.document import Texts
from ...results.line_result import LineStatus
from ...results.picture import Picture
from ...robot_status import CarDimensions
from ...scenario import Scenario
from .constant import as_constant, is_constant_with, revised
from .error_map import picture_of
from .parameters import DigitalKeyParameters
from .places import MapPlace, key_point, places_around, reference_of
from .reading import Answer, Reading, read
from .result import MAX_FIGURES, PHONE, DigitalKeyResult
from .summary import summary_of

# Of each way beside its length by the speed: turning, speeding up, slowing down; as Zone map's.
_MOVE_S = 3.0
_MOVED = "The robot moved while the phone's distance was read."


@dataclass(frozen=True)
class _Stood:
    """Where the phone was, on its radial and from the reference; car_point: in the Car coordinate system."""

    made: Distance
    reference: Distance
    car_point: tuple[float, float]


class DigitalKey(Scenario[DigitalKeyParameters, MapPlace, DigitalKeyResult]):
    """Carry the phone to places around the Car, read there the distance that phone or Car tells, and map its error."""

    name = "digital_key"
    title = "Digital key"
    line_word = "position"
    parameters_type = DigitalKeyParameters
    result_type = DigitalKeyResult
    distance_words = (PHONE,)

    def lines(self, parameters: DigitalKeyParameters, car: CarDimensions) -> list[MapPlace]:
        """See places_around."""
        return places_around(parameters, car)

    def check_means(self, car: Car) -> None:
        """See Scenario: something has to tell the phone's distance."""
        car.require_phone()

    def measure(self, line: MapPlace, parameters: DigitalKeyParameters, robot: Robot, car: Car) -> DigitalKeyResult:
        """Stand there and read."""
        robot.say(f"position {line.number} ({line.side.replace('_', ' ')}, {line.distance_m:.2f} m)")
        try:
            car.wait_for_phone()
            start_s, end_s = _stand(line, parameters, robot, car)
            made = robot.key_distance(line.ray, (start_s + end_s) / 2.0, 0.0)
            reference = reference_of(made, line.ray, parameters, car.dimensions(), robot)
        except LineInvalid as error:
            return _unmeasured(line, parameters, str(error), error.evidence)
        reading = read(car.reported, (start_s, end_s), parameters)
        result = _result(line, reading, _Stood(made, reference, key_point(line.ray, made)))
        earlier = [each for each in robot.results
                   if isinstance(each, DigitalKeyResult) and each.number != line.number]
        reason = is_constant_with(result, earlier) if result.status is LineStatus.OK else ""
        result = as_constant(result, reason) if reason else result
        robot.keep(PHONE, result.status, made)
        return result

    def concluded(self, parameters: DigitalKeyParameters,
                  results: Sequence[DigitalKeyResult]) -> Sequence[DigitalKeyResult]:
        """See Scenario: a figure that never changes tells nothing of its first places either."""
        return revised(results)

    def picture(self, parameters: DigitalKeyParameters, car: CarDimensions,
                results: Sequence[DigitalKeyResult]) -> Picture:
        """See picture_of."""
        return picture_of(parameters, car, results)

    def summary(self, results: Sequence[DigitalKeyResult]) -> Sequence[tuple[str, str]]:
        """See summary_of."""
        return summary_of(results)

    def prospect(self, parameters: DigitalKeyParameters, facts: LockFacts,
                 results: Sequence[DigitalKeyResult]) -> Prospect | None:
        """See Scenario: each place takes the same."""
        each_s = self.expected_line_s(parameters)
        return Prospect((1, 1), None, (each_s, each_s), None)

    def expected_line_s(self, parameters: DigitalKeyParameters) -> float:
        """See Scenario: with the way from the neighbour."""
        return (parameters.spacing_m / parameters.maximum_speed_mps + _MOVE_S + parameters.stand_time_s
                + parameters.reading_time_s)


def _stand(line: MapPlace, parameters: DigitalKeyParameters, robot: Robot, car: Car) -> tuple[float, float]:
    """Robot times between which the robot stood at the place; what the Car's locks do there is no matter."""
    robot.go_to(line.ray, line.distance_m)
    robot.wait_until_reached()
    robot.wait(parameters.stand_time_s)
    with robot.watched(parameters, judges_locks=False) as watch:
        watch.ray = line.ray
        start_s = robot.now_s
        robot.wait(parameters.reading_time_s)
        if robot.rest_s < robot.now_s - start_s:
            raise LineInvalid(_MOVED)
        if car.phone_problem:
            raise LineInvalid(car.phone_problem)
    return start_s, robot.now_s


def _unmeasured(line: MapPlace, parameters: DigitalKeyParameters, reason: str, evidence: Texts) -> DigitalKeyResult:
    return DigitalKeyResult(line.number, line.side, line.distance_m, parameters.key_height_m, LineStatus.INVALID,
                            reason=reason, evidence=evidence)


def _result(line: MapPlace, reading: Reading, stood: _Stood) -> DigitalKeyResult:
    made, reference, median = stood.made, stood.reference, reading.median
    figures_m = tuple(round(figure_m, 6) for figure_m in reading.figures_m)
    result = DigitalKeyResult(
        line.number, line.side, line.distance_m, _rounded(made.key_height_m), LineStatus.INVALID,
        answer=reading.answer.value, samples=len(figures_m),
        age_s=None if reading.age_s is None else _rounded(reading.age_s), reference_m=_rounded(reference.distance_m),
        robot_time_s=_rounded(made.robot_time_s), x_m=_rounded(stood.car_point[0]), y_m=_rounded(stood.car_point[1]),
        along_m=_rounded(made.distance_m), lateral_offset_m=_rounded(made.lateral_m),
        heading_offset_deg=_rounded(math.degrees(made.heading_rad)), reason=reading.reason,
        figures_m=figures_m[::-(-len(figures_m) // MAX_FIGURES) or 1])
    if median is None:
        return result
    result = replace(result, reported_m=_rounded(median.value_m), reported_spread_m=_rounded(median.spread_m),
                     reported_sigma_m=_rounded(median.sigma_m))
    if math.isnan(reference.uncertainty_m):
        return replace(result, reason=reading.reason or "The robot does not say how sure it is of its position.",
                       answer=Answer.NOT_MEASURED.value if reading.answer is Answer.DISTANCE else result.answer)
    result = replace(result, uncertainty_m=_rounded(reference.uncertainty_m))
    if reading.answer is not Answer.DISTANCE:
        return result
    error_m = median.value_m - reference.distance_m
    reach_m = SIGMAS_OF_LEVEL * math.hypot(median.sigma_m, reference.uncertainty_m)
    if not (limits.DISTANCE.allows(error_m - reach_m) and limits.DISTANCE.allows(error_m + reach_m)):
        return replace(result, answer=Answer.NONE.value, reason=f"The phone's distance, {median.value_m:.1f} m, is off "
                                                                f"by {abs(error_m):.1f} m; that is none.")
    return replace(result, status=LineStatus.OK, error_m=_rounded(error_m), error_low_m=_rounded(error_m - reach_m),
                   error_high_m=_rounded(error_m + reach_m))


def _rounded(value: float) -> float:
    return round(value, 6)


SCENARIO = DigitalKey()
