"""Parameters of the Digital key scenario."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ...choice import choice
from ...errors import InvalidParameter
from ...parameters import CENTIMETRES, DEGREE, KILOMETRES_PER_HOUR, parameter
from ...scenario import ScenarioParameters

OUTLINE, ANCHOR = "outline", "anchor"
_OF_ANCHOR = ("reference", ANCHOR)


@dataclass(frozen=True)
class DigitalKeyParameters(ScenarioParameters):
    """Places are by the distance of the phone, which is the Remote key here, from the Car's outline on radials."""

    minimum_distance_m: float = parameter(0.5, 0.0, 20.0, "m", "Nearest places at which the distance is read.")
    maximum_distance_m: float = parameter(4.5, 0.1, 20.0, "m", "Farthest places at which the distance is read.")
    spacing_m: float = parameter(1.0, 0.1, 10.0, "m", "Distance between neighbouring places away from the Car.")
    angle_between_radials_rad: float = parameter(
        30.0, 5.0, 90.0, "deg", "Angle between neighbouring radials.", file_key="angle_between_radials_deg",
        si_per_unit=math.pi / 180.0, shown=(DEGREE, 1.0))
    key_height_m: float = parameter(1.0, 0.35, 1.55, "m", "Height of the Remote key above ground.", shown=CENTIMETRES)
    maximum_speed_mps: float = parameter(1.0, 0.05, 2.0, "m/s", "Speed limit on the whole way.",
                                         shown=KILOMETRES_PER_HOUR)
    stand_time_s: float = parameter(1.0, 0.0, 60.0, "s", "Standstill before the distance is read.")
    reading_time_s: float = parameter(5.0, 0.5, 55.0, "s", "How long the distance is read at each place.")
    minimum_samples: int = parameter(
        3, 2, 1000, "", "Minimum number of reported distances at a place, and of changes among them; at least 4 "
                        "changes are needed in any case.")
    maximum_age_s: float = parameter(
        1.0, 0.2, 30.0, "s", "Longest time for which the newest reported distance may stand; a place where it is "
                             "older is invalid.")
    resolution_m: float = parameter(0.01, 0.0, 1.0, "m", "Step of the reported distances.", shown=CENTIMETRES)
    reference: str = choice(
        (OUTLINE, ANCHOR), OUTLINE,
        "What the reported distance is compared with. outline: the shortest way from the phone to the Car's outline, "
        "over ground. anchor: the straight way to a point of the Car, with the difference in height.")
    anchor_x_m: float = parameter(0.0, -15.0, 15.0, "m", "The anchor, ahead of the Car's centre.", only=_OF_ANCHOR)
    anchor_y_m: float = parameter(0.0, -5.0, 5.0, "m", "The anchor, to the left of the Car's centre.", only=_OF_ANCHOR)
    anchor_height_m: float = parameter(1.0, 0.0, 4.0, "m", "Height of the anchor above ground.", shown=CENTIMETRES,
                                       only=_OF_ANCHOR)
    clearance_m: float = parameter(0.3, 0.0, 5.0, "m", "Gap that has to remain between Remote key and Car.")

    def check(self) -> None:
        """Constraints between parameters."""
        low, high = self.minimum_distance_m, self.maximum_distance_m
        if low > high:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; it has to be at most "
                                   f"maximum_distance_m, {high:g} m.")
        if low < self.clearance_m:
            raise InvalidParameter(f"Parameter minimum_distance_m is {low:g} m; allowed is clearance_m, "
                                   f"{self.clearance_m:g} m, and more.")
        if self.maximum_age_s > self.reading_time_s:
            raise InvalidParameter(f"Parameter maximum_age_s is {self.maximum_age_s:g} s; it has to be at most "
                                   f"reading_time_s, {self.reading_time_s:g} s.")

    @property
    def distances_m(self) -> list[float]:
        """From near to far."""
        count = math.floor((self.maximum_distance_m - self.minimum_distance_m) / self.spacing_m + 1e-9) + 1
        return [self.minimum_distance_m + index * self.spacing_m for index in range(count)]
