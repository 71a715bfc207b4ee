"""The Autolock scenario: where a Car unlocks when the Remote key comes near, and locks when it goes away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Callable, Sequence

from ..actions.car import Car
from ..actions.distance import Distance, outline_sigma, recorded_values
from ..actions.line_watch import LineWatch
from ..actions.lock_history import Expected
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..geometry.axes import Axis, axes_around
from ..geometry.ray import Ray
from ..ports import PASSIVE_ENTRY, CarEvent, LockState
from ..requests import Direction
from ..results.carried import carried_values
from ..results.line_result import LineStatus, MeasuredDistance
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along
from ..robot_status import CarDimensions
from ..scenario import Scenario
from .autolock_parameters import AutolockParameters
from .autolock_result import LOCK, UNLOCK, AutolockResult
from .autolock_resume import can_go_on, come_back

_VICINITY = "the Remote key's vicinity"


@dataclass
class _Measured:
    """One of the two measurements on an axis; time_s: robot time from which on it holds."""

    status: LineStatus = LineStatus.INVALID
    distance: Distance | None = None
    time_s: float = math.inf


class Autolock(Scenario[AutolockParameters, Axis, AutolockResult]):
    """Approach until the Car unlocks, retreat backwards until it locks, on every axis."""

    name = "autolock"
    title = "Autolock"
    line_word = "axis"
    parameters_type = AutolockParameters
    result_type = AutolockResult
    distance_words = (UNLOCK, LOCK)

    def lines(self, parameters: AutolockParameters, car: CarDimensions) -> list[Axis]:
        """All axes of all sides and corners."""
        return axes_around(car, parameters.measurements_distance_m)

    def measure(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> AutolockResult:
        """The thesis' algorithm 2 for one axis."""
        unlock, lock = _Measured(), _Measured()
        trouble: LineInvalid | None = None
        axis, origin_sigma_m = line.ray, outline_sigma(line.ray, car.dimensions())

        def place_of(event: CarEvent) -> Distance:
            return robot.key_distance(axis, event.time_s, event.time_sigma_s, origin_sigma_m)

        _take_up(unlock, robot.kept(UNLOCK))
        _take_up(lock, robot.kept(LOCK))
        try:
            if unlock.distance is None:
                _go_to_start(line, parameters, robot, car)
            with robot.watched(parameters) as watch:
                if unlock.distance is None:
                    _approach(axis, watch, parameters, robot)
                    _record(unlock, watch, parameters, place_of)
                    robot.keep(UNLOCK, unlock.status, unlock.distance)
                elif lock.distance is None:
                    come_back(axis, unlock.distance, robot)
                if lock.distance is None:
                    _retreat(axis, watch, parameters, robot, is_unlocked=unlock.distance is not None)
                    _record(lock, watch, parameters, place_of)
                    robot.keep(LOCK, lock.status, lock.distance)
        except LineInvalid as error:
            trouble = error
            if unlock.time_s >= error.since_s:
                unlock = _Measured()
        return _result(line, unlock, lock, trouble)

    def can_go_on(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> bool:
        """See Scenario."""
        return can_go_on(line.ray, parameters, robot, car)

    def unreached(self, parameters: AutolockParameters, word: str) -> tuple[float | None, float | None]:
        """See Scenario: the approach ends near the Car, the retreat far from it."""
        return (parameters.straightened_distance_m, None) if word == LOCK else super().unreached(parameters, word)

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
        """See Scenario: the Car is taken to unlock half way between the straightening's end and the minimum."""
        straight_m = parameters.straightened_distance_m - parameters.minimum_distance_m
        return (parameters.straightening_distance_m / parameters.maximum_speed_mps
                + straight_m / parameters.speed_on_axis_mps)


def _go_to_start(line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> None:
    robot.say(f"axis {line.number} ({line.side.replace('_', ' ')}): go to the start")
    robot.set_maximum_speed(parameters.maximum_speed_mps)
    robot.go_to(line.ray, parameters.maximum_distance_m)
    robot.wait_until_reached()
    robot.wait(parameters.lock_timeout_s, or_when=lambda: car.is_locked() and not robot.trouble())
    if robot.trouble():
        raise LineInvalid(robot.trouble())
    if not car.is_locked():
        raise LineInvalid(
            f"The Car was still unlocked {parameters.lock_timeout_s:g} s after the robot had reached the starting "
            f"distance of {parameters.maximum_distance_m:g} m; lock it with its key, or increase maximum_distance_m if "
            "it locks farther away.")


def _approach(axis: Ray, watch: LineWatch, parameters: AutolockParameters, robot: Robot) -> None:
    robot.say("approach until the Car unlocks")
    watch.expect(Expected(LockState.UNLOCKED, PASSIVE_ENTRY, _VICINITY, robot.now_s))
    robot.go_to(axis, parameters.straightened_distance_m, Direction.FORWARD)
    robot.wait_until_reached(or_when=lambda: watch.answer)
    watch.ray = axis
    robot.set_maximum_speed(parameters.speed_on_axis_mps)
    if not watch.answer:
        robot.go_to(axis, parameters.minimum_distance_m, Direction.FORWARD)
        robot.wait_until_reached(or_when=lambda: watch.answer)
    robot.wait(parameters.response_timeout_s, or_when=lambda: watch.answer)


def _take_up(measured: _Measured, kept: Distance | None) -> None:
    if kept is not None:
        measured.distance, measured.status, measured.time_s = kept, LineStatus.OK, kept.robot_time_s


def _retreat(axis: Ray, watch: LineWatch, parameters: AutolockParameters, robot: Robot, is_unlocked: bool) -> None:
    robot.say("retreat until the Car locks")
    watch.ray = axis
    if is_unlocked:
        watch.expect(Expected(LockState.LOCKED, PASSIVE_ENTRY, _VICINITY, robot.now_s))
    else:
        watch.close()
    robot.go_to(axis, parameters.straightened_distance_m, Direction.BACKWARD)
    robot.wait_until_reached(or_when=lambda: watch.answer)
    robot.wait(parameters.response_timeout_s, or_when=lambda: watch.answer)
    # What a single frame says may be a glitch: the one before was followed by the retreat, this one by nothing.
    robot.wait(watch.confirmed_s - robot.now_s if watch.answer else 0.0)


def _record(measured: _Measured, watch: LineWatch, parameters: AutolockParameters,
            place_of: Callable[[CarEvent], Distance]) -> None:
    event = watch.answer
    if event is None:
        measured.status, measured.time_s = LineStatus.NOT_REACHED, watch.now_s
        return
    distance = place_of(event)
    watch.check_distance(distance, parameters.minimum_distance_m, parameters.maximum_distance_m,
                         parameters.maximum_speed_mps)
    measured.distance = replace(distance, source=event.source)
    measured.status, measured.time_s = LineStatus.OK, event.time_s


def _result(line: Axis, unlock: _Measured, lock: _Measured, trouble: LineInvalid | None) -> AutolockResult:
    axis = line.ray
    return AutolockResult(line.number, line.side, axis.origin_x, axis.origin_y, axis.direction_x, axis.direction_y,
                          reason=str(trouble or ""), evidence=trouble.evidence if trouble else (),
                          **_columns(UNLOCK, unlock), **_columns(LOCK, lock))


def _columns(word: str, measured: _Measured) -> dict[str, Any]:
    distance_m, uncertainty_m, robot_time_s = recorded_values(measured.distance)
    return {f"{word}_status": measured.status, f"{word}_distance_m": distance_m,
            f"{word}_uncertainty_m": uncertainty_m, f"{word}_robot_time_s": robot_time_s,
            **carried_values(f"{word}_", measured.distance)}


def _area(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]]) -> PointSet:
    points = tuple(None if distance.distance_m is None or distance.status is not LineStatus.OK
                   else ray.point(distance.distance_m) for ray, distance in measured)
    return PointSet(label, role, points, is_outline=True, bars=bars_along(measured))


def _not_reached(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]],
                 distance_m: float) -> PointSet:
    return PointSet(label, role, tuple(ray.point(distance_m) for ray, distance in measured
                                       if distance.status is LineStatus.NOT_REACHED))


SCENARIO = Autolock()
