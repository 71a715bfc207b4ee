"""The Sleep time scenario: for how long a key that is held still answers when the Car's handle is taken."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import statistics
from dataclasses import dataclass, replace
from typing import Sequence

from ...actions.car import Car
from ...actions.distance import recorded_values
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...forecast import Forecast
from ...geometry.axes import axes_around
from ...geometry.ray import Ray
from ...interfaces.scenario_parts import Forecasting, Judging, Resuming
from ...ports import LockFacts
from ...results.carried import carried_values
from ...results.figure import figure_of
from ...results.line_result import LineStatus
from ...results.picture import Picture, PointRole, PointSet, Stretch
from ...results.quantity import Quantity
from ...robot_status import CarDimensions
from ...scenario import Scenario
from ...supervision.announcements import HANDLES
from ...verdict.requirement import AT_LEAST_S, AT_MOST_S
from .parameters import SleepTimeParameters
from .result import HELD, SLEEP_TIME, SleepTimeResult, rest_columns
from .still_trial import StillKey, has_kept
from .waits import WaitSearch, WaitTrial, tried

# A side has no axis but that of its middle.
_ONE_AXIS_M = 1e3
_DIGITS = 6
# Columns of the newest answer.
_OF_ANSWER = ("cause", "key_number", "doors")
# From a request until an unlock is read and believed, and the press that locks the Car again.
_ANSWER_S, _LOCKED_S = 0.4, 1.5
# Sleep times of a forecast, in parts of the longest rest; the last key never sleeps.
_PARTS = (0.01, 0.03, 0.1, 0.3, 0.9, 2.0)


@dataclass(frozen=True)
class HeldPlace:
    """Where the key is held; number is 1."""

    number: int
    side: str
    ray: Ray


class SleepTime(Scenario[SleepTimeParameters, HeldPlace, SleepTimeResult], Resuming, Judging, Forecasting):
    """Hold the key still near the Car, have the handle taken after ever longer rests, and find after which the key no
    longer answers."""

    name = "sleep_time"
    title = "Sleep time"
    line_word = "axis"
    parameters_type = SleepTimeParameters
    result_type = SleepTimeResult
    distance_words = (HELD,)
    announcement = HANDLES

    def lines(self, parameters: SleepTimeParameters, car: CarDimensions) -> list[HeldPlace]:
        """The middle of the side."""
        axis = next(axis for axis in axes_around(car, _ONE_AXIS_M) if axis.side == parameters.side)
        return [HeldPlace(1, axis.side, axis.ray)]

    def measure(self, line: HeldPlace, parameters: SleepTimeParameters, robot: Robot, car: Car) -> SleepTimeResult:
        """Longer and longer rests until the key is silent, then between the last answer and the first silence."""
        key = StillKey(line.ray, parameters, robot, car, WaitSearch(parameters.wait_plan))
        robot.say(f"axis {line.number} ({line.side.replace('_', ' ')}): go to the start")
        try:
            robot.move_key_to(parameters.key_height_m)
            key.recall()
            key.measure()
        except LineInvalid as error:
            return replace(_result(line, parameters, key), reason=str(error), evidence=error.evidence)
        distance_m, uncertainty_m, robot_time_s = recorded_values(key.place)
        carried = {name: value for name, value in carried_values("", key.answer).items() if name in _OF_ANSWER}
        return replace(_result(line, parameters, key), status=LineStatus.OK, distance_m=distance_m,
                       uncertainty_m=uncertainty_m, robot_time_s=robot_time_s, **carried)

    def can_go_on(self, line: HeldPlace, parameters: SleepTimeParameters, robot: Robot, car: Car) -> bool:
        """The search goes on with the trials that are kept."""
        return not robot.trouble() and has_kept(robot)

    def judged_quantities(self, parameters: SleepTimeParameters) -> tuple[Quantity, ...]:
        """Between the shortest and the longest rest that is tried."""
        return (Quantity(SLEEP_TIME, (AT_LEAST_S, AT_MOST_S), parameters.shortest_wait_s, parameters.longest_wait_s),)

    def picture(self, parameters: SleepTimeParameters, car: CarDimensions,
                results: Sequence[SleepTimeResult]) -> Picture:
        """Where the key was held."""
        rays = {line.number: line.ray for line in self.lines(parameters, car)}
        held = [(rays[result.number], result.distances[0]) for result in results]
        known = [(ray, distance) for ray, distance in held if distance.distance_m is not None]
        invalid = tuple(rays[result.number].point(parameters.minimum_distance_m) for result in results
                        if result.status is LineStatus.INVALID)
        stretches = tuple(Stretch(rays[result.number].point(parameters.minimum_distance_m),
                                  rays[result.number].point(parameters.maximum_distance_m), str(result.number))
                          for result in results)
        return Picture(stretches, (
            PointSet("Held still", PointRole.FIRST, tuple(ray.point(distance.distance_m or 0.0)
                                                          for ray, distance in known),
                     figures=tuple(figure_of(distance) for _, distance in known)),
            PointSet("Invalid", PointRole.INVALID, invalid)))

    def forecast(self, parameters: SleepTimeParameters, facts: LockFacts,
                 results: Sequence[SleepTimeResult]) -> Forecast:
        """Of keys that sleep soon, late or never."""
        tests = [tried(parameters.wait_plan, part * parameters.longest_wait_s) for part in _PARTS]
        counts, seconds = [len(trials) for trials in tests], [_seconds(parameters, trials) for trials in tests]
        return Forecast((min(counts), max(counts)), None, (min(seconds), max(seconds)))

    def expected_line_s(self, parameters: SleepTimeParameters) -> float:
        return statistics.fmean(self.forecast(parameters, LockFacts(), ()).line_s)


def _result(line: HeldPlace, parameters: SleepTimeParameters, key: StillKey) -> SleepTimeResult:
    """The trials alone, as an invalid line has them."""
    return SleepTimeResult(
        line.number, line.side, round(parameters.key_height_m, _DIGITS), LineStatus.INVALID, **rest_columns(key.search),
        disturbed=key.disturbed, requested_by=key.requested_by)


def _seconds(parameters: SleepTimeParameters, trials: Sequence[WaitTrial]) -> float:
    """Robot time of trials, with the motions that wake the key: one for each, one more for each silence."""
    move_s = 2.0 * parameters.wake_move_m / parameters.maximum_speed_mps + parameters.settle_time_s
    return sum(trial.rest_s + move_s + _ANSWER_S + _LOCKED_S + (not trial.answered) * (
        move_s + parameters.response_timeout_s) for trial in trials)


SCENARIO = SleepTime()
