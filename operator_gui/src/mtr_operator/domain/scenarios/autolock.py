"""The Autolock scenario: where a Car unlocks when the Remote key comes near, and locks when it goes away."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

from ..actions.car import Car
from ..actions.distance import Distance, outline_sigma
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..geometry.axes import Axis, axes_around
from ..geometry.pose import Point
from ..geometry.ray import Ray
from ..ports import KEY_BUTTON, CarDimensions, CarEvent, Direction, LockState
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along
from ..scenario import REASON, Column, LineStatus, Measurement, Result, Scenario, distance_values
from .autolock_parameters import AutolockParameters

_MEASURED = {"unlock": "the Car unlocked", "lock": "the Car locked"}


@dataclass
class _Measured:
    """One of the two measurements on an axis."""

    status: LineStatus = LineStatus.INVALID
    distance: Distance | None = None


class Autolock(Scenario[AutolockParameters, Axis]):
    """Approach until the Car unlocks, retreat backwards until it locks, on every axis."""

    name = "autolock"
    title = "Autolock"
    line_word = "axis"
    parameters_type = AutolockParameters
    measurements = tuple(Measurement(name, f"{name}_status", f"{name}_distance_m", f"{name}_uncertainty_m")
                         for name in _MEASURED)
    columns = (
        Column("axis", "", "number of the axis, clockwise around the Car"),
        Column("side", "", "side or corner of the Car that the axis belongs to"),
        Column("origin_x_m", "m", "origin of the axis, Car coordinate system"),
        Column("origin_y_m", "m", "origin of the axis, Car coordinate system"),
        Column("direction_x", "", "unit vector of the axis away from the Car", digits=6),
        Column("direction_y", "", "unit vector of the axis away from the Car", digits=6),
        *(column for name, event in _MEASURED.items() for column in (
            Column(f"{name}_status", "", "ok, not_reached or invalid"),
            Column(f"{name}_distance_m", "m", f"Remote key from the Car's side or corner when {event}"),
            Column(f"{name}_uncertainty_m", "m", "1 sigma of the distance"),
            Column(f"{name}_robot_time_s", "s", f"robot's clock when {event}", digits=3))))

    def lines(self, parameters: AutolockParameters, car: CarDimensions) -> list[Axis]:
        """All axes of all sides and corners."""
        return axes_around(car, parameters.measurements_distance_m)

    def measure(self, line: Axis, parameters: AutolockParameters, robot: Robot, car: Car) -> Result:
        """The thesis' algorithm 2 for one axis."""
        unlock, lock, reason = _Measured(), _Measured(), ""
        axis, origin_sigma_m = line.ray, outline_sigma(line.ray, car.dimensions())
        try:
            _go_to_start(line, parameters, robot, car)
            with robot.watched():
                start_s = robot.now_s
                event = _approach(axis, start_s, parameters, robot, car)
                _record(unlock, event, axis, robot, origin_sigma_m)
                event = _retreat(axis, start_s if event is None else event.time_s, parameters, robot, car)
                _record(lock, event, axis, robot, origin_sigma_m)
        except LineInvalid as error:
            reason = str(error)
        return _result(line, unlock, lock, reason)

    def picture(self, parameters: AutolockParameters, car: CarDimensions, results: Sequence[Result]) -> Picture:
        """Axes, and the two areas that the points enclose."""
        rays = [(result, Ray(result["origin_x_m"], result["origin_y_m"], result["direction_x"], result["direction_y"]))
                for result in results]
        stretches = [Stretch(ray.point(parameters.minimum_distance_m), ray.point(parameters.maximum_distance_m),
                             str(result["axis"])) for result, ray in rays]
        ends = (("unlock", PointRole.FIRST, PointRole.FIRST_FAILED, parameters.minimum_distance_m),
                ("lock", PointRole.SECOND, PointRole.SECOND_FAILED, parameters.straightened_distance_m))
        sets = [PointSet(f"{name.capitalize()}ed", role, _outline(rays, name), is_outline=True,
                         bars=bars_along(rays, f"{name}_distance_m", f"{name}_uncertainty_m"))
                for name, role, _, _ in ends]
        for name, _, role, distance_m in ends:
            points = tuple(ray.point(distance_m) for result, ray in rays
                           if result[f"{name}_status"] == LineStatus.NOT_REACHED.value)
            sets.append(PointSet(f"{name.capitalize()} not reached", role, points))
        invalid = tuple(ray.point(parameters.straightened_distance_m) for result, ray in rays
                        if self.invalid_count(result))
        sets.append(PointSet("Invalid", PointRole.INVALID, invalid))
        return Picture(tuple(stretches), tuple(sets))

    def expected_line_s(self, parameters: AutolockParameters) -> float:
        """See Scenario: the Car is taken to unlock half way between the straightening's end and the minimum."""
        straight_m = parameters.straightened_distance_m - parameters.minimum_distance_m
        return (parameters.straightening_distance_m / parameters.maximum_speed_mps
                + straight_m / parameters.speed_on_axis_mps)

    def place_of(self, result: Result) -> str:
        """See Scenario."""
        return str(result["side"]).replace("_", " ")


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


def _result(line: Axis, unlock: _Measured, lock: _Measured, reason: str) -> Result:
    axis = line.ray
    result = {"axis": line.number, "side": line.side, "origin_x_m": axis.origin_x, "origin_y_m": axis.origin_y,
              "direction_x": axis.direction_x, "direction_y": axis.direction_y, REASON: reason}
    for name, measured in (("unlock", unlock), ("lock", lock)):
        values = (None, None, None) if measured.distance is None else distance_values(measured.distance)
        result.update(zip((f"{name}_distance_m", f"{name}_uncertainty_m", f"{name}_robot_time_s"), values))
        result[f"{name}_status"] = measured.status.value
    return result


def _outline(rays: Sequence[tuple[Result, Ray]], name: str) -> tuple[Point | None, ...]:
    return tuple(ray.point(result[f"{name}_distance_m"]) if result[f"{name}_status"] == LineStatus.OK.value else None
                 for result, ray in rays)


SCENARIO = Autolock()
