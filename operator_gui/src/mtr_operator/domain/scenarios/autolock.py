"""The Autolock scenario: where a Car unlocks when the Remote key comes near, and locks when it goes away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, Generator, Sequence

from ..actions.car import Car
from ..actions.distance import Distance, recorded_values
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid, LineLeft, LineStopped
from ..estimation.passes.delay import has_two_speeds
from ..forecast import Forecast
from ..geometry.axes import Axis, axes_around
from ..geometry.ray import Ray
from ..interfaces.scenario_parts import Concluding, Forecasting, FurtherAttempts, Judging, Resuming, StartChecks
from ..ports import LockFacts
from ..results.carried import carried_values
from ..results.line_result import LineStatus, MeasuredDistance
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along, intervals_along
from ..robot_status import CarDimensions
from ..scenario import Scenario
from ..supervision.announcements import LOCKS
from .autolock_boundary import with_boundaries
from .autolock_parameters import AutolockParameters
from .autolock_pass import AxisPass, Course, Measured
from .autolock_result import LOCK, UNLOCK, AutolockResult
from .autolock_resume import can_go_on
from .autolock_speeds import FURTHER_M, TURNING_S, USUAL_CYCLE_S, pass_forecast, pass_speeds, speed_cautions

# A line that nobody can decide ends some time.
# Of a pass that is not in steps: the least that its column tells from 0.
_LEAST_SPEED_MPS = 1e-6
_MAX_PASSES = 16


class Autolock(Scenario[AutolockParameters, Axis, AutolockResult],
               StartChecks, Resuming, FurtherAttempts, Concluding, Judging, Forecasting):
    """Approach until the Car unlocks, retreat backwards until it locks, on every axis."""

    name = "autolock"
    title = "Autolock"
    line_word = "axis"
    parameters_type = AutolockParameters
    result_type = AutolockResult
    distance_words = (UNLOCK, LOCK)
    announcement = LOCKS

    def lines(self, parameters: AutolockParameters, car: CarDimensions) -> list[Axis]:
        """All axes of all sides and corners."""
        return axes_around(car, parameters.measurements_distance_m)

    def measure(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> AutolockResult:
        """The thesis' algorithm 2 for one axis, and further passes at other speeds."""
        result = self.drive(line, parameters, robot, car)
        others = [each for each in robot.results if isinstance(each, AutolockResult) and each.axis != line.number]
        return with_boundaries([*others, result], parameters, [result])[0]

    def drive(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> AutolockResult:
        """The same without the static boundary, which takes longer than all else; concluded() gives it."""
        first, *further = planned_passes(parameters, car.facts.told_every_s)
        course, done, trouble = Course(line, parameters, robot, car), [first], None
        try:
            course.measure(first)
            if first.is_complete:
                done += _further(course, first, further, robot)
        except LineInvalid as error:
            trouble = error
            if first.unlock.time_s >= error.since_s:
                first.unlock = Measured()
        return _result(line, done, trouble, car.facts.told_every_s)

    def concluded(self, parameters: AutolockParameters, results: Sequence[AutolockResult]) -> list[AutolockResult]:
        """What all axes say of the Car's reaction time moves the boundary of each."""
        revised = with_boundaries(results, parameters, results)
        return [new for new, old in zip(revised, results) if new != old]

    def measure_further(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car,
                        so_far: AutolockResult) -> AutolockResult | None:
        """One more pass, at the slowest speed."""
        speeds_mps, count = pass_speeds(parameters, car.facts.told_every_s), len(so_far.passes(UNLOCK))
        if so_far.lock_distance_m is None or count >= _MAX_PASSES or not self.judged_shares(parameters):
            return None
        more = _further(Course(line, parameters, robot, car), _first_of(so_far, speeds_mps[0]),
                        [AxisPass(count + 1, min(speeds_mps))], robot)
        if not more:
            return None
        added = {**_pass_columns(UNLOCK, [(more[0].unlock, None)]), **_pass_columns(LOCK, [(more[0].lock, None)])}
        result = replace(so_far, **{name: getattr(so_far, name) + values for name, values in added.items()})
        return with_boundaries([each if each.number != line.number else result for each in robot.results
                                if isinstance(each, AutolockResult)], parameters, [result])[0]

    def share_of_most(self, parameters: AutolockParameters, result: AutolockResult) -> float | None:
        can_be_more = result.lock_distance_m is not None and bool(self.judged_shares(parameters))
        return len(result.passes(UNLOCK)) / _MAX_PASSES if can_be_more else None

    def looked(self, parameters: AutolockParameters, results: Sequence[AutolockResult],
               number: int) -> Generator[None, None, AutolockResult]:
        yield
        return with_boundaries(results, parameters, [each for each in results if each.number == number])[0]

    def judged_shares(self, parameters: AutolockParameters) -> tuple[int, ...]:
        """At the static boundary half of the polls notice the key; one speed does not tell it."""
        has_boundary = parameters.last_step_m is not None or has_two_speeds(pass_speeds(parameters, USUAL_CYCLE_S))
        return (50,) if has_boundary else ()

    def cautions(self, parameters: AutolockParameters, facts: LockFacts) -> Sequence[str]:
        return tuple(speed_cautions(parameters, facts.told_every_s))

    def can_go_on(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> bool:
        return can_go_on(line.ray, parameters, robot, car)

    def forecast(self, parameters: AutolockParameters, facts: LockFacts,
                 results: Sequence[AutolockResult]) -> Forecast:
        """The axes measured so far know the static boundary best."""
        return pass_forecast(parameters, facts.told_every_s, self.expected_line_s(parameters), results)

    def unreached(self, parameters: AutolockParameters, result: AutolockResult,
                  word: str) -> tuple[float | None, float | None]:
        """The approach ends near the Car, the retreat far from it; a Car that never unlocked could not
        lock, wherever that is."""
        if word != LOCK:
            return super().unreached(parameters, result, word)
        return (parameters.straightened_distance_m if result.unlock_status is LineStatus.OK else None), None

    def measurand(self, parameters: AutolockParameters, result: AutolockResult, word: str) -> str:
        """Without a static boundary it is where the Car reacted to the first pass, at its speed."""
        if getattr(result, f"{word}_static_m") is not None:
            return ""
        cycle_s = USUAL_CYCLE_S if result.told_every_s is None else result.told_every_s
        return f"event at {pass_speeds(parameters, cycle_s)[0]:.2f} m/s"

    def picture(self, parameters: AutolockParameters, car: CarDimensions, results: Sequence[AutolockResult]) -> Picture:
        """Axes, and the two areas that the points enclose."""
        stretches = [Stretch(result.ray.point(parameters.minimum_distance_m),
                             result.ray.point(parameters.maximum_distance_m), str(result.axis)) for result in results]
        unlocks, locks = ([(result.ray, result.distances[index]) for result in results] for index in (0, 1))
        invalid = tuple(result.ray.point(parameters.straightened_distance_m) for result in results
                        if result.invalid_count)
        return Picture(tuple(stretches), (
            _area("Unlocked", PointRole.FIRST, unlocks),
            _area("Locked", PointRole.SECOND, locks),
            _not_reached("Unlock not reached", PointRole.FIRST_FAILED, unlocks, parameters.minimum_distance_m),
            _not_reached("Lock not reached", PointRole.SECOND_FAILED, locks, parameters.straightened_distance_m),
            PointSet("Invalid", PointRole.INVALID, invalid)))

    def expected_line_s(self, parameters: AutolockParameters) -> float:
        """The Car is taken to unlock half way between the straightening's end and the minimum."""
        straight_m = parameters.straightened_distance_m - parameters.minimum_distance_m
        first_mps, *others_mps = (each.speed_mps for each in planned_passes(parameters, USUAL_CYCLE_S))
        return (parameters.straightening_distance_m / parameters.maximum_speed_mps + straight_m / first_mps
                + sum(TURNING_S + FURTHER_M / speed_mps for speed_mps in others_mps))


def planned_passes(parameters: AutolockParameters, cycle_s: float) -> list[AxisPass]:
    """Passes of each axis, not yet measured; one in steps is the last, and retreats as slowly as the slowest."""
    speeds_mps = pass_speeds(parameters, cycle_s)
    passes = [AxisPass(number, speed_mps) for number, speed_mps in enumerate(speeds_mps, 1)]
    if parameters.last_step_m is not None:
        passes.append(AxisPass(len(passes) + 1, min(speeds_mps), parameters.last_step_m))
    return passes


def _first_of(result: AutolockResult, speed_mps: float) -> AxisPass:
    """The first pass as far as one more has to know it: where the Car reacted."""
    unlock, lock = (None if distance_m is None else Distance(distance_m, math.nan, -math.inf)
                    for distance_m in (result.unlock_distance_m, result.lock_distance_m))
    return AxisPass(1, speed_mps, None, Measured(LineStatus.OK, unlock, -math.inf),
                    Measured(LineStatus.OK, lock, -math.inf))


def _further(course: Course, first: AxisPass, passes: Sequence[AxisPass], robot: Robot) -> list[AxisPass]:
    """Those that came to their end: each is tried twice, and one that fails takes nothing from the others but what it
    makes doubtful; LineInvalid when that is the first pass."""
    done: list[AxisPass] = []
    for this in passes:
        for planned in (this, AxisPass(this.number, this.speed_mps, this.step_m)):
            try:
                course.measure(planned, first)
            except LineStopped:
                first.lock = Measured()
                raise
            except LineLeft:
                # What is measured counts.
                return done
            except LineInvalid as error:
                if first.lock.time_s >= error.since_s:
                    first.lock = Measured()
                    raise
                done = [each for each in done if each.lock.time_s < error.since_s]
                robot.say(f"warning: pass {planned.number} of this axis was not measured. {error}")
                if course.is_frame_left:
                    return done
            else:
                done.append(planned)
                break
    return done


def _result(line: Axis, passes: Sequence[AxisPass], trouble: LineInvalid | None, cycle_s: float) -> AutolockResult:
    axis, first = line.ray, passes[0]
    return AutolockResult(line.number, line.side, axis.origin_x, axis.origin_y, axis.direction_x, axis.direction_y,
                          reason=str(trouble or ""), evidence=trouble.evidence if trouble else (),
                          told_every_s=cycle_s, **_columns(UNLOCK, first.unlock), **_columns(LOCK, first.lock),
                          **_pass_columns(UNLOCK, [(each.unlock, each.step_m) for each in passes]),
                          **_pass_columns(LOCK, [(each.lock, None) for each in passes]))


def _columns(word: str, measured: Measured) -> dict[str, Any]:
    distance_m, uncertainty_m, robot_time_s = recorded_values(measured.distance)
    return {f"{word}_status": measured.status, f"{word}_distance_m": distance_m,
            f"{word}_uncertainty_m": uncertainty_m, f"{word}_robot_time_s": robot_time_s,
            **carried_values(f"{word}_", measured.distance)}


def _pass_columns(word: str, passes: Sequence[tuple[Measured, float | None]]) -> dict[str, Any]:
    """Of a pass in steps the speed is 0: the key stood. Of another one it is not, though the key may have stood too."""
    known = [(each.distance, step_m) for each, step_m in passes if each.distance is not None]
    return {f"{word}_pass_distances_m": tuple(round(distance.distance_m, 6) for distance, _ in known),
            f"{word}_pass_speeds_mps": tuple(0.0 if step_m else max(round(abs(distance.speed_mps), 6), _LEAST_SPEED_MPS)
                                             for distance, step_m in known)}


def _area(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]]) -> PointSet:
    points = tuple(None if distance.distance_m is None or distance.status is not LineStatus.OK
                   else ray.point(distance.distance_m) for ray, distance in measured)
    return PointSet(label, role, points, is_outline=True, bars=bars_along(measured),
                    intervals=intervals_along(measured))


def _not_reached(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]],
                 distance_m: float) -> PointSet:
    return PointSet(label, role, tuple(ray.point(distance_m) for ray, distance in measured
                                       if distance.status is LineStatus.NOT_REACHED))


SCENARIO = Autolock()
