"""The Relay resistance scenario: whether an extender has the Car unlock although its key is outside the zone."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Sequence

from ...actions.car import Car
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...geometry.axes import axes_around
from ...geometry.pose import Point
from ...geometry.ray import Ray
from ...interfaces.scenario_parts import Forecasting, Judging, Resuming, StartChecks
from ...results.figure import figure_of
from ...results.line_result import LineStatus
from ...results.picture import Picture, PointRole, PointSet, Stretch
from ...results.quantity import Quantity
from ...robot_status import CarDimensions
from ...scenario import Scenario
from ...supervision.announcements import HANDLES
from ...verdict.requirement import AT_MOST_PERCENT
from ..handle.fields import ALL_SIDES
from .axis_trial import RelayTrial, has_kept
from .parameters import RelayResistanceParameters
from .result import RELAY, RELAY_PROBABILITY, RelayResistanceResult, valid_columns
from .tally import DIGITS, tally_columns, upper_bound


@dataclass(frozen=True)
class RelayAxis:
    """One axis; number counts from 1."""

    number: int
    side: str
    ray: Ray


class RelayResistance(Scenario[RelayResistanceParameters, RelayAxis, RelayResistanceResult],
                      StartChecks, Resuming, Judging, Forecasting):
    """Have the handle taken with the key beyond the zone, first with an extender switched off, then on, and bound how
    often the Car unlocks."""

    name = "relay_resistance"
    title = "Relay resistance"
    line_word = "axis"
    parameters_type = RelayResistanceParameters
    result_type = RelayResistanceResult
    distance_words = (RELAY,)
    announcement = HANDLES

    def lines(self, parameters: RelayResistanceParameters, car: CarDimensions) -> list[RelayAxis]:
        """Those of the side, or of all."""
        axes = [axis for axis in axes_around(car, parameters.measurements_distance_m)
                if parameters.side in (ALL_SIDES, axis.side)]
        return [RelayAxis(number, axis.side, axis.ray) for number, axis in enumerate(axes, start=1)]

    def check_means(self, car: Car) -> None:
        car.require_extender()

    def measure(self, line: RelayAxis, parameters: RelayResistanceParameters, robot: Robot,
                car: Car) -> RelayResistanceResult:
        """All places with the extender off, then with it on, between proofs that the Car hears its key."""
        trial = RelayTrial(line.ray, parameters, robot, car)
        robot.say(f"axis {line.number} ({line.side.replace('_', ' ')}): go to the start")
        try:
            robot.move_key_to(parameters.key_height_m)
            trial.measure()
        except LineInvalid as error:
            return replace(_result(line, parameters, trial), reason=str(error), evidence=error.evidence)
        return replace(_result(line, parameters, trial), **valid_columns(trial.tried, trial.farthest))

    def can_go_on(self, line: RelayAxis, parameters: RelayResistanceParameters, robot: Robot, car: Car) -> bool:
        """The axis goes on with the requests that are kept."""
        return not robot.trouble() and has_kept(robot)

    def unreached(self, parameters: RelayResistanceParameters, result: RelayResistanceResult,
                  word: str) -> tuple[float | None, float | None]:
        """Requests without an unlock bound a probability, and no distance."""
        return None, None

    def judged_quantities(self, parameters: RelayResistanceParameters) -> tuple[Quantity, ...]:
        """So many requests without an unlock bound the probability at best by this."""
        requests = len(parameters.tried_places_m) * parameters.requests_per_place
        return (Quantity(RELAY_PROBABILITY, (AT_MOST_PERCENT,), 100.0 * upper_bound(0, requests), 100.0),)

    def picture(self, parameters: RelayResistanceParameters, car: CarDimensions,
                results: Sequence[RelayResistanceResult]) -> Picture:
        """Every unlock, and where the Car stayed locked in spite of the extender."""
        rays = {line.number: line.ray for line in self.lines(parameters, car)}
        near_m, far_m = parameters.border_distance_m, parameters.maximum_distance_m
        stretches = tuple(Stretch(rays[result.number].point(near_m), rays[result.number].point(far_m),
                                  str(result.number)) for result in results)
        farthest = [(rays[result.number], result.distances[0]) for result in results if result.distance_m is not None]

        def points(*names: str) -> tuple[Point, ...]:
            return tuple(rays[result.number].point(place_m) for result in results for name in names
                         for place_m in getattr(result, name))

        invalid = tuple(rays[result.number].point(far_m) for result in results if result.status is LineStatus.INVALID)
        return Picture(stretches, (
            PointSet("Farthest unlock, extender on", PointRole.FIRST,
                     tuple(ray.point(distance.distance_m or 0.0) for ray, distance in farthest),
                     figures=tuple(figure_of(distance) for _, distance in farthest)),
            PointSet("Unlocked beyond the border", PointRole.SECOND, points("unlocked_off_m", "unlocked_on_m")),
            PointSet("Stayed locked, extender on", PointRole.FAILED, points("silent_on_m")),
            PointSet("Invalid", PointRole.INVALID, invalid)))

    def expected_line_s(self, parameters: RelayResistanceParameters) -> float:
        """Of a Car that stays locked."""
        requests = 2 * len(parameters.tried_places_m) * parameters.requests_per_place
        ways_m = 4.0 * (parameters.maximum_distance_m - parameters.minimum_distance_m)
        return (requests * (parameters.settle_time_s + parameters.response_timeout_s)
                + ways_m / parameters.maximum_speed_mps)


def _result(line: RelayAxis, parameters: RelayResistanceParameters, trial: RelayTrial) -> RelayResistanceResult:
    """The requests alone, as an invalid axis has them."""
    return RelayResistanceResult(
        line.number, line.side, round(parameters.key_height_m, DIGITS), LineStatus.INVALID,
        border_m=parameters.border_distance_m, **tally_columns(trial.tried), requested_by=trial.requested_by,
        switched_by=trial.switched_by)


SCENARIO = RelayResistance()
