"""The Key press scenario: how far from the Car, by direction, a press of the Remote key's button still works."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Sequence

from ..actions.car import Car
from ..actions.distance import Distance, distance_to_outline, recorded_values
from ..actions.line_watch import LineWatch
from ..actions.lock_history import PRESS_SIGMA_S, Expected
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..errors import InvalidParameter
from ..geometry.pose import Point
from ..geometry.radials import Radial, radials_around
from ..geometry.ray import Ray
from ..ports import KEY_BUTTON, LockState
from ..requests import Direction
from ..results.carried import carried_values
from ..results.document import Texts
from ..results.line_result import LineStatus
from ..results.picture import Picture, PointRole, PointSet, Stretch, bars_along
from ..robot_status import CarDimensions
from ..scenario import Scenario
from .key_press_parameters import KeyPressParameters
from .key_press_result import PRESS, KeyPressResult

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
    evidence: Texts = ()


class KeyPress(Scenario[KeyPressParameters, Radial, KeyPressResult]):
    """Press a button from far to near until the Car obeys, on every radial."""

    name = "key_press"
    title = "Key press"
    line_word = "radial"
    lines_stay = True
    parameters_type = KeyPressParameters
    result_type = KeyPressResult
    distance_words = (PRESS,)

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

    def measure(self, line: Radial, parameters: KeyPressParameters, robot: Robot, car: Car) -> KeyPressResult:
        """The thesis' algorithm 1 for one radial."""
        measured = _Measured()
        robot.say(f"radial {line.number} ({line.clockwise_deg:g}\N{DEGREE SIGN}): go to the start")
        try:
            robot.go_to(line.ray, parameters.maximum_distance_m)
            robot.wait_until_reached()
            robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
            with robot.watched(parameters) as watch:
                for distance_m in parameters.press_distances_m:
                    robot.say(f"press at {distance_m:.2f} m")
                    robot.go_to(line.ray, distance_m, Direction.FORWARD)
                    robot.wait_until_reached()
                    if _press_here(line.ray, watch, measured, parameters, robot):
                        break
                measured.status = LineStatus.NOT_REACHED if measured.success is None else LineStatus.OK
        except LineInvalid as error:
            measured.reason, measured.evidence = str(error), error.evidence
        return _result(line, measured)

    def picture(self, parameters: KeyPressParameters, car: CarDimensions, results: Sequence[KeyPressResult]) -> Picture:
        """Radials, the outline of the places that worked, and the next ones that did not."""
        rays = {radial.number: radial.ray for radial in radials_around(parameters.angle_between_radials_rad)}
        measured = [(rays[result.radial], result) for result in results]
        stretches = tuple(Stretch(ray.point(parameters.minimum_distance_m), ray.point(parameters.maximum_distance_m),
                                  result.place) for ray, result in measured)
        worked = tuple(_place(ray, result.distance_m) for ray, result in measured)
        failed = tuple(_place(ray, result.failed_distance_m) for ray, result in measured)
        invalid = tuple(ray.point(parameters.press_distances_m[0]) for ray, result in measured
                        if result.status is LineStatus.INVALID)
        return Picture(stretches, (
            PointSet("Press worked", PointRole.FIRST, worked, is_outline=True,
                     bars=bars_along([(ray, result.distances[0]) for ray, result in measured])),
            PointSet("Press failed", PointRole.FAILED, failed),
            PointSet("Invalid", PointRole.INVALID, invalid)))

    def expected_line_s(self, parameters: KeyPressParameters) -> float:
        """See Scenario: the Car is taken to react at the middle one of the places."""
        places = parameters.press_distances_m
        failed = len(places) // 2
        way_m = parameters.maximum_distance_m - places[failed]
        press_s = parameters.settle_time_s + parameters.press_duration_s
        waited_s = failed * parameters.attempts * (press_s + parameters.response_timeout_s) + press_s
        return way_m / parameters.maximum_speed_mps + waited_s


def _press_here(radial: Ray, watch: LineWatch, measured: _Measured, parameters: KeyPressParameters,
                robot: Robot) -> bool:
    for _ in range(parameters.attempts):
        robot.wait(parameters.settle_time_s)
        button, expected = _CHANGING_PRESS[watch.lock_state]
        measured.attempts += 1
        # A change from here on to the press' beginning has another reason; when it begins is known when it is over.
        watch.hold()
        press = robot.press(button, parameters.press_strength, parameters.press_duration_s)
        place = robot.key_distance(radial, press.start_s, 0.0)
        watch.expect(Expected(expected, KEY_BUTTON, f"the press at {place.distance_m:.2f} m", press.start_s,
                              press.start_s + parameters.response_timeout_s, PRESS_SIGMA_S))
        watch.check_distance(place, parameters.minimum_distance_m, parameters.maximum_distance_m, 0.0)
        robot.wait(press.start_s + parameters.response_timeout_s - robot.now_s, or_when=lambda: watch.answer)
        if watch.answer is not None:
            robot.wait(watch.confirmed_s - robot.now_s)
            measured.success = replace(place, source=watch.answer.source)
            robot.keep(PRESS, LineStatus.OK, measured.success)
            return True
        watch.close()
        measured.failure = place
        robot.keep(PRESS, LineStatus.NOT_REACHED, place)
    return False


def _result(line: Radial, measured: _Measured) -> KeyPressResult:
    distance_m, uncertainty_m, robot_time_s = recorded_values(measured.success)
    return KeyPressResult(line.number, line.clockwise_deg, measured.status, distance_m,
                          recorded_values(measured.failure)[0], uncertainty_m, measured.attempts, robot_time_s,
                          measured.reason, evidence=measured.evidence, **carried_values("", measured.success))


def _place(ray: Ray, distance_m: float | None) -> Point | None:
    return None if distance_m is None else ray.point(distance_m)


SCENARIO = KeyPress()
