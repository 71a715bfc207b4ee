"""Parameters of the Key press scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..choice import choice
from ..errors import InvalidParameter
from ..estimation.press.plan import RobotTimes, SearchPlan
from ..parameters import CENTIMETRES, DEGREE, KILOMETRES_PER_HOUR, parameter
from ..scenario import ScenarioParameters
from .key_press_result import ADAPTIVE, SCAN

# Rounding of repeated steps must not skip a press at exactly the minimum distance.
_ROUNDING_M = 1e-9
_LIGHT_MPS = 299_792_458.0
_HZ_PER_MHZ = 1e6
# From the end of the settling until the event of a press that works is read and believed; measured in the demo.
_ANSWER_S = 0.4
# What a press that fails takes beside the response time: the order's way to the servo.
_ORDER_S = 0.1
_MIN_PLACES = 3
# The outermost distance at which the ground's reflection cancels the wave is the product of both heights by half the
# wavelength (plane earth); no Receiver is higher than this, and the null ends so much farther out.
_RECEIVER_M, _NULLS_END = 1.6, 1.25
_ONLY_SCAN, _ONLY_ADAPTIVE = ("method", SCAN), ("method", ADAPTIVE)


@dataclass(frozen=True)
class KeyPressParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's centre."""

    method: str = choice(
        (SCAN, ADAPTIVE), ADAPTIVE, "adaptive: search for the distances at which 50 and 95 % of the presses work, with "
        "their intervals. scan: from far to near until a press works, as the thesis does; it reads too far where the "
        "Car's range is no sharp border.")
    minimum_distance_m: float = parameter(3.0, 0.0, 20.0, "m", "Nearest place at which the button is pressed.")
    maximum_distance_m: float = parameter(6.5, 0.1, 50.0, "m", "Starting distance of each radial.")
    straightening_distance_m: float = parameter(
        0.5, 0.0, 20.0, "m", "First piece of the approach, to correct the heading; the first press is at its end.")
    approach_distance_m: float = parameter(
        0.5, 0.01, 20.0, "m", "Step towards the Car after a press without success.", only=_ONLY_SCAN)
    angle_between_radials_rad: float = parameter(
        45.0, 1.0, 360.0, "deg", "Angle between neighbouring radials.", file_key="angle_between_radials_deg",
        si_per_unit=math.pi / 180.0, shown=(DEGREE, 1.0))
    interval_m: float = parameter(
        0.25, 0.05, 5.0, "m", "Half the width of the 95 % interval of the distance at which a radial ends.",
        only=_ONLY_ADAPTIVE)
    attempts_limit: int = parameter(
        24, 6, 200, "", "Presses after which a radial ends although its interval is wider.", only=_ONLY_ADAPTIVE)
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.",
                                    shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    press_strength: float = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
    press_duration_s: float = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
    settle_time_s: float = parameter(0.3, 0.0, 60.0, "s", "Standstill before each press.")
    response_timeout_s: float = parameter(
        1.0, 0.1, 60.0, "s", "How long after the beginning of a press the Car may take to react.")
    attempts: int = parameter(1, 1, 20, "", "Presses at each place before it counts as failed.", only=_ONLY_SCAN)
    confirming_presses: int = parameter(
        1, 0, 20, "", "Presses at the place of one that worked; unless one of them works too, another key or a late "
        "answer may have been taken for it, and the place counts as failed. 0: none, as the thesis does.",
        only=_ONLY_SCAN)
    key_frequency_hz: float = parameter(
        433.92, 100.0, 10_000.0, "MHz", "Radio frequency of the Remote key: presses half a wavelength apart meet "
        "another fading.", file_key="key_frequency_mhz", si_per_unit=_HZ_PER_MHZ, only=_ONLY_ADAPTIVE)
    key_rest_limit_s: float = parameter(
        45.0, 5.0, 55.0, "s", "Standstill after which the Remote key is moved before it is pressed, so that it does "
        "not sleep.", only=_ONLY_ADAPTIVE)
    clearance_m: float = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")

    def check(self) -> None:
        """Constraints between parameters."""
        low, high = self.minimum_distance_m, self.maximum_distance_m
        if low > high:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; allowed is at most "
                                   f"maximum_distance_m, {high:g} m.")
        if self.straightening_distance_m > high - low + _ROUNDING_M:
            raise InvalidParameter(
                f"Parameter straightening_distance_m is {self.straightening_distance_m:g} m; allowed is at most "
                f"maximum_distance_m - minimum_distance_m, {high - low:g} m.")
        if self.method == ADAPTIVE:
            self._check_search()

    def _check_search(self) -> None:
        """A search needs several places whose fading says nothing of each other."""
        plan = self.search_plan
        span_m, needed_m = plan.maximum_m - plan.minimum_m, _MIN_PLACES * plan.half_wavelength_m
        if span_m < needed_m:
            raise InvalidParameter(
                f"Parameter minimum_distance_m leaves {span_m:.2f} m up to the first press at {plan.maximum_m:g} m; "
                f"the method adaptive needs {needed_m:.2f} m.")

    @property
    def search_plan(self) -> SearchPlan:
        """What is wanted of each radial with the method adaptive."""
        times = RobotTimes(self.maximum_speed_mps, settle_s=self.settle_time_s, answer_s=_ANSWER_S,
                           timeout_s=_ORDER_S + self.response_timeout_s)
        half_wavelength_m = _LIGHT_MPS / (2.0 * self.key_frequency_hz)
        return SearchPlan(self.minimum_distance_m, self.press_distances_m[0], self.interval_m, self.attempts_limit,
                          half_wavelength_m, times, _NULLS_END * self.key_height_m * _RECEIVER_M / half_wavelength_m)

    @property
    def press_distances_m(self) -> list[float]:
        """Where the button is pressed, from far to near."""
        first = self.maximum_distance_m - self.straightening_distance_m
        steps = math.floor((first - self.minimum_distance_m + _ROUNDING_M) / self.approach_distance_m + _ROUNDING_M)
        return [first - step * self.approach_distance_m for step in range(steps + 1)]
