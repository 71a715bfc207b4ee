"""The Autolock scenario: where a Car unlocks when the Remote key comes near, and locks when it goes away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

from ..actions.car import Car
from ..actions.distance import Distance, outline_sigma, recorded_values
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..geometry.axes import Axis, axes_around
from ..geometry.ray import Ray
from ..ports import KEY_BUTTON, CarEvent, LockState
from ..requests import Direction
from ..results.line_result import LineStatus, MeasuredDistance
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along
from ..robot_status import CarDimensions
from ..scenario import Scenario
from .autolock_parameters import AutolockParameters
from .autolock_result import LOCK, UNLOCK, AutolockResult


@dataclass
class _Measured:
    """One of the two measurements on an axis."""

    status: LineStatus = LineStatus.INVALID
    distance: Distance | None = None


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
        unlock, lock, reason = _Measured(), _Measured(), ""
        axis, origin_sigma_m = line.ray, outline_sigma(line.ray, car.dimensions())
        try:
            _go_to_start(line, parameters, robot, car)
            with robot.watched():
                start_s = robot.now_s
                event = _approach(axis, start_s, parameters, robot, car)
                _record(unlock, event, axis, robot, origin_sigma_m)
                robot.keep(UNLOCK, unlock.status, unlock.distance)
                event = _retreat(axis, start_s if event is None else event.time_s, parameters, robot, car)
                _record(lock, event, axis, robot, origin_sigma_m)
                robot.keep(LOCK, lock.status, lock.distance)
        except LineInvalid as error:
            reason = str(error)
        return _result(line, unlock, lock, reason)

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


def _approach(axis: Ray, since_s: float, parameters: AutolockParameters, robot: Robot, car: Car) -> CarEvent | None:
    def is_unlocked() -> CarEvent | None:
        return car.change_to(LockState.UNLOCKED, since_s)

    robot.say("approach until the Car unlocks")
    robot.go_to(axis, parameters.straightened_distance_m, Direction.FORWARD)
    robot.wait_until_reached(or_when=is_unlocked)
    robot.set_maximum_speed(parameters.speed_on_axis_mps)
    if not is_unlocked():
        robot.go_to(axis, parameters.minimum_distance_m, Direction.FORWARD)
        robot.wait_until_reached(or_when=is_unlocked)
    return robot.wait(parameters.response_timeout_s, or_when=is_unlocked)


def _retreat(axis: Ray, since_s: float, parameters: AutolockParameters, robot: Robot, car: Car) -> CarEvent | None:
    def is_locked() -> CarEvent | None:
        return car.change_to(LockState.LOCKED, since_s)

    robot.say("retreat until the Car locks")
    robot.go_to(axis, parameters.straightened_distance_m, Direction.BACKWARD)
    robot.wait_until_reached(or_when=is_locked)
    return robot.wait(parameters.response_timeout_s, or_when=is_locked)


def _record(measured: _Measured, event: CarEvent | None, axis: Ray, robot: Robot, origin_sigma_m: float) -> None:
    if event is None:
        measured.status = LineStatus.NOT_REACHED
        return
    if event.source == KEY_BUTTON:
        raise LineInvalid(f"The Car was {event.lock_state.value} by the button of a key, not by the Remote key's "
                          "vicinity; leave the keys alone during the test.")
    measured.distance = robot.key_distance(axis, event.time_s, event.time_sigma_s, origin_sigma_m)
    measured.status = LineStatus.OK


def _result(line: Axis, unlock: _Measured, lock: _Measured, reason: str) -> AutolockResult:
    axis = line.ray
    return AutolockResult(line.number, line.side, axis.origin_x, axis.origin_y, axis.direction_x, axis.direction_y,
                          unlock.status, *recorded_values(unlock.distance),
                          lock.status, *recorded_values(lock.distance), reason)


def _area(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]]) -> PointSet:
    points = tuple(None if distance.distance_m is None or distance.status is not LineStatus.OK
                   else ray.point(distance.distance_m) for ray, distance in measured)
    return PointSet(label, role, points, is_outline=True, bars=bars_along(measured))


def _not_reached(label: str, role: PointRole, measured: Sequence[tuple[Ray, MeasuredDistance]],
                 distance_m: float) -> PointSet:
    return PointSet(label, role, tuple(ray.point(distance_m) for ray, distance in measured
                                       if distance.status is LineStatus.NOT_REACHED))


SCENARIO = Autolock()
