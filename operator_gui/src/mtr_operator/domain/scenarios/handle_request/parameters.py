"""Parameters of the Handle request scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...estimation.press.hypotheses import LF_FADING
from ...estimation.press.plan import RobotTimes, SearchPlan
from ...geometry.heights import check_heights, heights_between
from ...parameters import CENTIMETRES, parameter
from ...scenario import ScenarioParameters
from ..handle.fields import ALL_SIDES, DRIVERS_SIDE, ROUNDING_M, SIDES_FROM_DRIVERS, HandleFields, check_clearance

# From the request until an unlock is read and believed, as of a press; and the press that locks the Car again.
_ANSWER_S, _LOCKED_S = 0.4, 1.5
_MIN_PLACES = 3

_HANDLE = HandleFields()


@dataclass(frozen=True)
class HandleRequestParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    side: str = choice(
        (*SIDES_FROM_DRIVERS, ALL_SIDES), DRIVERS_SIDE,
        "Side or corner of the Car whose border is measured: that of the handle that is taken.")
    minimum_distance_m: float = parameter(0.5, 0.0, 20.0, "m", "Nearest place at which the handle is taken.")
    maximum_distance_m: float = parameter(4.0, 0.1, 50.0, "m", "Starting distance of each axis.")
    straightening_distance_m: float = parameter(
        0.5, 0.0, 20.0, "m", "First piece of the approach, to correct the heading; the farthest request is at its end.")
    measurements_distance_m: float = parameter(0.5, 0.05, 10.0, "m", "Distance between neighbouring axes of a side.")
    border_distance_m: float = parameter(
        1.5, 0.0, 50.0, "m", "Nominal border of the zone, where the first requests of each axis are made.")
    border_requests: int = parameter(
        2, 0, 50, "", "Requests at the nominal border on each axis before the border is searched; 0: only the search.")
    interval_m: float = parameter(
        0.15, 0.02, 5.0, "m", "Half the width of the 95 % interval of the border at which an axis ends.",
        shown=CENTIMETRES)
    attempts_limit: int = parameter(
        20, 6, 200, "", "Requests after which an axis ends although its interval is wider.")
    key_height_m: float = _HANDLE.key_height_m
    highest_key_height_m: float = parameter(
        1.4, 0.35, 1.55, "m", "Highest of the heights at which the border is measured, if there are several.",
        shown=CENTIMETRES)
    heights: int = parameter(1, 1, 5, "", "Heights at which the border is measured.")
    maximum_speed_mps: float = _HANDLE.maximum_speed_mps
    settle_time_s: float = _HANDLE.settle_time_s
    response_timeout_s: float = _HANDLE.response_timeout_s
    handle_timeout_s: float = _HANDLE.handle_timeout_s
    relock: str = _HANDLE.relock
    press_strength: float = _HANDLE.press_strength
    press_duration_s: float = _HANDLE.press_duration_s
    lock_timeout_s: float = _HANDLE.lock_timeout_s
    half_wavelength_m: float = parameter(
        0.35, 0.02, 2.0, "m", "Requests so far apart meet another field; half a wavelength of the Remote key's radio: "
        "0.35 m at 434 MHz, 0.17 m at 868 MHz.")
    key_rest_limit_s: float = _HANDLE.key_rest_limit_s
    clearance_m: float = _HANDLE.clearance_m

    def check(self) -> None:
        """Constraints between parameters."""
        low, high = self.minimum_distance_m, self.farthest_m
        check_clearance(self.minimum_distance_m, self.clearance_m)
        needed_m = _MIN_PLACES * self.half_wavelength_m
        if high - low < needed_m:
            raise InvalidParameter(
                f"Parameter minimum_distance_m leaves {high - low:.2f} m up to the first request at {high:g} m; the "
                f"search needs {needed_m:.2f} m.")
        if self.border_requests and not low <= self.border_distance_m <= high + ROUNDING_M:
            raise InvalidParameter(f"Parameter border_distance_m is {self.border_distance_m:g} m; allowed is {low:g} "
                                   f"to {high:g} m, where requests are made.")
        if self.border_requests > self.attempts_limit:
            raise InvalidParameter(f"Parameter border_requests is {self.border_requests}; allowed is at most "
                                   f"attempts_limit, {self.attempts_limit}.")
        check_heights(self.key_height_m, self.highest_key_height_m, self.heights)

    @property
    def farthest_m(self) -> float:
        """Farthest place at which the handle is taken."""
        return self.maximum_distance_m - self.straightening_distance_m

    @property
    def heights_m(self) -> list[float]:
        """From low to high."""
        return heights_between(self.key_height_m, self.highest_key_height_m, self.heights)

    @property
    def border_places_m(self) -> tuple[float, ...]:
        """Where the first requests of each axis are made."""
        return self.border_requests * (self.border_distance_m,)

    @property
    def search_plan(self) -> SearchPlan:
        """What is wanted of each axis; a request that works costs the press that locks the Car again.

        A zone does not follow the Car's outline: the simulated one ends 1.6 m beside the doors, 1.0 m off the corners.
        Its border is the end of a low-frequency field, which does not fade.
        """
        times = RobotTimes(self.maximum_speed_mps, settle_s=self.settle_time_s, answer_s=_ANSWER_S + _LOCKED_S,
                           timeout_s=self.response_timeout_s)
        return SearchPlan(self.minimum_distance_m, self.farthest_m, self.interval_m, self.attempts_limit,
                          self.half_wavelength_m, times, are_near=False, fading=LF_FADING)
