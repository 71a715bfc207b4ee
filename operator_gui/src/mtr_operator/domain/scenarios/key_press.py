"""The Key press scenario: how far from the Car, by direction, a press of the Remote key's button still works."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

from ..actions.car import Car
from ..actions.distance import Distance, distance_to_outline
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..errors import InvalidParameter
from ..geometry.pose import Point
from ..geometry.radials import Radial, radials_around
from ..geometry.ray import Ray
from ..ports import PASSIVE_ENTRY, CarDimensions, CarEvent, Direction, LockState
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along
from ..scenario import REASON, Column, LineStatus, Measurement, Result, Scenario, distance_values
from .key_press_parameters import KeyPressParameters

LOCK_BUTTON, UNLOCK_BUTTON = 1, 2
# The press that changes the Car's present state: button and state that it should lead to.
_CHANGING_PRESS = {LockState.LOCKED: (UNLOCK_BUTTON, LockState.UNLOCKED),
                   LockState.UNLOCKED: (LOCK_BUTTON, LockState.LOCKED)}


@dataclass
class _Measured:
    """What is known of a radial."""

    status: LineStatus = LineStatus.INVALID
    success: Distance | None = None
    failure: Distance | None = None
    attempts: int = 0
    reason: str = ""


class KeyPress(Scenario[KeyPressParameters, Radial]):
    """Press a button from far to near until the Car obeys, on every radial."""

    name = "key_press"
    title = "Key press"
    line_word = "radial"
    lines_stay = True
    parameters_type = KeyPressParameters
    measurements = (Measurement("press", "status", "distance_m", "uncertainty_m"),)
    columns = (
        Column("radial", "", "number of the radial, clockwise from the Car's front"),
        Column("angle_deg", "deg", "angle of the radial, clockwise from the Car's front", digits=3),
        Column("status", "", "ok, not_reached or invalid"),
        Column("distance_m", "m", "Remote key from the Car's centre at the farthest press that worked"),
        Column("failed_distance_m", "m", "the next farther place that failed, empty if none; with not_reached the "
                                         "nearest place that failed"),
        Column("uncertainty_m", "m", "1 sigma of the distance"),
        Column("attempts", "", "presses on this radial"),
        Column("robot_time_s", "s", "robot's clock when the button of the press that worked went down", digits=3))

    def lines(self, parameters: KeyPressParameters, car: CarDimensions) -> list[Radial]:
        """Radials around the Car; the nearest place on each has to lie outside the Car."""
        radials = radials_around(parameters.angle_between_radials_rad)
        for radial in radials:
            gap_m = distance_to_outline(radial.ray, parameters.minimum_distance_m, car)
            if gap_m < parameters.clearance_m:
                raise InvalidParameter(
                    f"Parameter minimum_distance_m is {parameters.minimum_distance_m:g} m; on the radial of "
                    f"{radial.clockwise_deg:g} degrees that leaves {gap_m:.2f} m between Remote key and Car, and "
                    f"clearance_m, {parameters.clearance_m:g} m, has to remain.")
        return radials

    def measure(self, line: Radial, parameters: KeyPressParameters, robot: Robot, car: Car) -> Result:
        """The thesis' algorithm 1 for one radial."""
        measured = _Measured()
        robot.say(f"radial {line.number} ({line.clockwise_deg:g}\N{DEGREE SIGN}): go to the start")
        try:
            robot.go_to(line.ray, parameters.maximum_distance_m)
            robot.wait_until_reached()
            robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
            with robot.watched():
                for distance_m in parameters.press_distances_m:
                    robot.say(f"press at {distance_m:.2f} m")
                    robot.go_to(line.ray, distance_m, Direction.FORWARD)
                    robot.wait_until_reached()
                    if _press_here(line.ray, measured, parameters, robot, car):
                        break
                measured.status = LineStatus.NOT_REACHED if measured.success is None else LineStatus.OK
        except LineInvalid as error:
            measured.reason = str(error)
        return _result(line, measured)

    def picture(self, parameters: KeyPressParameters, car: CarDimensions, results: Sequence[Result]) -> Picture:
        """Radials, the outline of the places that worked, and the next ones that did not."""
        rays = {radial.number: radial.ray for radial in radials_around(parameters.angle_between_radials_rad)}
        measured = [(result, rays[result["radial"]]) for result in results]
        stretches = tuple(Stretch(ray.point(parameters.minimum_distance_m), ray.point(parameters.maximum_distance_m),
                                  self.place_of(result)) for result, ray in measured)
        invalid = tuple(ray.point(parameters.press_distances_m[0]) for result, ray in measured
                        if result["status"] == LineStatus.INVALID.value)
        return Picture(stretches, (
            PointSet("Press worked", PointRole.FIRST, _places(measured, "distance_m"), is_outline=True,
                     bars=bars_along(measured, "distance_m", "uncertainty_m")),
            PointSet("Press failed", PointRole.FAILED, _places(measured, "failed_distance_m")),
            PointSet("Invalid", PointRole.INVALID, invalid)))

    def expected_line_s(self, parameters: KeyPressParameters) -> float:
        """See Scenario: the Car is taken to react at the middle one of the places."""
        places = parameters.press_distances_m
        failed = len(places) // 2
        way_m = parameters.maximum_distance_m - places[failed]
        press_s = parameters.settle_time_s + parameters.press_duration_s
        waited_s = failed * parameters.attempts * (press_s + parameters.response_timeout_s) + press_s
        return way_m / parameters.maximum_speed_mps + waited_s

    def place_of(self, result: Result) -> str:
        """See Scenario."""
        return f"{result['angle_deg']:g}\N{DEGREE SIGN}"


def _press_here(radial: Ray, measured: _Measured, parameters: KeyPressParameters, robot: Robot, car: Car) -> bool:
    for _ in range(parameters.attempts):
        robot.wait(parameters.settle_time_s)
        button, expected = _CHANGING_PRESS[car.lock_state]
        measured.attempts += 1
        # Not since the press began: its clock and that of the bus agree to some milliseconds only.
        requested_s = robot.now_s
        press = robot.press(button, parameters.press_strength, parameters.press_duration_s)

        def reacted(state: LockState = expected, since_s: float = requested_s) -> CarEvent | None:
            return car.change_to(state, since_s)

        robot.wait(press.start_s + parameters.response_timeout_s - robot.now_s, or_when=reacted)
        place = robot.key_distance(radial, press.start_s, 0.0)
        event = reacted()
        if event is not None and event.source == PASSIVE_ENTRY:
            raise LineInvalid(f"The Car was {event.lock_state.value} by the vicinity of a key, not by the press at "
                              f"{place.distance_m:.2f} m; switch passive entry off, or increase minimum_distance_m.")
        if event is not None and event.time_s <= press.start_s + parameters.response_timeout_s:
            measured.success = place
            return True
        measured.failure = place
    return False


def _result(line: Radial, measured: _Measured) -> Result:
    distance_m, uncertainty_m, robot_time_s = (None, None, None) if measured.success is None else \
        distance_values(measured.success)
    return {"radial": line.number, "angle_deg": line.clockwise_deg, "status": measured.status.value,
            "distance_m": distance_m, "uncertainty_m": uncertainty_m, "robot_time_s": robot_time_s,
            "failed_distance_m": None if measured.failure is None else distance_values(measured.failure)[0],
            "attempts": measured.attempts, REASON: measured.reason}


def _places(measured: Sequence[tuple[Result, Ray]], column: str) -> tuple[Point | None, ...]:
    return tuple(None if result[column] is None else ray.point(result[column]) for result, ray in measured)


SCENARIO = KeyPress()
