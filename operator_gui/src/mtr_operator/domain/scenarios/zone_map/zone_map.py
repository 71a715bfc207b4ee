"""The Zone map scenario: where around the Car presses of the Remote key work, as a map with its uncertainty."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Sequence

import numpy as np

from ...actions.car import Car
from ...actions.distance import Distance
from ...actions.pose_history import worst_sigma
from ...actions.robot import Robot
from ...actions.trouble import LineInvalid, LineLeft
from ...estimation.field.zone_search import ZoneSearch
from ...estimation.interval import FloatArray
from ...estimation.press.radial_search import PRESSES_IN_DOUBT
from ...forecast import Forecast
from ...geometry.pose import Point, Pose
from ...interfaces.scenario_parts import Forecasting, Judging, StartChecks
from ...ports import LockFacts
from ...results.document import Texts
from ...results.line_result import LineStatus
from ...results.picture import Picture
from ...robot_status import CarDimensions
from ...scenario import Scenario
from ...supervision.announcements import BUTTONS
from ..line_search.silence import MAX_SILENT_LINES, ask_when_lasting
from ..press.button import press_once
from .field import boundaries, place_array, search_in
from .forecast import MOVE_S, cautions_of, forecast_of, press_s
from .map_picture import picture_of
from .parameters import ZoneMapParameters
from .result import REACH, ZoneMapResult
from .zones import Place, Zone, zones_around

# A place that cannot be reached or pressed at is left out; so many of them, and the zone is measured again.
_MAX_TROUBLES = 3
_PLACES_DIGITS = 4
_ROUNDING_M = 1e-6
_SILENCE = ("No press worked in this zone, not at its nearest places either: the key sleeps, its battery is empty, or "
            "the Car's range ends nearer; then decrease minimum_distance_m.")
_LASTING_SILENCE = (
    f"The key has answered nowhere in {MAX_SILENT_LINES} zones one after the other; see whether it sleeps, whether its "
    "battery is empty and whether it is the Car's key, then continue the test, or begin one with a smaller "
    "minimum_distance_m.")


@dataclass
class _Measured:
    """What is known of a zone."""

    worked: list[Point] = field(default_factory=list)
    failed: list[Point] = field(default_factory=list)
    pressed: list[Place] = field(default_factory=list)
    sigma_m: float = 0.0
    reason: str = ""
    evidence: Texts = ()

    def take(self, place: Place, made: Distance, worked: bool) -> None:
        """Note a press."""
        self.pressed.append(place)
        x, y = place.ray.point(made.distance_m)
        (self.worked if worked else self.failed).append((round(x, _PLACES_DIGITS), round(y, _PLACES_DIGITS)))
        self.sigma_m = worst_sigma((self.sigma_m, made.uncertainty_m))


class ZoneMap(Scenario[ZoneMapParameters, Zone, ZoneMapResult], StartChecks, Judging, Forecasting):
    """Press a button where it tells most, in every zone around the Car, and draw the map of where it works."""

    name = "zone_map"
    title = "Zone map"
    line_word = "zone"
    parameters_type = ZoneMapParameters
    result_type = ZoneMapResult
    distance_words = (REACH,)
    announcement = BUTTONS

    def lines(self, parameters: ZoneMapParameters, car: CarDimensions) -> list[Zone]:
        """All zones at all heights."""
        return zones_around(parameters, car)

    def measure(self, line: Zone, parameters: ZoneMapParameters, robot: Robot, car: Car) -> ZoneMapResult:
        """Press where it tells most per second until the zone's coverage is known well enough."""
        measured = _Measured()
        earlier = [result for result in robot.results if isinstance(result, ZoneMapResult)]
        search = search_in(line, parameters, car.dimensions(), earlier)
        robot.say(f"zone {line.number} ({line.side.replace('_', ' ')})")
        try:
            robot.move_key_to(line.height_m)
            _search(search, line, measured, (parameters, robot, car))
        except LineInvalid as error:
            measured.reason, measured.evidence = str(error), error.evidence
        else:
            if not measured.worked:
                ask_when_lasting(line.number, earlier, lambda result: result.is_silent, _LASTING_SILENCE)
                measured.reason = _SILENCE
        return _result(line, measured, search, parameters, car.dimensions())

    def picture(self, parameters: ZoneMapParameters, car: CarDimensions, results: Sequence[ZoneMapResult]) -> Picture:
        """See picture_of."""
        return picture_of(parameters, car, results)

    def cautions(self, parameters: ZoneMapParameters, facts: LockFacts) -> Sequence[str]:
        return tuple(cautions_of(parameters))

    def forecast(self, parameters: ZoneMapParameters, facts: LockFacts, results: Sequence[ZoneMapResult]) -> Forecast:
        return forecast_of(parameters, results)

    def judged_shares(self, parameters: ZoneMapParameters) -> tuple[int, ...]:
        return (50,)

    def unreached(self, parameters: ZoneMapParameters, result: ZoneMapResult,
                  word: str) -> tuple[float | None, float | None]:
        """The results say themselves to which side they are not bounded; one of places that nobody knows
        well has neither end, also where the presses work as far as they were tried."""
        return None, None

    def expected_line_s(self, parameters: ZoneMapParameters) -> float:
        """No zone takes more presses than allowed, and few take fewer."""
        return parameters.presses_limit * press_s(parameters)


def _search(search: ZoneSearch, zone: Zone, measured: _Measured,
            means: tuple[ZoneMapParameters, Robot, Car]) -> None:
    parameters, robot, car = means
    troubles = 0
    left_out: set[int] = set()
    while True:
        if not search.is_finished(parameters.coverage_percent / 100.0, parameters.presses_limit):
            index = search.next_place(lambda places: _seconds(places, left_out, parameters, robot))
        elif measured.worked or not _is_in_doubt(zone, measured, left_out):
            return
        else:
            index = _nearest_places(zone, measured, left_out)[0]
        place = zone.places[index]
        try:
            made, worked = _press_at(place, parameters, robot, len(measured.worked) + len(measured.failed) + 1)
        except LineLeft:
            raise
        except LineInvalid:
            troubles += 1
            left_out.add(index)
            if troubles >= _MAX_TROUBLES:
                raise
            continue
        measured.take(place, made, worked)
        search.add(place_array(place.ray, made.distance_m, zone.height_m, car.dimensions()), worked)


def _is_in_doubt(zone: Zone, measured: _Measured, left_out: set[int]) -> bool:
    """True while a zone in which nothing worked has not been pressed in often enough at its nearest places."""
    nearest = _nearest_places(zone, measured, left_out)
    pressed = sum(measured.pressed.count(zone.places[index]) for index in nearest)
    return bool(nearest) and pressed < PRESSES_IN_DOUBT


def _nearest_places(zone: Zone, measured: _Measured, left_out: set[int]) -> list[int]:
    """Indices of those that can be reached, the ones pressed at least often first."""
    nearest_m = min(place.distance_m for place in zone.places)
    nearest = [index for index, place in enumerate(zone.places)
               if place.distance_m <= nearest_m + _ROUNDING_M and index not in left_out]
    return sorted(nearest, key=lambda index: measured.pressed.count(zone.places[index]))


def _press_at(place: Place, parameters: ZoneMapParameters, robot: Robot, number: int) -> tuple[Distance, bool]:
    robot.say(f"press at {place.distance_m:.2f} m")
    robot.go_to(place.ray, place.distance_m)
    robot.wait_until_reached()
    robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
    with robot.watched(parameters) as watch:
        robot.wait(parameters.settle_time_s)
        made = press_once(place.ray, watch, parameters, robot, f"{REACH} {number}")
    return made.place, made.worked


def _seconds(places: FloatArray, left_out: set[int], parameters: ZoneMapParameters, robot: Robot) -> FloatArray:
    """That a press at each place is expected to take; without end at those that are left out."""
    status = robot.status
    key_x, key_y = Pose(status.x, status.y, status.heading).apply((status.key_x, status.key_y))
    ways_m = np.hypot(places[:, 0] - key_x, places[:, 1] - key_y)
    tried_s = parameters.settle_time_s + parameters.press_duration_s + parameters.response_timeout_s
    seconds = ways_m / parameters.maximum_speed_mps + (ways_m > 0.0) * MOVE_S + tried_s
    seconds[sorted(left_out)] = math.inf
    return np.asarray(seconds)


def _result(zone: Zone, measured: _Measured, search: ZoneSearch, parameters: ZoneMapParameters,
            car: CarDimensions) -> ZoneMapResult:
    worked_x, worked_y = _columns(measured.worked)
    failed_x, failed_y = _columns(measured.failed)
    result = ZoneMapResult(
        zone.number, zone.side, zone.height_m, LineStatus.INVALID, len(worked_x) + len(failed_x),
        reason=measured.reason, worked_x_m=worked_x, worked_y_m=worked_y, failed_x_m=failed_x, failed_y_m=failed_y,
        evidence=measured.evidence)
    if measured.reason:
        return result
    distance_m, low_m, high_m = map(_rounded, boundaries(search, zone.ray, zone.height_m, parameters, car))
    if math.isnan(measured.sigma_m):
        # Nobody knows how far the places were from where they are in the map.
        low_m = high_m = None
    part = search.coverage()
    return replace(result, status=LineStatus.NOT_REACHED if distance_m is None else LineStatus.OK,
                   distance_m=distance_m, low_m=low_m, high_m=high_m,
                   uncertainty_m=None if distance_m is None else _rounded(measured.sigma_m),
                   coverage=_rounded(part.value_m), coverage_low=_rounded(part.low_m),
                   coverage_high=_rounded(part.high_m))


def _columns(points: Sequence[Point]) -> tuple[tuple[float, ...], tuple[float, ...]]:
    return tuple(x for x, _ in points), tuple(y for _, y in points)


def _rounded(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else round(value, 6)


SCENARIO = ZoneMap()
