"""Parameters of the Zone map scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ...errors import InvalidParameter
from ...geometry.heights import check_heights, heights_between
from ...parameters import CENTIMETRES, DEGREE, KILOMETRES_PER_HOUR, parameter
from ...scenario import ScenarioParameters


@dataclass(frozen=True)
class ZoneMapParameters(ScenarioParameters):
    """Distances are those of the Remote key from the Car's outline, away from its centre."""

    minimum_distance_m: float = parameter(0.5, 0.0, 20.0, "m", "Nearest places of the map.")
    maximum_distance_m: float = parameter(6.0, 0.1, 50.0, "m", "Farthest places of the map.")
    spacing_m: float = parameter(0.5, 0.1, 5.0, "m", "Distance between neighbouring places away from the Car.")
    angle_between_radials_rad: float = parameter(
        15.0, 5.0, 45.0, "deg", "Angle between neighbouring radials.", file_key="angle_between_radials_deg",
        si_per_unit=math.pi / 180.0, shown=(DEGREE, 1.0))
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.", shown=CENTIMETRES)
    highest_key_height_m: float = parameter(
        1.4, 0.35, 1.55, "m", "Highest of the heights at which the map is made, if there are several.",
        shown=CENTIMETRES)
    heights: int = parameter(1, 1, 5, "", "Heights at which the map is made.")
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    press_strength: float = parameter(1.0, 0.05, 1.0, "", "Travel of the button: 1 is pressed down fully.")
    press_duration_s: float = parameter(0.3, 0.05, 5.0, "s", "How long the button is held down.")
    settle_time_s: float = parameter(0.3, 0.0, 60.0, "s", "Standstill before each press.")
    response_timeout_s: float = parameter(
        1.0, 0.1, 60.0, "s", "How long after the beginning of a press the Car may take to react.")
    coverage_percent: float = parameter(
        10.0, 1.0, 50.0, "%", "Half the width of the 95 % interval of a zone's coverage at which the zone ends.")
    presses_limit: int = parameter(16, 6, 100, "", "Presses in a zone after which it ends anyway.")
    half_wavelength_m: float = parameter(
        0.35, 0.02, 2.0, "m", "Half a wavelength of the Remote key's radio: 0.35 m at 434 MHz, 0.17 m at 868 MHz.")
    clearance_m: float = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")

    def check(self) -> None:
        """Constraints between parameters."""
        low, high = self.minimum_distance_m, self.maximum_distance_m
        if low >= high:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; it has to be below "
                                   f"maximum_distance_m, {high:g} m.")
        if low < self.clearance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; allowed is clearance_m, "
                                   f"{self.clearance_m:g} m, and more.")
        check_heights(self.key_height_m, self.highest_key_height_m, self.heights)

    @property
    def heights_m(self) -> list[float]:
        """From low to high."""
        return heights_between(self.key_height_m, self.highest_key_height_m, self.heights)

    @property
    def distances_m(self) -> list[float]:
        """From near to far."""
        count = math.floor((self.maximum_distance_m - self.minimum_distance_m) / self.spacing_m + 1e-9) + 1
        return [self.minimum_distance_m + index * self.spacing_m for index in range(count)]
