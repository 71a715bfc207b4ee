"""Parameters of the Key press scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ..errors import InvalidParameter
from ..parameters import CENTIMETRES, DEGREE, KILOMETRES_PER_HOUR, parameter
from ..scenario import ScenarioParameters

# Rounding of repeated steps must not skip a press at exactly the minimum distance.
_ROUNDING_M = 1e-9


@dataclass(frozen=True)
class KeyPressParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's centre."""

    minimum_distance_m: float = parameter(3.0, 0.0, 20.0, "m", "Nearest place at which the button is pressed.")
    maximum_distance_m: float = parameter(6.5, 0.1, 50.0, "m", "Starting distance of each radial.")
    straightening_distance_m: float = parameter(
        0.5, 0.0, 20.0, "m", "First piece of the approach, to correct the heading; the first press is at its end.")
    approach_distance_m: float = parameter(0.5, 0.01, 20.0, "m", "Step towards the Car after a press without success.")
    angle_between_radials_rad: float = parameter(
        45.0, 1.0, 360.0, "deg", "Angle between neighbouring radials.", file_key="angle_between_radials_deg",
        si_per_unit=math.pi / 180.0, shown=(DEGREE, 1.0))
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.",
                                    shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    press_strength: float = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
    press_duration_s: float = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
    settle_time_s: float = parameter(0.3, 0.0, 60.0, "s", "Standstill before each press.")
    response_timeout_s: float = parameter(
        1.0, 0.1, 60.0, "s", "How long after the beginning of a press the Car may take to react.")
    attempts: int = parameter(1, 1, 20, "", "Presses at each place before it counts as failed.")
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

    @property
    def press_distances_m(self) -> list[float]:
        """Where the button is pressed, from far to near."""
        first = self.maximum_distance_m - self.straightening_distance_m
        steps = math.floor((first - self.minimum_distance_m + _ROUNDING_M) / self.approach_distance_m + _ROUNDING_M)
        return [first - step * self.approach_distance_m for step in range(steps + 1)]
