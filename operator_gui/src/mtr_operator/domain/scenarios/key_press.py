"""The Key press scenario: how far from the Car, by direction, a press of the Remote key's button still works."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass
from typing import Generator, Sequence

from ..actions.car import Car
from ..actions.distance import Distance, distance_to_outline, recorded_values
from ..actions.line_watch import LineWatch
from ..actions.robot import Robot
from ..actions.trouble import LineInvalid
from ..errors import InvalidParameter
from ..forecast import Forecast
from ..geometry.radials import Radial, radials_around
from ..geometry.ray import Ray
from ..interfaces.scenario_parts import Concluding, Forecasting, FurtherAttempts, Judging, Resuming, StartChecks
from ..ports import LockFacts
from ..requests import Direction
from ..results.carried import carried_values
from ..results.document import Texts
from ..results.line_result import LineStatus
from ..results.picture import Picture
from ..robot_status import CarDimensions
from ..scenario import Scenario
from ..supervision.announcements import BUTTONS
from .key_press_parameters import KeyPressParameters
from .key_press_result import ADAPTIVE, CONFIRMING, PRESS, KeyPressResult
from .line_search import campaign, forecast, search
from .line_search.result import SHARES
from .line_search.silence import ask_when_lasting
from .press.button import press_once
from .press.picture import picture_of
from .press.radial import LASTING_SILENCE, LIMITS, WIDTHS, RadialTrial
from .press.scan_forecast import scan_forecast, scan_s


@dataclass
class _Measured:
    """What is known of a radial."""

    status: LineStatus = LineStatus.INVALID
    success: Distance | None = None
    failure: Distance | None = None
    attempts: int = 0
    reason: str = ""
    evidence: Texts = ()


class KeyPress(Scenario[KeyPressParameters, Radial, KeyPressResult],
               StartChecks, Resuming, FurtherAttempts, Concluding, Judging, Forecasting):
    """Press a button on every radial, and find from how far the Car obeys."""

    name = "key_press"
    title = "Key press"
    line_word = "radial"
    lines_stay = True
    parameters_type = KeyPressParameters
    result_type = KeyPressResult
    distance_words = (PRESS,)
    announcement = BUTTONS

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
        """A search, or the thesis' algorithm 1."""
        if parameters.method == ADAPTIVE:
            return search.measure_by_search(RadialTrial(line, parameters), robot)
        return _scan(line, parameters, robot)

    def can_go_on(self, line: Radial, parameters: KeyPressParameters, robot: Robot, car: Car) -> bool:
        """A search goes on with the presses that are kept."""
        return parameters.method == ADAPTIVE and search.can_go_on(RadialTrial(line, parameters), robot)

    def measure_further(self, line: Radial, parameters: KeyPressParameters, robot: Robot, car: Car,
                        so_far: KeyPressResult) -> KeyPressResult | None:
        """A search goes on after its end."""
        if so_far.method != ADAPTIVE:
            return None
        return search.measure_further(RadialTrial(line, parameters), robot, so_far)

    def share_of_most(self, parameters: KeyPressParameters, result: KeyPressResult) -> float | None:
        return search.share_of_most(parameters, result)

    def looked(self, parameters: KeyPressParameters, results: Sequence[KeyPressResult],
               number: int) -> Generator[None, None, KeyPressResult]:
        return campaign.looked(parameters.search_plan, results, number)

    def cautions(self, parameters: KeyPressParameters, facts: LockFacts) -> Sequence[str]:
        if parameters.method != ADAPTIVE:
            return ()
        return tuple(forecast.cautions(parameters.search_plan, WIDTHS, LIMITS))

    def forecast(self, parameters: KeyPressParameters, facts: LockFacts,
                 results: Sequence[KeyPressResult]) -> Forecast:
        if parameters.method == ADAPTIVE:
            return forecast.search_forecast(parameters.search_plan, WIDTHS, results)
        return scan_forecast(parameters, results)

    def unreached(self, parameters: KeyPressParameters, result: KeyPressResult,
                  word: str) -> tuple[float | None, float | None]:
        """The results of a search say themselves to which side they are not bounded."""
        return (None, None) if result.was_searched else super().unreached(parameters, result, word)

    def measurand(self, parameters: KeyPressParameters, result: KeyPressResult, word: str) -> str:
        """A scan tells the farthest place at which one of so many presses worked."""
        return "" if result.was_searched else f"place where one of {parameters.attempts} presses worked"

    def judged_shares(self, parameters: KeyPressParameters) -> tuple[int, ...]:
        return SHARES if parameters.method == ADAPTIVE else ()

    def concluded(self, parameters: KeyPressParameters, results: Sequence[KeyPressResult]) -> Sequence[KeyPressResult]:
        """What radials measured later say of the transition counts for the earlier ones too."""
        return campaign.concluded(parameters.search_plan, results) if parameters.method == ADAPTIVE else ()

    def picture(self, parameters: KeyPressParameters, car: CarDimensions, results: Sequence[KeyPressResult]) -> Picture:
        """See picture_of."""
        return picture_of(parameters, results)

    def expected_line_s(self, parameters: KeyPressParameters) -> float:
        """A scan's Car is taken to react at the middle one of the places."""
        if parameters.method == ADAPTIVE:
            return sum(forecast.search_forecast(parameters.search_plan, WIDTHS, ()).line_s) / 2.0
        return scan_s(parameters, len(parameters.press_distances_m) // 2)


def _scan(line: Radial, parameters: KeyPressParameters, robot: Robot) -> KeyPressResult:
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
    result = _result(line, measured)
    if result.status is LineStatus.NOT_REACHED:
        earlier = [each for each in robot.results if isinstance(each, KeyPressResult)]
        ask_when_lasting(line.number, earlier, lambda each: each.status is LineStatus.NOT_REACHED, LASTING_SILENCE)
    return result


def _press_here(radial: Ray, watch: LineWatch, measured: _Measured, parameters: KeyPressParameters,
                robot: Robot) -> bool:
    for _ in range(parameters.attempts):
        robot.wait(parameters.settle_time_s)
        measured.attempts += 1
        made = press_once(radial, watch, parameters, robot, PRESS)
        if made.worked and _is_confirmed(radial, watch, measured, parameters, robot):
            measured.success = made.place
            return True
    # A place at which one of the attempts works is none at which they fail.
    measured.failure = made.place
    return False


def _is_confirmed(radial: Ray, watch: LineWatch, measured: _Measured, parameters: KeyPressParameters,
                  robot: Robot) -> bool:
    """Another key of the same Car names the cause that this one would: only a second press tells them apart."""
    for _ in range(parameters.confirming_presses):
        robot.wait(parameters.settle_time_s)
        measured.attempts += 1
        if press_once(radial, watch, parameters, robot, CONFIRMING).worked:
            return True
    return not parameters.confirming_presses


def _result(line: Radial, measured: _Measured) -> KeyPressResult:
    distance_m, uncertainty_m, robot_time_s = recorded_values(measured.success)
    return KeyPressResult(line.number, line.clockwise_deg, measured.status, distance_m,
                          recorded_values(measured.failure)[0], uncertainty_m, measured.attempts, robot_time_s,
                          measured.reason, evidence=measured.evidence, **carried_values("", measured.success))


SCENARIO = KeyPress()
