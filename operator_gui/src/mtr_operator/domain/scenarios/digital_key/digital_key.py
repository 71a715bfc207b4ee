"""The Digital key scenario: how far off a phone's own distance is, at places around the Car."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Sequence

from ...actions.car import Car
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...distance_feed import REPORTED
from ...forecast import Forecast
from ...interfaces.scenario_parts import Concluding, Forecasting, Judging, StartChecks
from ...ports import LockFacts
from ...results.document import Texts
from ...results.line_result import LineStatus
from ...results.picture import Picture
from ...results.quantity import Quantity
from ...robot_status import CarDimensions
from ...scenario import Scenario
from ...verdict.requirement import AT_MOST_ERROR_M
from .constant import beside_others, revised
from .error_map import picture_of
from .parameters import DigitalKeyParameters
from .place_result import place_result, stood_at
from .places import MapPlace, places_around
from .reading import read
from .result import PHONE, PHONE_ERROR, DigitalKeyResult
from .summary import summary_of

# Of each way beside its length by the speed: turning, speeding up, slowing down; as Zone map's.
_MOVE_S = 3.0
_MOVED = "The robot moved while the phone's distance was read."


class DigitalKey(Scenario[DigitalKeyParameters, MapPlace, DigitalKeyResult],
                 StartChecks, Concluding, Judging, Forecasting):
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
        """Something has to tell the phone's distance."""
        car.require_phone()

    def measure(self, line: MapPlace, parameters: DigitalKeyParameters, robot: Robot, car: Car) -> DigitalKeyResult:
        """Stand there and read."""
        robot.say(f"position {line.number} ({line.side.replace('_', ' ')}, {line.distance_m:.2f} m)")
        try:
            car.wait_for_phone()
            start_s, end_s = _stand(line, parameters, robot, car)
            made = robot.key_distance(line.ray, (start_s + end_s) / 2.0, 0.0)
            stood = stood_at(line, made, parameters, car.dimensions(),
                             lambda ray, time_s, origin: robot.key_distance(ray, time_s, 0.0, origin))
        except LineInvalid as error:
            return _unmeasured(line, parameters, str(error), error.evidence)
        reading = read(car.reported, (start_s, end_s), parameters)
        result = beside_others(place_result(line, reading, stood),
                               [each for each in robot.results if isinstance(each, DigitalKeyResult)])
        robot.keep(PHONE, result.status, made)
        return result

    def concluded(self, parameters: DigitalKeyParameters,
                  results: Sequence[DigitalKeyResult]) -> Sequence[DigitalKeyResult]:
        """A figure that never changes tells nothing of its first places either."""
        return revised(results)

    def judged_quantities(self, parameters: DigitalKeyParameters) -> tuple[Quantity, ...]:
        """An error within a step of the figures is none that they show."""
        return (Quantity(PHONE_ERROR, (AT_MOST_ERROR_M,), parameters.resolution_m, REPORTED.high),)

    def picture(self, parameters: DigitalKeyParameters, car: CarDimensions,
                results: Sequence[DigitalKeyResult]) -> Picture:
        """See picture_of."""
        return picture_of(parameters, car, results)

    def summary(self, results: Sequence[DigitalKeyResult]) -> Sequence[tuple[str, str]]:
        """See summary_of."""
        return summary_of(results)

    def forecast(self, parameters: DigitalKeyParameters, facts: LockFacts,
                 results: Sequence[DigitalKeyResult]) -> Forecast | None:
        """Each place takes the same."""
        each_s = self.expected_line_s(parameters)
        return Forecast((1, 1), None, (each_s, each_s), None)

    def expected_line_s(self, parameters: DigitalKeyParameters) -> float:
        """With the way from the neighbour."""
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


SCENARIO = DigitalKey()
